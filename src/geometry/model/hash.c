/* Computes the hash of a model. */
#include "base/hash.h"
#include "geometry/model/parts.h"

#include <string.h>

uint64_t sb_model_hash_before(const sb_model *model)
{
    uint64_t hash = sb_hash(0, &model->min, sizeof model->min);
    hash = sb_hash(hash, &model->max, sizeof model->max);
    return sb_hash(hash, &model->still_depth, sizeof model->still_depth);
}

static uint64_t hash_water(const sb_model *model)
{
    if (model->part.divided) return model->part.hash;
    uint64_t hash = sb_model_hash_before(model);
    hash = sb_hash(hash, model->fluid_position, model->fluid_count * sizeof *model->fluid_position);
    hash = sb_hash(hash, model->fluid_velocity, model->fluid_count * sizeof *model->fluid_velocity);
    return sb_hash(hash, model->fluid_pressure, model->fluid_count * sizeof *model->fluid_pressure);
}

uint64_t sb_model_hash_wall(const sb_model *model, size_t body, size_t particle)
{
    const uint64_t hash = sb_hash(body, &model->wall_position[particle], sizeof *model->wall_position);
    if (!model->wall_normal) return hash;
    return sb_hash(hash, &model->wall_normal[particle], sizeof *model->wall_normal);
}

/* A sum over the boundary particles, to which each of several ranks can add its own. */
static uint64_t hash_walls(const sb_model *model)
{
    uint64_t hash = 0;
    if (model->walls.divided) return model->walls.hash;
    for (size_t b = 0; b < model->body_count; b++) {
        const sb_model_body *body = &model->bodies[b];
        for (size_t i = body->begin; i < body->begin + body->count; i++) hash += sb_model_hash_wall(model, b, i);
    }
    return hash;
}

uint64_t sb_model_hash(const sb_model *model)
{
    const uint64_t walls = hash_walls(model);
    uint64_t hash = sb_hash(hash_water(model), &walls, sizeof walls);
    for (size_t b = 0; b < model->body_count; b++) {
        const sb_model_body *body = &model->bodies[b];
        const uint64_t facts[] = {sb_model_body_walls(model, b), (uint64_t)body->wavemaker, body->report};
        hash = sb_hash(hash, body->name, strlen(body->name));
        hash = sb_hash(hash, facts, sizeof facts);
        hash = sb_hash(hash, &body->moment_point, sizeof body->moment_point);
    }
    for (int side = 0; side < 4; side++)
        if (model->sea[side].along > 0)
            hash =
                sb_hash(hash, model->sea[side].bed, model->sea[side].along * model->sea[side].across * sizeof(double));
    const size_t cells = model->grid.columns * model->grid.rows;
    if (cells > 0) {
        hash = sb_hash(hash, model->grid.bed, cells * sizeof(double));
        hash = sb_hash(hash, model->grid.depth, cells * sizeof(double));
        hash = sb_hash(hash, model->grid.hu, cells * sizeof(double));
    }
    return hash;
}
