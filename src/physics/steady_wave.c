#include "physics/steady_wave.h"

#include "physics/breaking.h"
#include "physics/dispersion.h"

#include <math.h>
#include <stddef.h>

/* POINTS + 1 places from crest to trough, POINTS terms; unknowns: levels, coefficients, mean speed, wave number,
   discharge and Bernoulli's constant. The height grows in STEPS. */
enum { POINTS = 24, LEVEL = 0, TERM = POINTS + 1, SPEED = TERM + POINTS, NUMBER, DISCHARGE, HEAD, UNKNOWNS };
enum { STEPS = 12, ROUNDS = 30 };
static const double ENOUGH = 1e-11;

/* What is given, in units of depth and gravity. */
typedef struct given {
    double height, period;
} given;

static double half_of_ends(int i)
{
    return i == 0 || i == POINTS ? 0.5 : 1;
}

/* In the frame of the wave, which the water passes towards -x: psi = -speed z + sum B_j sinh(jkz)/cosh(jk) cos(jkx) is
   -discharge at the surface, where (u^2 + w^2)/2 + z = head. */
static void residuals(const double x[UNKNOWNS], given g, double out[UNKNOWNS])
{
    const double k = x[NUMBER];
    double mean = 0;
    for (int i = 0; i <= POINTS; i++) {
        const double z = x[LEVEL + i];
        double psi = -x[SPEED] * z, u = -x[SPEED], w = 0;
        for (int j = 1; j <= POINTS; j++) {
            const double angle = M_PI * i * j / POINTS;
            /* Exponentials of both signs over cosh(jk): the functions alone overflow in deep water. */
            const double grows = exp(j * k * (z - 1)), falls = exp(-j * k * (z + 1));
            const double b = x[TERM + j - 1] / (1 + exp(-2 * j * k));
            psi += b * (grows - falls) * cos(angle);
            u += j * k * b * (grows + falls) * cos(angle);
            w += j * k * b * (grows - falls) * sin(angle);
        }
        out[i] = psi + x[DISCHARGE];
        out[POINTS + 1 + i] = 0.5 * (u * u + w * w) + z - x[HEAD];
        mean += half_of_ends(i) * z / POINTS;
    }
    out[2 * POINTS + 2] = mean - 1;
    out[2 * POINTS + 3] = x[LEVEL] - x[LEVEL + POINTS] - g.height;
    out[2 * POINTS + 4] =
        k * x[DISCHARGE] * g.period - 2 * M_PI; /* without transport the crests move at discharge/depth */
}

/* Solves a x = b by elimination with row pivots; the solution is in b. */
static bool solve(double a[UNKNOWNS][UNKNOWNS], double b[UNKNOWNS])
{
    for (int i = 0; i < UNKNOWNS; i++) {
        int best = i;
        for (int r = i + 1; r < UNKNOWNS; r++)
            if (fabs(a[r][i]) > fabs(a[best][i])) best = r;
        if (!(fabs(a[best][i]) > 0)) return false;
        for (int c = 0; c < UNKNOWNS; c++) {
            const double swap = a[i][c];
            a[i][c] = a[best][c];
            a[best][c] = swap;
        }
        const double swap = b[i];
        b[i] = b[best];
        b[best] = swap;
        for (int r = i + 1; r < UNKNOWNS; r++) {
            const double share = a[r][i] / a[i][i];
            for (int c = i; c < UNKNOWNS; c++) a[r][c] -= share * a[i][c];
            b[r] -= share * b[i];
        }
    }
    for (int i = UNKNOWNS - 1; i >= 0; i--) {
        for (int c = i + 1; c < UNKNOWNS; c++) b[i] -= a[i][c] * b[c];
        b[i] /= a[i][i];
    }
    return true;
}

static double largest(const double v[UNKNOWNS])
{
    double most = 0;
    for (int i = 0; i < UNKNOWNS; i++) most = isfinite(v[i]) ? fmax(most, fabs(v[i])) : HUGE_VAL;
    return most;
}

/* Newton's method with differences for derivatives. */
static bool improve(double x[UNKNOWNS], given g, double *error)
{
    double f[UNKNOWNS], near[UNKNOWNS], a[UNKNOWNS][UNKNOWNS];
    for (int round = 0; round < ROUNDS; round++) {
        residuals(x, g, f);
        *error = largest(f);
        if (*error < ENOUGH) return true;
        for (int c = 0; c < UNKNOWNS; c++) {
            const double before = x[c], step = 1e-7 * (1e-3 + fabs(before));
            x[c] = before + step;
            residuals(x, g, near);
            x[c] = before;
            for (int r = 0; r < UNKNOWNS; r++) a[r][c] = (near[r] - f[r]) / step;
        }
        if (!solve(a, f)) return false;
        for (int c = 0; c < UNKNOWNS; c++) x[c] -= f[c];
    }
    return false;
}

/* The linear wave of that height. */
static void begin(double x[UNKNOWNS], given g)
{
    const double k = sb_wave_number(g.period, 1, 1), speed = 2 * M_PI / (g.period * k);
    for (int c = 0; c < UNKNOWNS; c++) x[c] = 0;
    for (int i = 0; i <= POINTS; i++) x[LEVEL + i] = 1 + 0.5 * g.height * cos(M_PI * i / POINTS);
    x[TERM] = 0.5 * g.height / (speed * tanh(k));
    x[SPEED] = x[DISCHARGE] = speed;
    x[NUMBER] = k;
    x[HEAD] = 1 + 0.5 * speed * speed;
}

/* Trapezoids are exact for the harmonics that the points distinguish. */
static double first_harmonic(const double x[UNKNOWNS])
{
    double sum = 0;
    for (int i = 0; i <= POINTS; i++) sum += half_of_ends(i) * x[LEVEL + i] * cos(M_PI * i / POINTS);
    return 2 * sum / POINTS;
}

/* Other solutions of the equations have several crests. */
static bool has_one_crest(const double x[UNKNOWNS])
{
    bool falls = true;
    for (int i = 1; i <= POINTS; i++) falls &= x[LEVEL + i] < x[LEVEL + i - 1];
    return falls;
}

bool sb_steady_wave_of(double height, double period, double depth, double gravity, sb_steady_wave *wave)
{
    double x[UNKNOWNS], last[UNKNOWNS];
    const double unit = sqrt(depth / gravity);
    if (!(height > 0 && period > 0 && depth > 0 && height <= SB_SOLITARY_HIGHEST * depth)) return false;
    for (int s = 1; s <= STEPS; s++) {
        const given g = {height / depth * s / STEPS, period / unit};
        if (s == 1) begin(x, g);
        for (int c = 0; c < UNKNOWNS; c++) {
            const double before = x[c];
            if (s > 2) x[c] += before - last[c];
            last[c] = before;
        }
        if (!improve(x, g, &wave->residual) || !has_one_crest(x)) return false;
    }
    wave->length = 2 * M_PI / x[NUMBER] * depth;
    wave->speed = x[DISCHARGE] * depth / unit;
    wave->current = (x[DISCHARGE] - x[SPEED]) * depth / unit;
    wave->first = first_harmonic(x) * depth;
    return true;
}
