/* The passes of the deviatoric stress correction (sim/terms/stress_correction.h). */
#include "sim/exchange/exchange.h"
#include "sim/passes/cpu/cpu.h"
#include "sim/passes/cpu/eights.h"
#include "sim/passes/cpu/reactions.h"
#include "sim/passes/groups.h"
#include "sim/terms/stress_correction.h"

/* Sums over neighbours of slope (q_i + q_j) x (x) x. */
typedef struct moments {
    float xx, yy, zz, xy, xz, yz;
    float squares; /* slope x . x */
} moments;

SB_INLINE moments gather(const sb_sim *sim, const sb_group *group, const sb_f4 *around, size_t i)
{
    const sb_f4 self = sb_in_group(sim, group, i), own = sb_splat(self[3]);
    const sb_four_pairs *four = sim->work.pairs.four + sim->work.pairs.first[i], *end = four + sim->work.pairs.count[i];
    sb_f4 xx = {0}, yy = {0}, zz = {0}, xy = {0}, xz = {0}, yz = {0}, squares = {0};
    for (; four < end; four++) {
        sb_prefetch(four);
        const sb_four at = sb_transpose(*sb_at(around, four->place[0]), *sb_at(around, four->place[1]),
                                        *sb_at(around, four->place[2]), *sb_at(around, four->place[3]));
        const sb_f4 alone = sb_slopes(four), slope = alone * (own + at.w);
        const sb_f4 dx = sb_splat(self[0]) - at.x, dy = sb_splat(self[1]) - at.y, dz = sb_splat(self[2]) - at.z;
        const sb_f4 x = dx * slope, y = dy * slope;
        xx += x * dx, xy += x * dy, xz += x * dz;
        yy += y * dy, yz += y * dz, zz += dz * slope * dz;
        squares += (dx * dx + dy * dy + dz * dz) * alone;
    }
    const sb_four a = sb_transpose(xx, yy, zz, xy), b = sb_transpose(xz, yz, squares, (sb_f4){0});
    const sb_f4 p = a.x + a.y + a.z + a.w, q = b.x + b.y + b.z + b.w;
    return (moments){p[0], p[1], p[2], p[3], q[0], q[1], q[2]};
}

/* D_i as deviator_xx, and yy, xy, xz, yz as deviator. */
SB_MULTIVERSION
static void find_deviator(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    _Alignas(64) sb_f4 around[SB_AROUND_MAX];
    const bool flat = sim->constant.dimension == 2;
    const float part = flat ? 0.5f : 1 / 3.0f;
    const float per = sim->work.pairs.unit * (float)sim->space.quantum / sim->constant.rest_density;
    sb_around(sim, group, around);
    for (size_t i = group->first; i < group->end; i++) {
        const moments m = gather(sim, group, around, i);
        const float mean = part * (m.xx + m.yy + m.zz);
        const float factor = 0.5f * per * sb_stress_factor(sim, -part * per * m.squares);
        sim->work.deviator_xx[i] = factor * (m.xx - mean);
        sim->work.deviator[i] = (sb_f4){flat ? 0 : m.yy - mean, m.xy, m.xz, m.yz} * sb_splat(factor);
    }
}

/* <D>_i over the particle, its neighbours and images, weighted by their slopes; that of the particle itself is the
   slope of a coincident one. */
SB_MULTIVERSION
static void average_deviator(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    const float most = (float)SB_ROOT_MAX * (float)SB_ROOT_MAX;
    _Alignas(64) sb_f4 around[2 * SB_AROUND_MAX];
    const bool any = sb_around_tensors(sim, group, sim->work.deviator, around);
    for (size_t i = group->first; i < group->end; i++) {
        sim->work.stress[i] = (sb_f4){0};
        sim->work.stress_xx[i] = 0;
        if (!any) continue;
        const sb_four_pairs *four = sim->work.pairs.four + sim->work.pairs.first[i],
                            *end = four + sim->work.pairs.count[i];
        const sb_f4 own = {0, 0, 0, sim->work.deviator_xx[i]};
        sb_f8 even = sb_join(own, sim->work.deviator[i]) * sb_splat8(most), odd = {0};
        sb_f4 weights = {most};
        for (; four < end; four++) {
            const sb_f4 slope = sb_slopes(four);
            sb_prefetch(four);
            even += *sb_both_at(around, four->place[0]) * sb_splat8(slope[0]);
            odd += *sb_both_at(around, four->place[1]) * sb_splat8(slope[1]);
            even += *sb_both_at(around, four->place[2]) * sb_splat8(slope[2]);
            odd += *sb_both_at(around, four->place[3]) * sb_splat8(slope[3]);
            weights += slope;
        }
        const sb_f8 sum = even + odd;
        const float factor = 1 / (sb_sum3(weights) + weights[3]);
        sim->work.stress[i] = __builtin_shufflevector(sum, sum, 4, 5, 6, 7) * sb_splat(factor);
        sim->work.stress_xx[i] = sum[3] * factor;
    }
}

/* The velocity after the correction. The pressure in its last lane does not change. */
SB_INLINE void correct_with(sb_sim *sim, const sb_group *group, const sb_f4 *around, bool any)
{
    const float dt = (float)sim->state.time_step;
    sb_f4 *next = sim->work.corrected;
    for (size_t i = group->first; i < group->end; i++) {
        next[i] = sim->state.velocity[i];
        if (!any) continue;
        const sb_f4 self = sb_in_group(sim, group, i), own = sim->work.stress[i];
        const sb_four_pairs *four = sim->work.pairs.four + sim->work.pairs.first[i],
                            *end = four + sim->work.pairs.count[i];
        sb_f4 sum_x = {0}, sum_y = {0}, sum_z = {0};
        for (; four < end; four += 2) {
            const bool two = four + 1 < end;
            const sb_four_pairs *other = two ? four + 1 : four;
            sb_prefetch(four);
            const sb_eight at = sb_eight_with(around, four, other, 0), s = sb_eight_with(around, four, other, 1);
            const sb_f8 slope = sb_eight_slopes(four, other);
            const sb_f8 x = (sb_spread(self, 0) - at.x) * slope, y = (sb_spread(self, 1) - at.y) * slope;
            const sb_f8 z = (sb_spread(self, 2) - at.z) * slope;
            const sb_f8 xx = sb_spread(self, 3) + at.w, yy = sb_spread(own, 0) + s.x, xy = sb_spread(own, 1) + s.y;
            const sb_f8 xz = sb_spread(own, 2) + s.z, yz = sb_spread(own, 3) + s.w;
            const sb_f8 a_x = xx * x + xy * y + xz * z, a_y = xy * x + yy * y + yz * z;
            const sb_f8 a_z = xz * x + yz * y - (xx + yy) * z;
            sum_x += sb_first4(a_x);
            sum_y += sb_first4(a_y);
            sum_z += sb_first4(a_z);
            if (!two) break;
            sum_x += sb_second4(a_x);
            sum_y += sb_second4(a_y);
            sum_z += sb_second4(a_z);
        }
        const sb_four t = sb_transpose(sum_x, sum_y, sum_z, (sb_f4){0});
        next[i] -= (t.x + t.y + t.z + t.w) * sb_splat(dt * sim->work.pairs.unit);
    }
}

void sb_cpu_deviator(sb_sim *sim)
{
    sb_each_group(sim, find_deviator, NULL);
}

void sb_cpu_mean_deviator(sb_sim *sim)
{
    sb_each_group(sim, average_deviator, NULL);
}

/* Adds the reactions of walls to the correction of a group's particles by images. */
SB_INLINE void push_walls(const sb_sim *sim, const sb_group *group, const sb_f4 *around, sb_body_forces *to)
{
    const sb_lists *lists = &sim->work.pairs;
    const uint32_t records = sb_around_count(sim, group);
    const sb_group_plane *planes = sim->groups.plane + group->plane;
    sb_reactions reactions = {0};
    sb_stretch stretches[SB_AROUND_MAX];
    sb_stretches_find(sim, group, around + 2 * (size_t)records, stretches);
    for (size_t i = group->first; i < group->end; i++) {
        const sb_f4 self = sb_in_group(sim, group, i), own = sim->work.stress[i];
        const sb_vec3 at = sb_space_position(&sim->space, sim->state.position[i]);
        sb_f4 through[SB_NEAR_MAX];
        for (uint32_t p = 0; p < group->planes; p++) through[p] = sb_tensor_times(self, own, planes[p].plane);
        const size_t first = lists->first[i];
        for (size_t f = first + lists->direct[i]; f < first + lists->count[i]; f++) {
            const sb_f4 slope = sb_slopes(&lists->four[f]) * sb_splat(lists->unit);
            for (size_t k = 0; k < 4; k++) {
                if (slope[k] == 0) continue;
                const uint32_t image = lists->four[f].place[k] / SB_PLACE_STEP - records;
                const sb_f4 *other = sb_at_with(around, lists->four[f].place[k]);
                const sb_f4 d = (self - other[0]) * sb_splat(slope[k]);
                const sb_stretch *s = &stretches[image];
                if (s->plane != SB_PLANES_SEVERAL)
                    sb_reaction(&reactions, s->plane, sb_sum3((through[s->plane] + s->through) * d));
                else
                    sb_reactions_reflected(&reactions, planes, sim->groups.image[group->image + image].path,
                                           -sb_tensor_times(self + other[0], own + other[1], d));
            }
        }
        sb_reactions_close(sim, planes, at, &reactions, to);
    }
    sb_body_forces_close(to);
}

/* The correction with its reactions. */
SB_MULTIVERSION
static void correct_reflected(sb_sim *sim, const sb_group *group, sb_body_forces *to)
{
    _Alignas(64) sb_f4 around[2 * SB_AROUND_MAX];
    const bool any = sb_around_tensors(sim, group, sim->work.stress, around);
    correct_with(sim, group, around, any);
    if (any && group->images > 0) push_walls(sim, group, around, to);
}

/* The same for all groups. False: a thread has no memory for its sums. */
static bool correct_all_reflected(sb_sim *sim, sb_body_forces *total)
{
    const size_t groups = sim->groups.count, bodies = sim->model->body_count;
    bool enough = true;
#pragma omp parallel reduction(&& : enough)
    {
        sb_body_forces own;
        enough = sb_body_forces_create(&own, bodies) == 0;
#pragma omp for schedule(dynamic, SB_GROUPS_AT_A_TIME)
        for (size_t g = 0; g < groups; g++)
            if (enough) correct_reflected(sim, &sim->groups.group[g], &own);
        if (enough) sb_sums_merge(total->all, own.all, bodies * SB_FORCE_VALUES);
        sb_body_forces_free(&own);
    }
    return enough;
}

int sb_cpu_correct(sb_sim *sim)
{
    const size_t values = sim->model->body_count * SB_FORCE_VALUES;
    sb_body_forces all;
    int status = sb_body_forces_create(&all, sim->model->body_count);
    if (status == 0 && !correct_all_reflected(sim, &all)) status = -1;
    if (sim->exchange->agree(sim, status == 0 ? SB_OK : SB_FAILED, NULL) != SB_OK) status = -1;
    if (status == 0) sim->exchange->sum(sim, all.all, values);
    for (size_t v = 0; v < values && status == 0; v++) sim->work.stress_force[v] = sb_exact_value(&all.all[v]);
    sb_body_forces_free(&all);
    return status;
}
