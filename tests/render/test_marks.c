/* Lines, plots, names and boundary particles over a picture. */
#include "../check.h"
#include "base/memory.h"
#include "render/bodies/samples.h"
#include "render/overlay/inset.h"
#include "render/overlay/labels.h"
#include "render/overlay/marks.h"
#include "render/overlay/paint.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static sb_image black(int width, int height)
{
    sb_image image = {0};
    assert_int_equal(sb_image_resize(&image, width, height, NULL), SB_OK);
    memset(image.rgb, 0, 3 * (size_t)width * (size_t)height);
    return image;
}

static int red(const sb_image *image, int x, int y)
{
    return image->rgb[3 * ((size_t)y * (size_t)image->width + (size_t)x)];
}

/* Each pixel of a line, of any slope and partly outside, is as bright as its distance says. */
static void lines_cover_the_pixels_near_them(void **state)
{
    (void)state;
    static const float white[3] = {1, 1, 1};
    static const double ends[][5] = {{5, 5, 55, 9, 3},      {20, 50, 24, 2, 2},    {-30, 20, 90, 45, 4},
                                     {7, 7, 7, 50, 1},      {3, 30, 60, 30, 2},    {30, 30, 30, 30, 6},
                                     {70, 80, 10, -40, 5},  {50, 10, 49.9, 40, 3}, {-9, -9, -2, -2, 1.5},
                                     {60, 60, 80, 61, 2.5}, {1, 1, 62, 62, 1}};
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) {
        sb_image image = black(64, 64);
        const double *e = ends[i];
        sb_paint_line(&image, e[0], e[1], e[2], e[3], e[4], white, 1);
        for (int y = 0; y < 64; y++)
            for (int x = 0; x < 64; x++) {
                double least = HUGE_VAL; /* distance from 4000 points of the line */
                for (int k = 0; k <= 4000; k++)
                    least = fmin(least, hypot(x + 0.5 - e[0] - (e[2] - e[0]) * k / 4000,
                                              y + 0.5 - e[1] - (e[3] - e[1]) * k / 4000));
                const double cover = fmin(fmax(0.5 * e[4] + 0.5 - least, 0), 1);
                if (fabs(red(&image, x, y) - 255 * cover) > 3) /* the points are up to 0.02 px apart */
                    fail_msg("line %zu at %d, %d: %d, expected %g", i, x, y, red(&image, x, y), 255 * cover);
            }
        sb_image_free(&image);
    }
}

static void boxes_are_cut_off(void **state)
{
    (void)state;
    static const float white[3] = {1, 1, 1};
    sb_image image = black(10, 8);
    sb_paint_box(&image, -5, 2, 4, 100, white, 1);
    for (int y = 0; y < 8; y++)
        for (int x = 0; x < 10; x++) assert_int_equal(red(&image, x, y), x < 4 && y >= 2 ? 255 : 0);
    sb_image_free(&image);
}

/* Orange pixels, those of the curve, in a column; their mean height, or -1. */
static double curve_at(const sb_image *image, int x)
{
    double sum = 0, count = 0;
    for (int y = 548; y < 622; y++) {
        const unsigned char *p = image->rgb + 3 * ((size_t)y * (size_t)image->width + (size_t)x);
        if (p[0] < 200 || p[2] > 110 || p[0] < p[1] + 40) continue;
        sum += y;
        count++;
    }
    return count > 0 ? sum / count : -1;
}

/* The highest row of a picture 1280 px x 720 px that the scale bar and its label touch. */
static int scale_bar_top(void)
{
    const sb_camera_key key = {.eye = {0, -10, 0}, .target = {0, 0, 0}, .fov = 60};
    const sb_view view = sb_view_create(&key, 1280.0 / 720, sb_vec(-9, -9, -9), sb_vec(9, 9, 9));
    sb_image image = black(1280, 720);
    assert_int_equal(sb_marks_scale(&image, &view, sb_vec(0, 0, 0), NULL), SB_OK);
    int top = 720;
    for (int y = 719; y >= 0; y--)
        for (int x = 0; x < 1280; x++)
            if (red(&image, x, y) > 0) top = y;
    sb_image_free(&image);
    return top;
}

/* The curve of v = 1000 t rises along the axes of 0 to 10 s and 0 to 10 kN, stops at the picture's time, and has gaps.
 */
static void a_plot_shows_its_rows(void **state)
{
    (void)state;
    enum { ROWS = 61 };
    static double rows[ROWS][2];
    for (int i = 0; i < ROWS; i++) {
        rows[i][0] = 0.1 * i;
        rows[i][1] = i > 20 && i < 30 ? (double)NAN : 100.0 * i;
    }
    sb_image image = black(1280, 720);
    const sb_inset_plot plot = {
        .title = "tank: Fx", .unit = "N", .time = 6, .rows = (const double(*)[2])rows, .count = ROWS};
    assert_int_equal(sb_inset_draw(&image, 0, &plot, NULL), SB_OK);
    const double left = 30 + 54, right = 30 + 300 - 26, bottom = 720 - 72 - 24, top = 720 - 72 - 134 + 33;
    for (double t = 0.5; t < 5.9; t += 0.5) {
        const double y = curve_at(&image, (int)(left + (right - left) * t / 10));
        if (t > 2.05 && t < 2.95) {
            assert_true(y < 0);
            continue;
        }
        const double expected = bottom - (bottom - top) * t / 6;
        if (t < 1.6 || t > 5.4) continue; /* outside of the rows that curve_at looks at */
        if (fabs(y - expected) > 2) fail_msg("t = %g s: the curve is at row %g, expected %g", t, y, expected);
    }
    assert_true(curve_at(&image, (int)(left + (right - left) * 0.65)) < 0);
    /* The plots leave the place of the scale bar, and that of the title. */
    for (int slot = 1; slot < 4; slot++) assert_int_equal(sb_inset_draw(&image, (size_t)slot, &plot, NULL), SB_OK);
    const int bar_top = scale_bar_top();
    assert_true(bar_top > 600);
    for (int y = 0; y < 720; y++)
        for (int x = 0; x < 1280; x++)
            if (y < 76 || y >= bar_top) assert_int_equal(red(&image, x, y), 0);
    /* No rows, and a picture that is too low, are no error. */
    const sb_inset_plot empty = {.title = "", .unit = "m", .time = 0};
    assert_int_equal(sb_inset_draw(&image, 3, &empty, NULL), SB_OK);
    sb_image low = black(160, 90);
    assert_int_equal(sb_inset_draw(&low, 0, &plot, NULL), SB_OK);
    for (int x = 0; x < 160; x++) assert_int_equal(red(&low, x, 60), 0);
    sb_image_free(&low);
    sb_image_free(&image);
}

static void names_do_not_cover_each_other(void **state)
{
    (void)state;
    static const float rgb[3] = {1, 1, 0};
    sb_image image = black(1200, 675);
    sb_labels labels = {0};
    const sb_camera_key key = {.eye = {0, -10, 0}, .target = {0, 0, 0}, .fov = 60};
    const sb_view view = sb_view_create(&key, 1200.0 / 675, sb_vec(-9, -9, -9), sb_vec(9, 9, 9));
    double x, y;
    assert_true(sb_labels_project(&view, &image, sb_vec(0, 0, 0), &x, &y));
    assert_true(fabs(x - 600) < 1e-9 && fabs(y - 337.5) < 1e-9);
    /* At a distance of 10 m the picture is 20 tan(30 deg) m high. */
    assert_true(sb_labels_project(&view, &image, sb_vec(0, 0, 10 * tan(3.14159265358979 / 6)), &x, &y) &&
                fabs(y) < 1e-6);
    assert_false(sb_labels_project(&view, &image, sb_vec(0, -20, 0), &x, &y));
    for (int i = 0; i < 40; i++)
        assert_int_equal(sb_labels_add(&labels, &image, &view, sb_vec(0.02 * i, 0, 0.01 * i), rgb, "reactor", NULL),
                         SB_OK);
    assert_int_equal(labels.count + labels.left_out, 40);
    assert_true(labels.count > 30);
    for (size_t i = 0; i < labels.count; i++)
        for (size_t j = 0; j < i; j++)
            assert_false(labels.box[i].x0 < labels.box[j].x1 && labels.box[i].x1 > labels.box[j].x0 &&
                         labels.box[i].y0 < labels.box[j].y1 && labels.box[i].y1 > labels.box[j].y0);
    /* Neither what is outside of the picture, nor what is behind the eye. */
    const size_t before = labels.count + labels.left_out;
    sb_labels_add(&labels, &image, &view, sb_vec(90, 0, 0), rgb, "far", NULL);
    sb_labels_add(&labels, &image, &view, sb_vec(0, -30, 0), rgb, "behind", NULL);
    assert_int_equal(labels.count + labels.left_out, before);
    sb_image_free(&image);
}

/* Particles on a plane with the spacing have density 1 away from its edges, and four times as many have 4. */
static void the_density_of_a_plane_is_one(void **state)
{
    (void)state;
    enum { SIDE = 40 };
    static sb_vec3 at[SIDE * SIDE];
    static float density[SIDE * SIDE];
    const double spacing = 0.3;
    sb_model model = {.dimensions = 3, .spacing = spacing, .wall_count = SIDE * SIDE, .wall_position = at};
    for (int packed = 0; packed < 2; packed++) {
        const double step = packed ? spacing / 2 : spacing;
        for (int i = 0; i < SIDE; i++)
            for (int j = 0; j < SIDE; j++) at[i * SIDE + j] = sb_vec(100 + i * step, -j * step, 0.2 * i * step);
        /* The plane is inclined: rows are farther apart by the factor of its length. */
        const double expected = (packed ? 4 : 1) / hypot(1, 0.2);
        assert_int_equal(sb_samples_density(&model, spacing, density, NULL), SB_OK);
        for (int i = 5; i < SIDE - 5; i++)
            for (int j = 5; j < SIDE - 5; j++)
                if (fabs((double)density[i * SIDE + j] - expected) > 0.03 * expected)
                    fail_msg("%g at %d, %d, expected %g", (double)density[i * SIDE + j], i, j, expected);
        assert_true((double)density[SIDE / 2] < 0.85 * expected && (double)density[0] < 0.65 * expected);
    }
    model.dimensions = 2;
    model.wall_count = SIDE;
    for (int i = 0; i < SIDE; i++) at[i] = sb_vec(i * spacing, 0, 0);
    assert_int_equal(sb_samples_density(&model, spacing, density, NULL), SB_OK);
    assert_true(fabs((double)density[SIDE / 2] - 1) < 0.01);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_cover_the_pixels_near_them),
        cmocka_unit_test(boxes_are_cut_off),
        cmocka_unit_test(a_plot_shows_its_rows),
        cmocka_unit_test(names_do_not_cover_each_other),
        cmocka_unit_test(the_density_of_a_plane_is_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
