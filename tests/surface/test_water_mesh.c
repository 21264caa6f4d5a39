/* Meshes of water: volume, closed surfaces, normals, values at vertices, the same bits for any number of threads. */
#include "lattice.h"

#include <omp.h>
#include <string.h>

/* The number of connected surfaces. */
static size_t parts_of(const sb_water_mesh *mesh)
{
    uint32_t *part = sb_alloc(mesh->vertices, sizeof *part);
    size_t count = 0;
    assert_non_null(part);
    for (uint32_t v = 0; v < mesh->vertices; v++) part[v] = v;
    for (bool changed = true; changed;) {
        changed = false;
        for (size_t t = 0; t < mesh->triangles; t++) {
            const uint32_t *c = mesh->corner[t];
            for (int k = 0; k < 3; k++)
                if (part[c[k]] > part[c[(k + 1) % 3]]) {
                    part[c[k]] = part[part[c[(k + 1) % 3]]];
                    changed = true;
                } else if (part[c[k]] < part[c[(k + 1) % 3]]) {
                    part[c[(k + 1) % 3]] = part[part[c[k]]];
                    changed = true;
                }
        }
    }
    for (uint32_t v = 0; v < mesh->vertices; v++) count += part[v] == v;
    sb_free(part);
    return count;
}

static sb_frame *sphere(void)
{
    sb_frame *frame = empty_frame(40 * 40 * 40, 0.25);
    for (int k = 0; k < 40; k++)
        for (int j = 0; j < 40; j++)
            for (int i = 0; i < 40; i++) {
                const double x = i - 19.5, y = j - 19.5, z = k - 19.5;
                if (x * x + y * y + z * z < 15 * 15) add_particle(frame, 0.25 * x, 0.25 * y, 0.25 * z);
            }
    return frame;
}

static void a_sphere(void **state)
{
    (void)state;
    static const double cells[] = {0.3, 0.5, 0.7, 1};
    sb_frame *frame = sphere();
    frame->origin = sb_vec(1e6, -2e6, 30);
    for (size_t c = 0; c < 4; c++) {
        sb_water_mesh mesh = mesh_of(frame, cells[c], 10);
        assert_watertight(&mesh);
        assert_int_equal(parts_of(&mesh), 1);
        assert_near(sb_water_mesh_volume(&mesh) / water_of(frame), 1, 1e-5);
        assert_true(mesh.origin.x == frame->origin.x && mesh.origin.y == frame->origin.y);
        for (size_t v = 0; v < mesh.vertices; v++) {
            double radius = 0, along = 0, length = 0;
            for (int a = 0; a < 3; a++) {
                radius += pow((double)mesh.position[v][a], 2);
                along += (double)mesh.position[v][a] * (double)mesh.normal[v][a];
                length += pow((double)mesh.normal[v][a], 2);
            }
            assert_near(sqrt(radius), 0.25 * 15, 0.25);
            assert_near(length, 1, 1e-5);
            assert_true(along / sqrt(radius) > 0.8);
        }
        sb_water_mesh_free(&mesh);
    }
    sb_frame_release(frame);
}

static void a_box(void **state)
{
    (void)state;
    sb_frame *frame = empty_frame(40 * 32 * 24, 2);
    add_box(frame, 40, 32, 24, 7, -300, 1);
    for (int smooth = 0; smooth <= 10; smooth += 10) {
        sb_water_mesh mesh = mesh_of(frame, 0.5, smooth);
        assert_watertight(&mesh);
        assert_near(sb_water_mesh_volume(&mesh) / water_of(frame), 1, 1e-5);
        float top = -1000;
        for (size_t v = 0; v < mesh.vertices; v++) top = fmaxf(top, mesh.position[v][2]);
        assert_near((double)top, 48, 0.3); /* half a spacing above the last layer at 47 m */
        sb_water_mesh_free(&mesh);
    }
    sb_frame_release(frame);
}

/* The shaken film has distances from 0.7 to 1.3 spacings. */
static void a_film_stays_connected(void **state)
{
    (void)state;
    for (int run = 0; run < 4; run++) {
        const int shaken = run % 2;
        const double cell = run < 2 ? 0.5 : 0.25;
        sb_frame *frame = empty_frame(60 * 60, 1);
        srand(5);
        for (int j = 0; j < 60; j++)
            for (int i = 0; i < 60; i++) {
                const double x = i + shaken * 0.15 * (2.0 * rand() / RAND_MAX - 1),
                             y = j + shaken * 0.15 * (2.0 * rand() / RAND_MAX - 1);
                add_particle(frame, x, y, 0.02 * x + 0.03 * y);
            }
        sb_water_mesh mesh = mesh_of(frame, cell, 10);
        assert_watertight(&mesh);
        assert_int_equal(parts_of(&mesh), 1);
        assert_near(sb_water_mesh_volume(&mesh) / water_of(frame), 1, 1e-5);
        /* No holes: V - E + F = 2 for a closed surface without handles, and E = 3 F / 2. */
        assert_int_equal((long)mesh.vertices - (long)mesh.triangles / 2, 2);
        sb_water_mesh_free(&mesh);
        sb_frame_release(frame);
    }
}

/* Of a box beside a drop both have their own volume, with and without smoothing. */
static void each_water_has_its_volume(void **state)
{
    (void)state;
    sb_frame *drop = empty_frame(1, 1), *row = empty_frame(40, 1), *both = empty_frame(1001, 1);
    add_particle(drop, 30.3, 0.2, 0.1);
    add_box(row, 40, 1, 1, 0.4, 0.3, 0.2);
    add_box(both, 10, 10, 10, 0, 0, 0);
    for (int run = 0; run < 6; run++) {
        const int smooth = run % 3 * 15;
        const double cell = run < 3 ? 0.5 : 0.25;
        sb_water_mesh one = mesh_of(drop, cell, smooth), tube = mesh_of(row, cell, smooth),
                      box = mesh_of(both, cell, smooth);
        assert_near(sb_water_mesh_volume(&one), 1, 1e-3);
        assert_near(sb_water_mesh_volume(&tube) / 40, 1, 1e-4);
        assert_near(sb_water_mesh_volume(&box) / 1000, 1, 1e-5);
        add_particle(both, 30.3, 0.2, 0.1);
        sb_water_mesh together = mesh_of(both, cell, smooth);
        assert_int_equal(parts_of(&together), 2);
        assert_near(sb_water_mesh_volume(&together) - sb_water_mesh_volume(&box), 1, 0.01);
        both->count = 1000;
        sb_water_mesh_free(&one);
        sb_water_mesh_free(&tube);
        sb_water_mesh_free(&box);
        sb_water_mesh_free(&together);
    }
    sb_frame_release(drop);
    sb_frame_release(row);
    sb_frame_release(both);
}

/* A box with a cavity is one water with two surfaces: the cavity keeps its place and nearly its size, and both surfaces
   move by the same way. A drop in the cavity is another water. */
static void a_cavity_belongs_to_its_water(void **state)
{
    (void)state;
    sb_frame *frame = empty_frame(20 * 20 * 20 + 1, 1);
    for (int k = 0; k < 20; k++)
        for (int j = 0; j < 20; j++)
            for (int i = 0; i < 20; i++)
                if (i < 6 || i >= 14 || j < 6 || j >= 14 || k < 6 || k >= 14) add_particle(frame, i, j, k);
    for (int with_drop = 0; with_drop < 2; with_drop++) {
        if (with_drop) add_particle(frame, 9.6, 9.5, 9.4);
        sb_water_mesh mesh = mesh_of(frame, 0.5, 10);
        assert_int_equal(parts_of(&mesh), 2 + with_drop);
        assert_near(sb_water_mesh_volume(&mesh) / water_of(frame), 1, 1e-5);
        for (size_t v = 0; v < mesh.vertices; v++) {
            const double x = fabs((double)mesh.position[v][0] - 9.5), y = fabs((double)mesh.position[v][1] - 9.5),
                         z = fabs((double)mesh.position[v][2] - 9.5), out = fmax(x, fmax(y, z));
            assert_true(out > 9 || (out > 3 && out < 4.2) || (with_drop && out < 1));
        }
        sb_water_mesh_free(&mesh);
    }
    sb_frame_release(frame);
}

/* A disordered cloud has every case of the table, cavities and drops. */
static sb_frame *cloud(void)
{
    sb_frame *frame = empty_frame(5000, 0.1);
    srand(11);
    for (int i = 0; i < 5000; i++)
        add_particle(frame, 2.5 * rand() / RAND_MAX, 2.0 * rand() / RAND_MAX, 1.5 * rand() / RAND_MAX);
    return frame;
}

static void a_disordered_cloud_is_closed(void **state)
{
    (void)state;
    sb_frame *frame = cloud();
    for (int c = 0; c < 2; c++) {
        sb_water_mesh mesh = mesh_of(frame, c ? 1 : 0.5, 5);
        assert_watertight(&mesh);
        assert_true(parts_of(&mesh) > 10);
        assert_near(sb_water_mesh_volume(&mesh) / water_of(frame), 1, 1e-5);
        for (size_t v = 0; v < mesh.vertices; v++)
            for (int a = 0; a < 3; a++) assert_true(isfinite(mesh.position[v][a]) && isfinite(mesh.normal[v][a]));
        sb_water_mesh_free(&mesh);
    }
    sb_frame_release(frame);
}

static void the_same_bits_for_any_number_of_threads(void **state)
{
    (void)state;
    sb_frame *frame = cloud();
    sb_water_mesh first = {0};
    for (int threads = 1; threads <= 3; threads++) {
        omp_set_num_threads(threads);
        sb_water_mesh mesh = mesh_of(frame, 0.5, 10);
        if (threads == 1) {
            first = mesh;
            continue;
        }
        assert_int_equal(mesh.vertices, first.vertices);
        assert_int_equal(mesh.triangles, first.triangles);
        assert_memory_equal(mesh.position, first.position, first.vertices * sizeof *first.position);
        assert_memory_equal(mesh.normal, first.normal, first.vertices * sizeof *first.normal);
        assert_memory_equal(mesh.velocity, first.velocity, first.vertices * sizeof *first.velocity);
        assert_memory_equal(mesh.pressure, first.pressure, first.vertices * sizeof *first.pressure);
        assert_memory_equal(mesh.corner, first.corner, first.triangles * sizeof *first.corner);
        sb_water_mesh_free(&mesh);
    }
    omp_set_num_threads(1);
    sb_water_mesh_free(&first);
    sb_frame_release(frame);
}

/* The particles have one velocity, and pressures that grow with x; a vertex has the mean over its side of the surface.
 */
static void values_at_vertices(void **state)
{
    (void)state;
    sb_frame *frame = sphere();
    sb_water_mesh mesh = mesh_of(frame, 0.5, 0);
    for (size_t v = 0; v < mesh.vertices; v++) {
        for (int a = 0; a < 3; a++) assert_near((double)mesh.velocity[v][a], a + 1, 1e-5);
        assert_near((double)mesh.pressure[v], 1000 + 10 * (double)mesh.position[v][0], 10 * 0.25);
    }
    sb_water_mesh_free(&mesh);
    sb_frame_release(frame);
}

static void bad_input(void **state)
{
    (void)state;
    sb_frame *frame = empty_frame(10, 0.01);
    sb_error error = {0};
    sb_water_mesh mesh = mesh_of(frame, 0.5, 10);
    assert_int_equal(mesh.vertices + mesh.triangles, 0);
    add_particle(frame, 0, 0, 0);
    assert_int_equal(sb_water_mesh_make(frame, 0.2, 10, &mesh, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "0.2 spacings"));
    add_particle(frame, 0, 1e9, 0);
    assert_int_equal(sb_water_mesh_make(frame, 0.5, 10, &mesh, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "along y"));
    assert_true(!mesh.position && !mesh.corner);
    sb_frame_release(frame);
}

static void any_allocation_may_fail(void **state)
{
    (void)state;
    sb_frame *frame = empty_frame(27, 1);
    add_box(frame, 3, 3, 3, 0, 0, 0);
    omp_set_num_threads(1);
    int failures = 0;
    for (long n = 1;; n++) {
        sb_water_mesh mesh;
        sb_error error = {0};
        sb_memory_fail_at(n);
        const sb_status status = sb_water_mesh_make(frame, 0.5, 2, &mesh, &error);
        const bool pending = sb_memory_fail_pending();
        sb_memory_fail_at(0);
        sb_water_mesh_free(&mesh);
        if (pending) {
            assert_int_equal(status, SB_OK);
            break;
        }
        assert_int_equal(status, SB_FAILED);
        assert_non_null(strstr(error.text, "memory"));
        failures++;
    }
    assert_true(failures > 20);
    sb_frame_release(frame);
}

int main(void)
{
    omp_set_num_threads(1);
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_sphere),
                                       cmocka_unit_test(a_box),
                                       cmocka_unit_test(a_film_stays_connected),
                                       cmocka_unit_test(each_water_has_its_volume),
                                       cmocka_unit_test(a_cavity_belongs_to_its_water),
                                       cmocka_unit_test(a_disordered_cloud_is_closed),
                                       cmocka_unit_test(the_same_bits_for_any_number_of_threads),
                                       cmocka_unit_test(values_at_vertices),
                                       cmocka_unit_test(bad_input),
                                       cmocka_unit_test(any_allocation_may_fail)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
