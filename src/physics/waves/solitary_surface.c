/* Solitary waves by Babenko's equation, which Petviashvili's iteration solves, in the manner of [Clamond and Dutykh
   2013, Fast accurate computation of the fully nonlinear solitary surface gravity waves]. docs/method.md, (M46). */
#include "physics/waves/solitary_surface.h"
#include "base/memory.h"

#include <float.h>
#include <math.h>

enum { N = SB_SURFACE_MODES, ROUNDS = 1000 };

/* The wave falls as exp(-decay x): at the end of the half that is computed, by this power. */
static const double TAIL = 26;

/* Part of the error in height by which c^2 changes per round, because c^2 is nearly 1 + H; change per round at which
   the wave is found, over its height. */
static const double FOLLOW = 0.5, ENOUGH = 1e-11;

/* Values of even functions at 0 <= j <= N on one half, or their coefficients of cos(pi m j/N). */
typedef double row[N + 1];

typedef struct fields {
    double cosine[N + 1][N + 1];
    row factor, eta, conjugate, product, square, mode, first, second;
} fields;

static double end_weight(size_t j)
{
    return j == 0 || j == N ? 0.5 : 1;
}

/* From coefficients to values; from values to coefficients with the factor 2/N. */
static void transform(const fields *f, const row from, double scale, row to)
{
    for (size_t m = 0; m <= N; m++) to[m] = 0;
    for (size_t j = 0; j <= N; j++) {
        const double value = scale * end_weight(j) * from[j];
        for (size_t m = 0; m <= N; m++) to[m] += value * f->cosine[j][m];
    }
}

/* First guess: the wave of third order. */
static void start(fields *f, double height, double length)
{
    const double alpha = sqrt(0.75 * height) * (1 - 5 / 8.0 * height + 71 / 128.0 * height * height);
    for (size_t j = 0; j <= N; j++) {
        const double sech = 1 / cosh(alpha * length * (double)j / N), k = M_PI * (double)j / length;
        f->eta[j] = height * sech * sech;
        f->factor[j] = j > 0 ? k / tanh(k) : 1;
        for (size_t m = 0; m <= N; m++) f->cosine[j][m] = cos(M_PI * (double)(j * m % (2 * N)) / N);
    }
}

/* C eta, with C the operator of the factors k coth k: x' - 1 on the surface. */
static void find_conjugate(fields *f)
{
    transform(f, f->eta, 2.0 / N, f->mode);
    for (size_t m = 0; m <= N; m++) f->first[m] = f->factor[m] * f->mode[m];
    transform(f, f->first, 1, f->conjugate);
}

/* A round for c^2 C eta - eta = C eta^2/2 + eta C eta. Returns the largest change. */
static double iterate(fields *f, double square)
{
    find_conjugate(f);
    for (size_t j = 0; j <= N; j++) {
        f->square[j] = 0.5 * f->eta[j] * f->eta[j];
        f->product[j] = f->eta[j] * f->conjugate[j];
    }
    transform(f, f->square, 2.0 / N, f->first);
    transform(f, f->product, 2.0 / N, f->second);
    double linear = 0, other = 0, most = 0;
    for (size_t m = 0; m <= N; m++) {
        const double left = square * f->factor[m] - 1, right = f->factor[m] * f->first[m] + f->second[m];
        linear += end_weight(m) * f->mode[m] * left * f->mode[m];
        other += end_weight(m) * f->mode[m] * right;
        f->second[m] = right / left;
    }
    const double scale = linear / other * (linear / other);
    transform(f, f->second, scale, f->product);
    for (size_t j = 0; j <= N; j++) {
        most = fmax(most, fabs(f->product[j] - f->eta[j]));
        f->eta[j] = f->product[j];
    }
    return most;
}

static void keep(fields *f, double length, double square, sb_solitary_surface *surface)
{
    find_conjugate(f);
    *surface = (sb_solitary_surface){.celerity = sqrt(square), .length = length, .stretch = 1 + 0.5 * f->mode[0]};
    for (size_t j = 0; j <= N; j++)
        surface->volume += 2 * length / N * end_weight(j) * f->eta[j] * (1 + f->conjugate[j]);
    for (size_t m = 1; m < N; m++) {
        if (fabs(f->mode[m]) > DBL_EPSILON * fabs(f->mode[1])) surface->modes = m;
        surface->b[m - 1] = f->mode[m] / sinh(M_PI * (double)m / length);
    }
}

int sb_solitary_surface_find(double height, sb_solitary_surface *surface)
{
    fields *f = sb_alloc(1, sizeof *f);
    if (!f) return -1;
    const double length = TAIL / (sqrt(3 * height) * (1 - 0.3 * height));
    double square = 1 + height * (1 - height / 20 - 3 * height * height / 70), most = HUGE_VAL;
    start(f, height, length);
    for (int round = 0; round < ROUNDS && !(most < ENOUGH * height); round++) {
        most = iterate(f, square);
        const double lacks = height - f->eta[0];
        square += FOLLOW * lacks;
        most = fmax(most, fabs(lacks));
    }
    keep(f, length, square, surface);
    sb_free(f);
    return most < ENOUGH * height ? 0 : 1;
}

void sb_solitary_surface_map(const sb_solitary_surface *surface, double complex at, double complex z[4])
{
    const double wave = M_PI / surface->length;
    const double complex turn = cexp(CMPLX(0, wave) * at), back = 1 / turn;
    double complex ahead = 1, behind = 1;
    z[0] = surface->stretch * at;
    z[1] = surface->stretch;
    z[2] = z[3] = 0;
    for (size_t m = 1; m <= surface->modes; m++) {
        const double k = wave * (double)m, b = surface->b[m - 1];
        ahead *= turn;
        behind *= back;
        const double complex sine = CMPLX(0, -0.5 * b) * (ahead - behind), cosine = 0.5 * b * (ahead + behind);
        z[0] += sine;
        z[1] += k * cosine;
        z[2] -= k * k * sine;
        z[3] -= k * k * k * cosine;
    }
}
