/* Pictures with a slice: colours of the cut water, what is cut off, and what remains. */
#include "box.h"

#include "base/memory.h"
#include "render/overlay/colormap.h"
#include "render/renderer.h"
#include "render/slice/slice.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SIDE = 120 };

/* A block of water, 8 m on each side around the origin, moving along x, and a column before it and one in it. A camera
   at -y looks at them; the plane is y = 0. */
struct stage {
    sb_camera_key key;
    sb_camera camera;
    sb_scene scene;
    sb_model_body list[2];
    sb_model model;
    sb_frame *frame;
};

static void set_stage(struct stage *stage)
{
    enum { N = 16 };
    memset(stage, 0, sizeof *stage);
    stage->key = (sb_camera_key){.eye = {0, -24, 0}, .fov = 60};
    stage->camera = (sb_camera){.name = "front", .key_count = 1, .keys = &stage->key};
    stage->camera.slice = (sb_slice){.normal = {0, 1, 0}, .behind = true, .vectors = 0};
    stage->scene.fluid.gravity = 9.81;
    stage->scene.render = (sb_render_settings){
        .width = SIDE, .height = SIDE, .speed_max = 10, .camera_count = 1, .cameras = &stage->camera};
    stage->model = (sb_model){.min = {-20, -20, -20}, .max = {20, 20, 20}, .bodies = stage->list, .body_count = 2};
    for (int b = 0; b < 2; b++) stage->list[b].wavemaker = -1;
    strcpy(stage->list[0].name, "before");
    strcpy(stage->list[1].name, "within");
    stage->list[0].mesh = box(sb_vec(-6, -8, -10), sb_vec(6, -6, 10));
    stage->list[1].mesh = box(sb_vec(1, -6, -10), sb_vec(3, 6, 10));
    stage->frame = sb_frame_create(N * N * N, 0);
    stage->frame->spacing = 0.5;
    stage->frame->status.time = 1;
    for (size_t i = 0; i < stage->frame->count; i++) {
        const size_t at[3] = {i % N, i / N % N, i / N / N};
        for (size_t a = 0; a < 3; a++) {
            stage->frame->position[3 * i + a] = 0.5f * (float)at[a] - 3.75f;
            stage->frame->velocity[3 * i + a] = a == 0 ? 4 : 0;
        }
        stage->frame->pressure[i] = 0;
    }
}

static void clear_stage(struct stage *stage)
{
    sb_frame_release(stage->frame);
    for (int b = 0; b < 2; b++) {
        sb_free(stage->list[b].mesh.vertices);
        sb_free(stage->list[b].mesh.triangles);
    }
}

static sb_image picture(const struct stage *stage)
{
    sb_error error = {0};
    sb_renderer *renderer = NULL;
    sb_image image = {0};
    if (sb_renderer_create(&stage->scene, &stage->model, &renderer, &error) != SB_OK ||
        sb_renderer_draw(renderer, stage->frame, 0, &image, &error) != SB_OK)
        fail_msg("%s", error.text);
    sb_renderer_destroy(renderer);
    return image;
}

/* The largest difference of a pixel from a colour 0..1. The place is in m of the plane y = 0. */
static int differs(const sb_image *image, double x, double z, const float rgb[3])
{
    const double scale = 0.5 * SIDE / (24 * tan(3.14159265358979 / 6));
    const int column = (int)floor(0.5 * SIDE + x * scale), row = (int)floor(0.5 * SIDE - z * scale);
    int most = 0;
    for (int c = 0; c < 3; c++) {
        const int off = abs(image->rgb[3 * (row * SIDE + column) + c] - (int)lrintf(255 * rgb[c]));
        most = off > most ? off : most;
    }
    return most;
}

/* The water on the plane has exactly the colour that the legend has at its speed; the column before the plane is not
   drawn; the one that the plane cuts has a plain face. */
static void cut_water_has_the_legend_s_colour(void **state)
{
    (void)state;
    struct stage stage;
    set_stage(&stage);
    float rgb[3];
    sb_colormap(SB_COLORMAP_SEA, 0.4, rgb);
    sb_image cut = picture(&stage);
    for (double x = -3; x < 4; x += 0.5)
        for (double z = -3; z <= 3; z += 0.5) {
            if (x > 0.7 && x < 3.3) continue;
            assert_in_range(differs(&cut, x, z, rgb), 0, 1);
        }
    const float solid[3] = {0.33f, 0.34f, 0.36f};
    assert_in_range(differs(&cut, 2, 1, solid), 0, 1);
    assert_in_range(differs(&cut, 2, 7, solid), 0, 1);
    /* Without a slice, the first column hides all. */
    stage.camera.slice.normal = sb_vec(0, 0, 0);
    sb_image whole = picture(&stage);
    assert_true(differs(&whole, -2, 0, rgb) > 20);
    assert_true(differs(&whole, 2, 1, solid) > 20);
    sb_image_free(&cut);
    sb_image_free(&whole);
    clear_stage(&stage);
}

/* What lies behind the plane is drawn; the sign of the normal has no meaning. Faces in the plane count as before it. */
static void what_lies_behind_remains(void **state)
{
    (void)state;
    struct stage stage;
    set_stage(&stage);
    sb_image whole, turned;
    stage.list[0].mesh.triangle_count = 0; /* no column before the water */
    stage.camera.slice = (sb_slice){0};
    whole = picture(&stage);
    stage.list[0].mesh.triangle_count = 12;
    stage.camera.slice = (sb_slice){.point = {0, -6, 0}, .normal = {0, 1, 0}, .behind = true};
    sb_image cut = picture(&stage);
    stage.camera.slice.normal = sb_vec(0, -3, 0);
    turned = picture(&stage);
    assert_memory_equal(cut.rgb, turned.rgb, (size_t)3 * SIDE * SIDE);
    int different = 0;
    for (int i = 0; i < SIDE * SIDE; i++)
        for (int c = 0; c < 3; c++)
            if (abs(cut.rgb[3 * i + c] - whole.rgb[3 * i + c]) > 60) {
                different++;
                break;
            }
    /* The shadow of the column that is cut off remains, and the end of the other one has a plain face. */
    assert_in_range(different, 0, SIDE * SIDE / 4);
    sb_image_free(&whole);
    sb_image_free(&cut);
    sb_image_free(&turned);
    clear_stage(&stage);
}

/* With behind: false, pixels without water and bodies on the plane are plain. */
static void only_the_plane_can_be_drawn(void **state)
{
    (void)state;
    struct stage stage;
    set_stage(&stage);
    stage.camera.slice.behind = false;
    sb_image image = picture(&stage);
    float rgb[3];
    const float paper[3] = {0.84f, 0.87f, 0.89f};
    sb_colormap(SB_COLORMAP_SEA, 0.4, rgb);
    assert_in_range(differs(&image, -2, 1, rgb), 0, 1);
    for (double x = -9; x < 9; x += 0.5) {
        if (x > 0.5 && x < 3.5) continue;
        assert_in_range(differs(&image, x, 6, paper), 0, 1);
        assert_in_range(differs(&image, x, -6, paper), 0, 1);
    }
    sb_image_free(&image);
    clear_stage(&stage);
}

/* Any number of threads draws the same pixels, with arrows and lines, too. */
static void threads_draw_the_same_slice(void **state)
{
    (void)state;
    struct stage stage;
    set_stage(&stage);
    for (size_t i = 0; i < stage.frame->count; i++) stage.frame->velocity[3 * i + 2] = stage.frame->position[3 * i];
    const sb_slice slice = {.normal = {0, 1, 0.3}, .vectors = 1, .streamlines = 0.7};
    const sb_view view = sb_view_create(&stage.key, 1, stage.model.min, stage.model.max);
    sb_slicer slicer;
    sb_error error = {0};
    sb_image images[3] = {{0}};
    assert_int_equal(sb_slicer_create(&stage.model, &slicer, &error), SB_OK);
    for (int k = 0; k < 3; k++) {
        const sb_slice_job job = {.slice = &slice,
                                  .frame = stage.frame,
                                  .view = &view,
                                  .min = stage.model.min,
                                  .max = stage.model.max,
                                  .range = {0, 10},
                                  .vector_speed = 5,
                                  .threads = k + 1};
        assert_int_equal(sb_image_resize(&images[k], SIDE, SIDE, &error), SB_OK);
        assert_int_equal(sb_slicer_draw(&slicer, &job, &images[k], &error), SB_OK);
        assert_true(slicer.streamlines.line_count > 3);
        if (k > 0) assert_memory_equal(images[0].rgb, images[k].rgb, (size_t)3 * SIDE * SIDE);
    }
    for (int k = 0; k < 3; k++) sb_image_free(&images[k]);
    sb_slicer_free(&slicer);
    clear_stage(&stage);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cut_water_has_the_legend_s_colour),
        cmocka_unit_test(what_lies_behind_remains),
        cmocka_unit_test(only_the_plane_can_be_drawn),
        cmocka_unit_test(threads_draw_the_same_slice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
