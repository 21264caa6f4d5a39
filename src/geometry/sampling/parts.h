/* Types and functions that the files of the sampling share. Private to src/geometry/sample*.c. */
#ifndef SB_GEOMETRY_SAMPLE_PARTS_H
#define SB_GEOMETRY_SAMPLE_PARTS_H

#include "geometry/sampling/sample.h"
#include "geometry/sampling/set.h"

/* In spacings. Lattice points may be as near as LATTICE to each other. Other points may be as near as FILL, and are
   added where the distance to the next particle exceeds COVER. 0.70 < FILL < COVER < 0.75 leaves room for rounding. */
#define SB_SAMPLE_LATTICE 0.9
#define SB_SAMPLE_FILL 0.74
#define SB_SAMPLE_COVER 0.746

/* In spacings: a point this near to a side counts as in its plane. */
#define SB_SAMPLE_SIDE 1e-6

/* Cosine: a terrain's face this close to vertical faces neither upwards nor downwards, and keeps the orientation of
   its mesh. */
#define SB_SAMPLE_UPRIGHT 1e-9

/* An edge that is concave seen from the water. The boundary surface goes round it from one normal to the other. */
typedef struct sb_crease {
    sb_vec3 a, b, normal[2];
} sb_crease;

/* An edge of a solid that is convex seen from the water, and the two triangles that meet there. */
typedef struct sb_ridge {
    sb_vec3 a, b;
    uint32_t triangle[2];
} sb_ridge;

/* A corner of the boundary surface around a concave vertex, between three normals. */
typedef struct sb_cap {
    sb_vec3 at, normal[3];
} sb_cap;

/* A source with the properties that the sampling derives from its mesh. Arrays are owned. */
typedef struct sb_surface {
    const sb_sample_source *source;
    sb_vec3 min, max;
    bool bounded; /* no point outside of [min, max] is inside the solid */
    bool mixed;   /* orientation is inconsistent: the normals of neighbours differ in sign */
    double sign;  /* factor that turns the mesh's normals towards the water: -1 for a wholly flipped mesh */
    /* Per triangle, unit, towards the water. Zero for a degenerate triangle, and for one in a periodic side, which is
       no surface. */
    sb_vec3 *normal;
    uint32_t *region;            /* per triangle: first triangle of its plane */
    struct sb_lattice *lattices; /* of each plane, at index of its first triangle; NULL: not chosen yet */
    size_t crease_count, crease_capacity, cap_count, cap_capacity, ridge_count, ridge_capacity;
    sb_crease *creases;
    sb_cap *caps;
    sb_ridge *ridges; /* of solids only */
} sb_surface;

/* Slabs across an axis of the domain. The first and the last one have no outer border. */
typedef struct sb_slabs {
    int axis;
    double from, width; /* m, lower border of the first slab, if it had one; width of each */
    uint32_t count;
} sb_slabs;

typedef struct sb_sampler {
    sb_sample_settings settings;
    size_t surface_count;
    sb_surface *surfaces;
    bool moving;          /* the current group: one moving surface, or all static ones */
    uint32_t first, last; /* surfaces of the group: those in [first, last) whose source->moving equals `moving` */
    sb_slabs slabs, rows; /* across the longest axis of the domain, and across the longest of the others */
    uint32_t slab, row;   /* the current slab, and the current row of it, which only the filling of voids has */
    double low, high;     /* m, the slab's borders; infinite at the ends */
    sb_sample_set set;
} sb_sampler;

static inline double sb_sample_along(sb_vec3 a, int axis)
{
    return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

/* Returns the distance in m by which a point lies beyond the domain along an axis; negative inside. */
static inline double sb_sample_beyond(const sb_sample_settings *settings, sb_vec3 at, int axis)
{
    return fmax(sb_sample_along(settings->min, axis) - sb_sample_along(at, axis),
                sb_sample_along(at, axis) - sb_sample_along(settings->max, axis));
}

/* Returns the slab of a point. */
static inline uint32_t sb_slab_of(const sb_slabs *slabs, sb_vec3 at)
{
    const double k = floor((sb_sample_along(at, slabs->axis) - slabs->from) / slabs->width);
    return k < 1 ? 0 : k < (double)slabs->count ? (uint32_t)k : slabs->count - 1;
}

/* Whether a point belongs to the current slab. */
static inline bool sb_slab_owns(const sb_sampler *sampler, sb_vec3 at)
{
    return sb_slab_of(&sampler->slabs, at) == sampler->slab;
}

/* Whether a part of the range between two numbers along the slabs' axis is within `margin` of the current slab. */
static inline bool sb_slab_meets(const sb_sampler *sampler, double low, double high, double margin)
{
    return low <= sampler->high + margin && high >= sampler->low - margin;
}

static inline const sb_mesh *sb_surface_mesh(const sb_surface *surface)
{
    return surface->source->mesh;
}

/* Finds the orientation, planes and creases of a source's mesh. */
sb_status sb_surface_build(const sb_sample_source *source, const sb_sample_settings *settings, sb_surface *surface,
                           sb_error *error);
void sb_surface_free(sb_surface *surface);

/* Whether the current group samples this surface. */
static inline bool sb_sampler_takes(const sb_sampler *sampler, size_t surface)
{
    return surface >= sampler->first && surface < sampler->last &&
           sampler->surfaces[surface].source->moving == sampler->moving;
}

/* A lattice with points at origin + (i + 1/2) step along two directions of a plane, or of a projection. */
typedef struct sb_lattice {
    sb_vec3 u, v, origin;
    double step_u, step_v;
    bool suits; /* false: no lattice is suitable */
} sb_lattice;

/* Chooses the lattice of each plane of a surface, at index of the plane's first triangle. Returns nonzero without
   memory. */
int sb_sample_planes(const sb_sampler *sampler, uint32_t index, sb_lattice *lattices);
/* Returns the step near the spacing that divides `length` evenly, or the spacing if none is near. */
double sb_sample_fitted_step(double length, double spacing);
/* Returns the step of the global lattice along an axis. It is fitted between periodic sides. */
double sb_sample_axis_step(const sb_sample_settings *settings, int axis);
/* Whether a unit vector is parallel to an axis, and the axis to which a vector is nearest. */
bool sb_sample_is_axis(sb_vec3 a);
int sb_sample_dominant(sb_vec3 n);

/* Result of placing a surface point. BURIED and CROWDED: it gets no particle, and neither do the surface points
   within *margin of it (0: no other point). */
typedef enum sb_placement { SB_PLACED, SB_BURIED, SB_CROWDED } sb_placement;
sb_placement sb_sample_place(const sb_sampler *sampler, uint32_t surface, sb_vec3 at, sb_vec3 inward, sb_vec3 *placed,
                             double *margin);
/* Returns the distance to the nearest point of a surface that water can touch, like sb_solid_distance; *normal
   points to the water. The end of a solid in a periodic side is no surface, because the solid continues at the
   opposite side. For a point beside it, the result is that of a point further inside the domain. */
double sb_sample_distance(const sb_sampler *sampler, uint32_t surface, sb_vec3 at, double limit, sb_vec3 *nearest,
                          sb_vec3 *normal);
/* Whether no water comes near any point within `radius` of this one. */
bool sb_sample_buried(const sb_sampler *sampler, uint32_t surface, sb_vec3 at, sb_vec3 inward, double radius);
/* Whether water can be in front of a surface's point, because no other solid covers it. */
bool sb_sample_exposed(const sb_sampler *sampler, uint32_t surface, sb_vec3 at, sb_vec3 normal);
/* Like sb_sample_place, for a point that lies on the boundary surface already, at `offset` from the surface. */
bool sb_sample_fits(const sb_sampler *sampler, uint32_t surface, sb_vec3 at, sb_vec3 inward, double offset);
/* Finds the point of the boundary surface nearest to `at`, which is near the boundary surface of this surface. */
bool sb_sample_project(const sb_sampler *sampler, uint32_t surface, sb_vec3 at, sb_sample *sample);

/* Stages of the sampling of the current slab. Each adds particles of this slab to sampler->set, and sees those that are
   near in the slabs beside it. Returns nonzero without memory, or if the process is to stop. */
int sb_sample_lattices(sb_sampler *sampler);
int sb_sample_grow(sb_sampler *sampler);
int sb_sample_voids(sb_sampler *sampler);

/* Chooses the slabs and rows of a domain. */
void sb_slabs_choose(const sb_sample_settings *settings, sb_slabs *slabs, sb_slabs *rows);
/* Samples the slabs [first, last) of the current group. Visits the particles of each slab when they are final, slab
   after slab. Nothing that is visited depends on `first` and `last`. The visitor may change the particles. Returns
   nonzero if the visitor does, without memory, or if the process is to stop. */
typedef int sb_slab_visit(void *context, sb_sample *found, size_t count);
int sb_slabs_sample(sb_sampler *sampler, uint32_t first, uint32_t last, sb_slab_visit *visit, void *context);

/* Sets the normals of particles along convex edges of solids to the mean normal of the faces that meet there. */
void sb_sample_round_edges(const sb_sampler *sampler, sb_sample *found, size_t count);

/* Candidates for particles. They are collected one by one, placed in parallel, and accepted in their order. */
typedef struct sb_candidate {
    sb_vec3 at, inward; /* on the surface, or on the boundary surface if `placed` */
    uint32_t surface;
    bool placed;
    double offset; /* m, distance from the surface if `placed` */
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
