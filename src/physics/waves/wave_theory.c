/* Solitary, standing and damped waves by wave theory. */
#include "physics/waves/wave_theory.h"

#include <math.h>
#include <stdbool.h>

/* Dimensionless terms of a solitary wave; lengths are in depths, speeds in sqrt(gh): e = H/h, s = sech^2(alpha xi), t =
   tanh(alpha xi), s + t^2 = 1. */
typedef struct phase {
    double e, alpha, s, t;
} phase;

static phase phase_at(const sb_solitary *wave, double xi)
{
    const double e = wave->height / wave->depth;
    const double first = sqrt(0.75 * e / (wave->theory == SB_SOLITARY_SERRE ? 1 + e : 1));
    const bool third = wave->theory == SB_SOLITARY_THIRD_ORDER;
    const double alpha = third ? first * (1 + e * (-5 / 8.0 + e * 71 / 128.0)) : first;
    const double sech = 1 / cosh(alpha * xi / wave->depth); /* underflows to the limit 0 far from the crest */
    return (phase){e, alpha, sech * sech, tanh(alpha * xi / wave->depth)};
}

double sb_solitary_celerity(const sb_solitary *wave)
{
    const double e = wave->height / wave->depth;
    const double beyond = wave->theory == SB_SOLITARY_THIRD_ORDER ? e * e * (-1 / 20.0 - e * 3 / 70.0) : 0;
    return sqrt(wave->gravity * wave->depth * (1 + e + beyond));
}

double sb_solitary_elevation(const sb_solitary *wave, double xi)
{
    const phase p = phase_at(wave, xi);
    const double e = p.e, s = p.s, t2 = p.t * p.t;
    const double beyond =
        wave->theory == SB_SOLITARY_THIRD_ORDER ? e * t2 * (-3 / 4.0 + e * (5 / 8.0 - s * 101 / 80.0)) : 0;
    return wave->height * s * (1 + beyond);
}

/* u = C eta/(h + eta) is uniform over the depth; w follows from continuity. */
static void first_order(const sb_solitary *wave, const phase *p, double z, double *u, double *w)
{
    const double h = wave->depth, eta = wave->height * p->s, celerity = sb_solitary_celerity(wave);
    const double slope = -2 * p->alpha / h * eta * p->t;
    *u = celerity * eta / (h + eta);
    *w = -z * celerity * h * slope / ((h + eta) * (h + eta));
}

static void third_order(const sb_solitary *wave, const phase *p, double z, double *u, double *w)
{
    const double e = p->e, s = p->s, y = z * z / (wave->depth * wave->depth);
    const double u2 = -1 / 4.0 + s + y * (3 / 2.0 - s * 9 / 4.0);
    const double u3 = 19 / 40.0 + s * (1 / 5.0 - s * 6 / 5.0) + y * (-3 / 2.0 + s * (-15 / 4.0 + s * 15 / 2.0)) +
                      y * y * (-3 / 8.0 + s * (45 / 16.0 - s * 45 / 16.0));
    const double w2 = 3 / 8.0 + 2 * s + y * (1 / 2.0 - s * 3 / 2.0);
    const double w3 = 49 / 640.0 + s * (-17 / 20.0 - s * 18 / 5.0) +
                      y * (-13 / 16.0 + s * (-25 / 16.0 + s * 15 / 2.0)) +
                      y * y * (-3 / 40.0 + s * (9 / 8.0 - s * 27 / 16.0));
    const double scale = sqrt(wave->gravity * wave->depth) * e * s;
    *u = scale * (1 - e * (u2 + e * u3));
    *w = scale * sqrt(3 * e) * z / wave->depth * p->t * (1 - e * (w2 + e * w3));
}

void sb_solitary_velocity(const sb_solitary *wave, double xi, double z, double *u, double *w)
{
    const phase p = phase_at(wave, xi);
    if (wave->theory == SB_SOLITARY_THIRD_ORDER)
        third_order(wave, &p, z, u, w);
    else
        first_order(wave, &p, z, u, w);
}

void sb_solitary_motion(const sb_solitary *wave, double xi, double z, sb_wave_motion *motion)
{
    /* A wave of constant form has d/dt = -C d/dxi. Weights of the fourth-order difference at -2, -1, 1, 2 steps. */
    static const double weights[] = {1 / 12.0, -8 / 12.0, 8 / 12.0, -1 / 12.0};
    static const double places[] = {-2, -1, 1, 2};
    const double step = 1e-3 * wave->depth, scale = -sb_solitary_celerity(wave) / step;
    *motion = (sb_wave_motion){.elevation = sb_solitary_elevation(wave, xi)};
    sb_solitary_velocity(wave, xi, z, &motion->u, &motion->w);
    for (int i = 0; i < 4; i++) {
        double u, w;
        sb_solitary_velocity(wave, xi + places[i] * step, z, &u, &w);
        motion->u_rate += scale * weights[i] * u;
        motion->w_rate += scale * weights[i] * w;
    }
}

double sb_standing_elevation(double amplitude, double wavelength, double x)
{
    return amplitude * cos(2 * M_PI / wavelength * x);
}

/* omega^2 = g k tanh(k h) */
double sb_standing_period(double wavelength, double depth, double gravity)
{
    double k = 2 * M_PI / wavelength;
    return 2 * M_PI / sqrt(gravity * k * tanh(k * depth));
}

/* (H/h)^-1/4 = (H0/h)^-1/4 + 0.0836 sqrt(nu/(g^1/2 h^3/2)) x/h (Keulegan 1948). */
double sb_keulegan_height(double height, double depth, double viscosity, double gravity, double x)
{
    double rate = 0.0836 * sqrt(viscosity / (sqrt(gravity) * pow(depth, 1.5)));
    return depth * pow(pow(height / depth, -0.25) + rate * x / depth, -4);
}
