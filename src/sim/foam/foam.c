#include "sim/foam/foam.h"

#include "base/memory.h"

#include <math.h>

/* Speeds are fractions of sqrt(g D), or of sqrt(g dr) for speeds of approach. A calm wave of half the depth's height
   has a speed of approach of about 0.1 sqrt(dr/D) sqrt(g dr), water that falls into water one of sqrt(D/dr) sqrt(g dr).
   A crest with a radius of curvature R has a mean of 0.2 (dr/R)^2 with the default support radius. */
static sb_foam_law law_of(const sb_sim *sim)
{
    const sb_constants *c = &sim->constant;
    const float waves = c->wave_speed, lift = sqrtf(c->gravity * c->spacing), time = waves / c->gravity;
    const double reach = (double)(c->support / c->spacing);
    const double full = c->dimension == 2 ? M_PI * reach * reach / 3 : M_PI * reach * reach * reach / 3;
    const double lifetime = sim->scene->foam.lifetime;
    return (sb_foam_law){
        .energy = {0.03f * waves * waves, 0.25f * waves * waves},
        .trapped = {0.4f * lift, 1.2f * lift},
        .crest = {0.02f, 0.1f},
        .surface = 0.25f,
        .outwards = 0.6f,
        .rate = (float)(25 * sim->scene->foam.amount) / time,
        .lifetime = lifetime > 0 ? (float)lifetime : 6 * time,
        .rise = 0.3f * lift,
        .air = 0.15f,
        .water = 0.8f,
        .support = c->support,
        .inverse = 1 / c->support,
        .full = (float)full,
    };
}

sb_status sb_foam_create(sb_sim *sim, sb_error *error)
{
    _Static_assert(sizeof(sb_foam_particle) == 48, "no padding");
    if (!sim->needs.foam) return SB_OK;
    sim->foam = sb_alloc(1, sizeof *sim->foam);
    if (!sim->foam) return sb_fail_memory(error, "foam");
    sim->foam->law = law_of(sim);
    return SB_OK;
}

void sb_foam_destroy(sb_foam *foam)
{
    if (!foam) return;
    sb_free(foam->particle);
    sb_free(foam->words);
    sb_free(foam->other);
    sb_free(foam);
}

size_t sb_foam_bytes(const sb_foam *foam)
{
    if (!foam) return 0;
    const size_t words = foam->words_capacity + foam->other_capacity;
    return sizeof *foam + foam->capacity * sizeof *foam->particle + words * sizeof *foam->words;
}

sb_status sb_stage_foam(sb_sim *sim, sb_error *error)
{
    if (!sim->policy->runs) return SB_OK;
    if (sb_foam_move(sim) != 0) return sb_fail_memory(error, "foam");
    sb_foam_find_surface(sim);
    sb_foam_find_emission(sim);
    return sb_foam_emit(sim) == 0 ? SB_OK : sb_fail_memory(error, "foam");
}

void sb_foam_count(const sb_foam *foam, size_t count[SB_FOAM_KINDS])
{
    for (int kind = 0; kind < SB_FOAM_KINDS; kind++) count[kind] = 0;
    for (size_t p = 0; foam && p < foam->count; p++) count[foam->particle[p].kind]++;
}

int sb_foam_fill(const sb_sim *sim, sb_frame *frame)
{
    const sb_foam *foam = sim->foam;
    if (!foam || foam->count == 0) return 0;
    if (sb_frame_add_foam(frame, foam->count) != 0) return -1;
    const sb_vec3 shift = sb_sub(sim->space.origin, sim->model->min);
    const double by[3] = {shift.x, shift.y, shift.z};
    for (size_t p = 0; p < foam->count; p++) {
        const sb_foam_particle *one = &foam->particle[p];
        for (size_t axis = 0; axis < 3; axis++) {
            frame->foam.position[3 * p + axis] = (float)(one->position[axis] * sim->space.quantum + by[axis]);
            frame->foam.velocity[3 * p + axis] = one->velocity[axis];
        }
        frame->foam.life[p] = one->velocity[3] / foam->law.lifetime;
        frame->foam.id[p] = one->id;
        frame->foam.kind[p] = (uint8_t)one->kind;
    }
    return 0;
}

void sb_foam_save(const sb_sim *sim, sb_archive_out *out)
{
    if (!sim->foam) return;
    sb_put_count(out, sim->foam->next_id);
    sb_put_list(out, sim->foam->particle, sim->foam->count, sizeof *sim->foam->particle);
}

static bool is_possible(const sb_foam_particle *p)
{
    for (int axis = 0; axis < 3; axis++)
        if (p->position[axis] >= SB_POSITION_END || !isfinite(p->velocity[axis])) return false;
    return p->velocity[3] > 0 && isfinite(p->velocity[3]) && p->kind < SB_FOAM_KINDS && p->position[3] == 0;
}

void sb_foam_load(sb_sim *sim, sb_archive_in *in)
{
    sb_foam *foam = sim->foam;
    if (!foam) return;
    foam->count = 0;
    foam->next_id = (uint32_t)sb_take_count(in, UINT32_MAX);
    const size_t n = sb_take_length(in, sizeof *foam->particle, (size_t)sim->scene->foam.most);
    if (sb_grow((void **)&foam->particle, &foam->capacity, n, sizeof *foam->particle) != 0) {
        sb_archive_refuse(in, "%zu particles of foam: not enough memory", n);
        return;
    }
    sb_take_list(in, foam->particle, n, sizeof *foam->particle);
    for (size_t p = 0; p < n && in->error.status == SB_OK; p++)
        if (!is_possible(&foam->particle[p]))
            sb_archive_refuse(
                in, "particle %zu of foam: expected a place, a finite velocity, a life above 0 and a kind", p);
    foam->count = in->error.status == SB_OK ? n : 0;
}
