/* Incident and reflected waves from gauges in a line. */
#include "physics/reflection.h"

#include <complex.h>
#include <math.h>

/* The sums are the upper triangle of the normal matrix, row by row in full rows, then its right-hand side. */
static size_t terms_of(int harmonics)
{
    return 2 * (size_t)harmonics + 1;
}

size_t sb_harmonics_size(int harmonics)
{
    const size_t n = terms_of(harmonics);
    return n * n + n;
}

/* The functions of the fit at a phase: 1, cos, sin, cos 2, sin 2, ... */
static double function_of(size_t i, double phase)
{
    const double angle = (double)((i + 1) / 2) * phase;
    return i == 0 ? 1 : i % 2 ? cos(angle) : sin(angle);
}

void sb_harmonics_add(double *sums, int harmonics, double omega, double t, double value)
{
    const size_t n = terms_of(harmonics);
    const double phase = fmod(omega * t, 2 * M_PI);
    for (size_t i = 0; i < n; i++) {
        const double f = function_of(i, phase);
        for (size_t j = i; j < n; j++) sums[i * n + j] += f * function_of(j, phase);
        sums[n * n + i] += f * value;
    }
}

/* Cholesky's factor U of the matrix, in place. A pivot is the part of a function that the earlier ones do not explain.
 */
static bool factorise(double *a, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        const double whole = a[i * n + i];
        double pivot = whole;
        for (size_t k = 0; k < i; k++) pivot -= a[k * n + i] * a[k * n + i];
        if (!(pivot > 1e-6 * whole)) return false;
        a[i * n + i] = sqrt(pivot);
        for (size_t j = i + 1; j < n; j++) {
            double sum = a[i * n + j];
            for (size_t k = 0; k < i; k++) sum -= a[k * n + i] * a[k * n + j];
            a[i * n + j] = sum / a[i * n + i];
        }
    }
    return true;
}

bool sb_harmonics_solve(const double *sums, int harmonics, double *scratch, double *cosines, double *sines)
{
    const size_t n = terms_of(harmonics);
    if (!(sums[0] >= (double)n)) return false; /* the number of samples */
    for (size_t i = 0; i < n * n + n; i++) scratch[i] = sums[i];
    double *a = scratch, *x = scratch + n * n;
    if (!factorise(a, n)) return false;
    for (size_t i = 0; i < n; i++) {
        for (size_t k = 0; k < i; k++) x[i] -= a[k * n + i] * x[k];
        x[i] /= a[i * n + i];
    }
    for (size_t i = n; i-- > 0;) {
        for (size_t k = i + 1; k < n; k++) x[i] -= a[i * n + k] * x[k];
        x[i] /= a[i * n + i];
    }
    for (int h = 0; h < harmonics; h++) {
        cosines[h] = x[2 * h + 1];
        sines[h] = x[2 * h + 2];
    }
    return true;
}

static double complex turned(double angle)
{
    return CMPLX(cos(angle), sin(angle));
}

double sb_split_separation(const double *x, size_t count, double number)
{
    double complex sum = 0;
    for (size_t i = 0; i < count; i++) sum += turned(2 * number * (x[i] - x[0]));
    return fmax(1 - cabs(sum) / (double)count, 0);
}

/* With z = A - iB the surface is Re(z exp(iwt)), and z = a exp(-ikx) + b exp(ikx). The normal equations are
   n a + s b = p and conj(s) a + n b = q, with s the sum of exp(2ikx), p of z exp(ikx), q of z exp(-ikx). */
sb_split sb_split_of(const double *x, const double *cosines, const double *sines, size_t count, double number)
{
    const double n = (double)count;
    double complex s = 0, p = 0, q = 0;
    sb_split split = {(double)NAN, (double)NAN, (double)NAN, sb_split_separation(x, count, number)};
    for (size_t i = 0; i < count; i++) {
        const double complex e = turned(number * (x[i] - x[0])), z = CMPLX(cosines[i], -sines[i]);
        s += e * e;
        p += z * e;
        q += z * conj(e);
    }
    const double determinant = n * n - creal(s * conj(s));
    if (!(determinant > 1e-8 * n * n)) return split;
    const double complex a = (n * p - s * q) / determinant, b = (n * q - conj(s) * p) / determinant;
    double square = 0;
    for (size_t i = 0; i < count; i++) {
        const double complex e = turned(number * (x[i] - x[0]));
        const double rest = cabs(CMPLX(cosines[i], -sines[i]) - a * conj(e) - b * e);
        square += rest * rest;
    }
    split.incident = cabs(a);
    split.reflected = cabs(b);
    split.misfit = sqrt(square / n);
    return split;
}
