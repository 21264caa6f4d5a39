/* The passes of the strain of the packing (sim/terms/packing_strain.h). */
#include "sim/passes/cpu/cpu.h"
#include "sim/passes/cpu/eights.h"
#include "sim/passes/cpu/moments.h"
#include "sim/passes/groups.h"

SB_MULTIVERSION
static void find_strain(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    _Alignas(64) sb_f4 around[2 * SB_AROUND_MAX];
    const bool flat = sim->constant.dimension == 2;
    sb_around_with(sim, group, sim->state.velocity, around);
    for (size_t i = group->first; i < group->end; i++) {
        sb_moments m = sb_moments_gather(sim, group, around, i);
        float g[3][3] = {{0}};
        sb_moments_gradient(&m, flat, (float)sim->space.quantum, g);
        const float mean = (g[0][0] + g[1][1] + g[2][2]) * (flat ? 0.5f : 1 / 3.0f);
        sim->work.deviator_xx[i] = g[0][0] - mean;
        sim->work.deviator[i] = (sb_f4){flat ? 0 : g[1][1] - mean, 0.5f * (g[0][1] + g[1][0]),
                                        0.5f * (g[0][2] + g[2][0]), 0.5f * (g[1][2] + g[2][1])};
    }
}

/* Sum over the pairs of a particle of slope (L_i + L_j) x . x. */
SB_INLINE float strained_of(const sb_sim *sim, const sb_group *group, const sb_f4 *around, size_t i)
{
    const sb_f4 self = sb_in_group(sim, group, i), own = sim->work.stress[i];
    const sb_four_pairs *four = sim->work.pairs.four + sim->work.pairs.first[i], *end = four + sim->work.pairs.count[i];
    sb_f4 sum = {0};
    for (; four < end; four += 2) {
        const bool two = four + 1 < end;
        const sb_four_pairs *other = two ? four + 1 : four;
        sb_prefetch(four);
        const sb_eight at = sb_eight_with(around, four, other, 0), l = sb_eight_with(around, four, other, 1);
        const sb_f8 x = sb_spread(self, 0) - at.x, y = sb_spread(self, 1) - at.y, z = sb_spread(self, 2) - at.z;
        const sb_f8 xx = sb_spread(self, 3) + at.w, yy = sb_spread(own, 0) + l.x, xy = sb_spread(own, 1) + l.y;
        const sb_f8 xz = sb_spread(own, 2) + l.z, yz = sb_spread(own, 3) + l.w;
        const sb_f8 along = xx * (x * x - z * z) + yy * (y * y - z * z) + 2 * (xy * x * y + xz * x * z + yz * y * z);
        const sb_f8 all = along * sb_eight_slopes(four, other);
        sum += sb_first4(all);
        if (!two) break;
        sum += sb_second4(all);
    }
    return sum[0] + sum[1] + sum[2] + sum[3];
}

SB_MULTIVERSION
static void find_strained(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    _Alignas(64) sb_f4 around[2 * SB_AROUND_MAX];
    const float unit = 0.5f * sim->work.pairs.unit * (float)sim->space.quantum;
    const bool any = sb_around_tensors(sim, group, sim->work.stress, around);
    for (size_t i = group->first; i < group->end; i++)
        sim->work.strained[i] = any ? unit * strained_of(sim, group, around, i) : 0;
}

void sb_cpu_strain(sb_sim *sim)
{
    sb_each_group(sim, find_strain, NULL);
}

void sb_cpu_strained(sb_sim *sim)
{
    sb_each_group(sim, find_strained, NULL);
}
