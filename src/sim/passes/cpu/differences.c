/* Sums of differences between neighbours (sim/terms/hyperviscosity.h). */
#include "sim/passes/cpu/cpu.h"
#include "sim/passes/cpu/eights.h"
#include "sim/passes/groups.h"

/* Arguments of the pass. */
typedef struct between {
    const sb_f4 *field;
    float factor;
    sb_f4 *out;
} between;

SB_MULTIVERSION
static void add_differences(sb_sim *sim, const sb_group *group, const void *arguments)
{
    const between *of = arguments;
    _Alignas(64) sb_f4 around[2 * SB_AROUND_MAX];
    const float unit = of->factor * -sim->work.pairs.unit / (float)sim->space.quantum;
    sb_around_with(sim, group, of->field, around);
    for (size_t i = group->first; i < group->end; i++) {
        const sb_f4 own = of->field[i];
        const sb_f8 u = sb_spread(own, 0), v = sb_spread(own, 1), w = sb_spread(own, 2);
        const sb_four_pairs *four = sim->work.pairs.four + sim->work.pairs.first[i],
                            *end = four + sb_direct(&sim->work.pairs, i);
        sb_f4 x = {0}, y = {0}, z = {0};
        for (; four < end; four += 2) {
            const bool two = four + 1 < end;
            const sb_four_pairs *other = two ? four + 1 : four;
            const sb_eight at = sb_eight_with(around, four, other, 1);
            const sb_f8 slope = sb_eight_slopes(four, other);
            const sb_f8 dx = (u - at.x) * slope, dy = (v - at.y) * slope, dz = (w - at.z) * slope;
            x += sb_first4(dx);
            y += sb_first4(dy);
            z += sb_first4(dz);
            if (!two) break;
            x += sb_second4(dx);
            y += sb_second4(dy);
            z += sb_second4(dz);
        }
        const sb_four sum = sb_transpose(x, y, z, (sb_f4){0});
        of->out[i] += (sum.x + sum.y + sum.z + sum.w) * sb_splat(unit);
    }
}

void sb_cpu_differences(sb_sim *sim, const sb_f4 *field, float factor, sb_f4 *out)
{
    sb_each_group(sim, add_differences, &(between){field, factor, out});
}
