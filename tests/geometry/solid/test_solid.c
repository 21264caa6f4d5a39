/* Tests distance, rays, winding numbers and inside tests against sums over all triangles. */
#include "base/clock.h"
#include "base/memory.h"
#include "base/random.h"
#include "geometry/solid/solid.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static sb_error error;

#define assert_ok(call)                                                                                                \
    do {                                                                                                               \
        error.text[0] = 0;                                                                                             \
        if ((call) != SB_OK) fail_msg("%s", error.text);                                                               \
    } while (0)

static sb_vec3 random_point(uint64_t seed, uint64_t index, sb_vec3 min, sb_vec3 max)
{
    return sb_vec(min.x + (max.x - min.x) * sb_random(seed, 3 * index),
                  min.y + (max.y - min.y) * sb_random(seed, 3 * index + 1),
                  min.z + (max.z - min.z) * sb_random(seed, 3 * index + 2));
}

/* Makes an uneven ball of 2 * rings * 2 rings triangles around (3, -2, 1) with a radius of about 1. */
static void make_ball(uint32_t rings, sb_mesh *mesh)
{
    uint32_t around = 2 * rings;
    assert_ok(sb_mesh_alloc(mesh, (size_t)around * (rings - 1) + 2, 2 * (size_t)around * (rings - 1), &error));
    size_t vertex = 0, triangle = 0;
    for (uint32_t i = 1; i < rings; ++i)
        for (uint32_t j = 0; j < around; ++j) {
            double polar = M_PI * i / rings, angle = 2 * M_PI * j / around;
            double r = 1 + 0.2 * sin(5 * polar) * cos(3 * angle);
            mesh->vertices[vertex++] =
                sb_vec(3 + r * sin(polar) * cos(angle), -2 + r * sin(polar) * sin(angle), 1 + r * cos(polar));
        }
    uint32_t top = (uint32_t)vertex, bottom = top + 1;
    mesh->vertices[top] = sb_vec(3, -2, 2);
    mesh->vertices[bottom] = sb_vec(3, -2, 0);
    for (uint32_t j = 0; j < around; ++j) {
        uint32_t k = (j + 1) % around, last = (rings - 2) * around;
        memcpy(mesh->triangles[triangle++], (uint32_t[3]){top, j, k}, 12);
        memcpy(mesh->triangles[triangle++], (uint32_t[3]){bottom, last + k, last + j}, 12);
        for (uint32_t i = 0; i + 2 < rings; ++i) {
            uint32_t a = i * around + j, b = i * around + k;
            memcpy(mesh->triangles[triangle++], (uint32_t[3]){a, a + around, b}, 12);
            memcpy(mesh->triangles[triangle++], (uint32_t[3]){b, a + around, b + around}, 12);
        }
    }
    assert_int_equal(triangle, mesh->triangle_count);
}

/* Heights over n x n squares of side 1, offset to x0, y0. */
static double hill(double x, double y)
{
    return 3 * sin(0.3 * x) * cos(0.2 * y) + 0.05 * x;
}

static void make_terrain(uint32_t n, double x0, double y0, sb_mesh *mesh)
{
    assert_ok(sb_mesh_alloc(mesh, (size_t)(n + 1) * (n + 1), 2 * (size_t)n * n, &error));
    for (uint32_t j = 0; j <= n; ++j)
        for (uint32_t i = 0; i <= n; ++i) mesh->vertices[j * (n + 1) + i] = sb_vec(x0 + i, y0 + j, hill(i, j));
    size_t triangle = 0;
    for (uint32_t j = 0; j < n; ++j)
        for (uint32_t i = 0; i < n; ++i) {
            uint32_t a = j * (n + 1) + i, c = a + n + 1;
            memcpy(mesh->triangles[triangle++], (uint32_t[3]){a, a + 1, c}, 12);
            memcpy(mesh->triangles[triangle++], (uint32_t[3]){a + 1, c + 1, c}, 12);
        }
}

static void corners_of(const sb_mesh *mesh, size_t i, sb_vec3 corner[3])
{
    for (int k = 0; k < 3; ++k) corner[k] = mesh->vertices[mesh->triangles[i][k]];
}

static double exact_winding(const sb_mesh *mesh, sb_vec3 p)
{
    double sum = 0;
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        sb_vec3 v[3];
        corners_of(mesh, i, v);
        for (int k = 0; k < 3; ++k) v[k] = sb_sub(v[k], p);
        double a = sb_norm(v[0]), b = sb_norm(v[1]), c = sb_norm(v[2]);
        sum += 2 * atan2(sb_dot(v[0], sb_cross(v[1], v[2])),
                         a * b * c + sb_dot(v[0], v[1]) * c + sb_dot(v[1], v[2]) * a + sb_dot(v[2], v[0]) * b);
    }
    return sum / (4 * M_PI);
}

/* Computes the smallest distance directly for each triangle: to the plane if the projection is inside by barycentric
   coordinates, else to the three edges. */
static double exact_distance(const sb_mesh *mesh, sb_vec3 p)
{
    double best = HUGE_VAL;
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        sb_vec3 v[3];
        corners_of(mesh, i, v);
        sb_vec3 e1 = sb_sub(v[1], v[0]), e2 = sb_sub(v[2], v[0]), w = sb_sub(p, v[0]);
        double aa = sb_dot(e1, e1), ab = sb_dot(e1, e2), bb = sb_dot(e2, e2);
        double wa = sb_dot(w, e1), wb = sb_dot(w, e2), det = aa * bb - ab * ab;
        double s = (wa * bb - wb * ab) / det, t = (wb * aa - wa * ab) / det;
        if (s >= 0 && t >= 0 && s + t <= 1) {
            double d = sb_norm(sb_sub(w, sb_add(sb_scale(e1, s), sb_scale(e2, t))));
            best = d < best ? d : best;
        }
        for (int k = 0; k < 3; ++k) {
            sb_vec3 e = sb_sub(v[(k + 1) % 3], v[k]), u = sb_sub(p, v[k]);
            double r = sb_dot(u, e) / sb_dot(e, e);
            r = r < 0 ? 0 : r > 1 ? 1 : r;
            double d = sb_norm(sb_madd(u, -r, e));
            best = d < best ? d : best;
        }
    }
    return best;
}

static void test_winding_is_the_exact_sum(void **state)
{
    (void)state;
    sb_mesh mesh;
    make_ball(24, &mesh);
    sb_solid *solid;
    assert_ok(sb_solid_create(&mesh, SB_ROLE_SOLID, &solid, &error));
    double worst = 0, worst_near = 0;
    for (uint64_t i = 0; i < 1000; ++i) {
        sb_vec3 p = random_point(1, i, sb_vec(1, -4, -1), sb_vec(5, 0, 3));
        double off = fabs(sb_solid_winding(solid, p) - exact_winding(&mesh, p));
        worst = off > worst ? off : worst;
        /* Just beside a triangle's centre, on alternating sides. */
        sb_vec3 v[3];
        corners_of(&mesh, i % mesh.triangle_count, v);
        sb_vec3 center = sb_scale(sb_add(v[0], sb_add(v[1], v[2])), 1.0 / 3);
        sb_vec3 normal = sb_normalize(sb_cross(sb_sub(v[1], v[0]), sb_sub(v[2], v[0])));
        p = sb_madd(center, i % 2 ? 1e-6 : -1e-6, normal);
        off = fabs(sb_solid_winding(solid, p) - exact_winding(&mesh, p));
        worst_near = off > worst_near ? off : worst_near;
        assert_int_equal(sb_solid_contains(solid, p), i % 2 == 0);
    }
    print_message("winding: worst error %.2g, beside the surface %.2g\n", worst, worst_near);
    assert_true(worst <= 0.01 && worst_near <= 0.01);
    sb_solid_destroy(solid);
    sb_mesh_free(&mesh);
}

static void test_winding_of_small_mesh_is_exact_near(void **state)
{
    (void)state;
    sb_mesh box;
    assert_ok(sb_mesh_box(sb_vec(0, 0, 0), sb_vec(1, 2, 3), &box, &error));
    sb_solid *solid;
    assert_ok(sb_solid_create(&box, SB_ROLE_SOLID, &solid, &error));
    for (uint64_t i = 0; i < 300; ++i) {
        sb_vec3 p = random_point(2, i, sb_vec(-0.1, -0.1, -0.1), sb_vec(1.1, 2.1, 3.1));
        bool inside = p.x > 0 && p.x < 1 && p.y > 0 && p.y < 2 && p.z > 0 && p.z < 3;
        assert_true(fabs(sb_solid_winding(solid, p) - exact_winding(&box, p)) < 1e-12);
        assert_true(fabs(sb_solid_winding(solid, p) - inside) < 1e-9);
        assert_int_equal(sb_solid_contains(solid, p), inside);
    }
    sb_solid_destroy(solid);
    sb_mesh_free(&box);
}

static void test_distance_is_the_least_of_all(void **state)
{
    (void)state;
    sb_mesh mesh;
    make_ball(12, &mesh);
    sb_solid *solid;
    assert_ok(sb_solid_create(&mesh, SB_ROLE_SOLID, &solid, &error));
    for (uint64_t i = 0; i < 1000; ++i) {
        sb_vec3 p = random_point(3, i, sb_vec(1, -4, -1), sb_vec(5, 0, 3)), nearest, normal;
        double exact = exact_distance(&mesh, p);
        double found = sb_solid_distance(solid, p, HUGE_VAL, &nearest, &normal);
        assert_true(fabs(found - exact) < 1e-12);
        assert_true(fabs(sb_norm(sb_sub(nearest, p)) - exact) < 1e-12);
        assert_true(fabs(sb_norm(normal) - 1) < 1e-12);
        double limited = sb_solid_distance(solid, p, 0.3, NULL, NULL);
        assert_true(fabs(limited - (exact < 0.3 ? exact : 0.3)) < 1e-12);
    }
    sb_solid_destroy(solid);
    sb_mesh_free(&mesh);
}

static void test_rays_hit_the_first_face(void **state)
{
    (void)state;
    sb_mesh box;
    assert_ok(sb_mesh_box(sb_vec(-1, -1, -1), sb_vec(1, 1, 1), &box, &error));
    sb_solid *solid;
    assert_ok(sb_solid_create(&box, SB_ROLE_SOLID, &solid, &error));
    assert_true(fabs(sb_solid_raycast(solid, sb_vec(-3, 0.2, 0), sb_vec(1, 0, 0), 10) - 2) < 1e-12);
    assert_true(fabs(sb_solid_raycast(solid, sb_vec(0, 0.2, 0), sb_vec(1, 0, 0), 10) - 1) < 1e-12);
    assert_true(sb_solid_raycast(solid, sb_vec(-3, 0.2, 0), sb_vec(1, 0, 0), 1.9) < 0);
    assert_true(sb_solid_raycast(solid, sb_vec(-3, 0.2, 0), sb_vec(-1, 0, 0), 10) < 0);
    assert_true(sb_solid_raycast(solid, sb_vec(-3, 1.2, 0), sb_vec(1, 0, 0), 10) < 0);
    /* From inside, every direction hits, diagonals, edges and corners included. */
    for (uint64_t i = 0; i < 2000; ++i) {
        sb_vec3 d = random_point(4, i, sb_vec(-1, -1, -1), sb_vec(1, 1, 1));
        if (i % 3 == 0) d = sb_vec(d.x < 0 ? -1 : 1, d.y < 0 ? -1 : 1, i % 2 ? d.z : 1);
        double widest = fmax(fabs(d.x), fmax(fabs(d.y), fabs(d.z))), length = sb_norm(d);
        double t = sb_solid_raycast(solid, sb_vec(0, 0, 0), sb_scale(d, 1 / length), 10);
        assert_true(fabs(t - length / widest) < 1e-9);
    }
    sb_solid_destroy(solid);
    sb_mesh_free(&box);
}

static void test_terrain_is_solid_below(void **state)
{
    (void)state;
    enum { N = 40 };
    sb_mesh mesh;
    make_terrain(N, 1e6, -2e6, &mesh);
    sb_solid *solid;
    assert_ok(sb_solid_create(&mesh, SB_ROLE_TERRAIN, &solid, &error));
    for (uint64_t i = 0; i < 4000; ++i) {
        /* Every other point lies on a grid line or node, where triangles meet. */
        double x = N * sb_random(5, 3 * i), y = N * sb_random(5, 3 * i + 1);
        x = i % 2 ? floor(x) : x;
        y = i % 4 == 1 ? floor(y) : y;
        uint32_t a = (uint32_t)x, b = (uint32_t)y;
        double u = x - a, v = y - b;
        double z = u + v < 1 ? hill(a, b) * (1 - u - v) + hill(a + 1, b) * u + hill(a, b + 1) * v
                             : hill(a + 1, b + 1) * (u + v - 1) + hill(a + 1, b) * (1 - v) + hill(a, b + 1) * (1 - u);
        assert_true(sb_solid_contains(solid, sb_vec(1e6 + x, -2e6 + y, z - 1e-6)));
        assert_true(sb_solid_contains(solid, sb_vec(1e6 + x, -2e6 + y, z - 100)));
        assert_false(sb_solid_contains(solid, sb_vec(1e6 + x, -2e6 + y, z + 1e-6)));
    }
    assert_false(sb_solid_contains(solid, sb_vec(1e6 - 0.1, -2e6 + 5, -50)));
    assert_false(sb_solid_contains(solid, sb_vec(1e6 + 5, -2e6 + N + 0.1, -50)));
    sb_solid_destroy(solid);
    sb_mesh_free(&mesh);
    /* A closed block as terrain: solid inside it, and below it, too. */
    assert_ok(sb_mesh_box(sb_vec(0, 0, -1), sb_vec(4, 4, 2), &mesh, &error));
    assert_ok(sb_solid_create(&mesh, SB_ROLE_TERRAIN, &solid, &error));
    assert_true(sb_solid_contains(solid, sb_vec(2, 2, 1.9)));
    assert_true(sb_solid_contains(solid, sb_vec(1, 2, -5)));
    assert_false(sb_solid_contains(solid, sb_vec(2, 2, 2.1)));
    assert_false(sb_solid_contains(solid, sb_vec(4.1, 2, 1)));
    sb_solid_destroy(solid);
    sb_mesh_free(&mesh);
}

/* Points that are aligned with corners, edges and faces of a closed mesh, where rays hit many triangles. */
static void test_aligned_points(void **state)
{
    (void)state;
    sb_mesh box, ball;
    sb_solid *solid;
    assert_ok(sb_mesh_box(sb_vec(1, 1, 1), sb_vec(3, 3, 3), &box, &error));
    assert_ok(sb_solid_create(&box, SB_ROLE_SOLID, &solid, &error));
    for (int i = 0; i < 9 * 9 * 9; ++i) {
        sb_vec3 p = sb_vec(i % 9 * 0.5, i / 9 % 9 * 0.5, i / 81 * 0.5);
        bool inside = p.x > 1 && p.x < 3 && p.y > 1 && p.y < 3 && p.z > 1 && p.z < 3;
        bool outside = p.x < 1 || p.x > 3 || p.y < 1 || p.y > 3 || p.z < 1 || p.z > 3;
        if (inside || outside) assert_int_equal(sb_solid_contains(solid, p), inside);
    }
    sb_solid_destroy(solid);
    sb_mesh_free(&box);
    make_ball(16, &ball);
    assert_ok(sb_solid_create(&ball, SB_ROLE_SOLID, &solid, &error));
    for (size_t i = 0; i < ball.vertex_count; ++i)
        for (int k = -8; k <= 8; ++k) {
            sb_vec3 p = sb_add(ball.vertices[i], sb_vec(0, 0, 0.21 * k));
            double winding = exact_winding(&ball, p);
            if (fabs(winding - round(winding)) < 1e-6) assert_int_equal(sb_solid_contains(solid, p), winding > 0.5);
        }
    sb_solid_destroy(solid);
    sb_mesh_free(&ball);
}

static void test_flipped_and_broken_boxes(void **state)
{
    (void)state;
    sb_mesh flipped, open;
    assert_ok(sb_mesh_box(sb_vec(0, 0, 0), sb_vec(1, 1, 1), &flipped, &error));
    assert_ok(sb_mesh_box(sb_vec(0, 0, 0), sb_vec(1, 1, 1), &open, &error));
    for (size_t i = 0; i < flipped.triangle_count; ++i) {
        uint32_t swapped = flipped.triangles[i][1];
        flipped.triangles[i][1] = flipped.triangles[i][2];
        flipped.triangles[i][2] = swapped;
    }
    open.triangle_count -= 2; /* the lid */
    sb_solid *solid[2];
    assert_ok(sb_solid_create(&flipped, SB_ROLE_SOLID, &solid[0], &error));
    assert_ok(sb_solid_create(&open, SB_ROLE_SOLID, &solid[1], &error));
    assert_true(fabs(sb_solid_winding(solid[0], sb_vec(0.3, 0.4, 0.5)) + 1) < 1e-12);
    assert_true(fabs(sb_solid_winding(solid[1], sb_vec(0.5, 0.5, 0.5)) - 5.0 / 6) < 1e-12);
    for (uint64_t i = 0; i < 1000; ++i) {
        sb_vec3 p = random_point(6, i, sb_vec(-0.5, -0.5, -0.5), sb_vec(1.5, 1.5, 1.5));
        bool inside = p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1 && p.z > 0 && p.z < 1;
        assert_int_equal(sb_solid_contains(solid[0], p), inside);
        /* Where the lid is missing, the outside may extend into the box by up to half the opening. */
        if (!inside || p.z < 0.5) assert_int_equal(sb_solid_contains(solid[1], p), inside);
    }
    for (int i = 0; i < 2; ++i) sb_solid_destroy(solid[i]);
    sb_mesh_free(&flipped);
    sb_mesh_free(&open);
}

static void test_open_surfaces_are_solid_behind(void **state)
{
    (void)state;
    sb_mesh basin, plane, patch;
    assert_ok(sb_mesh_basin(sb_vec(-1, -2, 0), sb_vec(1, 2, 1), &basin, &error));
    assert_ok(sb_mesh_plane(sb_vec(0, 0, 1), sb_vec(-1, 0, 1), 4, 2, &plane, &error));
    make_terrain(6, 0, 0, &patch);
    sb_solid *solid[3];
    assert_ok(sb_solid_create(&basin, SB_ROLE_SOLID, &solid[0], &error));
    assert_ok(sb_solid_create(&plane, SB_ROLE_SOLID, &solid[1], &error));
    for (uint64_t i = 0; i < 2000; ++i) {
        sb_vec3 p = random_point(7, i, sb_vec(-2, -3, -1), sb_vec(2, 3, 2));
        bool water = p.x > -1 && p.x < 1 && p.y > -2 && p.y < 2 && p.z > 0;
        assert_int_equal(sb_solid_contains(solid[0], p), !water);
        bool behind = p.z - 1 - p.x < 0;
        assert_int_equal(sb_solid_contains(solid[1], p), behind);
    }
    /* Edges and corners, where the nearest triangle alone would give a wrong result. */
    assert_true(sb_solid_contains(solid[0], sb_vec(1.1, 2.1, -0.1)));
    assert_true(sb_solid_contains(solid[0], sb_vec(1.3, 2.01, 0.5)));
    /* A surface that is not marked as open is recognised if its triangles face one way. */
    for (size_t i = 0; i < patch.vertex_count; ++i) patch.vertices[i].z *= 0.05;
    assert_false(patch.open_surface);
    assert_ok(sb_solid_create(&patch, SB_ROLE_SOLID, &solid[2], &error));
    assert_true(sb_solid_contains(solid[2], sb_vec(3, 3, -2)));
    assert_false(sb_solid_contains(solid[2], sb_vec(3, 3, 2)));
    for (int i = 0; i < 3; ++i) sb_solid_destroy(solid[i]);
    sb_mesh_free(&basin);
    sb_mesh_free(&plane);
    sb_mesh_free(&patch);
}

static void test_cylinder_contains(void **state)
{
    (void)state;
    sb_mesh mesh;
    assert_ok(sb_mesh_cylinder(sb_vec(10, 5, -2), 3, 7, 1e-3, &mesh, &error));
    sb_solid *solid;
    assert_ok(sb_solid_create(&mesh, SB_ROLE_SOLID, &solid, &error));
    int inside_count = 0;
    for (uint64_t i = 0; i < 2000; ++i) {
        sb_vec3 p = random_point(8, i, sb_vec(6, 1, -3), sb_vec(14, 9, 6));
        double r = hypot(p.x - 10, p.y - 5);
        if (r > 3 - 2e-3 && r < 3) continue;
        bool inside = r < 3 && p.z > -2 && p.z < 5;
        inside_count += inside;
        assert_int_equal(sb_solid_contains(solid, p), inside);
    }
    assert_true(inside_count > 300);
    sb_solid_destroy(solid);
    sb_mesh_free(&mesh);
}

static void test_bad_meshes_are_refused(void **state)
{
    (void)state;
    sb_mesh mesh;
    sb_solid *solid = NULL;
    assert_ok(sb_mesh_alloc(&mesh, 3, 0, &error));
    assert_int_equal(sb_solid_create(&mesh, SB_ROLE_SOLID, &solid, &error), SB_BAD_INPUT);
    sb_mesh_free(&mesh);
    assert_ok(sb_mesh_alloc(&mesh, 3, 1, &error));
    mesh.triangles[0][2] = 3;
    assert_int_equal(sb_solid_create(&mesh, SB_ROLE_SOLID, &solid, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "expected below 3"));
    mesh.triangles[0][2] = 2;
    mesh.vertices[1].y = (double)NAN;
    assert_int_equal(sb_solid_create(&mesh, SB_ROLE_SOLID, &solid, &error), SB_BAD_INPUT);
    assert_null(solid);
    sb_mesh_free(&mesh);
}

static void test_large_terrain_is_fast(void **state)
{
    (void)state;
    enum { N = 340, QUERIES = 50000 }; /* 231 200 triangles */
    sb_mesh mesh;
    make_terrain(N, 0, 0, &mesh);
    sb_solid *solid;
    double begin = sb_clock();
    assert_ok(sb_solid_create(&mesh, SB_ROLE_TERRAIN, &solid, &error));
    double built = sb_clock();
    double sum = 0;
    for (uint64_t i = 0; i < QUERIES; ++i) {
        double x = N * sb_random(9, 2 * i), y = N * sb_random(9, 2 * i + 1);
        sum += sb_solid_distance(solid, sb_vec(x, y, hill(x, y) + 4 * sb_random(10, i) - 2), 3, NULL, NULL);
    }
    double queried = sb_clock();
    size_t inside = 0;
    for (uint64_t i = 0; i < QUERIES; ++i) {
        double x = N * sb_random(9, 2 * i), y = N * sb_random(9, 2 * i + 1);
        inside += sb_solid_contains(solid, sb_vec(x, y, hill(x, y) + 4 * sb_random(10, i) - 2));
    }
    double contained = sb_clock();
    print_message("terrain of %zu triangles: tree %.0f ms, %.0f k distances/s, %.0f k inside/s\n", mesh.triangle_count,
                  1e3 * (built - begin), QUERIES / (queried - built) / 1e3, QUERIES / (contained - queried) / 1e3);
    assert_true(sum / QUERIES > 0.5 && sum / QUERIES < 1);
    assert_in_range(inside, QUERIES * 48 / 100, QUERIES * 52 / 100);
    sb_solid_destroy(solid);
    sb_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_winding_is_the_exact_sum),
        cmocka_unit_test(test_winding_of_small_mesh_is_exact_near),
        cmocka_unit_test(test_distance_is_the_least_of_all),
        cmocka_unit_test(test_rays_hit_the_first_face),
        cmocka_unit_test(test_terrain_is_solid_below),
        cmocka_unit_test(test_aligned_points),
        cmocka_unit_test(test_flipped_and_broken_boxes),
        cmocka_unit_test(test_open_surfaces_are_solid_behind),
        cmocka_unit_test(test_cylinder_contains),
        cmocka_unit_test(test_bad_meshes_are_refused),
        cmocka_unit_test(test_large_terrain_is_fast),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
