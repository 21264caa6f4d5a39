#include "physics/absorption/sponge.h"

#include "physics/waves/dispersion.h"

#include <complex.h>
#include <math.h>

double sb_sponge_share(sb_sponge_profile profile, double along)
{
    const double s = fmin(fmax(along, 0), 1);
    return profile == SB_SPONGE_LINEAR ? s : profile == SB_SPONGE_QUADRATIC ? s * s : s * s * s;
}

/* The root of k tanh kd = target next to `near`, by Newton's method. */
static double complex number_near(double complex near, double complex target, double depth)
{
    double complex k = near;
    for (int i = 0; i < 50; i++) {
        const double complex t = ctanh(k * depth), slope = t + k * depth * (1 - t * t);
        const double complex step = (k * t - target) / slope;
        k -= step;
        if (cabs(step) < 1e-13 * cabs(k)) break;
    }
    return k;
}

/* (k sin kx + f cos kx)/(k cos kx - f sin kx)/k of a slice of width x, with f the flux behind it. Both sums are divided
   by the growing exponential, which overflows where a strong sponge lets no wave through. The result is the same for
   -k. */
static double complex through(double complex k, double width, double complex f)
{
    if (cimag(k) < 0) k = -k;
    const double complex fading = cexp(CMPLX(0, 2 * width) * k), one = 1 + fading, other = CMPLX(0, 1) * (1 - fading);
    return (k * other + f * one) / (k * one - f * other) / k;
}

/* The flux is as eta_x tanh(kd)/(k (1 + i strength/omega)), which is as eta_x/k^2. From the wall, where it is 0, to the
   front. Time is as exp(-i omega t). */
double sb_sponge_reflection(sb_sponge_profile profile, double strength, double omega, double depth, double gravity,
                            double length)
{
    enum { SLICES = 1000 };
    const double width = length / SLICES, front = sb_wave_number(2 * M_PI / omega, depth, gravity);
    double complex wave[SLICES], k = front, flux = 0;
    for (int s = 0; s < SLICES; s++) {
        const double share = sb_sponge_share(profile, (s + 0.5) / SLICES);
        k = number_near(k, omega * omega / gravity * CMPLX(1, strength * share / omega), depth);
        wave[s] = k;
    }
    for (int s = SLICES - 1; s >= 0; s--) flux = through(wave[s], width, flux * wave[s] * wave[s]);
    const double complex ahead = CMPLX(0, 1 / front);
    return cabs((ahead - flux) / (ahead + flux));
}

double sb_sponge_best(sb_sponge_profile profile, double omega, double depth, double gravity, double length)
{
    double best = omega, least = 2;
    for (double strength = 0.05 * omega; strength < 20 * omega; strength *= 1.1) {
        const double r = sb_sponge_reflection(profile, strength, omega, depth, gravity, length);
        if (r < least) best = strength;
        least = fmin(r, least);
    }
    for (double factor = 1.05; factor > 1.005; factor = sqrt(factor)) {
        const double tried[] = {best * factor, best / factor};
        for (int i = 0; i < 2; i++) {
            const double r = sb_sponge_reflection(profile, tried[i], omega, depth, gravity, length);
            if (r < least) best = tried[i];
            least = fmin(r, least);
        }
    }
    return best;
}

double sb_sponge_viscosity(double alpha, double support, double sound_speed, int dimensions)
{
    return alpha * support * sound_speed / (4.0 * (dimensions + 2));
}

double sb_sponge_viscous_reflection(sb_sponge_profile profile, double viscosity, double omega, double depth,
                                    double gravity, double length)
{
    static const double means[] = {
        [SB_SPONGE_LINEAR] = 1.0 / 2, [SB_SPONGE_QUADRATIC] = 1.0 / 3, [SB_SPONGE_CUBIC] = 1.0 / 4};
    const double k = sb_wave_number(2 * M_PI / omega, depth, gravity);
    return exp(-2 * viscosity * means[profile] * k * k * 2 * length / sb_group_speed(omega, k, depth));
}
