/* Solitary waves by Goring's method [G78]: the paddle moves with the depth-averaged velocity of the water next to it,
   dX/dt = C eta/(h + eta), eta = H sech^2(kappa(Ct - X)), which integrates to X = H/(kappa h) tanh(kappa(Ct - X)) [S16
   eqs. 41-47, eq. 46 with tanh]. */
#include "physics/wavemakers/goring.h"

#include "base/memory.h"
#include "physics/wavemakers/wavemaker.h"
#include "physics/waves/breaking.h"

#include <math.h>
#include <stddef.h>

/* Fraction of T at each end over which the motion starts from rest and stops smoothly. */
static const double ease = 1.0 / 8.0;

sb_goring sb_goring_of(double height, double depth, double gravity, bool rayleigh)
{
    sb_goring law = {.ratio = height / depth,
                     .kappa = sqrt(3 * height / (4 * depth * depth * (rayleigh ? depth + height : depth))),
                     .celerity = sqrt(gravity * (depth + height))};
    law.stroke = 2 * law.ratio / law.kappa;
    law.period = 2 / (law.kappa * law.celerity) * (3.80 + law.ratio);
    return law;
}

/* Solves theta + ratio tanh(theta) = y by Newton's method. The left side is odd and concave for theta > 0, so the
   iteration starts below the root, at y/(1+ratio), and rises to it without overshooting. */
static double solve_phase(double y, double ratio)
{
    double magnitude = fabs(y), theta = magnitude / (1 + ratio);
    for (int i = 0; i < 60; i++) {
        double tanh_theta = tanh(theta);
        double step = (magnitude - theta - ratio * tanh_theta) / (1 + ratio * (1 - tanh_theta * tanh_theta));
        theta += step;
        if (fabs(step) <= 1e-15 * (1 + theta)) break;
    }
    return copysign(theta, y);
}

double sb_goring_paddle(const sb_goring *law, double t, double *speed)
{
    double y = law->kappa * law->celerity * (t - law->period / 2);
    double theta = solve_phase(y, law->ratio);
    double eta = law->ratio / (cosh(theta) * cosh(theta)); /* in units of h */
    if (speed) *speed = law->celerity * eta / (1 + eta);
    return (y - theta) / law->kappa + law->stroke / 2;
}

static sb_status make(const sb_wavemaker_parameters *parameters, bool rayleigh, void **state, sb_error *error)
{
    double ratio = parameters->height / parameters->depth;
    if (!(ratio <= SB_SOLITARY_HIGHEST * (1 + 1e-9)))
        return sb_fail(error, SB_BAD_INPUT,
                       "wave height %g m on depth %g m: no solitary wave is higher than %g of its depth, expected at "
                       "most %.4g m",
                       parameters->height, parameters->depth, SB_SOLITARY_HIGHEST,
                       SB_SOLITARY_HIGHEST * parameters->depth);
    if (!(parameters->gravity > 0))
        return sb_fail(error, SB_BAD_INPUT, "gravity %g m/s^2: expected more than 0", parameters->gravity);
    sb_goring *law = sb_alloc(1, sizeof *law);
    if (!law) return sb_fail_memory(error, "a solitary-wave paddle");
    *law = sb_goring_of(parameters->height, parameters->depth, parameters->gravity, rayleigh);
    *state = law;
    return SB_OK;
}

static sb_status create_boussinesq(const sb_wavemaker_parameters *parameters, void **state, sb_error *error)
{
    return make(parameters, false, state, error);
}

static sb_status create_rayleigh(const sb_wavemaker_parameters *parameters, void **state, sb_error *error)
{
    return make(parameters, true, state, error);
}

/* The cubic that starts at 0 at rest and arrives at `value` with `speed` after `length`. */
static double ease_in(double t, double length, double value, double speed)
{
    double s = t / length;
    return s * s * (3 * value - speed * length + s * (speed * length - 2 * value));
}

/* The law's motion extends over infinite time; T truncates it at 0.05 % of S and 0.3 % of the largest speed. A cubic
   over T/8 at each end removes the resulting jumps: the paddle moves from rest at exactly 0 to rest at exactly S. */
static double displacement(const void *state, double t)
{
    const sb_goring *law = state;
    double length = ease * law->period;
    if (t <= 0) return 0;
    if (t >= law->period) return law->stroke;
    if (t >= length && t <= law->period - length) return sb_goring_paddle(law, t, NULL);
    double speed, value = sb_goring_paddle(law, length, &speed);
    return t < length ? ease_in(t, length, value, speed) : law->stroke - ease_in(law->period - t, length, value, speed);
}

static double duration(const void *state)
{
    return ((const sb_goring *)state)->period;
}

static const char *warn_breaking(const sb_wavemaker_parameters *parameters)
{
    return parameters->height > 0.78 * parameters->depth
               ? "wave height above 0.78 of the depth: the wave breaks at the paddle"
               : NULL;
}

static const char *warn_boussinesq(const sb_wavemaker_parameters *parameters)
{
    const char *breaking = warn_breaking(parameters);
    if (breaking) return breaking;
    return parameters->height > 0.3 * parameters->depth
               ? "wave height above 0.3 of the depth: Boussinesq's profile sheds trailing waves; "
                 "goring-rayleigh reduces them"
               : NULL;
}

const sb_wavemaker sb_wavemaker_goring = {
    .name = "goring",
    .summary = "piston for a solitary wave, Boussinesq's profile",
    .reference = "Goring 1978; Sampath et al. 2016, section 7",
    .needs = SB_WM_HEIGHT | SB_WM_DEPTH,
    .create = create_boussinesq,
    .displacement = displacement,
    .duration = duration,
    .destroy = sb_free,
    .warning = warn_boussinesq,
};

const sb_wavemaker sb_wavemaker_goring_rayleigh = {
    .name = "goring-rayleigh",
    .summary = "piston for a solitary wave, Rayleigh's wider profile for high waves",
    .reference = "Goring 1978 with Rayleigh 1876; Guizien & Barthelemy 2002",
    .needs = SB_WM_HEIGHT | SB_WM_DEPTH,
    .create = create_rayleigh,
    .displacement = displacement,
    .duration = duration,
    .destroy = sb_free,
    .warning = warn_breaking,
};
