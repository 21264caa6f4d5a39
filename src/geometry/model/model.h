/* The model from which a simulation starts: bodies sampled as boundary particles, and water as fluid particles. It
   is plain data; this header needs no mesh library. The domain's sides of kind wall form one last body named
   "domain" without a mesh. */
#ifndef SB_GEOMETRY_MODEL_H
#define SB_GEOMETRY_MODEL_H

#include "base/ranks.h"
#include "base/status.h"
#include "geometry/facets/facet.h"
#include "geometry/mesh/mesh.h"
#include "offshore/start.h"
#include "scene/scene.h"

#include <math.h>

/* A rigid body. Its boundary particles are [begin, begin + count) of the model's; of a model with a part of them, those
   that are here. */
typedef struct sb_model_body {
    char name[SB_NAME_MAX];
    size_t begin, count;
    int wavemaker; /* index into scene.wavemakers, -1: static */
    size_t source; /* index into scene.bodies, SIZE_MAX: the domain's sides */
    bool report;   /* has rows in forces.csv */
    sb_role role;
    sb_vec3 moment_point; /* m */
    float color[3];
    double thin;  /* m, its thickness if that is less than the support radius; else 0 */
    double gap;   /* m, the narrowest gap before its surface if walls do not resolve it; else 0 */
    sb_mesh mesh; /* scene coordinates at t = 0; empty for domain sides */
    /* Of a paddle that is divided into push-plates, or a flap's rows: its plates follow each other. The first one has
       the paddle's name, and the forces on all. 0, 0: a body that is not divided. */
    size_t plate, plates;
    double held; /* share of the motion that it does not make: of the rows of a flap; else 0 */
    /* Of a model with a part of the boundary particles, of all of the body's; else 0. */
    size_t all;
    sb_vec3 low, high; /* m, extent; of a body without boundary particles 0 */
} sb_model_body;

/* The ground within `width` of a side through which a given sea comes in: cells of `step` inwards and `pitch` along the
   side. The water of the strip next to the side, `strip` wide, is held to the given sea. */
typedef struct sb_model_sea {
    size_t across, along;             /* cells; 0: no such side */
    double step, pitch, width, strip; /* m */
    double *bed; /* m, z of the ground, along * across, the cells of one line inwards after each other */
} sb_model_sea;

/* The part of the water's particles that one of several ranks has, and what it knows of all of them. */
typedef struct sb_model_part {
    bool divided;      /* false: the model has all particles, and the rest of this structure is 0 */
    size_t from, here; /* the arrays have the particles [from, from + here) */
    sb_vec3 low, high; /* m, extent of all */
    double speed;      /* m/s, greatest of all */
    uint64_t hash;     /* of all, and of what sb_model_hash has before them */
} sb_model_part;

/* What a rank has a boundary particle for: it is of its slabs; of a slab beside them; near a place or a moving body,
   where all ranks have it. Those of moving bodies are each rank's own. */
typedef enum sb_wall_of { SB_WALL_OWN, SB_WALL_BESIDE, SB_WALL_GUEST } sb_wall_of;

/* The part of the boundary particles that one of several ranks has, and what it knows of all of them. */
typedef struct sb_model_walls {
    bool divided;      /* false: the model has them all, and the rest of this structure is 0 */
    size_t here;       /* in the arrays, in the order of all */
    unsigned char *of; /* sb_wall_of of each */
    uint64_t hash;     /* of all */
} sb_model_walls;

typedef struct sb_model {
    sb_vec3 min, max; /* m, the domain; min is the origin of stored positions */
    int dimensions;
    double spacing;          /* m */
    double still_depth;      /* m, D: the largest still depth of water */
    double sea_depth;        /* m, the largest depth that a given sea reaches at its sides; 0: there is none */
    sb_model_sea sea[4];     /* by side, from x_min to y_max */
    sb_offshore_start grid;  /* of the depth-averaged model that gives the water there; empty with other sources */
    size_t fluid_count;      /* of all ranks */
    sb_model_part part;      /* which of them are here */
    sb_vec3 *fluid_position; /* m */
    sb_vec3 *fluid_velocity; /* m/s; NULL: freed, all zero */
    double *fluid_pressure;  /* Pa, initial guess: hydrostatic */
    size_t wall_count;       /* boundary particles, of all ranks */
    sb_model_walls walls;    /* which of them are here */
    sb_vec3 *wall_position;  /* m, on the boundary surface, at t = 0 */
    sb_vec3 *wall_normal;    /* unit, towards the water */
    sb_facets facets;        /* of walls that reflect water; empty with other walls */
    size_t body_count;
    sb_model_body *bodies;
    bool *shallow; /* per gauge of the scene: a warning reports that its still water is too shallow; NULL: there are no
                      gauges */
    size_t warning_count;
    char **warnings; /* one line each */
} sb_model;

/* Returns the speed of long waves sqrt(g D) in m/s, for a depth D of at least one spacing. A given sea that rises
   counts with its greatest depth. */
static inline double sb_model_wave_speed(const sb_scene *scene, const sb_model *model)
{
    return sqrt(scene->fluid.gravity * fmax(fmax(model->still_depth, model->sea_depth), scene->resolution));
}

/* speed_scale.c: returns render.speed_max, or for 0 the speed that stands for it, m/s: 2 sqrt(g D); or less, where all
   water moves by regular or irregular waves, whose speeds are known. */
double sb_model_speed_scale(const sb_scene *scene, const sb_model *model);

/* The boundary particles of a body, of all ranks. */
static inline size_t sb_model_body_walls(const sb_model *model, size_t body)
{
    return model->walls.divided ? model->bodies[body].all : model->bodies[body].count;
}

/* water.c: the fluid particles here. */
static inline size_t sb_model_fluid_here(const sb_model *model)
{
    return model->part.divided ? model->part.here : model->fluid_count;
}

/* Extent of all fluid particles at the start, m. Returns false if there are none, or if their positions were freed. */
bool sb_model_extent(const sb_model *model, sb_vec3 *low, sb_vec3 *high);
/* Their greatest speed at the start, m/s; 0 if their velocities were freed, which are all zero then. */
double sb_model_start_speed(const sb_model *model);

/* plates.c: the index of the body that has a body's forces: of a push-plate the first plate, otherwise the body. */
size_t sb_model_whole(const sb_model *model, size_t body);

/* Sets the box around a body at t = 0, of the first plate of a paddle that around all of its plates. Returns false if
   it has no mesh. */
static inline bool sb_model_box(const sb_model *model, size_t body, sb_vec3 *low, sb_vec3 *high)
{
    const size_t plates = model->bodies[body].plates, end = body + (plates > 0 ? plates : 1);
    const bool whole = model->bodies[body].plate == 0;
    bool found = false;
    for (size_t b = body; b < (whole ? end : body + 1); b++)
        for (size_t v = 0; v < model->bodies[b].mesh.vertex_count; v++) {
            const sb_vec3 at = model->bodies[b].mesh.vertices[v];
            *low = found ? sb_min(*low, at) : at;
            *high = found ? sb_max(*high, at) : at;
            found = true;
        }
    return found;
}

/* sea.c: half of the length (m) over which water of this depth is averaged inside of a strip of given water. */
double sb_model_sea_reach(const sb_model *model, double depth);
/* The place at these distances (m) from a side and along it, with z = 0. */
sb_vec3 sb_model_sea_place(const sb_model *model, int side, double inwards, double along);

/* Builds the model: imports the bodies, places the water and samples the boundary particles. model->warnings report
   what is too coarse or too thin for reliable results, and inputs that are probably mistakes. SB_BAD_INPUT for a
   plate thinner than half a spacing, which water would pass. SB_INTERRUPTED if the process is to stop (base/stop.h).
   On error *model is unchanged. The result is the same for any number of threads. */
sb_status sb_model_build(const sb_scene *scene, sb_model *model, sb_error *error);

/* Like sb_model_build, for a caller that will allocate `need` bytes for such a model, whose counts, bodies and
   extent are passed to `need`. SB_BAD_INPUT if more memory is needed than is available less the fraction
   SB_MEMORY_SPARE of it. This is estimated from a coarse model before much memory is allocated. need NULL: the model
   alone. */
typedef double sb_model_need(const sb_scene *scene, const sb_model *model);
sb_status sb_model_build_for(const sb_scene *scene, sb_model_need *need, sb_model *model, sb_error *error);

/* A place near which all ranks have the boundary particles: within `range` (m) of the line between two points; column:
   at all heights; else of a point, or of its images beyond periodic sides. */
typedef struct sb_model_place {
    sb_vec3 at, to; /* m */
    double range;
    bool column;
} sb_model_place;

/* The ranks that build a model together. agree: gives all ranks the same failure if one has failed. */
typedef struct sb_model_team {
    sb_ranks *ranks; /* NULL: one */
    sb_status (*agree)(sb_ranks *ranks, sb_status own, sb_error *error);
    const sb_model_place *places;
    size_t place_count;
} sb_model_team;

/* The same for one of several ranks, all of which call it. It has a part of the fluid particles if the water can be
   placed in parts (it is one sea or one box): model->part; and a part of the boundary particles if the longest axis
   is not periodic, the support is no wider than a slab allows (sb_model_divides_walls), and there are neither foam nor
   dynamic boundary particles: model->walls. All ranks have the same
   model otherwise, warnings and hash included. */
sb_status sb_model_build_part(const sb_scene *scene, sb_model_need *need, const sb_model_team *team, sb_model *model,
                              sb_error *error);
/* Whether sb_model_build_part divides the fluid particles of a scene, and the boundary particles. */
bool sb_model_divides(const sb_scene *scene);
bool sb_model_divides_walls(const sb_scene *scene);
void sb_model_free(sb_model *model);

/* Returns a hash of all parts of the model on which the simulation and its measurements depend. Runs of two models
   with the same hash give the same results. The order of a body's boundary particles, which follows from the meshes, is
   not part of it. */
uint64_t sb_model_hash(const sb_model *model);

/* Frees the initial positions and pressures of the fluid particles, and their velocities if all are zero (then
   NULL). A simulation that was created from the model no longer needs them. fluid_count stays. Compute a hash of the
   model before. */
void sb_model_free_start(sb_model *model);

/* Frees the places and normals of the boundary particles. A simulation that was created from the model and measurements
   that were prepared no longer need them. The counts stay. */
void sb_model_free_walls(sb_model *model);

/* Frees all remaining arrays of the fluid and boundary particles. They are not needed after the water has settled
   and the measurements are set up. Both counts stay. */
void sb_model_free_particles(sb_model *model);

/* Imports the bodies alone, in the same order, with meshes, colours and wave makers but without particles. Pictures
   of a finished run need these. On error *model is unchanged. */
sb_status sb_model_import_bodies(const sb_scene *scene, sb_model *model, sb_error *error);

/* Result of a search for points inside solids. */
typedef struct sb_inside_report {
    size_t count;
    size_t first, body; /* index of the first such point and of its body; SIZE_MAX: none */
    double depth;       /* m, depth of that point below the body's surface */
} sb_inside_report;

/* Checks for each point (xyz, relative to origin) whether it lies inside a body by more than tolerance (m). This
   verifies that no water has passed a wall, independently of the boundary particles. A point beside an open surface,
   beyond its border, is not inside it. displacement: per body, m; NULL: none has moved. */
sb_status sb_model_first_inside(const sb_model *model, const float *position, size_t count, sb_vec3 origin,
                                const sb_vec3 *displacement, double tolerance, sb_inside_report *report,
                                sb_error *error);

#endif
