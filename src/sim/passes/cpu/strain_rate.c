#include "sim/passes/cpu/cpu.h"
#include "sim/passes/groups.h"
#include "sim/terms/turbulence.h"
#include "sim/walls/entry.h"

#include <math.h>

/* Sums over the neighbours j of one particle, w = -m W'/r times the quantum, x_ij in quanta:
   velocity = sum w v_ij (x) x_ij, place = sum w x_ij (x) x_ij; gradient times place = velocity. */
typedef struct moments {
    float velocity[3][3], place[3][3];
} moments;

/* Sums of the lanes of four vectors. */
SB_INLINE sb_f4 sum_lanes(sb_f4 a, sb_f4 b, sb_f4 c, sb_f4 d)
{
    const sb_four t = sb_transpose(a, b, c, d);
    return t.x + t.y + t.z + t.w;
}

/* around: sb_around_with velocities. */
SB_INLINE moments gather(const sb_sim *sim, const sb_group *group, const sb_f4 *around, size_t i)
{
    const sb_f4 self = sb_in_group(sim, group, i), v = sim->state.velocity[i], unit = sb_splat(-sim->work.pairs.unit);
    const sb_four_pairs *four = sim->work.pairs.four + sim->work.pairs.first[i],
                        *end = four + sb_direct(&sim->work.pairs, i);
    sb_f4 xx = {0}, xy = {0}, xz = {0}, yy = {0}, yz = {0}, zz = {0};
    sb_f4 ux = {0}, uy = {0}, uz = {0}, vx = {0}, vy = {0}, vz = {0}, wx = {0}, wy = {0}, wz = {0};
    for (; four < end; four++) {
        const sb_f4 *a = sb_at_with(around, four->place[0]), *b = sb_at_with(around, four->place[1]);
        const sb_f4 *c = sb_at_with(around, four->place[2]), *e = sb_at_with(around, four->place[3]);
        const sb_four d = sb_transpose(self - a[0], self - b[0], self - c[0], self - e[0]);
        const sb_four u = sb_transpose(v - a[1], v - b[1], v - c[1], v - e[1]);
        const sb_f4 weight = sb_slopes(four) * unit;
        const sb_f4 x = d.x * weight, y = d.y * weight, z = d.z * weight;
        xx += x * d.x, xy += x * d.y, xz += x * d.z, yy += y * d.y, yz += y * d.z, zz += z * d.z;
        ux += x * u.x, uy += y * u.x, uz += z * u.x;
        vx += x * u.y, vy += y * u.y, vz += z * u.y;
        wx += x * u.z, wy += y * u.z, wz += z * u.z;
    }
    const sb_f4 p = sum_lanes(xx, xy, xz, yy), q = sum_lanes(yz, zz, ux, uy);
    const sb_f4 r = sum_lanes(uz, vx, vy, vz), s = sum_lanes(wx, wy, wz, (sb_f4){0});
    return (moments){.place = {{p[0], p[1], p[2]}, {p[1], p[3], q[0]}, {p[2], q[0], q[1]}},
                     .velocity = {{q[2], q[3], r[0]}, {r[1], r[2], r[3]}, {s[0], s[1], s[2]}}};
}

/* The inverse of a symmetric matrix times its determinant, which is returned. */
SB_INLINE float adjugate(float m[3][3], float out[3][3])
{
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            const int a1 = (a + 1) % 3, a2 = (a + 2) % 3, b1 = (b + 1) % 3, b2 = (b + 2) % 3;
            out[a][b] = m[a1][b1] * m[a2][b2] - m[a1][b2] * m[a2][b1];
        }
    return m[0][0] * out[0][0] + m[0][1] * out[0][1] + m[0][2] * out[0][2];
}

/* |S| in 1/s. Gradients are not corrected where the determinant is below SB_THINNEST. */
SB_INLINE float strain_rate(const sb_sim *sim, const sb_group *group, const sb_f4 *around, size_t i)
{
    const bool flat = sim->constant.dimension == 2;
    moments m = gather(sim, group, around, i);
    const float scale = (m.place[0][0] + m.place[1][1] + m.place[2][2]) / (flat ? 2.0f : 3.0f);
    float inverse[3][3], gradient[3][3];
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) m.place[a][b] = scale > 0 ? m.place[a][b] / scale : 0;
    if (flat) m.place[1][1] = 1;
    const float determinant = adjugate(m.place, inverse);
    const bool corrected = determinant > SB_THINNEST;
    const float factor = corrected ? 1 / (determinant * scale * (float)sim->space.quantum) : 1 / sim->work.density[i];
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            gradient[a][b] = factor * (corrected ? m.velocity[a][0] * inverse[0][b] + m.velocity[a][1] * inverse[1][b] +
                                                       m.velocity[a][2] * inverse[2][b]
                                                 : m.velocity[a][b]);
    float square = 0;
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            square += 0.5f * (gradient[a][b] + gradient[b][a]) * (gradient[a][b] + gradient[b][a]);
    return sqrtf(square);
}

/* Distance (m) from the wall at the nearest boundary particle. The boundary surface lies `offset` behind the wall. */
SB_INLINE float wall_distance(const sb_sim *sim, size_t i, float offset)
{
    const uint32_t *index = sim->work.wall_pairs.index + sim->work.wall_pairs.first[i];
    float nearest = INFINITY, distance = INFINITY;
    for (size_t k = 0; k < sim->work.wall_pairs.count[i]; k++) {
        const sb_wall_set *set = sb_wall_set_of(sim, index[k]);
        const uint32_t b = sb_wall_particle(index[k]);
        const sb_f4 d = sb_offset(sim->state.position[i], set->record[b]), normal = set->normal[b];
        const float square = sb_sum3(d * d);
        if (square >= nearest) continue;
        nearest = square;
        distance = sb_sum3(normal * normal) > 0 ? fabsf(sb_sum3(d * normal)) : sqrtf(square);
    }
    distance = distance * (float)sim->space.quantum - offset;
    return distance > 0 ? distance : 0;
}

SB_MULTIVERSION
static void do_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    _Alignas(64) sb_f4 around[2 * SB_AROUND_MAX];
    const sb_numerics *n = &sim->scene->numerics;
    const float longest = (float)n->smagorinsky * sim->constant.spacing;
    const float offset = (float)n->wall_offset * sim->constant.spacing;
    sb_around_with(sim, group, sim->state.velocity, around);
    for (size_t i = group->first; i < group->end; i++) {
        const float near = SB_KARMAN * wall_distance(sim, i, offset);
        const float length = near < longest ? near : longest;
        sim->work.eddy[i] = length * length * strain_rate(sim, group, around, i);
    }
}

void sb_cpu_strain_rate(sb_sim *sim)
{
    sb_each_group(sim, do_group, NULL);
}
