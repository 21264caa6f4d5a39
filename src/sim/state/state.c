#include "sim/state/state.h"

#include "base/memory.h"
#include "sim/terms/density_correction.h"

#include <string.h>

static bool starts_in_motion(const sb_scene *scene, const sb_model *model)
{
    bool moves = false;
    for (size_t i = 0; i < model->fluid_count && !moves; i++) moves = sb_norm(model->fluid_velocity[i]) > 0;
    return moves && sb_sim_settles(scene);
}

static bool corrects_density(const sb_scene *scene, const sb_model *model)
{
    (void)model;
    return sb_density_correction_on(scene);
}

#define FIELD(member) #member, .pointer = offsetof(sb_state, member), .size = sizeof *((sb_state *)0)->member

const sb_state_field sb_state_fields[] = {
    {FIELD(position), .unit = "quanta", .ghosts = true},
    {FIELD(velocity), .unit = "m/s", .ghosts = true},
    {FIELD(id), .unit = ""},
    {FIELD(density_correction), .unit = "kg/m^3", .needed = corrects_density},
    {FIELD(start_velocity), .unit = "m/s", .needed = starts_in_motion},
    {.name = NULL},
};

static void set_entries(sb_state *state, const sb_state_field *field, void *entries)
{
    memcpy((char *)state + field->pointer, &entries, sizeof entries);
}

int sb_state_create(sb_state *state, const sb_scene *scene, const sb_model *model)
{
    state->owned = state->capacity = model->fluid_count;
    state->impulse = sb_alloc(model->body_count, sizeof *state->impulse);
    if (!state->impulse) return -1;
    for (const sb_state_field *f = sb_state_fields; f->name; f++) {
        if (f->needed && !f->needed(scene, model)) continue;
        void *entries = sb_alloc(state->owned, f->size);
        if (!entries) return -1;
        set_entries(state, f, entries);
    }
    return 0;
}

int sb_state_lengthen(sb_state *state, size_t used, size_t capacity)
{
    for (const sb_state_field *f = sb_state_fields; f->name; f++) {
        if (!f->ghosts) continue;
        void *longer = sb_alloc_untouched(capacity, f->size);
        if (!longer) return -1;
        memcpy(longer, sb_state_entries(state, f), used * f->size);
        sb_free(sb_state_entries(state, f));
        set_entries(state, f, longer);
    }
    state->capacity = capacity;
    return 0;
}

void sb_state_destroy(sb_state *state)
{
    for (const sb_state_field *f = sb_state_fields; f->name; f++) sb_free(sb_state_entries(state, f));
    sb_free(state->impulse);
    *state = (sb_state){0};
}

size_t sb_state_bytes(const sb_state *state)
{
    size_t bytes = 0;
    for (const sb_state_field *f = sb_state_fields; f->name; f++)
        if (sb_state_entries(state, f)) bytes += f->size * (f->ghosts ? state->capacity : state->owned);
    return bytes;
}
