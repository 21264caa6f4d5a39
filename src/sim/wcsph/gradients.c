/* Corrected gradients [W, CSPM]: grad W_ij is replaced by L_i grad W_ij, L_i the inverse of
   -sum_j V_j x_ij (x) grad W_ij over water and boundary particles, with V = m/rho_i. L_i is the same for all pairs of a
   particle, so that it multiplies the sums: the acceleration, and the velocity gradient, whose trace is the divergence.
 */
#include "sim/passes/cpu/moments.h"
#include "sim/passes/groups.h"
#include "sim/terms/turbulence.h"
#include "sim/walls/entry.h"
#include "sim/wcsph/wcsph.h"

/* Least mean of the diagonal of L_i^-1 for which gradients are corrected: 1 in the bulk, 0.91 (3D: 0.94) in the second
   layer below a flat surface, 0.62 (0.67) in the first, whose correction doubles the forces along the normal. Still
   water diverged with that. */
static const float LEAST = 0.7f;

/* Adds the boundary particles around particle i. */
SB_INLINE void add_walls(const sb_sim *sim, size_t i, sb_moments *m)
{
    const size_t begin = sim->work.wall_pairs.first[i], end = begin + sim->work.wall_pairs.count[i];
    for (size_t k = begin; k < end; k++) {
        const uint32_t wall = sim->work.wall_pairs.index[k];
        const sb_f4 x = sb_offset(sim->state.position[i], sb_wall_set_of(sim, wall)->record[sb_wall_particle(wall)]);
        const sb_f4 v = sim->state.velocity[i] - sb_wall_velocity(sim, wall);
        const float weight = -sim->work.wall_pairs.slope[k];
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) {
                m->velocity[a][b] += weight * v[a] * x[b];
                m->place[a][b] += weight * x[a] * x[b];
            }
    }
}

/* Corrects the acceleration of particle i, and returns the rate of its density. */
SB_INLINE float correct_one(sb_sim *sim, const sb_group *group, const sb_f4 *around, size_t i)
{
    const bool flat = sim->constant.dimension == 2;
    const float quantum = (float)sim->space.quantum, density = sim->work.density[i];
    sb_moments m = sb_moments_gather(sim, group, around, i);
    float inverse[3][3];
    add_walls(sim, i, &m);
    const float scale = (m.place[0][0] + m.place[1][1] + m.place[2][2]) / (flat ? 2.0f : 3.0f);
    const float trace = m.velocity[0][0] + m.velocity[1][1] + m.velocity[2][2];
    if (!(scale > 0)) return 0;
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) m.place[a][b] /= scale;
    if (flat) m.place[1][1] = 1;
    const float determinant = sb_adjugate(m.place, inverse);
    if (!(determinant > SB_THINNEST && scale * quantum > LEAST * density)) return -trace;
    const float factor = density / (quantum * determinant * scale); /* of `inverse`: it is L_i then */
    const sb_f4 old = sim->work.acceleration[i];
    sb_f4 corrected = {0};
    float divergence = 0;
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            corrected[a] += factor * inverse[a][b] * old[b];
            divergence += m.velocity[a][b] * inverse[b][a];
        }
    sim->work.acceleration[i] = corrected;
    return -factor * divergence;
}

SB_MULTIVERSION
static void do_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    _Alignas(64) sb_f4 around[2 * SB_AROUND_MAX];
    sb_around_with(sim, group, sim->state.velocity, around);
    for (size_t i = group->first; i < group->end; i++) sim->work.rate[i] = correct_one(sim, group, around, i);
}

void sb_wcsph_correct_gradients(sb_sim *sim)
{
    sb_each_group(sim, do_group, NULL);
}
