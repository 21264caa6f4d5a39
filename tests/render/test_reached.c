/* What the water leaves behind: wet ground and walls, and the greatest depth on them. */
#include "box.h"

#include "base/memory.h"
#include "render/overlay/overlay.h"
#include "render/renderer.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 240, HEIGHT = 180 };

/* A camera 22 m before a wall whose face is at x = 2 m, on ground at z = 0. */
struct stage {
    sb_camera_key key;
    sb_camera camera;
    sb_scene scene;
    sb_model_body bodies[2];
    sb_model model;
};

static void set_stage(struct stage *stage, sb_vec3 eye)
{
    memset(stage, 0, sizeof *stage);
    stage->key = (sb_camera_key){.eye = eye, .target = sb_vec(2, 0, 3), .fov = 60};
    stage->camera = (sb_camera){.name = "front", .key_count = 1, .keys = &stage->key};
    stage->scene.fluid.gravity = 9.81;
    stage->scene.sea.level = -1;
    stage->scene.render = (sb_render_settings){
        .width = WIDTH, .height = HEIGHT, .speed_max = 10, .camera_count = 1, .cameras = &stage->camera};
    stage->model.min = sb_vec(-20, -20, -10);
    stage->model.max = sb_vec(20, 20, 10);
    stage->model.bodies = stage->bodies;
    stage->model.body_count = 2;
    for (int b = 0; b < 2; b++) {
        strcpy(stage->bodies[b].name, b ? "wall" : "ground");
        stage->bodies[b].color[0] = -1;
        stage->bodies[b].wavemaker = -1;
    }
    stage->bodies[0].mesh = box(sb_vec(-20, -20, -2), sb_vec(20, 20, 0));
    stage->bodies[1].mesh = box(sb_vec(2, -12, 0), sb_vec(6, 12, 9));
}

static void clear_stage(struct stage *stage)
{
    for (int b = 0; b < 2; b++) {
        sb_free(stage->bodies[b].mesh.vertices);
        sb_free(stage->bodies[b].mesh.triangles);
    }
}

/* nx x ny x nz particles of 0.5 m, the lowest corner of their volume at `from`. */
static sb_frame *water(double time, sb_vec3 from, int nx, int ny, int nz)
{
    sb_frame *frame = sb_frame_create((size_t)(nx * ny * nz), 2);
    assert_non_null(frame);
    frame->spacing = 0.5;
    frame->status.time = time;
    strcpy(frame->bodies[0].name, "ground");
    strcpy(frame->bodies[1].name, "wall");
    float *p = frame->position;
    for (int k = 0; k < nz; k++)
        for (int j = 0; j < ny; j++)
            for (int i = 0; i < nx; i++, p += 3) {
                p[0] = (float)(from.x + 0.25 + 0.5 * i);
                p[1] = (float)(from.y + 0.25 + 0.5 * j);
                p[2] = (float)(from.z + 0.25 + 0.5 * k);
            }
    memset(frame->velocity, 0, 3 * frame->count * sizeof(float));
    memset(frame->pressure, 0, frame->count * sizeof(float));
    return frame;
}

/* The picture of the dry stage after the water of the frames was there. Releases the frames. */
static sb_image after_all(const struct stage *stage, sb_frame **before, int count)
{
    sb_error error = {0};
    sb_renderer *renderer = NULL;
    sb_image image = {0};
    sb_frame *dry = water(100, sb_vec(0, 0, 0), 0, 0, 0);
    sb_status status = sb_renderer_create(&stage->scene, &stage->model, &renderer, &error);
    for (int f = 0; f <= count && status == SB_OK; f++)
        status = sb_renderer_draw(renderer, f < count ? before[f] : dry, 0, &image, &error);
    if (status != SB_OK) fail_msg("%s", error.text);
    sb_renderer_destroy(renderer);
    for (int f = 0; f < count; f++) sb_frame_release(before[f]);
    sb_frame_release(dry);
    return image;
}

static sb_image after(const struct stage *stage, sb_frame *before)
{
    return after_all(stage, &before, 1);
}

static const unsigned char *pixel(const sb_image *image, int x, int y)
{
    return image->rgb + 3 * (y * image->width + x);
}

static int differ(const sb_image *a, const sb_image *b, int x, int y)
{
    int most = 0;
    for (int c = 0; c < 3; c++) {
        const int d = abs(pixel(a, x, y)[c] - pixel(b, x, y)[c]);
        most = d > most ? d : most;
    }
    return most;
}

/* Row of a height on the wall's face in a level picture: 22 m under 60 degrees. */
static int row_of(double z)
{
    return (int)(HEIGHT / 2 * (1 - (z - 3) / (22 * 0.57735)));
}

/* A wall shows the depth that was before it, up to the highest water, whatever the height on the wall. */
static void walls_show_the_greatest_depth(void **state)
{
    (void)state;
    struct stage stage;
    set_stage(&stage, sb_vec(-20, 0, 3));
    stage.scene.render.greatest_depth = true;
    sb_image dry = after(&stage, water(1, sb_vec(-8, -5, 0), 0, 0, 0));
    sb_image deep = after(&stage, water(1, sb_vec(-8, -5, 0), 20, 20, 8));
    sb_image low = after(&stage, water(1, sb_vec(-8, -5, 0), 20, 20, 3));
    const int middle = WIDTH / 2;
    assert_true(differ(&deep, &dry, middle, row_of(3.2)) > 20);
    assert_true(differ(&deep, &dry, middle, row_of(0.8)) > 20);
    assert_int_equal(differ(&deep, &dry, middle, row_of(5.2)), 0);
    assert_int_equal(differ(&low, &dry, middle, row_of(3.2)), 0);
    assert_true(differ(&low, &dry, middle, row_of(0.8)) > 20);
    assert_true(differ(&low, &deep, middle, row_of(0.8)) > 20);
    sb_image_free(&dry);
    sb_image_free(&deep);
    sb_image_free(&low);
    clear_stage(&stage);
}

static int count_changes(const sb_image *a, const sb_image *b)
{
    int changes = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) changes += differ(a, b, x, y) > 8;
    return changes;
}

/* Row of the ground 16 m before the camera of the level picture. */
enum { ON_GROUND = 119 };

/* The colours of the greatest depth have a legend of their own above that of the water. */
static void painted_depths_have_a_legend(void **state)
{
    (void)state;
    struct stage stage;
    sb_image image[2];
    set_stage(&stage, sb_vec(-20, 0, 3));
    stage.scene.render.width = 1280;
    stage.scene.render.height = 720; /* smaller pictures may have no legends */
    for (int with = 0; with < 2; with++) {
        stage.scene.render.greatest_depth = with;
        image[with] = after(&stage, water(1, sb_vec(-8, -5, 0), 0, 0, 0));
    }
    int changes = 0;
    for (int y = 720 - 84 - SB_OVERLAY_SLOT; y < 720 - 84; y++)
        for (int x = 934; x < 1260; x++) changes += differ(&image[0], &image[1], x, y) > 0;
    assert_true(changes > 10000); /* of the 20 212 of its plate */
    for (int y = 720 - 84 + 1; y < 720; y++)
        for (int x = 0; x < 1280; x++) assert_int_equal(differ(&image[0], &image[1], x, y), 0);
    for (int with = 0; with < 2; with++) sb_image_free(&image[with]);
    clear_stage(&stage);
}

/* While the colours of the wall are those of its loads, nothing else is painted on it; terrain is painted. */
static void loads_are_not_painted_over(void **state)
{
    (void)state;
    struct stage stage;
    sb_image image[2];
    set_stage(&stage, sb_vec(-20, 0, 3));
    stage.scene.resolution = 0.5;
    stage.scene.render.loads = true;
    stage.bodies[0].role = SB_ROLE_TERRAIN;
    for (int with = 0; with < 2; with++) {
        stage.scene.render.greatest_depth = stage.scene.render.wet_ground = with;
        image[with] = after(&stage, water(1, sb_vec(-8, -5, 0), 20, 20, 8));
    }
    assert_int_equal(differ(&image[0], &image[1], WIDTH / 2, row_of(3.2)), 0);
    assert_int_equal(differ(&image[0], &image[1], WIDTH / 2, row_of(0.8)), 0);
    assert_true(differ(&image[0], &image[1], WIDTH / 2, ON_GROUND) > 20);
    for (int with = 0; with < 2; with++) sb_image_free(&image[with]);
    clear_stage(&stage);
}

/* The outer sides of the ground at the domain's sides have no water before them, although the map has some at their
   edge. */
static void sides_of_the_domain_are_not_painted(void **state)
{
    (void)state;
    struct stage stage;
    set_stage(&stage, sb_vec(-40, 0, -1));
    stage.key.target = sb_vec(-20, 0, -1);
    stage.scene.dimensions = 3;
    stage.scene.render.greatest_depth = stage.scene.render.wet_ground = true;
    sb_image dry = after(&stage, water(1, sb_vec(-20, -5, 0), 0, 0, 0));
    sb_image wet = after(&stage, water(1, sb_vec(-20.2, -5, 0), 20, 20, 8));
    const int edge = HEIGHT / 2 - (int)(HEIGHT / 2 / (20 * 0.57735)); /* of the side, 1 m above the picture's middle */
    for (int y = edge + 2; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) assert_int_equal(differ(&wet, &dry, x, y), 0);
    sb_image_free(&dry);
    sb_image_free(&wet);
    clear_stage(&stage);
}

/* A body that moves has no place where the water has been. */
static void bodies_that_move_are_not_painted(void **state)
{
    (void)state;
    struct stage stage;
    set_stage(&stage, sb_vec(-20, 0, 3));
    stage.bodies[1].wavemaker = 0;
    stage.scene.domain.min.z = -1; /* the ground is above the still water */
    for (int key = 0; key < 2; key++) {
        stage.scene.render.greatest_depth = key == 0;
        stage.scene.render.wet_ground = key == 1;
        sb_image dry = after(&stage, water(1, sb_vec(-8, -5, 0), 0, 0, 0));
        sb_image deep = after(&stage, water(1, sb_vec(-8, -5, 0), 20, 20, 8));
        assert_int_equal(differ(&deep, &dry, WIDTH / 2, row_of(3.2)), 0);
        assert_int_equal(differ(&deep, &dry, WIDTH / 2, row_of(0.8)), 0);
        assert_true(differ(&deep, &dry, WIDTH / 2, ON_GROUND) > 8);
        sb_image_free(&dry);
        sb_image_free(&deep);
    }
    clear_stage(&stage);
}

/* Sixteen columns of three particles, half a metre from each other, from the origin in a direction. */
static sb_frame *oblique_row(double angle)
{
    sb_frame *frame = water(1, sb_vec(-8, -3, 0), 16, 1, 3);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 16; i++) {
            float *p = frame->position + 3 * (16 * k + i);
            p[0] = (float)(-8 + 0.5 * i * cos(angle));
            p[1] = (float)(-3 + 0.5 * i * sin(angle));
        }
    return frame;
}

/* Neither a row in any direction nor a column that crosses the ground, over and over, wets it. */
static void oblique_tracks_leave_no_streaks(void **state)
{
    (void)state;
    enum { STEPS = 32 };
    struct stage stage;
    sb_frame *frames[STEPS];
    set_stage(&stage, sb_vec(-10, 0, 25));
    stage.scene.render.wet_ground = true;
    sb_image dry = after(&stage, water(1, sb_vec(-8, 0, 0), 0, 0, 0));
    for (int a = 1; a < 6; a++) {
        sb_image row = after(&stage, oblique_row(0.26 * a));
        assert_int_equal(count_changes(&row, &dry), 0);
        sb_image_free(&row);
    }
    for (int f = 0; f < STEPS; f++)
        frames[f] = water(1 + f, sb_vec(-8 + 0.5 * (f % 16), -3 + 0.5 * (f % 16) + f / 16 * 0.6, 0), 1, 1, 4);
    sb_image track = after_all(&stage, frames, STEPS);
    assert_int_equal(count_changes(&track, &dry), 0);
    sb_image_free(&dry);
    sb_image_free(&track);
    clear_stage(&stage);
}

/* The water of two dimensions is a row of cells. */
static void water_of_two_dimensions_wets(void **state)
{
    (void)state;
    struct stage stage;
    set_stage(&stage, sb_vec(-8, -12, 6));
    stage.scene.dimensions = 2;
    stage.scene.render.wet_ground = true;
    sb_image dry = after(&stage, water(1, sb_vec(-8, -0.25, 0), 0, 0, 0));
    sb_image wet = after(&stage, water(1, sb_vec(-8, -0.25, 0), 16, 1, 3));
    assert_true(count_changes(&wet, &dry) > 100);
    sb_image_free(&dry);
    sb_image_free(&wet);
    clear_stage(&stage);
}

/* Water of some breadth wets the ground; the track of a single row of particles does not. */
static void tracks_of_particles_leave_no_streaks(void **state)
{
    (void)state;
    struct stage stage;
    set_stage(&stage, sb_vec(-10, 0, 25));
    stage.scene.render.wet_ground = true;
    sb_image dry = after(&stage, water(1, sb_vec(-8, 0, 0), 0, 0, 0));
    sb_image broad = after(&stage, water(1, sb_vec(-8, -1, 0), 16, 5, 3));
    sb_image narrow = after(&stage, water(1, sb_vec(-8, 0, 0), 16, 1, 3));
    assert_true(count_changes(&broad, &dry) > 200);
    assert_int_equal(count_changes(&narrow, &dry), 0);
    sb_image_free(&dry);
    sb_image_free(&broad);
    sb_image_free(&narrow);
    clear_stage(&stage);
}

/* Draws a frame by a new renderer that shares what earlier ones have seen, and releases the frame. */
static sb_image draw_sharing(const struct stage *stage, sb_reached *reached, sb_frame *frame)
{
    sb_error error = {0};
    sb_renderer *renderer = NULL;
    sb_image image = {0};
    sb_status status = sb_renderer_create(&stage->scene, &stage->model, &renderer, &error);
    if (status == SB_OK) sb_renderer_share(renderer, reached);
    if (status == SB_OK) status = sb_renderer_draw(renderer, frame, 0, &image, &error);
    if (status != SB_OK) fail_msg("%s", error.text);
    sb_renderer_destroy(renderer);
    sb_frame_release(frame);
    return image;
}

static sb_status save_and_load(const struct stage *stage, const sb_reached *from, sb_reached *to, sb_error *error)
{
    sb_archive_out out = {0};
    sb_archive_in in = {0};
    sb_archive_begin(&out, "TEST", 1);
    sb_archive_section(&out, "reached");
    sb_reached_save(from, &out);
    assert_int_equal(sb_archive_close(&out, NULL), SB_OK);
    assert_int_equal(sb_archive_parse(&in, "saved", out.bytes, out.used, "TEST", 1, NULL), SB_OK);
    assert_int_equal(sb_archive_enter(&in, "reached", NULL), SB_OK);
    sb_status status = sb_reached_load(to, &stage->scene, &stage->model, &in, error);
    if (status == SB_OK) status = sb_archive_leave(&in, error);
    sb_archive_in_free(&in);
    sb_archive_out_free(&out);
    return status;
}

/* Renderers of other sizes and an archive hand the highest water on; a picture of the same time does, too. */
static void the_highest_water_is_handed_on(void **state)
{
    (void)state;
    struct stage stage;
    sb_reached reached = {0}, loaded = {0};
    set_stage(&stage, sb_vec(-20, 0, 3));
    stage.scene.render.greatest_depth = stage.scene.render.wet_ground = true;
    stage.scene.resolution = 0.5;
    assert_int_equal(save_and_load(&stage, &reached, &loaded, NULL), SB_OK);
    assert_true(loaded.changes == 0 && !loaded.tops.top);
    sb_image expected = after(&stage, water(1, sb_vec(-8, -5, 0), 20, 20, 8));
    stage.scene.render.width = WIDTH / 2;
    stage.scene.render.height = HEIGHT / 2;
    sb_image small = draw_sharing(&stage, &reached, water(1, sb_vec(-8, -5, 0), 20, 20, 8));
    assert_int_equal(save_and_load(&stage, &reached, &loaded, NULL), SB_OK);
    stage.scene.render.width = WIDTH;
    stage.scene.render.height = HEIGHT;
    sb_image same_time = draw_sharing(&stage, &reached, water(1, sb_vec(0, 0, 0), 0, 0, 0));
    sb_image later = draw_sharing(&stage, &loaded, water(100, sb_vec(0, 0, 0), 0, 0, 0));
    assert_int_equal(count_changes(&same_time, &expected), 0);
    assert_memory_equal(later.rgb, expected.rgb, 3 * WIDTH * HEIGHT);
    sb_image_free(&expected);
    sb_image_free(&small);
    sb_image_free(&same_time);
    sb_image_free(&later);
    sb_reached_free(&reached);
    sb_reached_free(&loaded);
    clear_stage(&stage);
}

/* Another size, or a height that is no number, is refused. */
static void a_wrong_highest_water_is_refused(void **state)
{
    (void)state;
    struct stage stage;
    sb_error error = {0};
    sb_reached reached = {0}, loaded = {0};
    set_stage(&stage, sb_vec(-20, 0, 3));
    stage.scene.render.wet_ground = true;
    stage.scene.resolution = 0.5;
    sb_image image = draw_sharing(&stage, &reached, water(1, sb_vec(-8, -5, 0), 20, 20, 8));
    stage.scene.resolution = 0.6;
    assert_int_equal(save_and_load(&stage, &reached, &loaded, &error), SB_BAD_INPUT);
    stage.scene.resolution = 0.5;
    reached.tops.top[3] = NAN;
    assert_int_equal(save_and_load(&stage, &reached, &loaded, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "cell 3 of the highest water has nan m"));
    reached.tops.top[3] = 0;
    reached.time = HUGE_VAL;
    assert_int_equal(save_and_load(&stage, &reached, &loaded, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "expected a finite time"));
    sb_image_free(&image);
    sb_reached_free(&reached);
    sb_reached_free(&loaded);
    clear_stage(&stage);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(painted_depths_have_a_legend),     cmocka_unit_test(walls_show_the_greatest_depth),
        cmocka_unit_test(loads_are_not_painted_over),       cmocka_unit_test(sides_of_the_domain_are_not_painted),
        cmocka_unit_test(bodies_that_move_are_not_painted), cmocka_unit_test(tracks_of_particles_leave_no_streaks),
        cmocka_unit_test(oblique_tracks_leave_no_streaks),  cmocka_unit_test(water_of_two_dimensions_wets),
        cmocka_unit_test(the_highest_water_is_handed_on),   cmocka_unit_test(a_wrong_highest_water_is_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
