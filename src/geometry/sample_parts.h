/* Inside of the sampling: what its files share. Private to src/geometry/sample*.c. */
#ifndef SB_GEOMETRY_SAMPLE_PARTS_H
#define SB_GEOMETRY_SAMPLE_PARTS_H

#include "geometry/sample.h"
#include "geometry/sample_set.h"

/* In spacings. Lattices stay whole from LATTICE on; what they leave open is filled from FILL on,
   and is filled when farther than COVER: 0.70 < FILL < COVER < 0.75 leave room for rounding. */
#define SB_SAMPLE_LATTICE 0.9
#define SB_SAMPLE_FILL 0.74
#define SB_SAMPLE_COVER 0.746

/* In spacings: what is this near to a side lies in it. */
#define SB_SAMPLE_SIDE 1e-6

/* Cosine: a terrain's face this near to upright looks neither up nor down, and is taken as its mesh turns it. */
#define SB_SAMPLE_UPRIGHT 1e-9

/* An edge that is concave from the water: the sheet goes round it from one normal to the other. */
typedef struct sb_crease {
    sb_vec3 a, b, normal[2];
} sb_crease;

/* An edge of a solid that is convex from the water, and the triangles that meet there. */
typedef struct sb_ridge {
    sb_vec3 a, b;
    uint32_t triangle[2];
} sb_ridge;

/* A corner of the sheet around a concave vertex, between three normals. */
typedef struct sb_cap {
    sb_vec3 at, normal[3];
} sb_cap;

/* What sampling knows of a source. Owned arrays. */
typedef struct sb_surface {
    const sb_sample_source *source;
    sb_vec3 min, max;
    bool bounded;     /* nothing outside of the box is inside the solid */
    bool mixed;       /* faces of both orientations: a neighbour's normal says nothing */
    double sign;      /* of the mesh's normals: -1 for a wholly flipped mesh */
    sb_vec3 *normal;  /* per triangle, unit, towards the water; zero when degenerate, or when it lies
                         in a side at which the domain repeats: then it is no surface */
    uint32_t *region; /* per triangle: first triangle of its plane */
    uint32_t *part;   /* per triangle: first triangle of its connected part */
    size_t crease_count, crease_capacity, cap_count, cap_capacity, ridge_count, ridge_capacity;
    sb_crease *creases;
    sb_cap *caps;
    sb_ridge *ridges; /* of solids alone */
} sb_surface;

typedef struct sb_sampler {
    sb_sample_settings settings;
    size_t surface_count;
    sb_surface *surfaces;
    bool moving;          /* the present group: one moving surface alone, or all static ones */
    uint32_t first, last; /* surfaces of the group: those in [first, last) that move or not */
    sb_sample_set set;
} sb_sampler;

static inline double sb_sample_along(sb_vec3 a, int axis)
{
    return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

/* m along an axis that a place is beyond the domain: negative within. */
static inline double sb_sample_beyond(const sb_sample_settings *settings, sb_vec3 at, int axis)
{
    return fmax(sb_sample_along(settings->min, axis) - sb_sample_along(at, axis),
                sb_sample_along(at, axis) - sb_sample_along(settings->max, axis));
}

static inline const sb_mesh *sb_surface_mesh(const sb_surface *surface)
{
    return surface->source->mesh;
}

/* Orientation, planes, parts and creases of a source's mesh. */
sb_status sb_surface_build(const sb_sample_source *source, const sb_sample_settings *settings, sb_surface *surface,
                           sb_error *error);
void sb_surface_free(sb_surface *surface);

/* Whether the present group samples this surface. */
static inline bool sb_sampler_takes(const sb_sampler *sampler, size_t surface)
{
    return surface >= sampler->first && surface < sampler->last &&
           sampler->surfaces[surface].source->moving == sampler->moving;
}

/* Lattice points at origin + (i + 1/2) step along two directions of a plane, or of a projection. */
typedef struct sb_lattice {
    sb_vec3 u, v, origin;
    double step_u, step_v;
    bool suits; /* false: none does */
} sb_lattice;

/* The lattice of every plane of a surface, at the plane's first triangle; not 0 without memory. */
int sb_sample_planes(const sb_sampler *sampler, uint32_t index, sb_lattice *lattices);
/* Step near the spacing that divides `length` evenly; the spacing itself when none is near. */
double sb_sample_fitted_step(double length, double spacing);
/* Of the world's lattice along an axis: between sides at which the domain repeats it fits. */
double sb_sample_axis_step(const sb_sample_settings *settings, int axis);
/* Whether a unit vector follows an axis, and the axis that a vector is nearest to. */
bool sb_sample_is_axis(sb_vec3 a);
int sb_sample_dominant(sb_vec3 n);

/* Where a surface point goes. BURIED and CROWDED: nowhere; then all surface points within *margin
   of this one share its fate (0: none may). */
typedef enum sb_placement { SB_PLACED, SB_BURIED, SB_CROWDED } sb_placement;
sb_placement sb_sample_place(const sb_sampler *sampler, uint32_t surface, sb_vec3 at, sb_vec3 inward, sb_vec3 *placed,
                             double *margin);
/* The distance to the nearest point of a surface before which water may stand, as sb_solid_distance; *normal points to
   the water. The end of a solid in a side at which the domain repeats is no surface, for the solid goes on at the other
   side: beside it the answer is that of a place further in. */
double sb_sample_distance(const sb_sampler *sampler, uint32_t surface, sb_vec3 at, double limit, sb_vec3 *nearest,
                          sb_vec3 *normal);
/* No water comes near any point within `radius` of this one. */
bool sb_sample_buried(const sb_sampler *sampler, uint32_t surface, sb_vec3 at, sb_vec3 inward, double radius);
/* Water may stand in front of a surface's point: no other solid covers it. */
bool sb_sample_exposed(const sb_sampler *sampler, uint32_t surface, sb_vec3 at, sb_vec3 normal);
/* As sb_sample_place for a point already on the sheet, `reach` from the surface. */
bool sb_sample_fits(const sb_sampler *sampler, uint32_t surface, sb_vec3 at, sb_vec3 inward, double reach);
/* The sheet's point nearest to `at`, which is near the sheet of this surface. */
bool sb_sample_project(const sb_sampler *sampler, uint32_t surface, sb_vec3 at, sb_sample *sample);

/* Stages: each adds to sampler->set. Not 0 without memory, or when the run is to stop. */
int sb_sample_lattices(sb_sampler *sampler);
int sb_sample_grow(sb_sampler *sampler);
int sb_sample_voids(sb_sampler *sampler);

/* Gives the particles along convex edges of solids the mean normal of the faces that meet there. */
void sb_sample_round_edges(const sb_sampler *sampler, sb_sample_set *all);

/* Candidates gathered one by one, placed in parallel, accepted in their order. */
typedef struct sb_candidate {
    sb_vec3 at, inward; /* on the surface; or on the sheet when `placed` */
    uint32_t surface;
    bool placed;
    double reach; /* m from the surface, when placed */
} sb_candidate;
enum { SB_SAMPLE_BATCH = 32768 };
typedef struct sb_candidate_batch {
    size_t count;
    sb_candidate *candidate; /* SB_SAMPLE_BATCH */
    bool *good;
} sb_candidate_batch;
int sb_candidate_push(sb_sampler *sampler, sb_candidate_batch *batch, sb_candidate candidate);
int sb_candidate_flush(sb_sampler *sampler, sb_candidate_batch *batch);

#endif
