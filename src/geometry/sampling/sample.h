/* Samples surfaces as boundary particles on the boundary surface, which lies `offset` behind the physical surface.
   No two particles are nearer than 0.7 spacings to each other, and no point of the boundary surface is farther than
   0.75 from a particle (blue noise around lattices; after Akinci et al. 2013, relaxed). */
#ifndef SB_GEOMETRY_SAMPLE_H
#define SB_GEOMETRY_SAMPLE_H

#include "geometry/mesh/mesh.h"
#include "geometry/solid/solid.h"

typedef struct sb_sample_settings {
    double spacing;   /* m */
    double offset;    /* m, distance of the boundary surface behind the physical surface */
    double support;   /* m: nothing is sampled farther than this outside of the domain */
    int dimensions;   /* 2: the curve in y = 0 */
    sb_vec3 min, max; /* m, the domain; min is also the origin of the lattices */
    /* Axes along which the domain is periodic. Nothing is sampled beyond those sides, nor on faces in their planes.
       Lattices are fitted between the sides where possible. */
    bool repeats[3];
} sb_sample_settings;

/* One surface. In 2D, mesh and solid are those of sb_section_mesh. */
typedef struct sb_sample_source {
    const sb_mesh *mesh;
    const sb_solid *solid;
    sb_role role;
    bool moving; /* sampled alone: static surfaces neither cover it nor reduce its particles */
} sb_sample_source;

/* The boundary particles. Those of source i are [begin[i], begin[i + 1]). Owned. */
typedef struct sb_samples {
    size_t count, source_count;
    size_t *begin;     /* source_count + 1 */
    sb_vec3 *position; /* m, on the boundary surface */
    sb_vec3 *normal;   /* unit, towards the water */
    uint32_t *slab;    /* of each; NULL: all slabs were sampled */
} sb_samples;

/* Samples all sources. Where sources meet, the earlier one has precedence. The result is the same for any number of
   threads. On error *samples is unchanged. */
sb_status sb_sample_surfaces(const sb_sample_settings *settings, const sb_sample_source *sources, size_t count,
                             sb_samples *samples, sb_error *error);
void sb_samples_free(sb_samples *samples);

/* The domain is cut into slabs of at least SB_SAMPLE_SLAB spacings, one after another along its longest axis, that of
   sb_sample_axis. Cuts them into parts of about the same area of static surfaces: part k has the slabs [bounds[k],
   bounds[k + 1]). `bounds` has one more item than there are parts, the last one is the number of slabs. SB_FAILED
   without memory. */
#define SB_SAMPLE_SLAB 16.0
int sb_sample_axis(sb_vec3 min, sb_vec3 max, int dimensions);
sb_status sb_sample_divide(const sb_sample_settings *settings, const sb_sample_source *sources, size_t count,
                           size_t parts, uint32_t *bounds, sb_error *error);
/* The same as sb_sample_surfaces, but of static sources only the particles of the slabs [first, last), with the bits
   and the order that they have among all. Moving sources are whole. */
sb_status sb_sample_slabs(const sb_sample_settings *settings, const sb_sample_source *sources, size_t count,
                          uint32_t first, uint32_t last, sb_samples *samples, sb_error *error);

/* Cuts a mesh with the plane y = 0. The section consists of strips along y, from -half_width to half_width, with two
   triangles per piece of the curve. If the plane does not cut the mesh, the section has no triangles. */
sb_status sb_section_mesh(const sb_mesh *mesh, double half_width, sb_mesh *section, sb_error *error);

#endif
