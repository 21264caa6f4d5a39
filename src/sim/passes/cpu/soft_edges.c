#include "sim/passes/cpu/soft_edges.h"

#include <string.h>

/* exp(-x) for 0 <= x < 80; relative error below 3e-7. 2^f on |f| <= 1/2 is the sum of (f ln 2)^n/n! for n <= 6. */
SB_INLINE float exponential(float x)
{
    const float y = -1.44269504f * x, whole = (float)(int)(y - 0.5f), f = y - whole;
    const float p =
        1 + f * (0.693147181f +
                 f * (0.240226507f +
                      f * (0.0555041087f + f * (0.00961812911f + f * (0.00133335581f + f * 0.000154035304f)))));
    const int32_t bits = ((int32_t)whole + 127) << 23;
    float scale;
    memcpy(&scale, &bits, sizeof scale);
    return p * scale;
}

SB_MULTIVERSION
void sb_soft_edges_weigh(sb_soft_edges *restrict of, float transition)
{
    const size_t count = (of->count + 15) / 16 * 16;
    const float least = 1e-6f * transition, twice = 2 / transition, norm = 1 / (1.7724539f * transition);
    for (size_t n = of->count; n < count; n++) {
        of->own_c[n] = of->own_s[n] = of->other_c[n] = of->other_s[n] = 0;
        of->own_rho[n] = of->other_rho[n] = 1;
    }
#pragma omp simd
    for (size_t n = 0; n < count; n++) {
        const float ci = of->own_c[n], si = of->own_s[n], cj = of->other_c[n], sj = of->other_s[n];
        const float t = twice * (ci * cj - si * sj), e = exponential(t * t), size = fabsf(t);
        const float tail = sb_erf_tail(size, e);
        const float to_i = norm * e / (of->own_rho[n] + least), to_j = norm * e / (of->other_rho[n] + least);
        const float across = si * cj - ci * sj, along = ci * cj + si * sj;
        of->value[n] = t < 0 ? 0.5f * tail : 1 - 0.5f * tail;
        of->own_o[n] = to_i * along;
        of->own_h[n] = to_i * across;
        of->other_o[n] = to_j * along;
        of->other_h[n] = -to_j * across;
    }
}
