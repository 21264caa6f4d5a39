/* Frames of particles on lattices, and checks of meshes, for the tests of src/surface. */
#ifndef SB_TESTS_SURFACE_LATTICE_H
#define SB_TESTS_SURFACE_LATTICE_H

#include "../check.h"
#include "base/memory.h"
#include "surface/make.h"

#include <stdlib.h>

/* A frame of at most `most` particles, none yet, with this spacing. */
static inline sb_frame *empty_frame(size_t most, double spacing)
{
    sb_frame *frame = sb_frame_create(most, 0);
    assert_non_null(frame);
    frame->spacing = spacing;
    frame->count = 0;
    return frame;
}

/* Adds a particle; its pressure is 1000 + 10 x, its velocity (1, 2, 3). */
static inline void add_particle(sb_frame *frame, double x, double y, double z)
{
    const size_t i = frame->count++;
    const double at[3] = {x, y, z};
    for (size_t a = 0; a < 3; a++) {
        frame->position[3 * i + a] = (float)at[a];
        frame->velocity[3 * i + a] = (float)(a + 1);
    }
    frame->pressure[i] = (float)(1000 + 10 * x);
    frame->id[i] = (uint32_t)i;
}

/* nx x ny x nz particles of a lattice, the first one at (x, y, z). */
static inline void add_box(sb_frame *frame, int nx, int ny, int nz, double x, double y, double z)
{
    const double h = frame->spacing;
    for (int k = 0; k < nz; k++)
        for (int j = 0; j < ny; j++)
            for (int i = 0; i < nx; i++) add_particle(frame, x + i * h, y + j * h, z + k * h);
}

static inline double water_of(const sb_frame *frame)
{
    return (double)frame->count * frame->spacing * frame->spacing * frame->spacing;
}

static inline sb_water_mesh mesh_of(const sb_frame *frame, double cell, int smooth)
{
    sb_water_mesh mesh;
    sb_error error = {0};
    if (sb_water_mesh_make(frame, cell, smooth, &mesh, &error) != SB_OK) fail_msg("%s", error.text);
    return mesh;
}

static inline int compare_edges(const void *a, const void *b)
{
    const uint64_t p = *(const uint64_t *)a, q = *(const uint64_t *)b;
    return (p > q) - (p < q);
}

/* Each directed edge is there once, and its opposite too. So each edge has two triangles, which agree about the side of
   the water. */
static inline void assert_watertight(const sb_water_mesh *mesh)
{
    const size_t count = 3 * mesh->triangles;
    uint64_t *edges = sb_alloc(count, sizeof *edges), *back = sb_alloc(count, sizeof *back);
    assert_true(edges && back && count > 0);
    for (size_t t = 0, e = 0; t < mesh->triangles; t++)
        for (int k = 0; k < 3; k++, e++) {
            const uint64_t a = mesh->corner[t][k], b = mesh->corner[t][(k + 1) % 3];
            assert_true(a != b && a < mesh->vertices);
            edges[e] = a << 32 | b;
            back[e] = b << 32 | a;
        }
    qsort(edges, count, sizeof *edges, compare_edges);
    qsort(back, count, sizeof *back, compare_edges);
    assert_memory_equal(edges, back, count * sizeof *edges);
    for (size_t e = 1; e < count; e++) assert_true(edges[e] != edges[e - 1]);
    sb_free(edges);
    sb_free(back);
}

#endif
