/* The two passes of a pressure iteration. A neighbour takes one record from a copy in the first-level cache and 4 bytes
   of a list. Walls are one vector per particle and cost nothing per neighbour. */
#include "sim/passes/cpu/cpu.h"
#include "sim/passes/cpu/simd_wide.h"
#include "sim/passes/groups.h"

/* The records of two neighbours. */
SB_INLINE sb_f8 two(const sb_f4 *around, const uint16_t *place)
{
    return sb_join(*sb_at(around, place[0]), *sb_at(around, place[1]));
}

/* The slopes of two neighbours, each in four lanes. The second one is 2^32 times too large, which saves a shift. */
SB_INLINE sb_f8 two_slopes(const uint16_t *slope)
{
    int32_t pair;
    memcpy(&pair, slope, sizeof pair);
    const sb_i8 mask = {0x7fff, 0x7fff, 0x7fff, 0x7fff, 0x7fff0000, 0x7fff0000, 0x7fff0000, 0x7fff0000};
    const sb_f8 root = __builtin_convertvector((sb_i8){pair, pair, pair, pair, pair, pair, pair, pair} & mask, sb_f8);
    return root * root;
}

/* Sum of the two halves of a vector that was weighted by two_slopes. */
SB_INLINE sb_f4 fold(sb_f8 v)
{
    return __builtin_shufflevector(v, v, 0, 1, 2, 3) + __builtin_shufflevector(v, v, 4, 5, 6, 7) * sb_splat(0x1p-32f);
}

SB_MULTIVERSION
static void accelerate_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    const bool reflects = sim->needs.images;
    const sb_wall_vectors wall = sb_wall_vectors_of(sim);
    _Alignas(64) sb_f4 around[SB_AROUND_MAX];
    sb_around(sim, group, around);
    for (size_t i = group->first; i < group->end; i++) {
        const sb_four_pairs *four = sim->work.pairs.four + sim->work.pairs.first[i],
                            *end = four + sim->work.pairs.count[i];
        const sb_f4 own = sb_in_group(sim, group, i);
        const sb_f8 self = sb_join(own, own), q = sb_carried8(self);
        sb_f8 even = {0}, odd = {0};
        for (; four < end; four++) {
            sb_prefetch(four);
            const sb_f8 a = two(around, four->place), b = two(around, four->place + 2);
            even += (self - a) * ((q + sb_carried8(a)) * two_slopes(four->slope));
            odd += (self - b) * ((q + sb_carried8(b)) * two_slopes(four->slope + 2));
        }
        const sb_f4 sum =
            fold(even + odd) * sb_splat(sim->work.pairs.unit) + sb_splat(own[3]) * wall.vector[i * wall.step];
        sim->work.acceleration[i] = (sb_f4){-sum[0], -sum[1], -sum[2], 0};
        if (reflects && sim->work.edge_pairs.count[i] > 0) sim->work.acceleration[i] -= sb_edges_push(sim, i, own[3]);
    }
}

SB_MULTIVERSION
static void diverge_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    const sb_divergence *of = arguments;
    const sb_f4 *field = of->field;
    const float factor = of->factor;
    float *out = of->out;
    const bool reflects = sim->needs.images;
    const sb_wall_vectors wall = sb_wall_vectors_of(sim);
    _Alignas(64) sb_f4 around[2 * SB_AROUND_MAX];
    sb_around_vectors(sim, group, field, around);
    for (size_t i = group->first; i < group->end; i++) {
        const sb_four_pairs *four = sim->work.pairs.four + sim->work.pairs.first[i],
                            *end = four + sim->work.pairs.count[i];
        const sb_f8 self = sb_join(sb_in_group(sim, group, i), field[i]);
        sb_f8 even = {0}, odd = {0};
        for (; four < end; four++) {
            sb_prefetch(four);
            const sb_f8 a = self - *sb_both_at(around, four->place[0]), b = self - *sb_both_at(around, four->place[1]);
            const sb_f8 c = self - *sb_both_at(around, four->place[2]), d = self - *sb_both_at(around, four->place[3]);
            even += sb_lower(a, b) * (sb_upper(a, b) * two_slopes(four->slope));
            odd += sb_lower(c, d) * (sb_upper(c, d) * two_slopes(four->slope + 2));
        }
        out[i] =
            factor * sb_sum3(fold(even + odd) * sb_splat(sim->work.pairs.unit) + field[i] * wall.vector[i * wall.step]);
        if (reflects && sim->work.edge_pairs.count[i] > 0) out[i] += factor * sb_edges_flow(sim, i, field);
    }
}

void sb_cpu_accelerate(sb_sim *sim)
{
    sb_each_group(sim, accelerate_group, NULL);
}

void sb_cpu_diverge(sb_sim *sim, const sb_f4 *field, float factor, float *out)
{
    sb_each_group(sim, diverge_group, &(sb_divergence){field, factor, out});
}
