/* The fluid particles of a model, of which one of several ranks has a part. */
#include "base/hash.h"
#include "geometry/model/parts.h"

enum { PIECE = 1 << 19 }; /* particles that are placed again at a time */

bool sb_model_divides(const sb_scene *scene)
{
    return sb_fill_divides(scene);
}

bool sb_model_extent(const sb_model *model, sb_vec3 *low, sb_vec3 *high)
{
    if (model->fluid_count == 0 || !model->fluid_position) return false;
    *low = model->part.low, *high = model->part.high;
    if (model->part.divided) return true;
    *low = *high = model->fluid_position[0];
    for (size_t i = 1; i < model->fluid_count; i++) {
        *low = sb_min(*low, model->fluid_position[i]);
        *high = sb_max(*high, model->fluid_position[i]);
    }
    return true;
}

double sb_model_start_speed(const sb_model *model)
{
    double speed = 0;
    if (model->part.divided) return model->fluid_velocity ? model->part.speed : 0;
    for (size_t i = 0; i < model->fluid_count && model->fluid_velocity; i++)
        speed = fmax(speed, sb_norm(model->fluid_velocity[i]));
    return speed;
}

sb_status sb_model_visit_water(const sb_model_space *space, const sb_model *model, sb_visit_water *visit, void *context,
                               sb_error *error)
{
    const size_t all = model->fluid_count;
    if (!space->water) {
        visit(context, &(sb_water_piece){0, all, model->fluid_position, model->fluid_velocity, model->fluid_pressure});
        return SB_OK;
    }
    for (size_t from = 0; from < all; from += PIECE) {
        sb_fluid fluid = {0};
        const size_t count = all - from < PIECE ? all - from : PIECE;
        const sb_status status = sb_fill_place(space->water, from, count, &fluid, error);
        if (status != SB_OK) return status;
        visit(context, &(sb_water_piece){from, count, fluid.position, fluid.velocity, fluid.pressure});
        sb_fluid_free(&fluid);
    }
    return SB_OK;
}

/* ---- what a rank knows of all particles ---- */

static void know_places(void *context, const sb_water_piece *piece)
{
    sb_model_part *part = context;
    for (size_t i = 0; i < piece->count; i++) {
        const sb_vec3 at = piece->position[i];
        const bool first = piece->from + i == 0;
        part->low = first ? at : sb_min(part->low, at);
        part->high = first ? at : sb_max(part->high, at);
        part->speed = fmax(part->speed, sb_norm(piece->velocity[i]));
    }
    part->hash = sb_hash_words(part->hash, piece->position, 3 * piece->count);
}

static void know_velocities(void *context, const sb_water_piece *piece)
{
    sb_model_part *part = context;
    part->hash = sb_hash_words(part->hash, piece->velocity, 3 * piece->count);
}

static void know_pressures(void *context, const sb_water_piece *piece)
{
    sb_model_part *part = context;
    part->hash = sb_hash_words(part->hash, piece->pressure, piece->count);
}

sb_status sb_model_know_water(const sb_model_space *space, sb_model *model, sb_error *error)
{
    sb_visit_water *const visits[] = {know_places, know_velocities, know_pressures};
    const size_t bytes[] = {sizeof(sb_vec3), sizeof(sb_vec3), sizeof(double)};
    sb_model_part *part = &model->part;
    sb_status status = SB_OK;
    if (!space->water) return SB_OK;
    part->hash = sb_model_hash_before(model);
    for (size_t k = 0; k < sizeof visits / sizeof *visits && status == SB_OK; k++) {
        part->hash = sb_hash_begin(part->hash, model->fluid_count * bytes[k]);
        status = sb_model_visit_water(space, model, visits[k], part, error);
        part->hash = sb_hash_end(part->hash, 0);
    }
    return status;
}
