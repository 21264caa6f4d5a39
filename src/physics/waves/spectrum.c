#include "physics/waves/spectrum.h"

#include "base/random.h"

#include <math.h>

double sb_spectrum_shape(sb_spectrum_kind kind, double gamma, double peak, double frequency)
{
    const double r = frequency / peak, width = r <= 1 ? 0.07 : 0.09;
    const double enhanced = kind == SB_SPECTRUM_JONSWAP ? pow(gamma, exp(-(r - 1) * (r - 1) / (2 * width * width))) : 1;
    return pow(r, -5) * exp(-1.25 * pow(r, -4)) * enhanced;
}

/* Integral over a band by Simpson's rule. */
static double band_energy(sb_spectrum_kind kind, double gamma, double peak, double from, double width)
{
    enum { PARTS = 8 };
    double sum = 0;
    for (int i = 0; i <= PARTS; i++) {
        const double weight = i == 0 || i == PARTS ? 1 : i % 2 ? 4 : 2;
        sum += weight * sb_spectrum_shape(kind, gamma, peak, from + width * i / PARTS);
    }
    return sum * width / (3 * PARTS);
}

void sb_spectrum_waves(sb_spectrum_kind kind, double gamma, double height, double period, uint64_t seed,
                       sb_spectral_wave *waves, size_t count)
{
    const double peak = 1 / period, width = (SB_SPECTRUM_HIGHEST - SB_SPECTRUM_LOWEST) * peak / (double)count;
    double energy = 0;
    for (size_t i = 0; i < count; i++) {
        const double from = SB_SPECTRUM_LOWEST * peak + width * (double)i;
        const double band = band_energy(kind, gamma, peak, from, width);
        energy += band;
        waves[i] = (sb_spectral_wave){.amplitude = band,
                                      .frequency = from + width * sb_random(seed, 2 * i),
                                      .phase = 2 * M_PI * sb_random(seed, 2 * i + 1)};
    }
    for (size_t i = 0; i < count; i++) waves[i].amplitude = height * sqrt(waves[i].amplitude / (8 * energy));
}
