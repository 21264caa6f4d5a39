/* What sampling a model's surfaces, whole or by several ranks, is made of. Private to src/geometry/model. */
#ifndef SB_GEOMETRY_MODEL_WALLS_H
#define SB_GEOMETRY_MODEL_WALLS_H

#include "geometry/model/parts.h"

/* Whether a body's boundary particles are divided among ranks: those of moving bodies are whole in each. */
static inline bool sb_body_is_static(const sb_model_body *body)
{
    return body->wavemaker < 0;
}

/* The surfaces that are sampled. The sources are owned; their meshes and solids are the space's or those of
   `wholes`. */
typedef struct sb_model_surfaces {
    sb_sample_settings settings;
    size_t count;
    sb_sample_source *sources;
    sb_wholes *wholes;
} sb_model_surfaces;

/* particles.c. On error *surfaces must be freed, too. */
sb_status sb_model_surfaces_create(const sb_scene *scene, const sb_model_space *space, const sb_model *model,
                                   sb_model_surfaces *surfaces, sb_error *error);
void sb_model_surfaces_free(sb_model_surfaces *surfaces);
/* Moves positions and normals into the model, frees `begin`, and sets the bodies' ranges. */
sb_status sb_model_take_samples(const sb_scene *scene, const sb_model_space *space, sb_samples *samples,
                                sb_model *model, sb_error *error);

/* Gives all ranks the same failure if one has failed. All call it. */
sb_status sb_team_agree(const sb_model_team *team, sb_status own, sb_error *error);

/* What a rank finds as it samples its part. Arrays are owned. */
typedef struct sb_walls_part {
    const sb_scene *scene;
    const sb_model_team *team;
    const sb_model_space *space;
    sb_model *model;
    uint32_t *bounds;     /* ranks + 1: rank r has the slabs [bounds[r], bounds[r + 1]) */
    uint32_t first, last; /* the slabs of which all particles are here */
    uint32_t *slab;       /* per boundary particle here */
    uint64_t *counts;     /* per body, and one more */
} sb_walls_part;

/* guests.c: gives all ranks the boundary particles near places and moving bodies. All ranks call it. */
sb_status sb_walls_exchange_guests(const sb_walls_part *part, sb_error *error);

/* Puts the `count` elements of `size` bytes that each rank has one after another, by rank, into *all, which the caller
   frees. All ranks call it; before: what each has found so far, of which a failure becomes that of all. */
sb_status sb_team_collect(const sb_model_team *team, sb_status before, void *own, size_t count, size_t size, void **all,
                          size_t *all_count, sb_error *error);

#endif
