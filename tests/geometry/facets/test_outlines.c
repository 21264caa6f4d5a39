/* Tests outlines: coplanar triangles merged into convex polygons that cover the same area. */
#include "check.h"
#include "geometry/facets/outlines.h"

#include <string.h>

static double area_of_outline(const sb_outline *o)
{
    double area = 0;
    for (size_t k = 0; k < o->count; k++) {
        const sb_vec3 a = sb_sub(o->corner[k], o->corner[0]);
        const sb_vec3 b = sb_sub(o->corner[(k + 1) % o->count], o->corner[0]);
        area += 0.5 * sb_dot(o->normal, sb_cross(a, b));
        const sb_vec3 here = sb_sub(o->corner[(k + 1) % o->count], o->corner[k]);
        const sb_vec3 next = sb_sub(o->corner[(k + 2) % o->count], o->corner[(k + 1) % o->count]);
        const double turn = sb_dot(o->normal, sb_cross(here, next));
        assert_true(turn > 1e-9 || (turn > -1e-9 && sb_dot(here, next) > 0)); /* convex, and no corner turns back */
    }
    return area;
}

/* Triangles of a regular polygon round its middle. The halves of a square share two edges; joined by one of them they
   would keep a spike to the middle. */
static void a_fan(void **state)
{
    (void)state;
    for (uint32_t n = 3; n <= 64; n++) {
        sb_vec3 vertices[65] = {{0, 0, 0}};
        uint32_t triangles[64][3];
        for (uint32_t k = 0; k < n; k++) {
            const double angle = 2 * M_PI * k / n;
            vertices[k + 1] = sb_vec(cos(angle), sin(angle), 0);
            triangles[k][0] = 0;
            triangles[k][1] = k + 1;
            triangles[k][2] = (k + 1) % n + 1;
        }
        const sb_mesh mesh = {.vertex_count = n + 1, .vertices = vertices, .triangle_count = n, .triangles = triangles};
        sb_outlines outlines = {0};
        assert_int_equal(sb_outlines_of_mesh(&mesh, &outlines), 0);
        double area = 0;
        for (size_t k = 0; k < outlines.count; k++) area += area_of_outline(&outlines.outline[k]);
        assert_near(area, 0.5 * n * sin(2 * M_PI / n), 1e-9);
        if (n <= 32) assert_true(outlines.count <= 3);
        if (n == 4) assert_int_equal(outlines.count, 1);
        sb_outlines_free(&outlines);
    }
}

/* Rows of a grid share several edges in a row; a flat grid becomes one polygon, if that has few enough corners. */
static void a_grid(void **state)
{
    (void)state;
    enum { COLUMNS = 7, ROWS = 7 };
    sb_vec3 vertices[COLUMNS * ROWS];
    uint32_t triangles[2 * (COLUMNS - 1) * (ROWS - 1)][3], n = 0;
    for (uint32_t k = 0; k < COLUMNS * ROWS; k++) vertices[k] = sb_vec(k % COLUMNS, k / COLUMNS, 0.25 * (k % COLUMNS));
    for (uint32_t k = 0; k < COLUMNS * (ROWS - 1); k++) {
        if (k % COLUMNS == COLUMNS - 1) continue;
        const uint32_t two[2][3] = {{k, k + 1, k + COLUMNS + 1}, {k, k + COLUMNS + 1, k + COLUMNS}};
        memcpy(triangles[n], two, sizeof two);
        n += 2;
    }
    const sb_mesh mesh = {
        .vertex_count = COLUMNS * ROWS, .vertices = vertices, .triangle_count = n, .triangles = triangles};
    sb_outlines outlines = {0};
    assert_int_equal(sb_outlines_of_mesh(&mesh, &outlines), 0);
    assert_int_equal(outlines.count, 1);
    assert_int_equal(outlines.outline[0].count, 2 * (COLUMNS + ROWS - 2)); /* straight corners stay */
    assert_near(area_of_outline(&outlines.outline[0]), 36 * sqrt(1 + 0.0625), 1e-9);
    sb_outlines_free(&outlines);
}

/* Pieces of a section join to one segment whatever their order. */
static void pieces_of_a_section(void **state)
{
    (void)state;
    static const int order[4][4] = {{0, 1, 2, 3}, {3, 1, 0, 2}, {0, 2, 1, 3}, {1, 3, 2, 0}};
    for (int way = 0; way < 4; way++) {
        sb_vec3 vertices[16];
        uint32_t triangles[8][3];
        for (uint32_t k = 0; k < 4; k++) {
            const double x = order[way][k];
            vertices[4 * k] = sb_vec(x, -1, 2);
            vertices[4 * k + 1] = sb_vec(x + 1, -1, 2);
            vertices[4 * k + 2] = sb_vec(x + 1, 1, 2);
            vertices[4 * k + 3] = sb_vec(x, 1, 2);
            const uint32_t two[2][3] = {{4 * k, 4 * k + 1, 4 * k + 2}, {4 * k, 4 * k + 2, 4 * k + 3}};
            memcpy(triangles[2 * k], two, sizeof two);
        }
        const sb_mesh mesh = {.vertex_count = 16, .vertices = vertices, .triangle_count = 8, .triangles = triangles};
        sb_outlines outlines = {0};
        assert_int_equal(sb_outlines_of_section(&mesh, 0.1, &outlines), 0);
        assert_int_equal(outlines.count, 1);
        assert_near(sb_norm(sb_sub(outlines.outline[0].corner[1], outlines.outline[0].corner[0])), 4, 1e-12);
        sb_outlines_free(&outlines);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_fan),
        cmocka_unit_test(a_grid),
        cmocka_unit_test(pieces_of_a_section),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
