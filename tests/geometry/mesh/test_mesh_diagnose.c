/* Tests the diagnosis of faulty meshes, and the correction of orientation, duplicate vertices and small holes. */
#include "base/memory.h"
#include "geometry/mesh/mesh.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static sb_error error;

static sb_mesh make_box(sb_vec3 min, sb_vec3 max)
{
    sb_mesh box;
    if (sb_mesh_box(min, max, &box, &error) != SB_OK) fail_msg("%s", error.text);
    return box;
}

static void flip(sb_mesh *mesh, size_t i)
{
    uint32_t swapped = mesh->triangles[i][1];
    mesh->triangles[i][1] = mesh->triangles[i][2];
    mesh->triangles[i][2] = swapped;
}

/* Returns the same triangles, each with three vertices of its own. */
static sb_mesh unweld(sb_mesh mesh)
{
    sb_mesh soup;
    assert_int_equal(sb_mesh_alloc(&soup, 3 * mesh.triangle_count, mesh.triangle_count, &error), SB_OK);
    for (size_t i = 0; i < 3 * mesh.triangle_count; ++i) {
        soup.vertices[i] = mesh.vertices[mesh.triangles[i / 3][i % 3]];
        soup.triangles[i / 3][i % 3] = (uint32_t)i;
    }
    sb_mesh_free(&mesh);
    return soup;
}

static void test_sound_box(void **state)
{
    (void)state;
    /* Far from the origin, where simple sums lose the digits of the volume. */
    sb_mesh box = unweld(make_box(sb_vec(1e6, -2e6, 0), sb_vec(1e6 + 2, -2e6 + 3, 4)));
    sb_mesh_report report;
    assert_int_equal(sb_mesh_diagnose(&box, &report, NULL), SB_OK);
    assert_true(report.watertight);
    assert_int_equal(report.open_edges + report.flipped_faces + report.degenerate_faces + report.doubled_faces, 0);
    assert_true(fabs(report.volume - 24) < 1e-9);
    assert_true(fabs(report.area - 52) < 1e-9);
    assert_true(report.min.x == 1e6 && report.max.y == -2e6 + 3 && report.max.z == 4);
    for (size_t i = 0; i < 12; ++i) flip(&box, i);
    assert_int_equal(sb_mesh_diagnose(&box, &report, NULL), SB_OK);
    assert_true(report.watertight && report.flipped_faces == 0);
    assert_true(fabs(report.volume + 24) < 1e-9);
    sb_mesh_free(&box);
}

static void test_each_fault(void **state)
{
    (void)state;
    sb_mesh_report report;
    sb_mesh box = unweld(make_box(sb_vec(0, 0, 0), sb_vec(1, 1, 1)));
    flip(&box, 10); /* half of the lid */
    assert_int_equal(sb_mesh_diagnose(&box, &report, NULL), SB_OK);
    assert_false(report.watertight);
    assert_int_equal(report.flipped_faces, 1);
    assert_int_equal(report.open_edges, 0);
    assert_true(fabs(report.first_flipped_face.z - 1) < 1e-12);
    box.triangle_count = 10; /* no lid */
    assert_int_equal(sb_mesh_diagnose(&box, &report, NULL), SB_OK);
    assert_false(report.watertight);
    assert_int_equal(report.open_edges, 4);
    assert_int_equal(report.flipped_faces, 0);
    assert_true(fabs(report.first_open_edge.z - 1) < 1e-12);
    assert_true(fabs(report.area - 5) < 1e-12);
    sb_mesh_free(&box);

    box = unweld(make_box(sb_vec(0, 0, 0), sb_vec(1, 1, 1)));
    memcpy(box.triangles[11], box.triangles[10], sizeof box.triangles[0]);
    assert_int_equal(sb_mesh_diagnose(&box, &report, NULL), SB_OK);
    assert_int_equal(report.doubled_faces, 1);
    assert_int_equal(report.open_edges, 2);
    box.triangles[11][2] = box.triangles[11][1];
    assert_int_equal(sb_mesh_diagnose(&box, &report, NULL), SB_OK);
    assert_int_equal(report.doubled_faces, 0);
    assert_int_equal(report.degenerate_faces, 1);
    assert_int_equal(report.open_edges, 3);
    sb_mesh_free(&box);

    box = (sb_mesh){0};
    assert_int_equal(sb_mesh_diagnose(&box, &report, NULL), SB_OK);
    assert_false(report.watertight);
    assert_true(report.area == 0 && report.volume == 0);
}

static void test_orientation_is_corrected(void **state)
{
    (void)state;
    sb_mesh_report report;
    sb_mesh box = unweld(make_box(sb_vec(0, 0, 0), sb_vec(1, 1, 1)));
    flip(&box, 0);
    flip(&box, 7);
    assert_int_equal(sb_mesh_orient(&box, SB_ROLE_SOLID, &error), SB_OK);
    assert_int_equal(box.turned, 2);
    assert_int_equal(sb_mesh_diagnose(&box, &report, NULL), SB_OK);
    assert_true(report.watertight && fabs(report.volume - 1) < 1e-12);
    for (size_t i = 0; i < 12; ++i)
        if (i != 3) flip(&box, i);
    assert_int_equal(sb_mesh_orient(&box, SB_ROLE_SOLID, &error), SB_OK);
    assert_int_equal(box.turned, 2 + 11);
    assert_int_equal(sb_mesh_diagnose(&box, &report, NULL), SB_OK);
    assert_true(report.watertight && fabs(report.volume - 1) < 1e-12);
    sb_mesh_free(&box);

    sb_mesh open;
    assert_int_equal(sb_mesh_plane(sb_vec(0, 0, 0), sb_vec(0.2, 0, -1), 2, 2, &open, &error), SB_OK);
    open.open_surface = false;
    assert_int_equal(sb_mesh_orient(&open, SB_ROLE_SOLID, &error), SB_OK);
    assert_int_equal(open.turned, 0);
    assert_int_equal(sb_mesh_orient(&open, SB_ROLE_TERRAIN, &error), SB_OK);
    assert_int_equal(open.turned, 2);
    sb_mesh_free(&open);
}

static void test_weld(void **state)
{
    (void)state;
    sb_mesh box = unweld(make_box(sb_vec(0, -1, -1), sb_vec(1, 0, 1)));
    box.vertices[0].x = -0.0;
    box.triangles[5][0] = box.triangles[5][1];
    assert_int_equal(sb_mesh_weld(&box, &error), SB_OK);
    assert_int_equal(box.vertex_count, 8);
    assert_int_equal(box.triangle_count, 11);
    assert_int_equal(box.dropped, 1);
    box.triangles[2][1] = 8;
    assert_int_equal(sb_mesh_weld(&box, &error), SB_BAD_INPUT);
    box.triangles[2][1] = 7;
    box.vertices[3].y = (double)INFINITY;
    assert_int_equal(sb_mesh_weld(&box, &error), SB_BAD_INPUT);
    sb_mesh_free(&box);
}

/* Closes the holes of a mesh of the first triangles, and returns how many triangles were added. */
static size_t closed_of(sb_mesh *mesh, size_t triangles)
{
    mesh->triangle_count = triangles;
    assert_int_equal(sb_mesh_close(mesh, &error), SB_OK);
    assert_int_equal(mesh->triangle_count, triangles + mesh->closed);
    return mesh->closed;
}

static void test_holes_of_one_triangle_are_closed(void **state)
{
    (void)state;
    sb_mesh_report report;
    for (int apart = 0; apart < 2; ++apart) {
        sb_mesh box = make_box(sb_vec(0, 0, 0), sb_vec(2, 3, 4));
        if (apart) box = unweld(box);
        assert_int_equal(closed_of(&box, 11), 1);
        assert_int_equal(sb_mesh_diagnose(&box, &report, NULL), SB_OK);
        assert_true(report.watertight && report.flipped_faces == 0);
        assert_true(fabs(report.volume - 24) < 1e-9);
        sb_mesh_free(&box);
    }
    /* A missing side, an open surface of one triangle, and a flat one of three triangles whose border is a triangle
       stay open. */
    sb_mesh box = make_box(sb_vec(0, 0, 0), sb_vec(2, 3, 4));
    assert_int_equal(closed_of(&box, 10), 0);
    assert_int_equal(closed_of(&box, 1), 0);
    sb_mesh_free(&box);
    static const sb_vec3 places[] = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {1, 1, 0}};
    static const uint32_t fan[3][3] = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    sb_mesh open;
    assert_int_equal(sb_mesh_alloc(&open, 4, 3, &error), SB_OK);
    memcpy(open.vertices, places, sizeof places);
    memcpy(open.triangles, fan, sizeof fan);
    assert_int_equal(closed_of(&open, 3), 0);
    open.vertices[3].z = 1; /* a pyramid without its base does not stay open */
    assert_int_equal(closed_of(&open, 3), 1);
    assert_int_equal(sb_mesh_diagnose(&open, &report, NULL), SB_OK);
    assert_true(report.watertight && fabs(report.volume - 1.5) < 1e-12);
    sb_mesh_free(&open);
}

static void test_without_memory(void **state)
{
    (void)state;
    sb_mesh box = make_box(sb_vec(0, 0, 0), sb_vec(1, 1, 1));
    int failures = 0;
    for (long n = 1; n <= 8; ++n) {
        sb_mesh_report report;
        sb_memory_fail_at(n);
        sb_status status = sb_mesh_diagnose(&box, &report, &error);
        failures += status == SB_FAILED;
        assert_true(status == SB_FAILED || (report.watertight && fabs(report.volume - 1) < 1e-12));
        sb_memory_fail_at(n);
        failures += sb_mesh_orient(&box, SB_ROLE_SOLID, &error) == SB_FAILED;
        sb_memory_fail_at(n);
        failures += sb_mesh_weld(&box, &error) == SB_FAILED;
        sb_memory_fail_at(0);
    }
    assert_in_range(failures, 14, 22);
    assert_int_equal(box.triangle_count, 12);
    sb_mesh_free(&box);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sound_box),
        cmocka_unit_test(test_each_fault),
        cmocka_unit_test(test_orientation_is_corrected),
        cmocka_unit_test(test_weld),
        cmocka_unit_test(test_holes_of_one_triangle_are_closed),
        cmocka_unit_test(test_without_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
