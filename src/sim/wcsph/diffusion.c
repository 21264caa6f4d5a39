#include "sim/passes/groups.h"
#include "sim/wcsph/wcsph.h"

/* Factors of one step. */
typedef struct diffusion {
    float scale;       /* 2 delta (h/2) c_0/rho_0 over the quantum: of -slope times the excess */
    float hydrostatic; /* rho_0 g/c_0^2 per quantum: excess of water at rest by depth */
} diffusion;

/* rate += delta (h/2) c_0 sum_j V_j 2 [rho_j - rho_i - rho_0 g (z_i - z_j)/c_0^2] x_ji . grad W_ij/r^2. With the slope
   s of the lists, m grad W = s x and m x_ji . grad W_ij/r^2 = -s/quantum. */
SB_MULTIVERSION
static void do_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    const diffusion *d = arguments;
    _Alignas(64) sb_f4 around[SB_AROUND_MAX];
    sb_around(sim, group, around);
    for (size_t i = group->first; i < group->end; i++) {
        const sb_four_pairs *four = sim->work.pairs.four + sim->work.pairs.first[i],
                            *end = four + sb_direct(&sim->work.pairs, i);
        const sb_f4 self = sb_in_group(sim, group, i);
        sb_f4 sum = {0};
        for (; four < end; four++) {
            const sb_four at = sb_transpose(*sb_at(around, four->place[0]), *sb_at(around, four->place[1]),
                                            *sb_at(around, four->place[2]), *sb_at(around, four->place[3]));
            const sb_f4 below = sb_splat(self[2]) - at.z, more = at.w - sb_splat(self[3]);
            sum += sb_slopes(four) * (more - below * sb_splat(d->hydrostatic));
        }
        sim->work.rate[i] -= d->scale * sim->work.pairs.unit * ((sum[0] + sum[1]) + (sum[2] + sum[3]));
    }
}

void sb_wcsph_diffuse(sb_sim *sim)
{
    const double c = (double)sim->constant.sound_speed, rest = (double)sim->constant.rest_density;
    const double h = (double)sim->constant.support, quantum = sim->space.quantum;
    const diffusion d = {(float)(sim->scene->numerics.density_diffusion * h * c / (rest * quantum)),
                         (float)(rest * (double)sim->constant.gravity * quantum / (c * c))};
    sb_each_group(sim, do_group, &d);
}
