/* Tests the distance rules of boundary particles on shapes with edges, curves, seams and plates. */
#include "test_sample.h"

#include <omp.h>
#include <stdlib.h>

static test_surfaces s;

static int tear_down(void **state)
{
    (void)state;
    test_surfaces_free(&s);
    return 0;
}

static void box(size_t k, sb_vec3 min, sb_vec3 max)
{
    sb_error error;
    assert_int_equal(sb_mesh_box(min, max, &s.mesh[k], &error), SB_OK);
    s.count = k + 1;
}

/* Checks the rules on the surface itself and half a spacing behind it. The density may be at most `density`. */
static void check_both(const char *name, double density)
{
    test_sample(&s, 0);
    test_rules rules = test_check(&s, name);
    assert_true(rules.density <= density);
    test_sample(&s, 0.5);
    test_check(&s, name);
}

static void box_keeps_the_lattice(void **state)
{
    (void)state;
    box(0, sb_vec(0, 0, 0), sb_vec(10, 8, 6));
    check_both("box", 1.06);
    /* 10 x 8 x 6 cells, half a spacing behind the surface: exactly the shell of the lattice. */
    assert_int_equal(s.samples.count, 10 * 8 * 6 - 8 * 6 * 4);
    for (size_t i = 0; i < s.samples.count; ++i) {
        sb_vec3 p = s.samples.position[i];
        assert_true(fabs(p.x - floor(p.x) - 0.5) < 1e-9 && fabs(p.y - floor(p.y) - 0.5) < 1e-9 &&
                    fabs(p.z - floor(p.z) - 0.5) < 1e-9);
    }
}

/* Counts the faces of a box that are near to a point below them, and sums their normals. */
static int faces_near(sb_vec3 at, sb_vec3 min, sb_vec3 max, double limit, sb_vec3 *sum)
{
    const double below[] = {at.x - min.x, max.x - at.x, at.y - min.y, max.y - at.y, at.z - min.z, max.z - at.z};
    double normal[3] = {0};
    int near = 0;
    for (int f = 0; f < 6; ++f) {
        if (below[f] > limit) continue;
        normal[f / 2] += f % 2 ? 1 : -1;
        near++;
    }
    *sum = sb_vec(normal[0], normal[1], normal[2]);
    return near;
}

/* The normal of a particle at an edge is the mean of both faces', whichever face was sampled first. A box and its
   mirror image thus act alike on the water. */
static void normals_at_edges_are_the_mean_of_both_faces(void **state)
{
    (void)state;
    const sb_vec3 min = sb_vec(0.3, 0.2, 0.1), max = sb_vec(8, 7.4, 6.6);
    size_t edges = 0, corners = 0;
    box(0, min, max);
    test_sample(&s, 0.8);
    for (size_t i = 0; i < s.samples.count; ++i) {
        sb_vec3 expected, further;
        int near = faces_near(s.samples.position[i], min, max, 0.94, &expected);
        if (near != faces_near(s.samples.position[i], min, max, 0.98, &further)) continue;
        edges += near == 2;
        corners += near == 3;
        sb_vec3 off = sb_sub(s.samples.normal[i], sb_normalize(expected));
        assert_true(near >= 1);
        assert_true(sb_norm(off) < 1e-6);
    }
    print_message("%zu particles at edges, %zu at corners\n", edges, corners);
    assert_true(edges > 20 && corners > 0);
}

static int compare_places(const void *left, const void *right)
{
    const sb_vec3 *a = left, *b = right;
    const double by[] = {a->x - b->x, a->y - b->y, a->z - b->z};
    for (int axis = 0; axis < 3; ++axis)
        if (fabs(by[axis]) > 1e-6) return by[axis] < 0 ? -1 : 1;
    return 0;
}

/* Collects the particles of the second box and sorts them. */
static size_t places_of_column(sb_vec3 *at, size_t most)
{
    const size_t begin = s.samples.begin[1], count = s.samples.count - begin;
    assert_in_range(count, 100, most);
    memcpy(at, s.samples.position + begin, count * sizeof *at);
    qsort(at, count, sizeof *at, compare_places);
    return count;
}

/* Off the global lattice, and whichever face was sampled first: where two faces meet they share a row. */
static void the_order_of_faces_changes_nothing(void **state)
{
    (void)state;
    enum { MOST = 1024 };
    sb_vec3 first[MOST], again[MOST];
    size_t count = 0;
    for (int turned = 0; turned <= 1; ++turned) {
        box(0, sb_vec(0, 0, -9), sb_vec(40, 15, 0));
        box(1, sb_vec(22.5, 5, 0), sb_vec(27.5, 10, 18.75));
        sb_mesh *mesh = &s.mesh[1];
        for (size_t t = 0, last = mesh->triangle_count - 1; turned && t < last; ++t, --last) {
            uint32_t swap[3];
            memcpy(swap, mesh->triangles[t], sizeof swap);
            memcpy(mesh->triangles[t], mesh->triangles[last], sizeof swap);
            memcpy(mesh->triangles[last], swap, sizeof swap);
        }
        test_sample(&s, 0.9375);
        const size_t n = places_of_column(turned ? again : first, MOST);
        assert_true(!turned || n == count);
        count = n;
        test_surfaces_free(&s);
    }
    for (size_t i = 0; i < count; ++i) assert_true(sb_norm(sb_sub(first[i], again[i])) < 1e-6);
}

static void boxes_off_the_lattice(void **state)
{
    (void)state;
    box(0, sb_vec(0.3, 0.2, 0.1), sb_vec(10, 8.05, 6.6));
    check_both("box off the lattice", 1.3);
    test_surfaces_free(&s);
    box(0, sb_vec(0, 0, 0), sb_vec(14, 12, 9));
    test_rotate(&s.mesh[0], 0.4, 0.5);
    check_both("tilted box", 1.15);
    test_surfaces_free(&s);
    box(0, sb_vec(0, 0, 0), sb_vec(4, 3, 5));
    test_rotate(&s.mesh[0], 0.4, 0.5);
    check_both("small tilted box", 1.4);
}

static void round_shapes(void **state)
{
    (void)state;
    sb_error error;
    s.count = 1;
    assert_int_equal(sb_mesh_cylinder(sb_vec(0, 0, 0), 5, 9, 0.02, &s.mesh[0], &error), SB_OK);
    check_both("cylinder", 1.3);
    test_surfaces_free(&s);
    s.count = 1;
    assert_int_equal(sb_mesh_cylinder(sb_vec(0, 0, 0), 1.3, 9, 0.02, &s.mesh[0], &error), SB_OK);
    check_both("slim cylinder", 1.4);
    test_surfaces_free(&s);
    s.count = 1;
    test_ball(7, 24, &s.mesh[0]);
    check_both("ball", 1.3);
    test_surfaces_free(&s);
    s.count = 1;
    test_ball(7, 70, &s.mesh[0]);
    check_both("fine ball", 1.3);
}

static void basins_close_their_corners(void **state)
{
    (void)state;
    sb_error error;
    s.count = 1;
    assert_int_equal(sb_mesh_basin(sb_vec(0, 0, 0), sb_vec(12, 8, 6), &s.mesh[0], &error), SB_OK);
    check_both("basin", 1.1);
    /* The floor with its rim, and four walls of six rows. */
    assert_int_equal(s.samples.count, 14 * 10 + 6 * 2 * (14 + 10 - 2));
    test_surfaces_free(&s);
    s.count = 1;
    assert_int_equal(sb_mesh_basin(sb_vec(0.2, 0.1, 0.4), sb_vec(12, 8.3, 6), &s.mesh[0], &error), SB_OK);
    test_rotate(&s.mesh[0], 0.4, 0);
    check_both("turned basin", 1.3);
}

static void plates_get_one_layer(void **state)
{
    (void)state;
    box(0, sb_vec(0, 0, 0), sb_vec(1, 10, 8));
    test_sample(&s, 0.5);
    test_check(&s, "plate");
    assert_int_equal(s.samples.count, 80);
    test_surfaces_free(&s);
    box(0, sb_vec(0, 0, 0), sb_vec(0.6, 10, 8));
    test_sample(&s, 0.5);
    for (size_t i = 0; i < s.samples.count; ++i) assert_true(fabs(s.samples.position[i].x - 0.3) < 1e-3);
    assert_in_range(s.samples.count, 75, 100);
    test_surfaces_free(&s);
    box(0, sb_vec(0, 0, 0), sb_vec(1.4, 10, 8));
    check_both("thicker plate", 1.3);
}

static void terrains(void **state)
{
    (void)state;
    s.count = 1;
    s.role = SB_ROLE_TERRAIN;
    test_hills(24, 2, 0.3, 0.2, &s.mesh[0]);
    check_both("hills", 1.3);
    test_surfaces_free(&s);
    s.count = 1;
    s.role = SB_ROLE_TERRAIN;
    test_hills(20, 0.7, 0.7, 0.3, &s.mesh[0]);
    check_both("steep hills", 1.3);
}

static void bodies_share_their_seams(void **state)
{
    (void)state;
    box(0, sb_vec(0, 0, 0), sb_vec(5, 8, 6));
    box(1, sb_vec(5, 0, 0), sb_vec(9, 8, 6));
    check_both("abutting boxes", 1.3);
    test_surfaces_free(&s);
    box(0, sb_vec(0, 0, 0), sb_vec(5, 8, 6));
    box(1, sb_vec(4.7, 0.3, -2), sb_vec(9, 5.8, 4.2));
    check_both("overlapping boxes", 1.3);
}

static void no_particles_where_no_water_comes(void **state)
{
    (void)state;
    box(0, sb_vec(0, 0, 0), sb_vec(20, 20, 20));
    box(1, sb_vec(6, 6, 6), sb_vec(12, 12, 12));
    test_sample(&s, 0.5);
    assert_int_equal(s.samples.begin[1], s.samples.count);
    test_surfaces_free(&s);
    /* The same box inside, but moving: a moving body may come out. */
    box(0, sb_vec(0, 0, 0), sb_vec(20, 20, 20));
    box(1, sb_vec(6, 6, 6), sb_vec(12, 12, 12));
    s.moving[1] = true;
    test_sample(&s, 0.5);
    assert_int_equal(s.samples.count - s.samples.begin[1], 6 * 6 * 6 - 4 * 4 * 4);
}

/* Ground with solids that stand on it, in it, and flush with it. As at the end of a single solid, no particle lies
   farther from all water than the boundary surface's corner and a quarter of a spacing, and no part of the corner is
   without particles. */
static void no_particles_below_standing_solids(void **state)
{
    (void)state;
    for (int deep = 0; deep <= 2; ++deep) {
        box(0, sb_vec(0, 0, -9), sb_vec(20, 20, 0));
        box(1, sb_vec(6.2, 7.1, deep == 2 ? -4.3 : -0.4 * deep), sb_vec(13.4, 12.9, 5));
        test_sample(&s, 0.6);
        test_check(&s, "a building on its ground");
        /* 0.2 more than the rule, because a random search finds the water only approximately. */
        const double limit = sb_norm(sb_vec(0.6, 0.6 + 0.25 + 0.2, 0));
        for (size_t i = 0; i < s.samples.count; ++i) {
            bool near = false;
            for (uint64_t n = 0; n < 4000 && !near; ++n) {
                const sb_vec3 at = sb_madd(s.samples.position[i], limit, sb_normalize(test_random(5, n)));
                near = !sb_solid_contains(s.solid[0], at) && !sb_solid_contains(s.solid[1], at);
            }
            assert_true(near);
        }
        test_surfaces_free(&s);
    }
}

/* Removes the faces that face downwards, which scanned buildings do not have. */
static void open_below(sb_mesh *mesh)
{
    size_t kept = 0;
    for (size_t t = 0; t < mesh->triangle_count; ++t)
        if (test_normal(mesh, t).z > -0.5) {
            memmove(mesh->triangles[kept], mesh->triangles[t], sizeof mesh->triangles[t]);
            ++kept;
        }
    assert_int_equal(mesh->triangle_count - kept, 2);
    mesh->triangle_count = kept;
}

/* A face on the ground has no contact with water. It gets no particles, and does not affect those of the walls that
   end at it. So nothing changes if it is removed. */
static void faces_on_the_ground_change_nothing(void **state)
{
    (void)state;
    const double offset = 0.75;
    const sb_vec3 low = sb_vec(6.2, 7.1, 0), high = sb_vec(13.4, 12.9, 5);
    sb_vec3 closed[4096];
    size_t count = 0;
    for (int open = 0; open <= 1; ++open) {
        box(0, sb_vec(0, 0, -9), sb_vec(20, 20, 0));
        box(1, low, high);
        if (open) open_below(&s.mesh[1]);
        test_sample(&s, offset);
        const sb_vec3 *at = s.samples.position + s.samples.begin[1];
        const size_t n = s.samples.count - s.samples.begin[1];
        assert_in_range(n, 100, 4096);
        for (size_t i = 0; i < n; ++i) {
            assert_true(at[i].x > low.x + 0.89 * offset && at[i].x < high.x - 0.89 * offset);
            assert_true(at[i].y > low.y + 0.89 * offset && at[i].y < high.y - 0.89 * offset);
            assert_true(!open || sb_norm(sb_sub(at[i], closed[i])) < 1e-9);
            closed[i] = at[i];
        }
        assert_true(!open || n == count);
        count = n;
        test_surfaces_free(&s);
    }
}

static void moving_bodies_are_sampled_alone(void **state)
{
    (void)state;
    box(0, sb_vec(0, 0, 0), sb_vec(5, 8, 6));
    box(1, sb_vec(5.3, 0, 0), sb_vec(9.3, 8, 6));
    s.moving[1] = true;
    test_sample(&s, 0.5);
    assert_int_equal(s.samples.begin[1], 5 * 8 * 6 - 3 * 6 * 4);
    size_t alone = s.samples.count - s.samples.begin[1];
    test_surfaces_free(&s);
    box(0, sb_vec(5.3, 0, 0), sb_vec(9.3, 8, 6));
    test_sample(&s, 0.5);
    assert_int_equal(s.samples.count, alone);
    /* Faces that touch at the start separate later: both have all their particles. */
    test_surfaces_free(&s);
    box(0, sb_vec(5, 0, 0), sb_vec(9, 8, 6));
    test_sample(&s, 0);
    alone = s.samples.count;
    test_surfaces_free(&s);
    box(0, sb_vec(0, 0, 0), sb_vec(5, 8, 6));
    box(1, sb_vec(5, 0, 0), sb_vec(9, 8, 6));
    s.moving[1] = true;
    test_sample(&s, 0);
    assert_int_equal(s.samples.count - s.samples.begin[1], alone);
    size_t touching[2] = {0};
    for (size_t i = 0; i < s.samples.count; ++i)
        touching[i >= s.samples.begin[1]] += fabs(s.samples.position[i].x - 5) < 1e-9;
    assert_true(touching[0] >= 48 && touching[1] >= 48);
}

static void normals_point_to_the_water(void **state)
{
    (void)state;
    s.count = 1;
    test_ball(7, 24, &s.mesh[0]);
    test_sample(&s, 0.5);
    for (size_t i = 0; i < s.samples.count; ++i) {
        assert_true(fabs(sb_norm(s.samples.normal[i]) - 1) < 1e-9);
        assert_true(sb_dot(s.samples.normal[i], sb_normalize(s.samples.position[i])) > 0.95);
    }
    /* The same ball with all its faces inside out. */
    size_t count = s.samples.count;
    test_surfaces_free(&s);
    s.count = 1;
    test_ball(7, 24, &s.mesh[0]);
    for (size_t t = 0; t < s.mesh[0].triangle_count; ++t) {
        uint32_t swap = s.mesh[0].triangles[t][0];
        s.mesh[0].triangles[t][0] = s.mesh[0].triangles[t][1];
        s.mesh[0].triangles[t][1] = swap;
    }
    test_sample(&s, 0.5);
    assert_in_range(s.samples.count, count - count / 20, count + count / 20);
    for (size_t i = 0; i < s.samples.count; ++i)
        assert_true(sb_dot(s.samples.normal[i], sb_normalize(s.samples.position[i])) > 0.95);
}

static void threads_change_nothing(void **state)
{
    (void)state;
    sb_samples first;
    int threads = omp_get_max_threads();
    box(0, sb_vec(0, 0, 0), sb_vec(9, 7, 5));
    test_rotate(&s.mesh[0], 0.4, 0.5);
    box(1, sb_vec(-6, 1, 0), sb_vec(2, 6, 6));
    test_ball(5, 20, &s.mesh[2]);
    s.count = 3;
    omp_set_num_threads(1);
    test_sample(&s, 0.5);
    first = s.samples;
    s.samples = (sb_samples){0};
    for (int n = 2; n <= 3; ++n) {
        omp_set_num_threads(n);
        test_sample(&s, 0.5);
        assert_int_equal(s.samples.count, first.count);
        assert_memory_equal(s.samples.position, first.position, first.count * sizeof *first.position);
        assert_memory_equal(s.samples.normal, first.normal, first.count * sizeof *first.normal);
        assert_memory_equal(s.samples.begin, first.begin, 4 * sizeof *first.begin);
    }
    omp_set_num_threads(threads);
    sb_samples_free(&first);
}

static void far_from_the_origin(void **state)
{
    (void)state;
    box(0, sb_vec(1e6, -1e6, 0), sb_vec(1e6 + 10, -1e6 + 8, 6));
    test_sample(&s, 0.5);
    assert_int_equal(s.samples.count, 10 * 8 * 6 - 8 * 6 * 4);
}

static void no_memory_is_an_error(void **state)
{
    (void)state;
    box(0, sb_vec(0, 0, 0), sb_vec(3, 3, 3));
    test_rotate(&s.mesh[0], 0.4, 0.5);
    test_sample(&s, 0.5);
    size_t count = s.samples.count;
    long failures = 0;
    for (long n = 1; n < 10000; ++n) {
        sb_samples samples = {.count = 77};
        sb_error error = {0};
        sb_memory_fail_at(n);
        sb_status status = sb_sample_surfaces(&s.settings, s.source, s.count, &samples, &error);
        sb_memory_fail_at(0);
        if (status == SB_OK) {
            assert_int_equal(samples.count, count);
            sb_samples_free(&samples);
            break;
        }
        ++failures;
        assert_int_equal(status, SB_FAILED);
        assert_true(error.text[0] != 0);
        assert_int_equal(samples.count, 77);
    }
    assert_true(failures > 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(box_keeps_the_lattice, tear_down),
        cmocka_unit_test_teardown(normals_at_edges_are_the_mean_of_both_faces, tear_down),
        cmocka_unit_test_teardown(the_order_of_faces_changes_nothing, tear_down),
        cmocka_unit_test_teardown(boxes_off_the_lattice, tear_down),
        cmocka_unit_test_teardown(round_shapes, tear_down),
        cmocka_unit_test_teardown(basins_close_their_corners, tear_down),
        cmocka_unit_test_teardown(plates_get_one_layer, tear_down),
        cmocka_unit_test_teardown(terrains, tear_down),
        cmocka_unit_test_teardown(bodies_share_their_seams, tear_down),
        cmocka_unit_test_teardown(no_particles_where_no_water_comes, tear_down),
        cmocka_unit_test_teardown(no_particles_below_standing_solids, tear_down),
        cmocka_unit_test_teardown(faces_on_the_ground_change_nothing, tear_down),
        cmocka_unit_test_teardown(moving_bodies_are_sampled_alone, tear_down),
        cmocka_unit_test_teardown(normals_point_to_the_water, tear_down),
        cmocka_unit_test_teardown(threads_change_nothing, tear_down),
        cmocka_unit_test_teardown(far_from_the_origin, tear_down),
        cmocka_unit_test_teardown(no_memory_is_an_error, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
