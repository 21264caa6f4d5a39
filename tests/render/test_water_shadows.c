/* Shadows of water on water. */
#include "render/renderer.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 240, HEIGHT = 180, N = 60 };

/* Water with a plane surface that falls away from the sun: its rays meet it at 35 degrees. */
static sb_frame *ramp(void)
{
    sb_frame *frame = sb_frame_create((size_t)N * N * N, 0);
    assert_non_null(frame);
    frame->spacing = 0.5;
    frame->status.time = 1;
    frame->count = 0;
    for (int k = 0; k < N; k++)
        for (int j = 0; j < N; j++)
            for (int i = 0; i < N; i++) {
                const double x = 0.5 * i - 15, y = 0.5 * j - 15, z = 0.5 * k - 15;
                /* The sun is towards (0.3, -0.62, 0.725). */
                if (z > 0.0872 * x - 0.18 * y || x * x + y * y > 200 || frame->count >= (size_t)N * N * N) continue;
                float *p = frame->position + 3 * frame->count++;
                p[0] = (float)x;
                p[1] = (float)y;
                p[2] = (float)z;
            }
    memset(frame->velocity, 0, 3 * frame->count * sizeof(float));
    memset(frame->pressure, 0, frame->count * sizeof(float));
    return frame;
}

/* The surface has no pattern of the shadow map's cells. */
static void a_plane_has_no_pattern(void **state)
{
    (void)state;
    sb_camera_key key = {.eye = sb_vec(-12, 26, 22), .target = sb_vec(0, 0, 0), .fov = 40};
    sb_camera camera = {.name = "front", .key_count = 1, .keys = &key};
    sb_scene scene = {.fluid = {.gravity = 9.81}};
    scene.render = (sb_render_settings){
        .width = WIDTH, .height = HEIGHT, .speed_max = 10, .camera_count = 1, .cameras = &camera, .shadows = true};
    sb_model model = {.min = sb_vec(-20, -20, -20), .max = sb_vec(20, 20, 20)};
    sb_error error = {0};
    sb_renderer *renderer = NULL;
    sb_image image = {0};
    sb_frame *frame = ramp();
    if (sb_renderer_create(&scene, &model, &renderer, &error) != SB_OK ||
        sb_renderer_draw(renderer, frame, 0, &image, &error) != SB_OK)
        fail_msg("%s", error.text);
    int steps = 0, most = 0;
    for (int y = 60; y < 120; y++)
        for (int x = 80; x < 160; x++) {
            const unsigned char *p = image.rgb + 3 * (y * WIDTH + x);
            const int step = abs(p[1] - p[4]);
            steps += step > 5;
            most = step > most ? step : most;
        }
    if (steps > 0) fail_msg("%d steps of up to %d between neighbouring pixels, expected none above 5", steps, most);
    sb_image_free(&image);
    sb_renderer_destroy(renderer);
    sb_frame_release(frame);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_plane_has_no_pattern)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
