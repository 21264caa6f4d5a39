/* Manning's friction, implicit. */
#include "offshore/flux.h"
#include "offshore/state.h"

#include <string.h>

/* x^(-1/3) for 1e-30 < x < 1e30 to 1e-14, without a call: a first guess from the exponent, then Newton's steps on
   y^-3 = x, whose error after each is twice the square of the one before. */
SB_INLINE double inverse_cube_root(double x)
{
    const float single = (float)x;
    int32_t bits;
    memcpy(&bits, &single, sizeof bits);
    bits = 0x54a21d2a - bits / 3;
    float guess;
    memcpy(&guess, &bits, sizeof guess);
    double y = (double)guess;
    for (int k = 0; k < 4; k++) y *= (4 - x * y * y * y) * (1.0 / 3);
    return y;
}

/* d|q|/dt = -g n^2 |q|^2 h^(-7/3), with the value at the end of the step on the right: a quadratic equation, whose
   solution keeps the sign of q and the exact balance with a slope. */
SB_MULTIVERSION static void slow_line(const double *restrict h, double *restrict hu, double *restrict hv,
                                      double strength, double dry, size_t count)
{
#pragma omp simd
    for (size_t i = 0; i < count; i++) {
        const double depth = most(h[i], dry), root = inverse_cube_root(depth);
        const double speed = sqrt(hu[i] * hu[i] + hv[i] * hv[i]);
        const double k = strength * root / (depth * depth);
        const double factor = 2 / (1 + sqrt(1 + 4 * k * speed));
        hu[i] *= factor;
        hv[i] *= factor;
    }
}

void sb_offshore_apply_friction(const sb_offshore *offshore, const sb_offshore_level *level, double dt)
{
    const sb_offshore_options *o = &offshore->options;
    if (!(o->manning > 0)) return;
    const double strength = dt * o->gravity * o->manning * o->manning;
#pragma omp parallel for schedule(static) if (offshore->cells > 20000)
    for (size_t j = 0; j < o->rows; j++) {
        const size_t at = offshore->origin + j * offshore->stride;
        slow_line(level->h + at, level->hu + at, level->hv + at, strength, o->dry_depth, o->columns);
    }
}
