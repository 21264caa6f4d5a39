#include "potential_tank.h"

#include "base/memory.h"
#include "check.h"
#include "physics/waves/dispersion.h"

#include <math.h>
#include <string.h>

enum { STEPS = 48, PLACES = 5, ACROSS = 18, SMOOTHING = 40 };

typedef struct state {
    const potential_tank *tank;
    double omega, length, end;  /* of the waves, m; of the tank, m */
    int n, all;                 /* points of the surface; and of the piston */
    double *x, *slope;          /* of the surface's points */
    double *from_x, *from_z;    /* sources */
    double *matrix, *u, *w, *q; /* rows of equations; velocities by unit sources; strengths */
} state;

static double piston(const state *s, double t, double *speed)
{
    const double ramp = 2 * s->tank->period, r = fmin(fmax(t / ramp, 0), 1);
    const double share = r * r * (3 - 2 * r), rate = 6 * r * (1 - r) / ramp;
    const double complex turn = cexp(CMPLX(0, s->omega * t));
    const double x = s->tank->stroke * cimag(turn) + creal(s->tank->second * turn * turn);
    const double v = s->omega * (s->tank->stroke * creal(turn) + creal(CMPLX(0, 2) * s->tank->second * turn * turn));
    *speed = share * v + rate * x;
    return share * x;
}

/* Derivatives over the points' number, of fourth order; 0 at the far wall. */
static void differences(const double *y, int n, double *d)
{
    for (int i = 2; i < n - 2; i++) d[i] = (y[i - 2] - 8 * y[i - 1] + 8 * y[i + 1] - y[i + 2]) / 12;
    d[0] = (-25 * y[0] + 48 * y[1] - 36 * y[2] + 16 * y[3] - 3 * y[4]) / 12;
    d[1] = (-3 * y[0] - 10 * y[1] + 18 * y[2] - 6 * y[3] + y[4]) / 12;
    d[n - 1] = 0;
    d[n - 2] = (3 * y[n - 1] + 10 * y[n - 2] - 18 * y[n - 3] + 6 * y[n - 4] - y[n - 5]) / 12;
}

/* Potential and velocity at (x, z) of a source, its images below the bed and behind the far wall. */
static double source(const state *s, int j, double x, double z, double *u, double *w)
{
    double potential = 0;
    *u = *w = 0;
    for (int k = 0; k < 4; k++) {
        const double dx = x - (k & 1 ? 2 * s->end - s->from_x[j] : s->from_x[j]);
        const double dz = z - (k & 2 ? -s->from_z[j] : s->from_z[j]), square = dx * dx + dz * dz;
        potential += 0.5 * log(square);
        *u += dx / square;
        *w += dz / square;
    }
    return potential;
}

static void solve(double *a, double *b, int n)
{
    for (int i = 0; i < n; i++) {
        int best = i;
        for (int r = i + 1; r < n; r++)
            if (fabs(a[r * n + i]) > fabs(a[best * n + i])) best = r;
        for (int c = i; c < n && best != i; c++) {
            const double swap = a[i * n + c];
            a[i * n + c] = a[best * n + c];
            a[best * n + c] = swap;
        }
        const double swap = b[i];
        b[i] = b[best];
        b[best] = swap;
        for (int r = i + 1; r < n; r++) {
            const double share = a[r * n + i] / a[i * n + i];
            for (int c = i + 1; c < n; c++) a[r * n + c] -= share * a[i * n + c];
            b[r] -= share * b[i];
        }
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int c = i + 1; c < n; c++) b[i] -= a[i * n + c] * b[c];
        b[i] /= a[i * n + i];
    }
}

/* Rates of elevation and potential at the points, which are spread evenly between the piston and the far wall. */
static void rates(state *s, double t, const double *eta, const double *potential, double *eta_rate, double *rate)
{
    const potential_tank *tank = s->tank;
    double speed;
    const double at = piston(s, t, &speed), step = (s->end - at) / (s->n - 1), away = s->end / (s->n - 1);
    differences(eta, s->n, s->slope);
    for (int i = 0; i < s->n; i++) {
        s->x[i] = at + step * i;
        s->slope[i] /= step;
        const double normal = away / sqrt(1 + s->slope[i] * s->slope[i]);
        s->from_x[i] = s->x[i] - s->slope[i] * normal;
        s->from_z[i] = tank->depth + eta[i] + normal;
        s->q[i] = potential[i];
    }
    for (int k = 0; k < ACROSS; k++) {
        s->from_x[s->n + k] = at - tank->depth / ACROSS;
        s->from_z[s->n + k] = (k + 0.5) / ACROSS * (tank->depth + eta[0]);
        s->q[s->n + k] = speed;
    }
    for (int i = 0; i < s->all; i++)
        for (int j = 0; j < s->all; j++) {
            double u, w;
            const bool surface = i < s->n;
            const double value =
                source(s, j, surface ? s->x[i] : at, surface ? tank->depth + eta[i] : s->from_z[i], &u, &w);
            s->matrix[i * s->all + j] = surface ? value : u;
            if (!surface) continue;
            s->u[i * s->all + j] = u;
            s->w[i * s->all + j] = w;
        }
    solve(s->matrix, s->q, s->all);
    for (int i = 0; i < s->n; i++) {
        double u = 0, w = 0;
        for (int j = 0; j < s->all; j++) {
            u += s->u[i * s->all + j] * s->q[j];
            w += s->w[i * s->all + j] * s->q[j];
        }
        const double moves = speed * (1 - (double)i / (s->n - 1)), into = fmax(s->x[i] / s->end - 2.0 / 3, 0) * 3;
        const double beach = into * into * s->omega;
        eta_rate[i] = w - s->slope[i] * (u - moves);
        rate[i] = -tank->gravity * eta[i] - 0.5 * (u * u + w * w) + u * moves + w * eta_rate[i] - beach * potential[i];
        eta_rate[i] -= beach * eta[i];
    }
}

/* Takes what has the length of two points. */
static void smooth(double *y, double *copy, int n)
{
    memcpy(copy, y, (size_t)n * sizeof *y);
    for (int i = 3; i < n - 3; i++)
        y[i] = (copy[i - 3] + copy[i + 3] - 6 * (copy[i - 2] + copy[i + 2]) + 15 * (copy[i - 1] + copy[i + 1]) +
                44 * copy[i]) /
               64;
}

double potential_tank_run(const potential_tank *tank)
{
    const double number = sb_wave_number(tank->period, tank->depth, tank->gravity), dt = tank->period / STEPS;
    state s = {.tank = tank, .omega = 2 * M_PI / tank->period, .length = 2 * M_PI / number};
    s.end = tank->lengths * s.length;
    s.n = tank->lengths * tank->points + 1;
    s.all = s.n + ACROSS;
    const size_t n = (size_t)s.n, all = (size_t)s.all;
    double *memory = sb_alloc(14 * n + 3 * all + 3 * all * all, sizeof *memory);
    assert_non_null(memory);
    double *at = memory, *eta = at, *phi = at + n, *k[8], *eta_then = at + 10 * n, *phi_then = at + 11 * n;
    for (int i = 0; i < 8; i++) k[i] = at + (size_t)(2 + i) * n;
    s.x = at + 12 * n;
    s.slope = at + 13 * n;
    s.from_x = at + 14 * n;
    s.from_z = s.from_x + all;
    s.q = s.from_z + all;
    s.matrix = s.q + all;
    s.u = s.matrix + all * all;
    s.w = s.u + all * all;
    for (size_t i = 0; i < n; i++) eta[i] = phi[i] = 0;
    double complex sum[PLACES] = {0};
    for (int step = 0; step < tank->periods * STEPS; step++) {
        static const double part[] = {0, 0.5, 0.5, 1}, weight[] = {1, 2, 2, 1};
        const double t = step * dt;
        for (int stage = 0; stage < 4; stage++) {
            for (size_t i = 0; i < n; i++) {
                eta_then[i] = eta[i] + (stage ? part[stage] * dt * k[2 * stage - 2][i] : 0);
                phi_then[i] = phi[i] + (stage ? part[stage] * dt * k[2 * stage - 1][i] : 0);
            }
            rates(&s, t + part[stage] * dt, eta_then, phi_then, k[2 * stage], k[2 * stage + 1]);
        }
        for (size_t i = 0; i < n; i++)
            for (int stage = 0; stage < 4; stage++) {
                eta[i] += weight[stage] * dt / 6 * k[2 * stage][i];
                phi[i] += weight[stage] * dt / 6 * k[2 * stage + 1][i];
            }
        if (step % SMOOTHING == SMOOTHING - 1) {
            smooth(eta, eta_then, s.n);
            smooth(phi, eta_then, s.n);
        }
        double speed;
        const double face = piston(&s, t + dt, &speed);
        for (int p = 0; p < PLACES && step >= (tank->periods - 2) * STEPS; p++) {
            const double place = ((1 + 0.25 * p) * s.length - face) / (s.end - face) * (s.n - 1);
            const int i = (int)place;
            const double here = eta[i] + (place - i) * (eta[i + 1] - eta[i]);
            sum[p] += here * cexp(CMPLX(0, -s.omega * (t + dt))) / STEPS;
        }
    }
    sb_free(memory);
    double mean = 0;
    for (int p = 0; p < PLACES; p++) mean += cabs(sum[p]) / PLACES;
    return mean;
}
