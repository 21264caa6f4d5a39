/* Splits the waves along a line into those that travel along it and those that come back. */
#ifndef SB_PHYSICS_REFLECTION_H
#define SB_PHYSICS_REFLECTION_H

#include <stdbool.h>
#include <stddef.h>

/* Periods of samples without which harmonics cannot be distinguished; the last sample of a period may be missing. */
static const double SB_LEAST_PERIODS = 0.9;

/* Number of harmonics of a period, s, that have more than two samples at this interval, s, in theirs. */
int sb_harmonics_most(double period, double interval);

/* Least-squares fit of mean + sum over n = 1..harmonics of A_n cos(n w t) + B_n sin(n w t) to samples that are added
   one by one. `sums` has sb_harmonics_size(harmonics) doubles, which are zero at first. The samples may have gaps, and
   need not cover whole periods. */
size_t sb_harmonics_size(int harmonics);
void sb_harmonics_add(double *sums, int harmonics, double omega, double t, double value);
/* Sets cosines[n - 1] = A_n and sines[n - 1] = B_n. False if the samples do not determine them: too few, or too short a
   time. scratch: as many doubles as sums. */
bool sb_harmonics_solve(const double *sums, int harmonics, double *scratch, double *cosines, double *sines);

/* A split at one frequency. */
typedef struct sb_split {
    double incident, reflected; /* m, amplitudes; NaN where the gauges do not determine them */
    double misfit;              /* m, root mean square over the gauges of the amplitude that both do not explain */
    double separation;          /* see sb_split_separation */
    double bound_incident, bound_reflected; /* m, amplitudes; NaN from sb_split_of */
} sb_split;

/* Fits A cos wt + B sin wt at each place x (m) by an incident wave cos(k x - w t) and a reflected one cos(k x + w t) of
   wave number k, 1/m, by least squares over two or more places [Mansard and Funke 1980]. */
sb_split sb_split_of(const double *x, const double *cosines, const double *sines, size_t count, double number);

/* 1 - |sum of exp(2 i k x)|/count: 0 where all places lie at half wavelengths and the two waves cannot be told apart, 1
   where they can be separated best. Independent errors e of the gauges
   give errors e/sqrt(count s(2 - s)) of the amplitudes, with s the separation. */
double sb_split_separation(const double *x, size_t count, double number);

/* Fits free waves of wave number `free` and bound ones of wave number `bound`, 1/m, incident and reflected, at once
   over four or more places: a harmonic of regular waves travels at its own speed, and also with the first harmonic. */
sb_split sb_split_bound_of(const double *x, const double *cosines, const double *sines, size_t count, double free,
                           double bound);

/* The smallest eigenvalue of the normal matrix of these four waves over count, from 0 to 1; of two waves it is
   sb_split_separation. Independent errors e of the gauges give errors of at most e/sqrt(count s) of the amplitudes. */
double sb_split_bound_separation(const double *x, size_t count, double free, double bound);

/* Separation below which a split is not trusted; two gauges 1/20 or 9/20 of a wavelength apart have it [Goda and Suzuki
   1976]. */
#define SB_SEPARATION_TRUSTED 0.05

#endif
