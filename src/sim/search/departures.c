#include "sim/search/departures.h"

#include "base/ranks.h"

#include <math.h>

const sb_departures *sb_sim_departures(const sb_sim *sim)
{
    return &sim->state.departures;
}

void sb_departures_note(const sb_sim *sim, sb_exit way, size_t particle, sb_departures *here)
{
    const sb_f4 v = sim->state.velocity[particle];
    here->by_side[way.side]++;
    if (here->count == SB_DEPARTURES) return;
    here->first[here->count++] = (sb_departure){
        .time = sim->state.time,
        .position = sb_space_position(&sim->space, sim->state.position[particle]),
        .speed = (double)sqrtf(sb_sum3(v * v)),
        .particle = sim->state.id[particle],
        .side = way.side,
        .lost = way.lost,
    };
}

static void append(sb_departures *all, const sb_departures *some)
{
    for (int side = 0; side < SB_SIDES; side++) all->by_side[side] += some->by_side[side];
    for (size_t k = 0; k < some->count && all->count < SB_DEPARTURES; k++) all->first[all->count++] = some->first[k];
}

/* The notes of all domains, in the order of the ids. */
static sb_departures merge(sb_ranks *ranks, const sb_departures *here)
{
    sb_departures all[SB_RANKS_MAX], merged = {.count = 0};
    size_t at[SB_RANKS_MAX] = {0};
    sb_ranks_gather(ranks, here, sizeof *here, all);
    for (int r = 0; r < ranks->count; r++)
        for (int side = 0; side < SB_SIDES; side++) merged.by_side[side] += all[r].by_side[side];
    while (merged.count < SB_DEPARTURES) {
        const sb_departure *next = NULL;
        int of = 0;
        for (int r = 0; r < ranks->count; r++) {
            const sb_departure *one = &all[r].first[at[r]];
            if (at[r] < all[r].count && (!next || one->particle < next->particle)) next = one, of = r;
        }
        if (!next) break;
        merged.first[merged.count++] = *next;
        at[of]++;
    }
    return merged;
}

void sb_departures_add(sb_sim *sim, const sb_departures *here)
{
    if (!sb_ranks_several(sim->ranks)) {
        append(&sim->state.departures, here);
        return;
    }
    const sb_departures merged = merge(sim->ranks, here);
    append(&sim->state.departures, &merged);
}

void sb_departures_save(const sb_sim *sim, sb_archive_out *out)
{
    const sb_departures *all = &sim->state.departures;
    sb_put_list(out, all->by_side, SB_SIDES, sizeof *all->by_side);
    sb_put_count(out, all->count);
    for (size_t i = 0; i < all->count; i++) {
        const sb_departure *one = &all->first[i];
        sb_put_real(out, one->time);
        sb_put_vector(out, one->position);
        sb_put_real(out, one->speed);
        sb_put_count(out, one->particle);
        sb_put_count(out, (uint64_t)one->side);
        sb_put_flag(out, one->lost);
    }
}

void sb_departures_load(sb_sim *sim, sb_archive_in *in)
{
    sb_departures *all = &sim->state.departures;
    sb_take_list(in, all->by_side, SB_SIDES, sizeof *all->by_side);
    all->count = (size_t)sb_take_count(in, SB_DEPARTURES);
    for (size_t i = 0; i < all->count; i++) {
        sb_departure *one = &all->first[i];
        one->time = sb_take_real(in);
        one->position = sb_take_vector(in);
        one->speed = sb_take_real(in);
        one->particle = (uint32_t)sb_take_count(in, UINT32_MAX);
        one->side = (int)sb_take_count(in, SB_SIDES - 1);
        one->lost = sb_take_flag(in);
    }
}
