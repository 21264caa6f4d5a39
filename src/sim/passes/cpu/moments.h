/* Sums over the water around a particle from which gradients of its velocity follow that are exact for linear fields.
 */
#ifndef SB_SIM_CPU_MOMENTS_H
#define SB_SIM_CPU_MOMENTS_H

#include "sim/search/around.h"
#include "sim/terms/turbulence.h"

/* Sums over the neighbours j of one particle, w = -m W'/r times the quantum, x_ij in quanta:
   velocity = sum w v_ij (x) x_ij, place = sum w x_ij (x) x_ij; gradient times place = velocity. */
typedef struct sb_moments {
    float velocity[3][3], place[3][3];
} sb_moments;

/* Sums of the lanes of four vectors. */
SB_INLINE sb_f4 sb_sum_lanes(sb_f4 a, sb_f4 b, sb_f4 c, sb_f4 d)
{
    const sb_four t = sb_transpose(a, b, c, d);
    return t.x + t.y + t.z + t.w;
}

/* around: sb_around_with velocities. */
SB_INLINE sb_moments sb_moments_gather(const sb_sim *sim, const sb_group *group, const sb_f4 *around, size_t i)
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
    const sb_f4 p = sb_sum_lanes(xx, xy, xz, yy), q = sb_sum_lanes(yz, zz, ux, uy);
    const sb_f4 r = sb_sum_lanes(uz, vx, vy, vz), s = sb_sum_lanes(wx, wy, wz, (sb_f4){0});
    return (sb_moments){.place = {{p[0], p[1], p[2]}, {p[1], p[3], q[0]}, {p[2], q[0], q[1]}},
                        .velocity = {{q[2], q[3], r[0]}, {r[1], r[2], r[3]}, {s[0], s[1], s[2]}}};
}

/* The inverse of a symmetric matrix times its determinant, which is returned. */
SB_INLINE float sb_adjugate(float m[3][3], float out[3][3])
{
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            const int a1 = (a + 1) % 3, a2 = (a + 2) % 3, b1 = (b + 1) % 3, b2 = (b + 2) % 3;
            out[a][b] = m[a1][b1] * m[a2][b2] - m[a1][b2] * m[a2][b1];
        }
    return m[0][0] * out[0][0] + m[0][1] * out[0][1] + m[0][2] * out[0][2];
}

/* The velocity gradient from the moments, which are scaled: gradient[a][b] is that of component a along b, 1/s. Returns
   false, without a gradient, where the determinant is at most SB_THINNEST. quantum: m. */
SB_INLINE bool sb_moments_gradient(sb_moments *m, bool flat, float quantum, float gradient[3][3])
{
    const float scale = (m->place[0][0] + m->place[1][1] + m->place[2][2]) / (flat ? 2.0f : 3.0f);
    float inverse[3][3];
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) m->place[a][b] = scale > 0 ? m->place[a][b] / scale : 0;
    if (flat) m->place[1][1] = 1;
    const float determinant = sb_adjugate(m->place, inverse);
    if (!(determinant > SB_THINNEST)) return false;
    const float factor = 1 / (determinant * scale * quantum);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            gradient[a][b] = factor * (m->velocity[a][0] * inverse[0][b] + m->velocity[a][1] * inverse[1][b] +
                                       m->velocity[a][2] * inverse[2][b]);
    return true;
}

#endif
