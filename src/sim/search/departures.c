#include "sim/search/departures.h"

#include <math.h>

const sb_departures *sb_sim_departures(const sb_sim *sim)
{
    return &sim->state.departures;
}

void sb_departures_note(sb_sim *sim, sb_exit way, size_t particle)
{
    sb_departures *all = &sim->state.departures;
    const sb_f4 v = sim->state.velocity[particle];
    all->by_side[way.side]++;
    if (all->count == SB_DEPARTURES) return;
    all->first[all->count++] = (sb_departure){
        .time = sim->state.time,
        .position = sb_space_position(&sim->space, sim->state.position[particle]),
        .speed = (double)sqrtf(sb_sum3(v * v)),
        .particle = sim->state.id[particle],
        .side = way.side,
        .lost = way.lost,
    };
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
