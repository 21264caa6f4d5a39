#include "sim/passes/cpu/cpu.h"
#include "sim/passes/groups.h"
#include "sim/walls/entry.h"

/* The record of entry e as it was when the lists were made: offset from the group's corner, and q in the last lane.
   back: -dt in quanta per m/s. */
SB_INLINE sb_f4 entry(const sb_sim *sim, const sb_group *group, size_t e, sb_f4 back)
{
    sb_f4 at = sb_offset(sim->state.position[e], group->corner);
    const size_t images = sb_images_first(sim);
    if (e < images) {
        at += sim->state.velocity[e] * back;
        at[3] = sim->work.unknown[e];
    } else
        at[3] = sim->work.unknown[sim->ghosts.of[e - images]];
    return at;
}

/* sum_b psi_b x_ib . grad W_ib in quanta. */
static float by_walls(const sb_sim *sim, const sb_group *group, size_t i, sb_f4 self)
{
    const sb_pairs *pairs = &sim->work.wall_pairs;
    float sum = 0;
    for (size_t k = pairs->first[i]; k < pairs->first[i] + pairs->count[i]; k++) {
        const uint32_t index = pairs->index[k];
        const sb_record wall = sb_wall_set_of(sim, index)->record[sb_wall_particle(index)];
        const sb_f4 d = self - sb_offset(wall, group->corner);
        sum += pairs->slope[k] * sb_sum3(d * d);
    }
    return sum;
}

SB_MULTIVERSION
static void find_pressures(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    _Alignas(64) sb_f4 around[SB_AROUND_MAX];
    const float quantum = (float)sim->space.quantum;
    const sb_f4 back = sb_splat(-(float)sim->state.time_step / quantum);
    const float factor = -0.5f * sim->constant.rest_density * quantum / (float)sim->constant.dimension;
    const sb_run *run = sim->groups.run + group->run;
    sb_f4 *at = around;
    for (size_t r = 0; r < group->runs; r++)
        for (size_t k = 0; k < run[r].count; k++) *at++ = entry(sim, group, run[r].begin + k, back);
    const sb_image *image = sim->groups.image + group->image;
    for (uint32_t k = 0; k < group->images; k++) {
        sb_f4 place = entry(sim, group, image[k].from, back);
        for (uint32_t path = image[k].path; path; path >>= SB_REFLECTION_BITS)
            place = sb_reflect(sb_path_plane(sim->groups.plane + group->plane, path), place);
        *at++ = place;
    }
    for (size_t i = group->first; i < group->end; i++) {
        const sb_four_pairs *four = sim->work.pairs.four + sim->work.pairs.first[i],
                            *end = four + sim->work.pairs.count[i];
        const sb_f4 self = entry(sim, group, i, back);
        sb_f4 sum = {0};
        for (; four < end; four++) {
            const sb_four d = sb_transpose(*sb_at(around, four->place[0]), *sb_at(around, four->place[1]),
                                           *sb_at(around, four->place[2]), *sb_at(around, four->place[3]));
            const sb_f4 x = d.x - sb_splat(self[0]), y = d.y - sb_splat(self[1]), z = d.z - sb_splat(self[2]);
            sum += (d.w + sb_splat(self[3])) * sb_slopes(four) * (x * x + y * y + z * z);
        }
        const float water = ((sum[0] + sum[1]) + (sum[2] + sum[3])) * sim->work.pairs.unit;
        const float walls = sim->needs.images ? 0 : by_walls(sim, group, i, self);
        sim->work.virial[i] = factor * (water + self[3] * walls);
    }
}

void sb_cpu_virial(sb_sim *sim)
{
    sb_each_group(sim, find_pressures, NULL);
}
