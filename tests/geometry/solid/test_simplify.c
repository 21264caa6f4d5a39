/* Tests the simplification of meshes: the surface stays within the tolerance, closed surfaces stay closed, no triangle
   becomes a line, and what has no detail does not change. */
#include "base/random.h"
#include "geometry/mesh/mesh.h"
#include "geometry/solid/simplify.h"
#include "geometry/solid/solid.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdio.h>

static sb_error error;

/* Largest distance of points of the surface of `of`, at random, from the surface of `from`. */
static double deviation(const sb_mesh *of, const sb_mesh *from, sb_role role)
{
    enum { POINTS = 20000 };
    sb_solid *solid;
    double most = 0;
    assert_int_equal(sb_solid_create(from, role, &solid, &error), SB_OK);
    for (uint64_t k = 0; k < POINTS; k++) {
        const uint32_t *corner = of->triangles[(size_t)(sb_random(1, k) * (double)of->triangle_count)];
        double u = sb_random(2, k), v = sb_random(3, k);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        sb_vec3 at = sb_scale(of->vertices[corner[0]], 1 - u - v);
        at = sb_madd(sb_madd(at, u, of->vertices[corner[1]]), v, of->vertices[corner[2]]);
        most = fmax(most, sb_solid_distance(solid, at, 10, NULL, NULL));
    }
    sb_solid_destroy(solid);
    return most;
}

/* A sphere of rings of triangles. */
static sb_mesh sphere(double radius, uint32_t rings)
{
    const uint32_t around = 2 * rings;
    sb_mesh m;
    assert_int_equal(sb_mesh_alloc(&m, 2 + (size_t)(rings - 1) * around, 2 * (size_t)(rings - 1) * around, &error),
                     SB_OK);
    size_t v = 0, t = 0;
    m.vertices[v++] = sb_vec(0, 0, radius);
    for (uint32_t i = 1; i < rings; i++)
        for (uint32_t k = 0; k < around; k++) {
            const double a = M_PI * i / rings, b = 2 * M_PI * k / around;
            m.vertices[v++] = sb_scale(sb_vec(sin(a) * cos(b), sin(a) * sin(b), cos(a)), radius);
        }
    m.vertices[v] = sb_vec(0, 0, -radius);
    const uint32_t last = (uint32_t)v;
    for (uint32_t k = 0; k < around; k++) {
        const uint32_t next = (k + 1) % around, low = last - around;
        const uint32_t top[3] = {0, 1 + k, 1 + next}, bottom[3] = {last, low + next, low + k};
        for (int c = 0; c < 3; c++) m.triangles[t][c] = top[c], m.triangles[t + 1][c] = bottom[c];
        t += 2;
        for (uint32_t i = 0; i + 2 < rings; i++) {
            const uint32_t at = 1 + i * around, below = at + around;
            const uint32_t two[2][3] = {{at + k, below + k, below + next}, {at + k, below + next, at + next}};
            for (int c = 0; c < 3; c++) m.triangles[t][c] = two[0][c], m.triangles[t + 1][c] = two[1][c];
            t += 2;
        }
    }
    assert_int_equal(t, m.triangle_count);
    return m;
}

static void a_sphere_stays_closed(void **state)
{
    (void)state;
    sb_mesh m = sphere(3, 40), simple;
    sb_mesh_report before, after;
    const double tolerance = 0.1;
    assert_int_equal(sb_mesh_simplify(&m, SB_ROLE_SOLID, tolerance, &simple, &error), SB_OK);
    assert_int_equal(sb_mesh_diagnose(&m, &before, &error), SB_OK);
    assert_int_equal(sb_mesh_diagnose(&simple, &after, &error), SB_OK);
    const double out = deviation(&m, &simple, SB_ROLE_SOLID), in = deviation(&simple, &m, SB_ROLE_SOLID);
    printf("%zu triangles -> %zu, deviation %.3g and %.3g, volume %.4g -> %.4g\n", m.triangle_count,
           simple.triangle_count, out, in, before.volume, after.volume);
    assert_true(before.watertight && after.watertight);
    assert_true(simple.triangle_count < m.triangle_count / 6);
    assert_true(out < 1.2 * tolerance &&
                in < 1.2 * tolerance); /* between vertices and middles it may be a little more */
    assert_true(after.volume > 0.95 * before.volume && after.volume < 1.01 * before.volume);
    sb_mesh_free(&m);
    sb_mesh_free(&simple);
}

/* A grid of squares of 0.25 m on a slope, with heights at random. */
static sb_mesh bumps(double high)
{
    enum { N = 60 };
    sb_mesh m;
    assert_int_equal(sb_mesh_alloc(&m, (N + 1) * (N + 1), 2 * N * N, &error), SB_OK);
    for (uint32_t v = 0; v < m.vertex_count; v++) {
        const double x = 0.25 * (v % (N + 1)), y = 0.25 * (v / (N + 1)); /* NOLINT(bugprone-integer-division) */
        m.vertices[v] = sb_vec(x, y, 0.3 * x + high * (sb_random(4, v) - 0.5));
    }
    for (uint32_t k = 0; k < N * N; k++) {
        const uint32_t at = k / N * (N + 1) + k % N, above = at + N + 1;
        const uint32_t two[2][3] = {{at, at + 1, above}, {at + 1, above + 1, above}};
        for (int c = 0; c < 3; c++) m.triangles[2 * k][c] = two[0][c], m.triangles[2 * k + 1][c] = two[1][c];
    }
    m.open_surface = true;
    return m;
}

static void small_bumps_vanish(void **state)
{
    (void)state;
    const double tolerance = 0.1;
    for (int k = 0; k < 3; k++) {
        const double high = (const double[]){0, 0.08, 0.4}[k];
        sb_mesh m = bumps(high), simple;
        sb_mesh_report after;
        assert_int_equal(sb_mesh_simplify(&m, SB_ROLE_TERRAIN, tolerance, &simple, &error), SB_OK);
        assert_int_equal(sb_mesh_diagnose(&simple, &after, &error), SB_OK);
        const double out = deviation(&m, &simple, SB_ROLE_TERRAIN);
        const double in = deviation(&simple, &m, SB_ROLE_TERRAIN);
        printf("bumps of %g: %zu triangles -> %zu, deviation %.3g and %.3g\n", high, m.triangle_count,
               simple.triangle_count, out, in);
        assert_true(simple.open_surface && out < 1.2 * tolerance && in < 1.2 * tolerance);
        assert_int_equal(after.degenerate_faces, 0);
        if (k < 2) assert_true(simple.triangle_count < 100);
        sb_mesh_free(&m);
        sb_mesh_free(&simple);
    }
}

/* Corners along a straight edge between two faces leave no cracks: the box stays closed. */
static void a_box_of_small_squares_stays_closed(void **state)
{
    (void)state;
    enum { N = 12 };
    sb_mesh m, simple;
    assert_int_equal(sb_mesh_alloc(&m, 6 * N * N * 4, 6 * N * N * 2, &error), SB_OK);
    for (uint32_t k = 0; k < 6 * N * N; k++) {
        const uint32_t axis = k / (2 * N * N), high = k / (N * N) % 2, i = k / N % N, j = k % N;
        for (uint32_t c = 0; c < 4; c++) {
            double x[3];
            x[axis] = high;
            x[(axis + 1) % 3] = (i + (c == 1 || c == 2)) / (double)N;
            x[(axis + 2) % 3] = (j + (c >= 2)) / (double)N;
            m.vertices[4 * k + c] = sb_vec(x[0], x[1], x[2]);
        }
        const uint32_t two[2][3] = {{0, 1, 2}, {0, 2, 3}};
        for (int t = 0; t < 2; t++)
            for (int c = 0; c < 3; c++) m.triangles[2 * k + (uint32_t)t][high ? c : 2 - c] = 4 * k + two[t][c];
    }
    assert_int_equal(sb_mesh_weld(&m, &error), SB_OK);
    assert_int_equal(sb_mesh_simplify(&m, SB_ROLE_SOLID, 0.01, &simple, &error), SB_OK);
    sb_mesh_report report;
    assert_int_equal(sb_mesh_diagnose(&simple, &report, &error), SB_OK);
    printf("a box of %zu triangles -> %zu, volume %.17g\n", m.triangle_count, simple.triangle_count, report.volume);
    assert_true(report.watertight && report.degenerate_faces == 0);
    assert_true(simple.triangle_count <= 24 && fabs(report.volume - 1) < 1e-9);
    sb_mesh_free(&m);
    sb_mesh_free(&simple);
}

static void a_box_does_not_change(void **state)
{
    (void)state;
    sb_mesh m, simple;
    assert_int_equal(sb_mesh_box(sb_vec(0, 0, 0), sb_vec(1, 0.3, 2), &m, &error), SB_OK);
    assert_int_equal(sb_mesh_simplify(&m, SB_ROLE_SOLID, 0.1, &simple, &error), SB_OK);
    assert_int_equal(simple.triangle_count, 0);
    sb_mesh_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sphere_stays_closed),
        cmocka_unit_test(small_bumps_vanish),
        cmocka_unit_test(a_box_of_small_squares_stays_closed),
        cmocka_unit_test(a_box_does_not_change),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
