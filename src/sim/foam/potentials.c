/* Where water emits foam. */
#include "sim/exchange/exchange.h"
#include "sim/foam/foam.h"
#include "sim/passes/groups.h"

#include <math.h>

SB_INLINE float part_of(sb_foam_range range, float x)
{
    const float t = (x - range.from) / (range.to - range.from);
    return t > 0 ? t < 1 ? t : 1 : 0;
}

/* N_i = -(sum_j m grad W_ij + B_i)/rho_0, images included; |N| dr is about 0.5 in the first layer below a surface. */
SB_MULTIVERSION
static void find_normals(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    _Alignas(64) sb_f4 around[SB_AROUND_MAX];
    const float unit = sim->work.pairs.unit, scale = -sim->constant.spacing / sim->constant.rest_density;
    sb_around(sim, group, around);
    for (size_t i = group->first; i < group->end; i++) {
        const sb_f4 self = sb_in_group(sim, group, i);
        const sb_four_pairs *four = sim->work.pairs.four + sim->work.pairs.first[i],
                            *end = four + sim->work.pairs.count[i];
        sb_f4 x = {0}, y = {0}, z = {0};
        for (; four < end; four++) {
            const sb_four d =
                sb_transpose(self - *sb_at(around, four->place[0]), self - *sb_at(around, four->place[1]),
                             self - *sb_at(around, four->place[2]), self - *sb_at(around, four->place[3]));
            const sb_f4 slope = sb_slopes(four);
            x += slope * d.x;
            y += slope * d.y;
            z += slope * d.z;
        }
        const sb_four sums = sb_transpose(x, y, z, (sb_f4){0});
        const sb_f4 sum = (sums.x + sums.y) + (sums.z + sums.w);
        sb_f4 normal = (sum * sb_splat(unit) + sb_wall_vector(sim, i)) * sb_splat(scale);
        const float length = sqrtf(sb_sum3(normal * normal));
        normal *= sb_splat(length > 0 ? 1 / length : 0);
        normal[3] = length;
        sim->work.surface[i] = normal;
    }
}

void sb_foam_find_surface(sb_sim *sim)
{
    sb_each_group(sim, find_normals, NULL);
    sb_refresh(sim, sim->work.surface);
}

void sb_foam_entries(const sb_sim *sim, const sb_group *group, uint32_t *entry)
{
    const sb_run *run = sim->groups.run + group->run;
    for (size_t r = 0; r < group->runs; r++)
        for (uint32_t k = 0; k < run[r].count; k++) *entry++ = run[r].begin + k;
}

/* trapped: sum_j (|v_ij| - v_ij . x_ij/r) w, which is 2 |v_ij| where j approaches and 0 where it departs. crest: sum_j
   (1 - n_i . n_j) w over those at the surface that are below the plane with normal n_i. */
SB_INLINE sb_foam_sums sums_of(const sb_sim *sim, const uint32_t *entry, size_t i)
{
    const sb_foam_law *law = &sim->foam->law;
    const float quantum = (float)sim->space.quantum;
    const sb_f4 v = sim->state.velocity[i], n = sim->work.surface[i];
    const float speed = sqrtf(sb_sum3(v * v));
    const bool crest = sb_sum3(v * n) >= law->outwards * speed;
    const sb_four_pairs *four = sim->work.pairs.four + sim->work.pairs.first[i],
                        *end = four + sb_direct(&sim->work.pairs, i);
    sb_foam_sums sums = {0};
    for (; four < end; four++)
        for (int k = 0; k < 4; k++) {
            const uint32_t j = entry[four->place[k] / SB_PLACE_STEP];
            const sb_f4 apart = sb_offset(sim->state.position[i], sim->state.position[j]) * sb_splat(quantum);
            const float r = sqrtf(sb_sum3(apart * apart)), w = 1 - r * law->inverse;
            if (!(r > 0) || !(w > 0)) continue;
            const sb_f4 relative = v - sim->state.velocity[j], m = sim->work.surface[j];
            sums.trapped += (sqrtf(sb_sum3(relative * relative)) - sb_sum3(relative * apart) / r) * w;
            if (crest && m[3] > law->surface && sb_sum3(apart * n) > 0) sums.crest += (1 - sb_sum3(n * m)) * w;
        }
    sums.trapped /= law->full;
    sums.crest /= law->full;
    return sums;
}

/* The expected number in this step. */
SB_INLINE float expected(const sb_sim *sim, const uint32_t *entry, size_t i, float energy)
{
    const sb_foam_law *law = &sim->foam->law;
    const sb_foam_sums sums = sums_of(sim, entry, i);
    const float reasons = part_of(law->trapped, sums.trapped) + part_of(law->crest, sums.crest);
    return law->rate * (float)sim->state.time_step * energy * reasons;
}

SB_MULTIVERSION
static void find_expected(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    enum { MOST = 1000 };
    uint32_t entry[SB_AROUND_MAX];
    const sb_foam_law *law = &sim->foam->law;
    bool known = false;
    for (size_t i = group->first; i < group->end; i++) {
        const sb_f4 v = sim->state.velocity[i];
        const float energy = part_of(law->energy, sb_sum3(v * v));
        sim->work.emission[i] = 0;
        if (!(energy > 0) || !(sim->work.surface[i][3] > law->surface)) continue;
        if (!known) sb_foam_entries(sim, group, entry);
        known = true;
        const float number = expected(sim, entry, i, energy);
        sim->work.emission[i] = (uint32_t)(SB_FOAM_ONE * (number < MOST ? number : MOST));
    }
}

sb_foam_sums sb_foam_sums_of(const sb_sim *sim, const uint32_t *entry, size_t i)
{
    return sums_of(sim, entry, i);
}

void sb_foam_find_emission(sb_sim *sim)
{
    sb_each_group(sim, find_expected, NULL);
}
