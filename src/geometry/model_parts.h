/* Inside of the model: what its files share. Private to src/geometry/model*.c. */
#ifndef SB_GEOMETRY_MODEL_PARTS_H
#define SB_GEOMETRY_MODEL_PARTS_H

#include "geometry/fill.h"
#include "geometry/model.h"
#include "geometry/solid.h"

/* Meshes as the questions of space see them (in 2D cut with y = 0), and their solids; one per body
   of the model, the domain's included. A body that 2D misses has no solid. */
typedef struct sb_model_space {
    size_t count;
    sb_mesh *section;     /* owned, in 2D and for the domain; else empty */
    const sb_mesh **mesh; /* the section or the body's own */
    sb_solid **solid;
} sb_model_space;

sb_status sb_model_space_create(const sb_model *model, const sb_scene *domain_of, sb_model_space *space,
                                sb_error *error);
void sb_model_space_free(sb_model_space *space);

/* Warns where solids at one periodic side have nothing to go on as at the other. */
sb_status sb_model_check_sides(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error);

/* Adds to model->warnings what is too coarse or too thin to trust. */
sb_status sb_model_check(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error);

/* model_ends.c: walls where terrain ends within the domain; and a line for a body that has some. */
sb_status sb_model_end_terrain(const sb_scene *scene, sb_model *model, sb_error *error);
sb_status sb_model_warn_of_ends(const sb_scene *scene, const sb_model_body *body, sb_model *model, sb_error *error);

/* Sets body->thin; SB_BAD_INPUT where more than half of its surface is that of a plate thinner than half a spacing,
   with room for water on both sides. */
sb_status sb_model_check_thickness(const sb_scene *scene, const sb_model_space *space, const sb_model *model,
                                   sb_model_body *body, sb_error *error);

/* One line for all bodies thinner than the support radius. */
sb_status sb_model_warn_of_thin(const sb_scene *scene, sb_model *model, sb_error *error);

/* A line for each moving body whose face stands less than a support radius before a wall that looks the same way. */
sb_status sb_model_warn_of_shared(const sb_scene *scene, sb_model *model, sb_error *error);

/* One line for all bodies at rest whose surface lies so close behind that of another that both take its load. */
sb_status sb_model_warn_of_clad(const sb_scene *scene, sb_model *model, sb_error *error);

/* A line for each grid with missing heights that are not marked as such, and for each terrain below the domain's floor
 * where water is. */
sb_status sb_model_warn_of_ground(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error);

/* A line for each open side that water stands at. */
sb_status sb_model_warn_of_open(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error);

/* A line for a body that no water can reach, with the scale that would bring its file into the domain. solid: NULL in
   2D where the plane y = 0 misses the body. */
sb_status sb_model_warn_of_place(const sb_scene *scene, const sb_model_body *body, const sb_solid *solid,
                                 sb_model *model, sb_error *error);

/* One line for all gauges over still water that is too thin for them; sets model->shallow. */
sb_status sb_model_warn_of_gauges(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error);

/* A line for each wave maker that is too fast for its water, and for each moving body that runs into another. */
sb_status sb_model_warn_of_strokes(const sb_scene *scene, const sb_model_space *space, sb_model *model,
                                   sb_error *error);

/* A line for an initial solitary wave of which more than 1 % is cut off. */
sb_status sb_model_warn_of_wave(const sb_scene *scene, const sb_wave_room *room, sb_model *model, sb_error *error);

/* model_particles.c: places the particles of walls and of water. */
sb_status sb_model_sample(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error);
sb_status sb_model_fill(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error);

/* SB_BAD_INPUT, with the figures and a spacing that would do, when the particles of these bodies and their water would
   take more memory than there is to plan with: as sb_model_build_for. */
sb_status sb_model_room(const sb_scene *scene, const sb_model *bodies, sb_model_need *need, sb_error *error);

/* model_data.c: one more line of warning; SB_FAILED without memory. */
sb_status sb_model_warn(sb_model *model, sb_error *error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
