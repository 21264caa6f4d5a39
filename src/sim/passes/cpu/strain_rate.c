#include "sim/passes/cpu/cpu.h"
#include "sim/passes/cpu/moments.h"
#include "sim/passes/cpu/wall_finder.h"
#include "sim/passes/groups.h"
#include "sim/terms/turbulence.h"
#include "sim/walls/normals.h"

#include <math.h>

/* |S| in 1/s. Gradients are not corrected where water is thin. */
SB_INLINE float strain_rate(const sb_sim *sim, const sb_group *group, const sb_f4 *around, size_t i)
{
    const bool flat = sim->constant.dimension == 2;
    sb_moments m = sb_moments_gather(sim, group, around, i);
    float gradient[3][3];
    if (!sb_moments_gradient(&m, flat, (float)sim->space.quantum, gradient))
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) gradient[a][b] = 1 / sim->work.density[i] * m.velocity[a][b];
    float square = 0;
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            square += 0.5f * (gradient[a][b] + gradient[b][a]) * (gradient[a][b] + gradient[b][a]);
    return sqrtf(square);
}

/* Distance (m) from the wall at the nearest boundary particle. The boundary surface lies `offset` behind the wall. */
SB_INLINE float wall_distance(const sb_sim *sim, sb_wall_finder *finder, size_t i, float offset)
{
    const sb_wall_list walls = sb_wall_list_of(sim, finder, i);
    float nearest = INFINITY, distance = INFINITY;
    for (size_t k = 0; k < walls.count; k++) {
        const sb_wall_set *set = sb_wall_set_of(sim, walls.index[k]);
        const uint32_t b = sb_wall_particle(walls.index[k]);
        const sb_f4 d = sb_offset(sim->state.position[i], set->record[b]), normal = sb_wall_normal(sim, set, b);
        const float square = sb_sum3(d * d);
        if (square >= nearest) continue;
        nearest = square;
        distance = sb_sum3(normal * normal) > 0 ? fabsf(sb_sum3(d * normal)) : sqrtf(square);
    }
    distance = distance * (float)sim->space.quantum - offset;
    return distance > 0 ? distance : 0;
}

typedef struct distances {
    const sb_wall_search *search;
    unsigned *full; /* limits that a finder of walls exceeded */
} distances;

SB_MULTIVERSION
static void do_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    const distances *to = arguments;
    _Alignas(64) sb_f4 around[2 * SB_AROUND_MAX];
    const sb_numerics *n = &sim->scene->numerics;
    const float longest = (float)n->smagorinsky * sim->constant.spacing;
    const float offset = (float)n->wall_offset * sim->constant.spacing;
    sb_wall_finder finder;
    sb_wall_finder_begin(&finder, to->search);
    sb_around_with(sim, group, sim->state.velocity, around);
    for (size_t i = group->first; i < group->end; i++) {
        const float near = SB_KARMAN * wall_distance(sim, &finder, i, offset);
        const float length = near < longest ? near : longest;
        sim->work.eddy[i] = length * length * strain_rate(sim, group, around, i);
    }
    if (finder.full) __atomic_fetch_or(to->full, finder.full, __ATOMIC_RELAXED);
}

sb_status sb_cpu_strain_rate(sb_sim *sim, sb_error *error)
{
    unsigned full = 0;
    const sb_wall_search search = sb_wall_search_of(sim);
    sb_each_group(sim, do_group, &(distances){&search, &full});
    return sb_wall_finder_refuse(sim, full, error);
}
