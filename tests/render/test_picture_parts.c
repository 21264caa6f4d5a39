/* The parts of the renderer that do not use OpenGL: colours, letters, files, edges, density, light. */
#include "base/memory.h"
#include "render/bodies/light.h"
#include "render/bodies/outline.h"
#include "render/image/image.h"
#include "render/image/soften.h"
#include "render/overlay/colormap.h"
#include "render/overlay/font.h"
#include "render/overlay/marks.h"
#include "render/overlay/overlay.h"
#include "render/water/density.h"
#include "render/water/visible.h"

#include <png.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static double decode(double value)
{
    return value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4);
}

/* CIE L* (0..100, D65) of an sRGB colour of 0..1. */
static double lightness(const float rgb[3])
{
    double y =
        0.2126729 * decode((double)rgb[0]) + 0.7151522 * decode((double)rgb[1]) + 0.0721750 * decode((double)rgb[2]);
    double cube = 6.0 / 29 * 6.0 / 29 * 6.0 / 29;
    return 116 * (y > cube ? cbrt(y) : y / (3 * 36.0 / 841) + 4.0 / 29) - 16;
}

static void colormap_lightness_rises_linearly(void **state)
{
    (void)state;
    enum { STEPS = 64 };
    float rgb[3];
    for (int map = 0; map < SB_COLORMAPS; map++) {
        sb_colormap(map, 0, rgb);
        double first = lightness(rgb), last = first;
        assert_true(rgb[2] > rgb[0] && rgb[2] > rgb[1]);
        sb_colormap(map, 1, rgb);
        double mean = (lightness(rgb) - first) / STEPS;
        assert_true(mean * STEPS > 70);
        for (int i = 1; i <= STEPS; i++) {
            sb_colormap(map, (double)i / STEPS, rgb);
            double rise = lightness(rgb) - last;
            assert_true(rise > 0.9 * mean && rise < 1.1 * mean);
            last += rise;
            for (int c = 0; c < 3; c++) assert_true(rgb[c] > 0 && rgb[c] < 1); /* no component is clipped */
        }
    }
    float low[3], high[3];
    sb_colormap(0, -3, low);
    sb_colormap(0, (double)NAN, high);
    assert_memory_equal(low, high, sizeof low);
    const float white[3] = {1, 1, 1}, grey[3] = {0.5f, 0.5f, 0.5f};
    assert_true(fabs(lightness(white) - 100) < 0.01);
    assert_true(fabs(lightness(grey) - 53.39) < 0.01); /* CIE value of sRGB 0.5 */
}

static void png_round_trip(void **state)
{
    (void)state;
    char path[64], missing[] = "/nonexistent-folder/picture.png";
    snprintf(path, sizeof path, "/tmp/sb-picture-%ld.png", (long)getpid());
    sb_error error = {0};
    sb_image image = {0};
    assert_int_equal(sb_image_resize(&image, 37, 23, &error), SB_OK);
    for (int i = 0; i < 37 * 23 * 3; i++) image.rgb[i] = (unsigned char)(i * 31 + i / 7);
    assert_int_equal(sb_png_write(path, &image, &error), SB_OK);
    png_image back = {.version = PNG_IMAGE_VERSION};
    unsigned char rgb[37 * 23 * 3];
    assert_true(png_image_begin_read_from_file(&back, path));
    assert_true(back.width == 37 && back.height == 23 && back.format == PNG_FORMAT_RGB);
    assert_true(png_image_finish_read(&back, NULL, rgb, 0, NULL));
    assert_memory_equal(rgb, image.rgb, sizeof rgb);
    assert_int_equal(sb_png_write(missing, &image, &error), SB_FAILED);
    assert_non_null(strstr(error.text, missing));

    unlink(path);
    sb_image_free(&image);
    assert_int_equal(sb_png_write(path, &image, &error), SB_BAD_INPUT);
    assert_true(access(path, F_OK) != 0);
}

static void image_sizes_are_checked(void **state)
{
    (void)state;
    sb_image image = {0};
    sb_error error = {0};
    const int bad[][2] = {{0, 10}, {10, 0}, {-1, 5}, {16385, 1}, {1, 16385}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_int_equal(sb_image_resize(&image, bad[i][0], bad[i][1], &error), SB_BAD_INPUT);
    assert_null(image.rgb);
    assert_int_equal(sb_image_resize(&image, 16384, 1, &error), SB_OK);
    sb_image_free(&image);
}

static int inked(const sb_image *image, int x0, int x1)
{
    int count = 0;
    for (int y = 0; y < image->height; y++)
        for (int x = x0; x < x1; x++) count += image->rgb[3 * (y * image->width + x)] > 200;
    return count;
}

static void every_letter_has_its_own_pixels(void **state)
{
    (void)state;
    enum { SIDE = 48 };
    static unsigned char seen['~' + 1][SIDE * SIDE * 3];
    const float white[3] = {1, 1, 1};
    sb_image image = {0};
    sb_error error = {0};
    assert_int_equal(sb_image_resize(&image, SIDE, SIDE, &error), SB_OK);
    for (char c = '!'; c <= '~'; c++) {
        char text[2] = {c, 0};
        memset(image.rgb, 60, SIDE * SIDE * 3);
        assert_int_equal(sb_font_draw(&image, 8, 32, 20, white, text, &error), SB_OK);
        assert_true(inked(&image, 0, SIDE) > 4);
        memcpy(seen[(int)c], image.rgb, SIDE * SIDE * 3);
        for (char other = '!'; other < c; other++)
            assert_true(memcmp(seen[(int)c], seen[(int)other], SIDE * SIDE * 3) != 0);
    }
    /* Text outside of the picture is cut off and not written to memory. */
    for (double x = -60; x < 100; x += 13)
        for (double y = -30; y < 100; y += 13)
            assert_int_equal(sb_font_draw(&image, x, y, 20, white, "Wg", &error), SB_OK);
    sb_image_free(&image);
}

static void text_ends_at_its_width(void **state)
{
    (void)state;
    const float white[3] = {1, 1, 1};
    sb_image image = {0};
    sb_error error = {0};
    assert_int_equal(sb_image_resize(&image, 400, 60, &error), SB_OK);
    memset(image.rgb, 60, 400 * 60 * 3);
    const char *text = "t = 50.0 s H";
    double width = sb_font_width(text, 20);
    assert_int_equal(sb_font_draw(&image, 20, 40, 20, white, text, &error), SB_OK);
    int end = (int)(20 + width);
    assert_true(inked(&image, end - 3, end + 3) > 20);
    assert_int_equal(inked(&image, end + 4, 400), 0);
    /* A character of two bytes is drawn as one '?'. */
    assert_true(sb_font_width("\xc3\xa4", 20) == sb_font_width("?", 20));
    assert_true(sb_font_width("", 20) == 0);
    sb_image_free(&image);
}

static void softening_changes_only_jagged_edges(void **state)
{
    (void)state;
    enum { SIDE = 32 };
    static unsigned char rgba[SIDE * SIDE * 4];
    sb_image image = {0};
    sb_error error = {0};
    assert_int_equal(sb_image_resize(&image, SIDE, SIDE, &error), SB_OK);
    /* White above a line with a slope of one in four; the first row of rgba is the lowest. */
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) memset(rgba + 4 * (y * SIDE + x), y > 12 + x / 4 ? 255 : 0, 4);
    sb_soften(rgba, &image);
    int between = 0;
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            int up = SIDE - 1 - y, value = image.rgb[3 * (y * SIDE + x)];
            bool near_edge = abs(up - (12 + x / 4)) <= 2;
            between += value > 10 && value < 245;
            assert_true(near_edge || value == (up > 12 + x / 4 ? 255 : 0));
        }
    assert_true(between >= 12);
    sb_image_free(&image);
}

static void ticks_are_round_numbers(void **state)
{
    (void)state;
    assert_true(fabs(sb_overlay_tick(38.6, 5) - 10) < 1e-12);
    assert_true(fabs(sb_overlay_tick(5, 5) - 1) < 1e-12);
    assert_true(fabs(sb_overlay_tick(0.83, 5) - 0.2) < 1e-12);
    assert_true(fabs(sb_overlay_tick(2200, 5) - 500) < 1e-9);
    /* The smallest and largest representable speeds give fewer ticks and no endless loop. */
    sb_image image = {0};
    sb_error error = {0};
    assert_int_equal(sb_image_resize(&image, 640, 360, &error), SB_OK);
    static const double speeds[] = {5e-324, 1e-300, 1e300, 1.7976931348623157e308};
    for (size_t i = 0; i < sizeof speeds / sizeof *speeds; i++) {
        const sb_legend legend = {"speed  m/s", SB_COLORMAP_SEA, 0, speeds[i]};
        assert_int_equal(sb_overlay_title(&image, "title", 1, &error), SB_OK);
        assert_int_equal(sb_overlay_legend(&image, 0, &legend, &error), SB_OK);
    }
    sb_image_free(&image);
}

/* The bar is as long as the object of its label is at the target, and the arrow points north. */
static void marks_measure_the_scene(void **state)
{
    (void)state;
    enum { W = 640, H = 360 };
    sb_image image = {0};
    sb_error error = {0};
    assert_int_equal(sb_image_resize(&image, W, H, &error), SB_OK);
    memset(image.rgb, 60, (size_t)W * H * 3);
    /* At a distance of 100 m under 90 degrees, 360 px are 200 m: 50 m are 90 px. */
    const sb_camera_key key = {0, {0, -100, 0}, {0, 0, 0}, 90, SB_EASE_SMOOTH};
    const sb_view view = sb_view_create(&key, (double)W / H, sb_vec(-50, -50, -50), sb_vec(50, 50, 50));
    assert_int_equal(sb_marks_scale(&image, &view, key.target, &error), SB_OK);
    int first = W, last = 0;
    const int row = (int)(H - 42 * 0.6);
    for (int x = 0; x < W; x++)
        if (image.rgb[3 * (row * W + x)] > 200) {
            first = x < first ? x : first;
            last = x > last ? x : last;
        }
    assert_in_range(last - first, 89, 93);
    /* East is at the right of this view, so that the letter is at the right end of the arrow. */
    memset(image.rgb, 60, (size_t)W * H * 3);
    assert_int_equal(sb_marks_north(&image, &view, key.target, sb_vec(1, 0, 0), &error), SB_OK);
    int left = 0, right = 0;
    for (int y = 0; y < 80; y++)
        for (int x = W - 100; x < W; x++) {
            const bool bright = image.rgb[3 * (y * W + x)] > 200;
            if (x < W - 38)
                left += bright;
            else
                right += bright;
        }
    assert_true(left > 10 && right > 2 * left);
    /* Behind the eye there is nothing to measure. */
    assert_int_equal(sb_marks_scale(&image, &view, sb_vec(0, -200, 0), &error), SB_OK);
    sb_image_free(&image);
}

static sb_mesh cube(void)
{
    /* Each face has its own corners, as in meshes with one normal per face. */
    static sb_vec3 vertices[36];
    static uint32_t triangles[12][3];
    static const int corner[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    for (int f = 0; f < 12; f++)
        for (int c = 0; c < 3; c++) {
            int at = corner[f][c];
            vertices[3 * f + c] = sb_vec(at & 1 ? 1 : 0, at & 2 ? 1 : 0, at & 4 ? 1 : 0);
            triangles[f][c] = (uint32_t)(3 * f + c);
        }
    return (sb_mesh){.vertex_count = 36, .vertices = vertices, .triangle_count = 12, .triangles = triangles};
}

static void outline_finds_the_edges_of_a_cube(void **state)
{
    (void)state;
    sb_mesh mesh = cube();
    sb_outline outline;
    sb_error error = {0};
    assert_int_equal(sb_outline_create(&mesh, 30, &outline, &error), SB_OK);
    assert_int_equal(outline.edge_count, 12); /* and no diagonals */
    for (size_t i = 0; i < 36; i++)
        assert_true(fabsf(outline.normals[i][0]) + fabsf(outline.normals[i][1]) + fabsf(outline.normals[i][2]) == 1);
    sb_outline_free(&outline);
    /* Without its top (two triangles), and with a crease angle of 100 degrees, only the four open edges are left. */
    mesh.triangle_count = 10;
    assert_int_equal(sb_outline_create(&mesh, 100, &outline, &error), SB_OK);
    assert_int_equal(outline.edge_count, 4);
    sb_outline_free(&outline);
    mesh.triangle_count = 0;
    assert_int_equal(sb_outline_create(&mesh, 30, &outline, &error), SB_OK);
    assert_int_equal(outline.edge_count, 0);
    sb_outline_free(&outline);
    mesh = cube();
    for (long n = 1; n <= 7; n++) {
        sb_memory_fail_at(n);
        assert_int_equal(sb_outline_create(&mesh, 30, &outline, &error), SB_FAILED);
    }
    sb_memory_fail_at(0);
}

static sb_frame *block(int side, int layers)
{
    sb_frame *frame = sb_frame_create((size_t)(side * side * layers), 0);
    assert_non_null(frame);
    frame->spacing = 0.5;
    size_t n = 0;
    for (int k = 0; k < layers; k++)
        for (int j = 0; j < side; j++)
            for (int i = 0; i < side; i++, n++) {
                frame->position[3 * n] = (float)(0.5 * i);
                frame->position[3 * n + 1] = (float)(0.5 * j);
                frame->position[3 * n + 2] = (float)(0.5 * k);
                for (int a = 0; a < 3; a++) frame->velocity[3 * n + (size_t)a] = 0;
            }
    return frame;
}

static void density_is_one_inside(void **state)
{
    (void)state;
    sb_frame *frame = block(24, 24);
    sb_density density = {0};
    sb_error error = {0};
    assert_int_equal(sb_density_build(&density, frame, NULL, 2, &error), SB_OK);
    assert_true(fabsf(sb_density_at(&density, 6, 6, 6) - 1) < 0.08f);
    assert_true(fabsf(sb_density_at(&density, 6, 6, 11.75f) - 0.5f) < 0.12f);
    assert_true(sb_density_at(&density, 6, 6, 14) < 0.01f);
    assert_true(sb_density_at(&density, 600, 6, 6) == 0);
    assert_true(sb_density_at(&density, (double)NAN, 6, 6) == 0);
    /* A distant particle makes the grid coarser, but not larger. A particle at infinity is left out. */
    frame->position[0] = 9e6f;
    frame->position[4] = NAN;
    frame->position[8] = INFINITY;
    assert_int_equal(sb_density_build(&density, frame, NULL, 2, &error), SB_OK);
    assert_true(density.n[0] * density.n[1] * density.n[2] < 30000000);
    frame->spacing = 5e-324; /* a file may contain this value */
    assert_int_equal(sb_density_build(&density, frame, NULL, 2, &error), SB_OK);
    sb_density_free(&density);
    sb_frame_release(frame);
}

static void only_the_surface_is_visible(void **state)
{
    (void)state;
    sb_frame *frame = block(40, 40);
    float *values = sb_alloc(frame->count, sizeof *values);
    assert_non_null(values);
    sb_camera_key key = {.eye = {10, 10, 60}, .target = {10, 10, 0}, .fov = 60};
    sb_view view = sb_view_create(&key, 1, sb_vec(0, 0, 0), sb_vec(20, 20, 20));
    sb_visible visible = {0};
    sb_error error = {0};
    assert_int_equal(sb_visible_collect(&visible, frame, values, NULL, &view, 2, &error), SB_OK);
    size_t top = 0;
    for (size_t i = 0; i < visible.count; i++) {
        const sb_visible_point *point = &visible.points[i];
        top += point->position[2] == 19.5f;
        /* From above, only particles at the sides are visible below the fifth layer. */
        bool side = point->position[0] < 1.6f || point->position[0] > 17.9f || point->position[1] < 1.6f ||
                    point->position[1] > 17.9f;
        assert_true(side || point->position[2] >= 17.5f);
        if (!side) assert_true(point->normal[2] > 120);
    }
    assert_int_equal(top, 40 * 40);
    /* A camera that is turned away sees no particle. */
    key.target.z = 100;
    view = sb_view_create(&key, 1, sb_vec(0, 0, 0), sb_vec(20, 20, 20));
    assert_int_equal(sb_visible_collect(&visible, frame, values, NULL, &view, 2, &error), SB_OK);
    assert_int_equal(visible.count, 0);
    sb_visible_free(&visible);
    sb_free(values);
    sb_frame_release(frame);
}

static void walls_hide_half_the_sky(void **state)
{
    (void)state;
    enum { N = 128 };
    static float height[N * N], open[N * N];
    for (int i = 0; i < N * N; i++) height[i] = i % N >= 96 ? 1000 : 0;
    sb_light_openness(height, N, 1, open);
    assert_true(open[32 * N + 40] > 0.99f); /* beyond the range of the search */
    assert_true(open[32 * N + 100] == 1);   /* on the top */
    assert_true(fabsf(open[32 * N + 95] - 0.55f) < 0.06f);
    assert_true(open[32 * N + 88] >= open[32 * N + 95]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(colormap_lightness_rises_linearly),
        cmocka_unit_test(png_round_trip),
        cmocka_unit_test(image_sizes_are_checked),
        cmocka_unit_test(every_letter_has_its_own_pixels),
        cmocka_unit_test(text_ends_at_its_width),
        cmocka_unit_test(softening_changes_only_jagged_edges),
        cmocka_unit_test(ticks_are_round_numbers),
        cmocka_unit_test(marks_measure_the_scene),
        cmocka_unit_test(outline_finds_the_edges_of_a_cube),
        cmocka_unit_test(density_is_one_inside),
        cmocka_unit_test(only_the_surface_is_visible),
        cmocka_unit_test(walls_hide_half_the_sky),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
