/* The smooth surface of the water: surface elements, their pictures, and the colours of fields. */
#include "base/memory.h"
#include "render/water/fields.h"
#include "render/water/splat.h"
#include "render/water/visible.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 160, HEIGHT = 120 };

/* nx x ny x nz particles on a lattice of 0.5 m, the lowest corner at (0.25, 0.25, 0.25). */
static sb_frame *lattice(int nx, int ny, int nz)
{
    sb_frame *frame = sb_frame_create((size_t)(nx * ny * nz), 0);
    assert_non_null(frame);
    frame->spacing = 0.5;
    float *p = frame->position;
    for (int k = 0; k < nz; k++)
        for (int j = 0; j < ny; j++)
            for (int i = 0; i < nx; i++, p += 3) {
                p[0] = 0.25f + 0.5f * (float)i;
                p[1] = 0.25f + 0.5f * (float)j;
                p[2] = 0.25f + 0.5f * (float)k;
            }
    memset(frame->velocity, 0, 3 * frame->count * sizeof(float));
    memset(frame->pressure, 0, frame->count * sizeof(float));
    return frame;
}

/* A picture of the frame; the caller frees both. */
static void draw(const sb_frame *frame, sb_vec3 eye, sb_vec3 target, int threads, sb_surfels *surfels, sb_splat *splat)
{
    sb_error error = {0};
    const sb_camera_key key = {0, eye, target, 50, SB_EASE_SMOOTH};
    const sb_view view = sb_view_create(&key, (double)WIDTH / HEIGHT, sb_vec(-20, -20, -20), sb_vec(60, 60, 60));
    float *values = sb_alloc(frame->count, sizeof *values);
    assert_non_null(values);
    memset(surfels, 0, sizeof *surfels);
    if (sb_splat_create(WIDTH, HEIGHT, splat, &error) != SB_OK ||
        sb_surfels_collect(surfels, frame, values, NULL, &view, threads, &error) != SB_OK ||
        sb_splat_draw(splat, surfels, &view, frame->spacing, threads, &error) != SB_OK)
        fail_msg("%s", error.text);
    sb_free(values);
}

/* Calm water of a lattice is a plane, whatever the size of its particles in the picture: the exact depth of each pixel
   is known. */
static void calm_water_is_flat(void **state)
{
    (void)state;
    static const double heights[] = {2, 8, 30};
    sb_frame *frame = lattice(60, 60, 8);
    for (size_t h = 0; h < sizeof heights / sizeof *heights; h++) {
        sb_surfels surfels;
        sb_splat splat;
        const sb_vec3 eye = sb_vec(15, 15 - 0.3 * heights[h], 4 + heights[h]);
        draw(frame, eye, sb_vec(15, 15, 4), 2, &surfels, &splat);
        const double slope = tan(25 * 3.14159265358979323846 / 180) * 2 / HEIGHT, tilt = atan2(1, 0.3);
        int pixels = 0;
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                /* Depth at which the ray is at z = 4, and whether it is at least 3 m inside of the edges there. */
                const double u = (x + 0.5 - WIDTH / 2.0) * slope, v = (y + 0.5 - HEIGHT / 2.0) * slope;
                const double depth = heights[h] / (sin(tilt) - v * cos(tilt));
                const double at_x = eye.x + depth * u, at_y = eye.y + depth * (cos(tilt) + v * sin(tilt));
                if (at_x < 3 || at_x > 27 || at_y < 3 || at_y > 27) continue;
                const float *surface = splat.surface + 4 * (y * WIDTH + x), *cover = splat.cover + 4 * (y * WIDTH + x);
                assert_true(cover[0] == 1);
                /* A tenth of a spacing of height, and one degree. */
                assert_true(fabs(((double)surface[0] - depth) * sin(tilt)) < 0.05);
                assert_true(fabs((double)surface[2]) < 0.02 && fabs((double)surface[3] - cos(tilt)) < 0.02);
                pixels++;
            }
        assert_true(pixels > WIDTH * HEIGHT / 8);
        sb_surfels_free(&surfels);
        sb_splat_free(&splat);
    }
    sb_frame_release(frame);
}

static void threads_do_not_change_a_bit(void **state)
{
    (void)state;
    sb_frame *frame = lattice(40, 30, 12);
    for (size_t i = 0; i < 3 * frame->count; i++)
        frame->position[i] += 0.4f * sinf(12.9898f * (float)i); /* disorder, with drops above the surface */
    sb_surfels surfels[3];
    sb_splat splat[3];
    for (int t = 0; t < 3; t++) draw(frame, sb_vec(10, -12, 14), sb_vec(10, 8, 4), t + 1, &surfels[t], &splat[t]);
    for (int t = 1; t < 3; t++) {
        assert_memory_equal(splat[0].surface, splat[t].surface, 4 * sizeof(float) * WIDTH * HEIGHT);
        assert_memory_equal(splat[0].cover, splat[t].cover, 4 * sizeof(float) * WIDTH * HEIGHT);
    }
    for (int t = 0; t < 3; t++) {
        sb_surfels_free(&surfels[t]);
        sb_splat_free(&splat[t]);
    }
    sb_frame_release(frame);
}

/* A drop is drawn as a small translucent sphere, a layer of particles as an unbroken sheet. */
static void drops_are_small_and_sheets_unbroken(void **state)
{
    (void)state;
    sb_frame *sheet = lattice(40, 1, 40), *drop = lattice(1, 1, 1);
    drop->position[0] = 10;
    drop->position[2] = 10;
    sheet->position[1] += 0.1f; /* or it would be a slice */
    sb_surfels surfels;
    sb_splat splat;
    draw(sheet, sb_vec(10, -10, 10), sb_vec(10, 0, 10), 1, &surfels, &splat);
    for (size_t i = 0; i < WIDTH * HEIGHT; i++) assert_true(splat.cover[4 * i] == 1);
    sb_surfels_free(&surfels);
    sb_splat_free(&splat);
    draw(drop, sb_vec(10, -10, 10), sb_vec(10, 0, 10), 1, &surfels, &splat);
    int seen = 0;
    for (size_t i = 0; i < WIDTH * HEIGHT; i++) {
        assert_true(splat.cover[4 * i] < 0.5f);
        seen += splat.cover[4 * i + 2] > 0.1f;
    }
    /* Less than a circle of 0.35 spacings: 2.2 px. */
    assert_in_range(seen, 2, 15);
    sb_surfels_free(&surfels);
    sb_splat_free(&splat);
    sb_frame_release(sheet);
    sb_frame_release(drop);
}

/* A slice that is seen along its plane, as at the ends of a wide picture: no particle hides another. */
static void all_of_a_slice_is_visible(void **state)
{
    (void)state;
    sb_frame *frame = lattice(80, 1, 16);
    const sb_vec3 eye = sb_vec(20, -6, 4), target = sb_vec(26, 0.25, 4);
    sb_surfels surfels;
    sb_splat splat;
    draw(frame, eye, target, 1, &surfels, &splat);
    for (size_t i = 0; i < WIDTH * 3 / 4; i++) assert_true(splat.cover[4 * (HEIGHT / 2 * WIDTH + i)] == 1);
    const sb_camera_key key = {0, eye, target, 50, SB_EASE_SMOOTH};
    const sb_view view = sb_view_create(&key, (double)WIDTH / HEIGHT, sb_vec(-20, -20, -20), sb_vec(60, 60, 60));
    sb_visible visible = {0};
    sb_error error = {0};
    float *values = sb_alloc(frame->count, sizeof *values);
    assert_non_null(values);
    assert_int_equal(sb_visible_collect(&visible, frame, values, NULL, &view, 1, &error), SB_OK);
    size_t middle = 0;
    for (size_t i = 0; i < visible.count; i++) {
        const float *p = visible.points[i].position;
        middle += p[0] > 24 && p[0] < 34 && p[2] > 2 && p[2] < 6;
    }
    assert_int_equal(middle, 20 * 8);
    sb_free(values);
    sb_visible_free(&visible);
    sb_surfels_free(&surfels);
    sb_splat_free(&splat);
    sb_frame_release(frame);
}

/* At a vertical wall and at the ground, the density is that of the water in front of it. */
static void density_continues_into_walls(void **state)
{
    (void)state;
    enum { SIDE = 40 };
    static float height[SIDE * SIDE]; /* the ground is at z = 0, a wall with its face at x = 10 */
    for (int i = 0; i < SIDE * SIDE; i++) height[i] = i % SIDE >= 10 ? 30 : 0;
    const sb_ground ground = {.side = SIDE, .height = height, .per_cell = 1, .floor_level = -5};
    sb_frame *frame = lattice(20, 40, 8);
    sb_density open = {0}, closed = {0};
    sb_error error = {0};
    assert_int_equal(sb_density_build(&open, frame, NULL, 2, &error), SB_OK);
    assert_int_equal(sb_density_build(&closed, frame, &ground, 2, &error), SB_OK);
    assert_true(sb_density_at(&open, 9.75f, 10, 2) < 0.75f);
    assert_true(fabsf(sb_density_at(&closed, 9.75f, 10, 2) - 1) < 0.12f);
    assert_true(fabsf(sb_density_at(&closed, 5, 10, 0.25f) - 1) < 0.12f);
    assert_true(fabsf(sb_density_at(&closed, 5, 10, 2) - sb_density_at(&open, 5, 10, 2)) < 1e-5f);
    assert_true(sb_density_at(&closed, 5, 10, 6) < 0.01f);
    sb_density_free(&open);
    sb_density_free(&closed);
    sb_frame_release(frame);
}

static void compute(sb_values *values, const sb_frame *frame, sb_water_color color, double max)
{
    sb_error error = {0};
    if (sb_values_compute(values, frame, color, 0, max, &error) != SB_OK) fail_msg("%s", error.text);
}

/* Whether a particle of 15 x 15 m of water is away from the sides, where cells are not full. */
static bool inside(const sb_frame *frame, size_t i)
{
    const float *p = frame->position + 3 * i;
    return p[0] > 2 && p[0] < 13 && p[1] > 2 && p[1] < 13;
}

/* Fields of flows whose exact values are known. */
static void fields_have_their_values(void **state)
{
    (void)state;
    sb_frame *frame = lattice(30, 30, 8);
    sb_values values = {0};
    for (size_t i = 0; i < frame->count; i++) {
        /* Rotation with 0.3 1/s about the vertical axis through (7.5, 7.5): the curl is 0.6 1/s. */
        const float *p = frame->position + 3 * i;
        frame->velocity[3 * i] = -0.3f * (p[1] - 7.5f);
        frame->velocity[3 * i + 1] = 0.3f * (p[0] - 7.5f);
        frame->pressure[i] = 9810 * (4 - p[2]);
    }
    compute(&values, frame, SB_COLOR_VORTICITY, 1);
    for (size_t i = 0; i < frame->count; i++)
        if (inside(frame, i)) assert_true(fabsf(values.list[i] - 0.6f) < 0.06f);
    compute(&values, frame, SB_COLOR_PRESSURE, 39240);
    for (size_t i = 0; i < frame->count; i++) assert_true(fabsf(values.list[i] - frame->pressure[i] / 39240) < 1e-5f);
    sb_error error = {0};
    assert_int_equal(sb_values_compute(&values, frame, SB_COLOR_DENSITY_ERROR, 0, 1, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "density_error"));
    assert_true(sb_frame_add_density_error(frame));
    for (size_t i = 0; i < frame->count; i++) frame->density_error[i] = 1e-5f * (float)(i % 1000);
    compute(&values, frame, SB_COLOR_DENSITY_ERROR, 1); /* % */
    for (size_t i = 0; i < frame->count; i++) assert_true(fabsf(values.list[i] - 1e-3f * (float)(i % 1000)) < 1e-5f);
    compute(&values, frame, SB_COLOR_SPEED, 10);
    for (size_t i = 0; i < frame->count; i++) {
        const double v = hypot((double)frame->velocity[3 * i], (double)frame->velocity[3 * i + 1]);
        assert_true(fabs((double)values.list[i] - v / 10) < 1e-5);
    }
    /* Water of 4 m depth that moves with 3 m/s: 4 m and 36 m3/s2, away from the edges. */
    for (size_t i = 0; i < frame->count; i++) {
        frame->velocity[3 * i] = 3;
        frame->velocity[3 * i + 1] = 0;
    }
    for (int flux = 0; flux < 2; flux++) {
        compute(&values, frame, flux ? SB_COLOR_MOMENTUM_FLUX : SB_COLOR_DEPTH, flux ? 72 : 8);
        for (size_t i = 0; i < frame->count; i++)
            if (inside(frame, i)) assert_true(fabsf(values.list[i] - 0.5f) < 0.06f);
    }
    sb_values_free(&values);
    sb_frame_release(frame);
}

static void strange_particles_are_left_out(void **state)
{
    (void)state;
    sb_frame *frame = lattice(8, 8, 8);
    sb_surfels surfels;
    sb_splat splat;
    sb_values values = {0};
    frame->position[0] = NAN;
    frame->position[4] = INFINITY;
    frame->position[8] = -9e9f;
    assert_true(sb_frame_add_density_error(frame));
    memset(frame->density_error, 0, frame->count * sizeof(float));
    for (int color = 0; color < SB_WATER_COLORS; color++) compute(&values, frame, (sb_water_color)color, 1);
    draw(frame, sb_vec(2, -8, 6), sb_vec(2, 2, 2), 2, &surfels, &splat);
    for (size_t i = 0; i < 4 * WIDTH * HEIGHT; i++) assert_true(isfinite(splat.surface[i]) && isfinite(splat.cover[i]));
    sb_values_free(&values);
    sb_surfels_free(&surfels);
    sb_splat_free(&splat);
    sb_frame_release(frame);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(calm_water_is_flat),
        cmocka_unit_test(threads_do_not_change_a_bit),
        cmocka_unit_test(drops_are_small_and_sheets_unbroken),
        cmocka_unit_test(all_of_a_slice_is_visible),
        cmocka_unit_test(density_continues_into_walls),
        cmocka_unit_test(fields_have_their_values),
        cmocka_unit_test(strange_particles_are_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
