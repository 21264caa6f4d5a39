/* Surfaces to boundary particles: none nearer than 0.7 spacings to another, no place of the sheet
   farther than 0.75 from one (blue noise around lattices; after Akinci et al. 2013, relaxed). */
#ifndef SB_GEOMETRY_SAMPLE_H
#define SB_GEOMETRY_SAMPLE_H

#include "geometry/mesh.h"
#include "geometry/solid.h"

typedef struct sb_sample_settings {
    double spacing;   /* m */
    double offset;    /* m that the sheet lies behind the surface */
    double support;   /* m: nothing is sampled farther than this outside of the domain */
    int dimensions;   /* 2: the curve in y = 0 */
    sb_vec3 min, max; /* m, the domain; min is also the origin of the lattices */
    bool repeats[3];  /* the domain does, along each axis: nothing is sampled beyond those sides, nor
                         faces in their planes; lattices fit between them where they can */
} sb_sample_settings;

/* One surface. In 2D mesh and solid are those of sb_section_mesh. */
typedef struct sb_sample_source {
    const sb_mesh *mesh;
    const sb_solid *solid;
    sb_role role;
    bool moving; /* sampled alone: what is static neither hides nor thins it */
} sb_sample_source;

/* Particles of source i are [begin[i], begin[i + 1]). Owned. */
typedef struct sb_samples {
    size_t count, source_count;
    size_t *begin;     /* source_count + 1 */
    sb_vec3 *position; /* m, on the sheet */
    sb_vec3 *normal;   /* unit, towards the water */
} sb_samples;

/* Samples all sources; earlier ones win where they meet. Same result for any number of threads.
   On error *samples is untouched. */
sb_status sb_sample_surfaces(const sb_sample_settings *settings, const sb_sample_source *sources, size_t count,
                             sb_samples *samples, sb_error *error);
void sb_samples_free(sb_samples *samples);

/* The cut of a mesh with the plane y = 0 as strips along y, +-half_width long: two triangles per
   piece of the curve. A mesh that the plane misses gives no triangles. */
sb_status sb_section_mesh(const sb_mesh *mesh, double half_width, sb_mesh *section, sb_error *error);

#endif
