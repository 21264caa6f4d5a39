/* Pictures of small scenes: which pixels show water, walls, moving bodies and text. */
#include "box.h"

#include "base/memory.h"
#include "render/renderer.h"

#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 160, HEIGHT = 120 };

/* A camera at -y looks at a block of water 8 x 8 x 8 m around (0, 0, 0) of a 40 m domain. */
struct stage {
    sb_camera_key key;
    sb_camera camera;
    sb_scene scene;
    sb_model_body body;
    sb_model model;
    sb_frame *frame;
};

static sb_frame *water(sb_vec3 origin, sb_vec3 center, int side)
{
    sb_frame *frame = sb_frame_create((size_t)(side * side * side), 1);
    assert_non_null(frame);
    frame->spacing = 0.5;
    frame->origin = origin;
    frame->status.time = 1;
    strcpy(frame->bodies[0].name, "wall");
    sb_vec3 corner = sb_sub(center, origin);
    size_t n = 0;
    for (int k = 0; k < side; k++)
        for (int j = 0; j < side; j++)
            for (int i = 0; i < side; i++, n++) {
                frame->position[3 * n] = (float)(corner.x + 0.5 * i - 0.25 * (side - 1));
                frame->position[3 * n + 1] = (float)(corner.y + 0.5 * j - 0.25 * (side - 1));
                frame->position[3 * n + 2] = (float)(corner.z + 0.5 * k - 0.25 * (side - 1));
                memset(frame->velocity + 3 * n, 0, 3 * sizeof(float));
            }
    return frame;
}

static void set_stage(struct stage *stage, sb_vec3 at, int height)
{
    memset(stage, 0, sizeof *stage);
    stage->key = (sb_camera_key){.eye = sb_add(at, sb_vec(0, -24, 0)), .target = at, .fov = 60};
    stage->camera = (sb_camera){.name = "front", .key_count = 1, .keys = &stage->key};
    stage->scene.title = "A block of water";
    stage->scene.fluid.gravity = 9.81;
    stage->scene.render = (sb_render_settings){.width = height * WIDTH / HEIGHT,
                                               .height = height,
                                               .speed_max = 10,
                                               .camera_count = 1,
                                               .cameras = &stage->camera};
    stage->model.min = sb_add(at, sb_vec(-20, -20, -20));
    stage->model.max = sb_add(at, sb_vec(20, 20, 20));
    stage->model.bodies = &stage->body;
    strcpy(stage->body.name, "wall");
    stage->body.color[0] = -1;
    stage->body.wavemaker = -1;
    stage->frame = water(stage->model.min, at, 16);
}

static void add_wall(struct stage *stage, sb_vec3 min, sb_vec3 max)
{
    stage->body.mesh = box(min, max);
    stage->model.body_count = 1;
}

static void clear_stage(struct stage *stage)
{
    sb_frame_release(stage->frame);
    sb_free(stage->body.mesh.vertices);
    sb_free(stage->body.mesh.triangles);
}

static sb_image picture(const struct stage *stage, const sb_frame *frame)
{
    sb_error error = {0};
    sb_renderer *renderer = NULL;
    sb_image image = {0};
    if (sb_renderer_create(&stage->scene, &stage->model, &renderer, &error) != SB_OK ||
        sb_renderer_draw(renderer, frame, 0, &image, &error) != SB_OK)
        fail_msg("%s", error.text);
    sb_renderer_destroy(renderer);
    assert_int_equal(image.width, stage->scene.render.width);
    assert_int_equal(image.height, stage->scene.render.height);
    return image;
}

static const unsigned char *pixel(const sb_image *image, int x, int y)
{
    return image->rgb + 3 * (y * image->width + x);
}

static int differ(const sb_image *a, const sb_image *b, int x, int y)
{
    int most = 0;
    for (int c = 0; c < 3; c++) {
        int d = abs(pixel(a, x, y)[c] - pixel(b, x, y)[c]);
        most = d > most ? d : most;
    }
    return most;
}

/* How many pixels of the rectangle differ by more than `tolerance`. */
static int differences(const sb_image *a, const sb_image *b, int x0, int y0, int x1, int y1, int tolerance)
{
    int count = 0;
    for (int y = y0; y < y1; y++)
        for (int x = x0; x < x1; x++) count += differ(a, b, x, y) > tolerance;
    return count;
}

static void water_is_drawn_at_its_position(void **state)
{
    (void)state;
    struct stage stage;
    set_stage(&stage, sb_vec(0, 0, 0), HEIGHT);
    sb_frame *dry = water(stage.model.min, sb_vec(0, 0, 0), 0);
    sb_image wet = picture(&stage, stage.frame), bare = picture(&stage, dry);
    int blue = 0;
    /* 4 m at a distance of 20 m under 60 degrees: 0.346 of the half height, 21 px. */
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            int dx = abs(x - WIDTH / 2), dy = abs(y - HEIGHT / 2);
            if (dx < 18 && dy < 18) {
                const unsigned char *rgb = pixel(&wet, x, y);
                blue += rgb[2] > rgb[0] + 30 && rgb[2] > rgb[1] + 15;
                assert_true(differ(&wet, &bare, x, y) > 20);
            } else if (dx > 25 || dy > 25) {
                assert_int_equal(differ(&wet, &bare, x, y), 0);
            }
        }
    assert_true(blue > 35 * 35 * 9 / 10); /* the remaining pixels may be reflections of the sun */
    /* Fast water is bright. */
    for (size_t i = 0; i < stage.frame->count; i++) stage.frame->velocity[3 * i + 1] = -10;
    sb_image fast = picture(&stage, stage.frame);
    const unsigned char *rgb = pixel(&fast, WIDTH / 2, HEIGHT / 2);
    assert_true(rgb[0] > pixel(&wet, WIDTH / 2, HEIGHT / 2)[0] + 60);
    sb_image_free(&wet);
    sb_image_free(&bare);
    sb_image_free(&fast);
    sb_frame_release(dry);
    clear_stage(&stage);
}

static void a_wall_hides_the_water_behind_it(void **state)
{
    (void)state;
    struct stage stage;
    set_stage(&stage, sb_vec(0, 0, 0), HEIGHT);
    sb_frame *dry = water(stage.model.min, sb_vec(0, 0, 0), 0);
    /* Left of the middle, between the camera and the water. */
    add_wall(&stage, sb_vec(-10, -12, -10), sb_vec(0, -11, 10));
    sb_image wet = picture(&stage, stage.frame), bare = picture(&stage, dry);
    assert_int_equal(differences(&wet, &bare, 0, 0, WIDTH / 2 - 2, HEIGHT, 0), 0);
    assert_true(differences(&wet, &bare, WIDTH / 2 + 2, 45, WIDTH / 2 + 18, 75, 20) == 16 * 30);
    /* The wall itself is drawn and does not have the water's colour. */
    const unsigned char *rgb = pixel(&wet, WIDTH / 2 - 20, HEIGHT / 2);
    assert_true(rgb[0] + 10 > rgb[2]);
    sb_image_free(&wet);
    sb_image_free(&bare);
    sb_frame_release(dry);
    clear_stage(&stage);
}

/* The water is 15 m behind the wall, whose pixels with the drop are mixtures: the depth of the water there is negative.
 */
static void a_drop_before_a_wall_does_not_show_the_water_behind_it(void **state)
{
    (void)state;
    struct stage stage;
    set_stage(&stage, sb_vec(0, 0, 0), HEIGHT);
    add_wall(&stage, sb_vec(-3, -20, -3), sb_vec(3, -19.5, 3));
    sb_frame *drop = water(stage.model.min, sb_vec(0, -21, 0), 1);
    memcpy(stage.frame->position, drop->position, 3 * sizeof(float));
    stage.model.min.y = -25; /* the drop is within the domain */
    sb_image both = picture(&stage, stage.frame), alone = picture(&stage, drop);
    sb_frame *none = water(stage.model.min, sb_vec(0, 0, 0), 0);
    sb_image bare = picture(&stage, none);
    const int x0 = WIDTH / 2 - 30, x1 = WIDTH / 2 + 30, y0 = HEIGHT / 2 - 30, y1 = HEIGHT / 2 + 30;
    assert_true(differences(&alone, &bare, x0, y0, x1, y1, 4) > 4);
    assert_int_equal(differences(&both, &alone, x0, y0, x1, y1, 4), 0);
    sb_image_free(&both);
    sb_image_free(&alone);
    sb_image_free(&bare);
    sb_frame_release(none);
    sb_frame_release(drop);
    clear_stage(&stage);
}

static void an_open_mesh_is_transparent_from_behind(void **state)
{
    (void)state;
    struct stage stage;
    set_stage(&stage, sb_vec(0, 0, 0), HEIGHT);
    /* A box with inward faces is a tank: only its far faces point towards the camera. */
    add_wall(&stage, sb_vec(-6, -6, -6), sb_vec(6, 6, 6));
    for (size_t i = 0; i < 12; i++) {
        uint32_t *t = stage.body.mesh.triangles[i], first = t[0];
        t[0] = t[1];
        t[1] = first;
    }
    stage.body.mesh.open_surface = true;
    sb_image tank = picture(&stage, stage.frame);
    stage.body.mesh.open_surface = false;
    sb_image closed = picture(&stage, stage.frame);
    const unsigned char *in = pixel(&tank, WIDTH / 2, HEIGHT / 2);
    const unsigned char *out = pixel(&closed, WIDTH / 2, HEIGHT / 2);
    assert_true(in[2] > in[0] + 30);
    assert_true(out[0] + 10 > out[2]);
    sb_image_free(&tank);
    sb_image_free(&closed);
    clear_stage(&stage);
}

static void pictures_do_not_depend_on_the_origin(void **state)
{
    (void)state;
    struct stage near_stage, far_stage;
    sb_vec3 far = sb_vec(1e6, -1e6, 1000);
    set_stage(&near_stage, sb_vec(0, 0, 0), HEIGHT);
    set_stage(&far_stage, far, HEIGHT);
    add_wall(&near_stage, sb_vec(-10, -12, -10), sb_vec(0, -11, 10));
    add_wall(&far_stage, sb_add(far, sb_vec(-10, -12, -10)), sb_add(far, sb_vec(0, -11, 10)));
    near_stage.scene.sea = (sb_sea){true, 0, {0, 0, 0}};
    far_stage.scene.sea = (sb_sea){true, 1000, {0, 0, 0}};
    sb_image a = picture(&near_stage, near_stage.frame), b = picture(&far_stage, far_stage.frame);
    assert_true(differences(&a, &b, 0, 0, WIDTH, HEIGHT, 3) < WIDTH * HEIGHT / 1000);
    sb_image_free(&a);
    sb_image_free(&b);
    clear_stage(&near_stage);
    clear_stage(&far_stage);
}

static int wall_center(const sb_image *image, const sb_image *bare)
{
    int sum = 0, count = 0;
    for (int x = 0; x < WIDTH; x++)
        for (int y = 0; y < HEIGHT; y++)
            if (differ(image, bare, x, y) > 20) {
                sum += x;
                count++;
            }
    assert_true(count > 50);
    return sum / count;
}

static void a_moving_body_moves(void **state)
{
    (void)state;
    struct stage stage;
    set_stage(&stage, sb_vec(0, 0, 0), HEIGHT);
    sb_frame *dry = water(stage.model.min, sb_vec(0, 0, 0), 0);
    sb_image bare = picture(&stage, dry);
    add_wall(&stage, sb_vec(-2, -1, -2), sb_vec(2, 1, 2));
    stage.body.wavemaker = 0;
    sb_image still = picture(&stage, dry);
    dry->bodies[0].displacement = sb_vec(6, 0, 0);
    sb_image moved = picture(&stage, dry);
    /* 6 m at 24 m: 0.433 of the half height, 26 px. */
    int shift = wall_center(&moved, &bare) - wall_center(&still, &bare);
    assert_in_range(shift, 24, 28);
    /* A frame that names another body does not move this one. */
    strcpy(dry->bodies[0].name, "other");
    sb_image other = picture(&stage, dry);
    assert_int_equal(differences(&other, &still, 0, 0, WIDTH, HEIGHT, 0), 0);
    sb_image_free(&bare);
    sb_image_free(&still);
    sb_image_free(&moved);
    sb_image_free(&other);
    sb_frame_release(dry);
    clear_stage(&stage);
}

static void bad_sizes_and_cameras_are_refused(void **state)
{
    (void)state;
    struct stage stage;
    sb_error error = {0};
    sb_renderer *renderer = NULL;
    sb_image image = {0};
    set_stage(&stage, sb_vec(0, 0, 0), HEIGHT);
    const int bad[][2] = {{0, 100}, {100, -5}, {20000, 100}, {100, 16385}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        stage.scene.render.width = bad[i][0];
        stage.scene.render.height = bad[i][1];
        assert_int_equal(sb_renderer_create(&stage.scene, &stage.model, &renderer, &error), SB_BAD_INPUT);
        assert_null(renderer);
        assert_non_null(strstr(error.text, "16384"));
    }
    stage.scene.render.width = 33;
    stage.scene.render.height = 7;
    assert_int_equal(sb_renderer_create(&stage.scene, &stage.model, &renderer, &error), SB_OK);
    assert_int_equal(sb_renderer_draw(renderer, stage.frame, 1, &image, &error), SB_BAD_INPUT);
    stage.frame->spacing = 0;
    assert_int_equal(sb_renderer_draw(renderer, stage.frame, 0, &image, &error), SB_BAD_INPUT);
    stage.frame->spacing = 0.5;
    assert_int_equal(sb_renderer_draw(renderer, stage.frame, 0, &image, &error), SB_OK);
    assert_int_equal(image.width, 33);
    sb_renderer_destroy(renderer);
    sb_renderer_destroy(NULL);
    sb_image_free(&image);
    clear_stage(&stage);
}

static void text_covers_only_the_corners(void **state)
{
    (void)state;
    struct stage stage;
    set_stage(&stage, sb_vec(0, 0, 0), 360);
    sb_frame *dry = water(stage.model.min, sb_vec(0, 0, 0), 0);
    sb_image with = picture(&stage, dry);
    stage.scene.title = "Another title that is longer";
    sb_image other = picture(&stage, dry);
    assert_true(differences(&with, &other, 0, 0, 480, 45, 40) > 100);
    assert_int_equal(differences(&with, &other, 0, 60, 480, 360, 0), 0);
    dry->status.time = 77;
    sb_image later = picture(&stage, dry);
    assert_true(differences(&later, &other, 0, 20, 200, 70, 40) > 20);
    assert_int_equal(differences(&later, &other, 0, 70, 480, 360, 0), 0);
    sb_image_free(&with);
    sb_image_free(&other);
    sb_image_free(&later);
    sb_frame_release(dry);
    clear_stage(&stage);
}

struct task {
    sb_renderer *renderer;
    const sb_frame *frame;
    sb_image image;
    sb_status status;
};

static void *draw_elsewhere(void *argument)
{
    struct task *task = argument;
    task->status = sb_renderer_draw(task->renderer, task->frame, 0, &task->image, NULL);
    return NULL;
}

static void any_thread_draws_the_same_picture(void **state)
{
    (void)state;
    struct stage stage;
    set_stage(&stage, sb_vec(0, 0, 0), HEIGHT);
    struct task task = {.frame = stage.frame};
    sb_error error = {0};
    sb_image here = {0};
    assert_int_equal(sb_renderer_create(&stage.scene, &stage.model, &task.renderer, &error), SB_OK);
    assert_int_equal(sb_renderer_draw(task.renderer, stage.frame, 0, &here, &error), SB_OK);
    pthread_t thread;
    assert_int_equal(pthread_create(&thread, NULL, draw_elsewhere, &task), 0);
    pthread_join(thread, NULL);
    assert_int_equal(task.status, SB_OK);
    assert_int_equal(differences(&here, &task.image, 0, 0, WIDTH, HEIGHT, 0), 0);
    sb_renderer_destroy(task.renderer);
    sb_image_free(&task.image);
    sb_image_free(&here);
    clear_stage(&stage);
}

static void running_out_of_memory_is_an_error(void **state)
{
    (void)state;
    struct stage stage;
    set_stage(&stage, sb_vec(0, 0, 0), HEIGHT);
    add_wall(&stage, sb_vec(-10, -12, -10), sb_vec(0, -11, 10));
    sb_renderer *renderer = NULL;
    sb_error error;
    long n = 1;
    for (;; n++) {
        error = (sb_error){0};
        sb_memory_fail_at(n);
        sb_status status = sb_renderer_create(&stage.scene, &stage.model, &renderer, &error);
        sb_memory_fail_at(0);
        if (status == SB_OK) break;
        assert_non_null(strstr(error.text, "memory"));
        assert_null(renderer);
    }
    assert_true(n > 10);
    sb_image image = {0};
    for (n = 1;; n++) {
        sb_memory_fail_at(n);
        sb_status status = sb_renderer_draw(renderer, stage.frame, 0, &image, &error);
        sb_memory_fail_at(0);
        if (status == SB_OK) break;
    }
    assert_true(n > 3);
    sb_renderer_destroy(renderer);
    sb_image_free(&image);
    clear_stage(&stage);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(water_is_drawn_at_its_position),
        cmocka_unit_test(a_wall_hides_the_water_behind_it),
        cmocka_unit_test(a_drop_before_a_wall_does_not_show_the_water_behind_it),
        cmocka_unit_test(an_open_mesh_is_transparent_from_behind),
        cmocka_unit_test(pictures_do_not_depend_on_the_origin),
        cmocka_unit_test(a_moving_body_moves),
        cmocka_unit_test(bad_sizes_and_cameras_are_refused),
        cmocka_unit_test(text_covers_only_the_corners),
        cmocka_unit_test(any_thread_draws_the_same_picture),
        cmocka_unit_test(running_out_of_memory_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
