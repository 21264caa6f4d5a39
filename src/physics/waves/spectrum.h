/* Spectra of wind waves, and the sums of waves that represent them. */
#ifndef SB_PHYSICS_SPECTRUM_H
#define SB_PHYSICS_SPECTRUM_H

#include <stddef.h>
#include <stdint.h>

typedef enum sb_spectrum_kind {
    SB_SPECTRUM_JONSWAP,          /* [Hasselmann et al. 1973] */
    SB_SPECTRUM_PIERSON_MOSKOWITZ /* [Pierson and Moskowitz 1964], JONSWAP with gamma 1 */
} sb_spectrum_kind;

/* Density over the frequency in 1/s, without its factor: f^-5 exp(-5/4 (f/fp)^-4) gamma^exp(-(f/fp - 1)^2/(2 s^2)), s =
   0.07 below the peak fp and 0.09 above. */
double sb_spectrum_shape(sb_spectrum_kind kind, double gamma, double peak, double frequency);

/* One wave of a sum. */
typedef struct sb_spectral_wave {
    double amplitude, frequency, phase; /* m, 1/s, rad */
} sb_spectral_wave;

/* Divides SB_SPECTRUM_LOWEST to SB_SPECTRUM_HIGHEST peak frequencies into `count` equal bands, each of which has one
   wave with the band's energy. The sum has the significant height exactly: 16 times half the sum of the squared
   amplitudes is its square. Frequencies within their bands and phases are random, by the seed. */
void sb_spectrum_waves(sb_spectrum_kind kind, double gamma, double height, double period, uint64_t seed,
                       sb_spectral_wave *waves, size_t count);

#define SB_SPECTRUM_LOWEST 0.5
#define SB_SPECTRUM_HIGHEST 3.0

#endif
