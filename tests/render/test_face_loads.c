/* Loads on the faces of bodies, against water at rest. */
#include "base/memory.h"
#include "base/random.h"
#include "render/bodies/face_loads.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

enum { NX = 24, NY = 24, NZ = 10 };

/* Water at rest, 12 m x 12 m and 5 m deep on a lattice of 0.5 m, around a house of 4 m x 3 m x 7 m. */
static sb_frame *water(sb_vec3 low, sb_vec3 high)
{
    sb_frame *frame = sb_frame_create((size_t)NX * NY * NZ, 0);
    assert_non_null(frame);
    frame->spacing = 0.5;
    frame->origin = sb_vec(-6, -6, 0);
    size_t n = 0;
    for (int k = 0; k < NZ; k++)
        for (int j = 0; j < NY; j++)
            for (int i = 0; i < NX; i++) {
                const sb_vec3 at = sb_vec(-5.75 + 0.5 * i, -5.75 + 0.5 * j, 0.25 + 0.5 * k);
                if (at.x > low.x && at.x < high.x && at.y > low.y && at.y < high.y && at.z < high.z) continue;
                frame->position[3 * n] = (float)(at.x + 6);
                frame->position[3 * n + 1] = (float)(at.y + 6);
                frame->position[3 * n + 2] = (float)at.z;
                frame->pressure[n++] = (float)(9810 * (5 - at.z));
            }
    frame->count = n;
    return frame;
}

static void make_box(sb_mesh *mesh, sb_vec3 min, sb_vec3 max)
{
    static const uint32_t faces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                          {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    *mesh = (sb_mesh){.vertex_count = 8, .triangle_count = 12};
    mesh->vertices = sb_alloc(8, sizeof *mesh->vertices);
    mesh->triangles = sb_alloc(12, sizeof *mesh->triangles);
    for (int i = 0; i < 8; i++)
        mesh->vertices[i] = sb_vec(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z);
    memcpy(mesh->triangles, faces, sizeof faces);
}

/* Each wall carries rho g h^2 / 2 per metre, whatever its height; the roof and the bottom carry nothing. The particles
   next to a body without a load have no effect. */
static void still_water_presses_on_walls(void **state)
{
    (void)state;
    const sb_vec3 low = sb_vec(-2, -1.5, 0), high = sb_vec(2, 1.5, 7);
    sb_model_body list[3] = {{.name = "ground", .role = SB_ROLE_TERRAIN, .wavemaker = -1, .color = {-1, -1, -1}},
                             {.name = "house", .wavemaker = -1, .color = {0.2f, 0.4f, 0.6f}},
                             {.name = "paddle", .wavemaker = 0, .color = {-1, -1, -1}}};
    make_box(&list[0].mesh, sb_vec(-6, -6, -1), sb_vec(6, 6, 0));
    make_box(&list[1].mesh, low, high);
    make_box(&list[2].mesh, sb_vec(-7, -6, 0), sb_vec(-6, 6, 6));
    const sb_model model = {.min = {-50, -50, -50}, .max = {50, 50, 50}, .bodies = list, .body_count = 3};
    sb_frame *frame = water(low, high);
    sb_face_loads loads;
    sb_error error = {0};
    assert_int_equal(sb_face_loads_create(&model, 0.5, &loads, &error), SB_OK);
    assert_int_equal(loads.faces.count, 6);
    assert_int_equal(loads.faces.all_count, 36);
    sb_face_loads_compute(&loads, frame, 20000);
    for (size_t f = 0; f < 6; f++) {
        const sb_face *face = &loads.faces.list[f];
        const double width = fabs(face->normal.x) > 0.5 ? 3 : fabs(face->normal.y) > 0.5 ? 4 : 0;
        assert_int_equal(face->body, 1);
        assert_true(fabs(face->area - (width > 0 ? 7 * width : 12)) < 1e-9);
        assert_true(fabs(loads.force[f] - 0.5 * 9810 * 25 * width) < 1e-4 * 0.5 * 9810 * 25 * 4);
    }
    /* Dry faces and other bodies keep their colour; a wall's mean pressure is 17.5 kPa. */
    for (size_t c = 0; c < 108; c++) {
        const uint32_t f = loads.faces.of[c / 3];
        const bool tinted = f != UINT32_MAX && fabs(loads.faces.list[f].normal.z) < 0.5;
        assert_true((memcmp(loads.paint[c], loads.colors[c], 4) != 0) == tinted);
        assert_true((f == UINT32_MAX) == (c < 36 || c >= 72));
    }
    /* Loads of the frame count instead of those of the particles. */
    assert_true(sb_frame_add_faces(frame, 6));
    for (size_t f = 0; f < 6; f++) frame->face_pressure[f] = 100 * (float)(f + 1);
    sb_face_loads_compute(&loads, frame, 20000);
    for (size_t f = 0; f < 6; f++)
        assert_true(fabs(loads.force[f] - 100.0 * (double)(f + 1) * loads.faces.list[f].area) < 1e-6);
    sb_face_loads_free(&loads);
    sb_frame_release(frame);
    for (int b = 0; b < 3; b++) {
        sb_free(list[b].mesh.vertices);
        sb_free(list[b].mesh.triangles);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(still_water_presses_on_walls)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
