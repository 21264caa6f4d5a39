#include "physics/waves/steady_wave.h"

#include "physics/waves/breaking.h"
#include "physics/waves/dispersion.h"

#include <math.h>
#include <string.h>

enum { FEW = 24, MANY = 48, MOST_UNKNOWNS = 2 * MANY + 5, ROUNDS = 30 };
static const double ENOUGH = 1e-11;

/* The height grows from 0 by at most the longest of these shares, and by shorter ones where Newton's method fails. */
static const double LONGEST = 1.0 / 12, SHORTEST = 1.0 / 400;

/* kd of water whose bed no wave feels; height over depth whose equations are as small as ENOUGH. */
static const double DEEP = 100, LOWEST = 1e-8;

/* Share of the height that the last harmonic may have: a wave with more has others that the points do not show. */
static const double TAIL = 1e-4;

/* In units of depth and gravity. Unknowns: the levels of points + 1 places from crest to trough, as many coefficients
   less one, and the four whose places follow. */
typedef struct problem {
    int points, term, speed, number, discharge, head, count;
    double height, period;
} problem;

static problem problem_of(int points, double height, double period)
{
    return (problem){.points = points,
                     .term = points + 1,
                     .speed = 2 * points + 1,
                     .number = 2 * points + 2,
                     .discharge = 2 * points + 3,
                     .head = 2 * points + 4,
                     .count = 2 * points + 5,
                     .height = height,
                     .period = period};
}

static double half_of_ends(const problem *p, int i)
{
    return i == 0 || i == p->points ? 0.5 : 1;
}

typedef double matrix[MOST_UNKNOWNS][MOST_UNKNOWNS];

/* In the frame of the wave, which the water passes towards -x: psi = -speed z + sum B_j sinh(jkz)/cosh(jk) cos(jkx) is
   -discharge at the surface, where (u^2 + w^2)/2 + z = head. Sets both equations of place i and their derivatives. */
static void at_place(const problem *p, const double *x, int i, double *out, matrix slope)
{
    const double k = x[p->number], z = x[i];
    double *const stream = slope[i], *const energy = slope[p->points + 1 + i];
    double psi = -x[p->speed] * z, u = -x[p->speed], w = 0, psi_k = 0, u_k = 0, w_k = 0, u_z = 0, w_z = 0;
    double u_of[MANY], w_of[MANY];
    for (int j = 1; j <= p->points; j++) {
        /* Exponentials of both signs over cosh(jk): the functions alone overflow in deep water. */
        const double grows = exp(j * k * (z - 1)), falls = exp(-j * k * (z + 1)), all = 1 + exp(-2 * j * k);
        const double b = x[p->term + j - 1], sine = (grows - falls) / all, cosine = (grows + falls) / all;
        const double angle = M_PI * (i * j % (2 * p->points)) / p->points, tanh_jk = 2 / all - 1;
        const double sine_k = j * (z * cosine - tanh_jk * sine), cosine_k = j * (z * sine - tanh_jk * cosine);
        u_of[j - 1] = j * k * cosine * cos(angle);
        w_of[j - 1] = j * k * sine * sin(angle);
        psi += b * sine * cos(angle);
        u += b * u_of[j - 1];
        w += b * w_of[j - 1];
        u_z += b * j * k * j * k * sine * cos(angle);
        w_z += b * j * k * j * k * cosine * sin(angle);
        psi_k += b * sine_k * cos(angle);
        u_k += b * j * cos(angle) * (cosine + k * cosine_k);
        w_k += b * j * sin(angle) * (sine + k * sine_k);
        stream[p->term + j - 1] = sine * cos(angle);
    }
    out[i] = psi + x[p->discharge];
    stream[i] = u;
    stream[p->speed] = -z;
    stream[p->number] = psi_k;
    stream[p->discharge] = 1;
    out[p->points + 1 + i] = 0.5 * (u * u + w * w) + z - x[p->head];
    for (int j = 0; j < p->points; j++) energy[p->term + j] = u * u_of[j] + w * w_of[j];
    energy[i] = u * u_z + w * w_z + 1;
    energy[p->speed] = -u;
    energy[p->number] = u * u_k + w * w_k;
    energy[p->head] = -1;
}

/* All equations and their derivatives. Without transport the crests move at discharge over depth. */
static void equations(const problem *p, const double *x, double *out, matrix slope)
{
    const int mean = 2 * p->points + 2, height = mean + 1, period = mean + 2;
    memset(slope, 0, sizeof(matrix));
    out[mean] = -1;
    for (int i = 0; i <= p->points; i++) {
        at_place(p, x, i, out, slope);
        out[mean] += half_of_ends(p, i) * x[i] / p->points;
        slope[mean][i] = half_of_ends(p, i) / p->points;
    }
    out[height] = x[0] - x[p->points] - p->height;
    slope[height][0] = 1;
    slope[height][p->points] = -1;
    out[period] = x[p->number] * x[p->discharge] * p->period - 2 * M_PI;
    slope[period][p->number] = x[p->discharge] * p->period;
    slope[period][p->discharge] = x[p->number] * p->period;
}

/* Solves a x = b by elimination with row pivots; the solution is in b. */
static bool solve(int count, matrix a, double *b)
{
    for (int i = 0; i < count; i++) {
        int best = i;
        for (int r = i + 1; r < count; r++)
            if (fabs(a[r][i]) > fabs(a[best][i])) best = r;
        if (!(fabs(a[best][i]) > 0)) return false;
        for (int c = 0; c < count; c++) {
            const double swap = a[i][c];
            a[i][c] = a[best][c];
            a[best][c] = swap;
        }
        const double swap = b[i];
        b[i] = b[best];
        b[best] = swap;
        for (int r = i + 1; r < count; r++) {
            const double share = a[r][i] / a[i][i];
            for (int c = i; c < count; c++) a[r][c] -= share * a[i][c];
            b[r] -= share * b[i];
        }
    }
    for (int i = count - 1; i >= 0; i--) {
        for (int c = i + 1; c < count; c++) b[i] -= a[i][c] * b[c];
        b[i] /= a[i][i];
    }
    return true;
}

static double largest(const double *v, int count)
{
    double most = 0;
    for (int i = 0; i < count; i++) most = isfinite(v[i]) ? fmax(most, fabs(v[i])) : HUGE_VAL;
    return most;
}

/* Other solutions of the equations have several crests. */
static bool has_one_crest(const problem *p, const double *x)
{
    bool falls = true;
    for (int i = 1; i <= p->points; i++) falls &= x[i] < x[i - 1];
    return falls;
}

/* Newton's method. */
static bool improve(const problem *p, double *x, double *residual)
{
    double f[MOST_UNKNOWNS];
    matrix slope;
    for (int round = 0; round < ROUNDS; round++) {
        equations(p, x, f, slope);
        *residual = largest(f, p->count);
        if (*residual < ENOUGH) return has_one_crest(p, x);
        if (!(*residual < 1e3) || !solve(p->count, slope, f)) return false;
        for (int c = 0; c < p->count; c++) x[c] -= f[c];
    }
    return false;
}

/* The linear wave of that height. */
static void begin(const problem *p, double *x)
{
    const double k = sb_wave_number(p->period, 1, 1), celerity = 2 * M_PI / (p->period * k);
    for (int c = 0; c < p->count; c++) x[c] = 0;
    for (int i = 0; i <= p->points; i++) x[i] = 1 + 0.5 * p->height * cos(M_PI * i / p->points);
    x[p->term] = 0.5 * p->height / (celerity * tanh(k));
    x[p->speed] = x[p->discharge] = celerity;
    x[p->number] = k;
    x[p->head] = 1 + 0.5 * celerity * celerity;
}

/* Trapezoids are exact for the harmonics that the points distinguish. */
static double harmonic(const problem *p, const double *x, int order)
{
    double sum = 0;
    for (int i = 0; i <= p->points; i++)
        sum += half_of_ends(p, i) * x[i] * cos(M_PI * (i * order % (2 * p->points)) / p->points);
    return (order == p->points ? 1 : 2) * sum / p->points;
}

/* Follows the waves of a period from low ones to the height. */
static bool follow(problem *p, double *x, double *residual)
{
    const double height = p->height;
    double reached = 0, before = 0, step = LONGEST, last[MOST_UNKNOWNS], good[MOST_UNKNOWNS];
    while (reached < 1) {
        const double share = reached + step > 1 - 1e-9 ? 1 : reached + step;
        p->height = share * height;
        if (reached == 0) begin(p, x);
        for (int c = 0; c < p->count && before > 0; c++)
            x[c] = good[c] + (good[c] - last[c]) * (share - reached) / (reached - before);
        if (improve(p, x, residual)) {
            if (reached > 0) memcpy(last, good, sizeof last);
            memcpy(good, x, sizeof good);
            before = reached;
            reached = share;
            step = fmin(1.5 * step, LONGEST);
            continue;
        }
        if (reached > 0) memcpy(x, good, sizeof good);
        step *= 0.5;
        if (step < SHORTEST) return false;
    }
    return fabs(harmonic(p, x, p->points)) < TAIL * height;
}

bool sb_steady_wave_of(double height, double period, double depth, double gravity, sb_steady_wave *wave)
{
    static const int points[] = {FEW, MANY};
    double x[MOST_UNKNOWNS];
    if (!(height > 0 && period > 0 && depth > 0)) return false;
    depth = fmin(depth, DEEP / sb_wave_number(period, depth, gravity));
    if (!(height > LOWEST * depth && height <= SB_SOLITARY_HIGHEST * depth)) return false;
    const double unit = sqrt(depth / gravity);
    for (int i = 0; i < 2; i++) {
        problem p = problem_of(points[i], height / depth, period / unit);
        if (!follow(&p, x, &wave->residual)) continue;
        wave->length = 2 * M_PI / x[p.number] * depth;
        wave->speed = x[p.discharge] * depth / unit;
        wave->current = (x[p.discharge] - x[p.speed]) * depth / unit;
        wave->first = harmonic(&p, x, 1) * depth;
        return true;
    }
    return false;
}
