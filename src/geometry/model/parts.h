/* Functions that the files of the model share. Private to src/geometry/model*.c. */
#ifndef SB_GEOMETRY_MODEL_PARTS_H
#define SB_GEOMETRY_MODEL_PARTS_H

#include "geometry/filling/fill.h"
#include "geometry/model/model.h"
#include "geometry/sampling/sample.h"
#include "geometry/solid/solid.h"
#include "sea/sea.h"

/* Meshes of the surfaces that water meets (in 2D their section with y = 0) and their solids, one per body of the model
   including the domain's. In 2D a body that the plane y = 0 does not cut has no solid. */
typedef struct sb_model_space {
    size_t count;
    sb_mesh *section;     /* owned, in 2D and for the domain; else empty */
    sb_mesh *simple;      /* owned: with less detail than the body's own, if walls reflect water; else empty */
    const sb_mesh **mesh; /* the section, the simple one or the body's own */
    sb_solid **solid;
    sb_fill_source *water; /* owned: places the particles of all ranks; NULL: the model has them all */
} sb_model_space;

sb_status sb_model_space_create(const sb_model *model, const sb_scene *domain_of, sb_model_space *space,
                                sb_error *error);
void sb_model_space_free(sb_model_space *space);
/* A half-width of sections that is large compared with the scene, so that a section's winding number is that of an
   infinite strip, m. */
double sb_model_strip_width(const sb_model *model);

/* The direction along an axis that a normal is nearest to: twice the axis, 1 more if it is that of growing coordinates.
 */
static inline int sb_model_direction_of(sb_vec3 normal)
{
    const double size[3] = {fabs(normal.x), fabs(normal.y), fabs(normal.z)};
    const int axis = size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
    return 2 * axis + (sb_component(normal, axis) > 0);
}

/* Warns if solids at one periodic side do not continue at the opposite side. */
sb_status sb_model_check_sides(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error);

/* facet*.c: the facets of bodies that water can meet, if walls reflect water. The result is the same for any number of
   threads. */
sb_status sb_model_facets(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error);

/* Adds warnings of what is too coarse or too thin for reliable results, and of inputs that are probably mistakes.
   team: the ranks that have parts of the boundary particles, all of which call it; NULL: the model has them all.
   before: what has been found so far; with a failure nothing is checked, but the other ranks get to know it. */
sb_status sb_model_check(const sb_scene *scene, const sb_model_team *team, const sb_model_space *space,
                         sb_status before, sb_model *model, sb_error *error);

/* gauges.c: depth of the still water at a place, m; 0: it is dry, or in a body. */
double sb_model_still_depth(const sb_scene *scene, const sb_model *model, const sb_model_space *space, double x,
                            double y);

/* depths.c: warns of sponges and sets of gauges whose depth is not that of the still water there. */
sb_status sb_model_warn_depths(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error);

/* wave_sizes.c: warns of waves at the start, given at a side or made by a paddle that are too low or too short for the
   spacing, and of linear waves at the start or given that are too long for their theory. */
sb_status sb_model_warn_wave_sizes(const sb_scene *scene, sb_model *model, sb_error *error);

/* standing.c: warns of a standing wave at the start whose water does not end at crests or troughs. */
sb_status sb_model_warn_standing(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error);

/* records.c: warns of recorded planes in which no wave can be recorded. model->sea is made before. */
sb_status sb_model_warn_records(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error);

/* paddles.c: refuses paddles of wave trains that have their water behind them, and warns of those without room. */
sb_status sb_model_check_paddles(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error);

/* sound.c: warns of a speed of sound of weakly compressible water that is too low, or refuses it. */
sb_status sb_model_check_sound(const sb_scene *scene, sb_model *model, sb_error *error);

/* plates.c: the part of a paddle that is one of its push-plates; the first and the last have what is outside of the
   domain. */
sb_body sb_model_plate(const sb_body *from, const sb_plate_row *row, size_t plate);
/* The undivided paddles, whose surfaces are sampled; NULL: no paddle is divided. */
typedef struct sb_wholes sb_wholes;
sb_status sb_wholes_create(const sb_scene *scene, const sb_model *model, sb_wholes **wholes, sb_error *error);
void sb_wholes_destroy(sb_wholes *wholes);
/* Returns whether a body is sampled; of a first plate, mesh and solid become those of the paddle. */
bool sb_wholes_source(const sb_wholes *wholes, const sb_model *model, size_t body, sb_sample_source *source);
/* Divides the boundary particles of a first plate among its plates. Returns 0, or -1 without memory. */
int sb_model_share_plates(const sb_scene *scene, sb_model *model, size_t body);

/* ends.c: adds walls where terrain ends within the domain, and warns of a body that has such walls. */
sb_status sb_model_end_terrain(const sb_scene *scene, sb_model *model, sb_error *error);
sb_status sb_model_warn_ends(const sb_scene *scene, const sb_model_body *body, sb_model *model, sb_error *error);

/* Sets body->thin. SB_BAD_INPUT if more than half of the body's surface belongs to a plate thinner than half a
   spacing with room for water on both sides. */
sb_status sb_model_check_thickness(const sb_scene *scene, const sb_model_space *space, const sb_model *model,
                                   sb_model_body *body, sb_error *error);

/* Adds one warning for all bodies thinner than the support radius. */
sb_status sb_model_warn_thin(const sb_scene *scene, sb_model *model, sb_error *error);

/* Adds a warning for each moving body whose face is less than a support radius in front of a wall that faces the
   same way. */
sb_status sb_model_warn_shared(const sb_scene *scene, sb_model *model, sb_error *error);
/* The box around a moving body in which that looks for walls. */
void sb_model_shared_box(const sb_scene *scene, const sb_model *model, const sb_model_body *body, sb_vec3 *min,
                         sb_vec3 *max);

/* Adds one warning for all static bodies whose surface lies so close behind that of another that both carry its
   load. team, before: as of sb_model_check. */
sb_status sb_model_warn_clad(const sb_scene *scene, const sb_model_team *team, sb_status before, sb_model *model,
                             sb_error *error);

/* Adds a warning for each pair of bodies (or body with itself) with a gap between them that is too narrow for the
   walls, and sets body->gap. team, before: as of sb_model_check. In spacings, the narrowest gaps that walls of each
   kind resolve: at them the force on a block in still water beside an alley is within 3 % of a face's load. */
#define SB_GAP_PARTICLES 1.5
#define SB_GAP_IMAGES 1.0
sb_status sb_model_warn_gaps(const sb_scene *scene, const sb_model_team *team, const sb_model_space *space,
                             sb_status before, sb_model *model, sb_error *error);

/* Adds a warning for each grid with missing heights that are not marked as such, and for each terrain below the
   domain's floor where water is. */
sb_status sb_model_warn_ground(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error);

/* sea.c: finds the ground beside sides of kind sea. SB_BAD_INPUT if such a side is dry or has no room. */
sb_status sb_model_sea_sides(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error);
/* sea_warnings.c: warns of given water that is probably not meant, once the ground is known. */
sb_status sb_model_sea_warn(const sb_scene *scene, sb_sea_source *sea, sb_model *model, sb_error *error);

/* Adds a warning for each open side at which water stands. */
sb_status sb_model_warn_open(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error);

/* Adds one warning for all bodies outside of the domain that no scale of their files would bring into it. */
sb_status sb_model_warn_elsewhere(const sb_scene *scene, sb_model *model, sb_error *error);
/* Adds a warning for another body that no water can reach, with the scale that would bring its file into the domain.
   solid: NULL in 2D if the plane y = 0 does not cut the body. */
sb_status sb_model_warn_place(const sb_scene *scene, const sb_model_body *body, const sb_solid *solid, sb_model *model,
                              sb_error *error);

/* Adds one warning for all gauges over still water that is too shallow for them. Sets model->shallow. */
sb_status sb_model_warn_gauges(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error);
/* Adds a warning for each probe inside of a body. */
sb_status sb_model_warn_probes(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error);
sb_status sb_model_warn_reflections(const sb_scene *scene, const sb_model_space *space, sb_model *model,
                                    sb_error *error);

/* Adds a warning for each wave maker that is too fast for its water, and for each moving body that runs into
   another. */
sb_status sb_model_warn_strokes(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error);

/* Adds a warning for an initial solitary wave of which more than 1 % is cut off. */
sb_status sb_model_warn_wave(const sb_scene *scene, const sb_wave_room *room, sb_model *model, sb_error *error);

/* particles.c: places the boundary particles and the fluid particles. */
sb_status sb_model_sample(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error);
/* walls.c: samples this rank's part of the surfaces. All ranks call it; before: what each has found so far, of which a
   failure becomes that of all. */
sb_status sb_model_sample_part(const sb_scene *scene, const sb_model_team *team, const sb_model_space *space,
                               sb_status before, sb_model *model, sb_error *error);
sb_status sb_model_fill(const sb_scene *scene, const sb_fill_share *share, sb_model_space *space, sb_model *model,
                        sb_error *error);

/* water.c: calls `visit` for all fluid particles in their order, some at a time. If the model has only a part, they are
   placed again for it, which can fail; else there is one call. */
typedef struct sb_water_piece {
    size_t from, count; /* the particles [from, from + count) of all */
    const sb_vec3 *position, *velocity;
    const double *pressure;
} sb_water_piece;
typedef void sb_visit_water(void *context, const sb_water_piece *piece);
sb_status sb_model_visit_water(const sb_model_space *space, const sb_model *model, sb_visit_water *visit, void *context,
                               sb_error *error);
/* Fills in model->part.low, high, speed and hash of a divided model. */
sb_status sb_model_know_water(const sb_model_space *space, sb_model *model, sb_error *error);
/* hash.c: the hash of what precedes the fluid particles in a model's. */
uint64_t sb_model_hash_before(const sb_model *model);
/* The hash of a body's boundary particle, at index `particle` of the model's. */
uint64_t sb_model_hash_wall(const sb_model *model, size_t body, size_t particle);

/* Whether a point is within a box. */
static inline bool sb_box_contains(sb_vec3 min, sb_vec3 max, sb_vec3 at)
{
    return !(at.x < min.x || at.y < min.y || at.z < min.z || at.x > max.x || at.y > max.y || at.z > max.z);
}

/* SB_BAD_INPUT, with the figures and a spacing that would fit, if the particles of these bodies and their water need
   more memory than may be planned with (see sb_model_build_for). */
sb_status sb_model_room(const sb_scene *scene, const sb_model *bodies, sb_model_need *need, sb_error *error);

/* model.c: the failure of a stage; a stop of the program replaces one that a stage reported because of it. */
sb_status sb_model_failure(sb_status own, sb_error *error);

/* data.c: adds a warning. SB_FAILED without memory. */
sb_status sb_model_warn(sb_model *model, sb_error *error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
