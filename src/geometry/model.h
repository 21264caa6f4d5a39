/* What a simulation is made of: bodies sampled into boundary particles, water into fluid particles.
   Plain data; this header needs no mesh library. The domain's wall sides are one last body named
   "domain" without a mesh. */
#ifndef SB_GEOMETRY_MODEL_H
#define SB_GEOMETRY_MODEL_H

#include "geometry/mesh.h"
#include "scene/scene.h"

#include <math.h>

/* One rigid body, its boundary particles being [begin, begin + count) of the model's. */
typedef struct sb_model_body {
    char name[SB_NAME_MAX];
    size_t begin, count;
    int wavemaker; /* index into scene.wavemakers, -1: static */
    size_t source; /* index into scene.bodies, SIZE_MAX: the domain's sides */
    bool report;   /* has rows in forces.csv */
    sb_role role;
    sb_vec3 moment_point; /* m */
    float color[3];
    double thin;  /* m, its thickness where that is less than the support radius; else 0 */
    sb_mesh mesh; /* scene coordinates at t = 0; empty for domain sides */
} sb_model_body;

typedef struct sb_model {
    sb_vec3 min, max; /* m, the domain; min is the origin of stored positions */
    int dimensions;
    double spacing;     /* m */
    double still_depth; /* m, D: the largest still depth of water */
    size_t fluid_count;
    sb_vec3 *fluid_position; /* m */
    sb_vec3 *fluid_velocity; /* m/s; NULL: forgotten, all zero */
    double *fluid_pressure;  /* Pa, hydrostatic first guess */
    size_t wall_count;
    sb_vec3 *wall_position; /* m, on the offset sheet, at t = 0 */
    sb_vec3 *wall_normal;   /* unit, towards the water */
    size_t body_count;
    sb_model_body *bodies;
    bool *shallow; /* per gauge of the scene: a warning says that its water is too thin; NULL: there are no gauges */
    size_t warning_count;
    char **warnings; /* one line each: what the user should know before running */
} sb_model;

/* m/s: sqrt(g D) of water at least one spacing deep. */
static inline double sb_model_wave_speed(const sb_scene *scene, const sb_model *model)
{
    return sqrt(scene->fluid.gravity * fmax(model->still_depth, scene->resolution));
}

/* Imports, samples and fills, and warns of what is too coarse or too thin to trust; SB_BAD_INPUT for a plate thinner
   than half a spacing, which water would pass. On error *model is untouched; SB_INTERRUPTED when the process is to stop
   (base/stop.h). Deterministic for any thread count. */
sb_status sb_model_build(const sb_scene *scene, sb_model *model, sb_error *error);

/* The same for a caller that goes on to take `need` bytes for such a model, of which it is given counts, bodies and
   extent: SB_BAD_INPUT, from a coarse look before much is allocated, where more is needed than is available less
   SB_MEMORY_SPARE of it. NULL: nothing but the model. */
typedef double sb_model_need(const sb_scene *scene, const sb_model *model);
sb_status sb_model_build_for(const sb_scene *scene, sb_model_need *need, sb_model *model, sb_error *error);
void sb_model_free(sb_model *model);

/* Of all that a simulation and its measurements start from: two models with one hash run alike. */
uint64_t sb_model_hash(const sb_model *model);

/* Frees where the fluid particles start, their pressures, and their velocities where all are zero (then NULL): what a
   simulation that was made from the model needs no more. fluid_count stays. A hash of the model is taken before. */
void sb_model_forget_start(sb_model *model);

/* Frees what else there is by particle, boundary particles too: what nobody asks for once the water has settled and the
   measurements are made. Both counts stay. */
void sb_model_forget_particles(sb_model *model);

/* The bodies alone, in the same order, with meshes, colours and wavemakers but without particles:
   what pictures of a finished run need. On error *model is untouched. */
sb_status sb_model_import_bodies(const sb_scene *scene, sb_model *model, sb_error *error);

/* Points found within solids. */
typedef struct sb_inside_report {
    size_t count;
    size_t first, body; /* the first such point and its body; SIZE_MAX: none */
    double depth;       /* m below the surface, of that point */
} sb_inside_report;

/* Asks for each point (xyz, relative to origin) whether it lies within a body by more than
   tolerance (m): a proof that walls held, independent of the boundary particles. What is beside an open
   sheet, beyond its rim, is not within it. displacement: per body, m; NULL: none moved. */
sb_status sb_model_first_inside(const sb_model *model, const float *position, size_t count, sb_vec3 origin,
                                const sb_vec3 *displacement, double tolerance, sb_inside_report *report,
                                sb_error *error);

#endif
