#include "sim/state/state.h"

#include "base/memory.h"

#include <string.h>

#define FIELD(member) #member, .pointer = offsetof(sb_state, member), .size = sizeof *((sb_state *)0)->member

const sb_state_field sb_state_fields[] = {
    {FIELD(position), .unit = "quanta", .ghosts = true, .needed = SB_ALWAYS},
    {FIELD(velocity), .unit = "m/s", .ghosts = true, .needed = SB_ALWAYS},
    {FIELD(id), .unit = "", .needed = SB_ALWAYS},
    {FIELD(excess), .unit = "kg/m^3", .needed = SB_NEEDS(wcsph), .apart = true},
    {FIELD(step_begin), .unit = "m/s", .needed = SB_NEEDS(wcsph), .apart = true},
    {FIELD(density_correction), .unit = "kg/m^3", .needed = SB_NEEDS(density_correction)},
    {FIELD(steady_stress), .unit = "Pa m^6/kg^2", .needed = SB_NEEDS(steady_stress)},
    {FIELD(steady_stress_xx), .unit = "Pa m^6/kg^2", .needed = SB_NEEDS(steady_stress)},
    {FIELD(steady_unknown), .unit = "Pa m^6/kg^2", .needed = SB_NEEDS(steady_stress)},
    {FIELD(start_velocity), .unit = "m/s", .needed = SB_NEEDS(start_velocity)},
    {.name = NULL},
};

static void set_entries(sb_state *state, const sb_state_field *field, void *entries)
{
    memcpy((char *)state + field->pointer, &entries, sizeof entries);
}

int sb_state_create(sb_state *state, const sb_needs *needs, size_t particles, size_t bodies)
{
    state->owned = state->capacity = particles;
    state->impulse = sb_alloc(bodies, sizeof *state->impulse);
    if (!state->impulse) return -1;
    for (const sb_state_field *f = sb_state_fields; f->name; f++) {
        if (!sb_needed(needs, f->needed)) continue;
        void *entries = sb_alloc(state->owned, f->size);
        if (!entries) return -1;
        set_entries(state, f, entries);
    }
    return 0;
}

int sb_state_grow(sb_state *state, size_t used, size_t owned)
{
    const size_t capacity = state->capacity + owned - state->owned;
    for (const sb_state_field *f = sb_state_fields; f->name; f++) {
        void *entries = sb_state_entries(state, f);
        if (!entries) continue;
        void *longer = sb_alloc(f->ghosts ? capacity : owned, f->size);
        if (!longer) return -1;
        memcpy(longer, entries, used * f->size);
        sb_free(entries);
        set_entries(state, f, longer);
    }
    state->owned = owned;
    state->capacity = capacity;
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
