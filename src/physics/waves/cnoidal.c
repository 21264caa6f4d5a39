/* Cnoidal waves by the theory of Korteweg and de Vries. */
#include "physics/waves/cnoidal.h"

#include <math.h>

enum { LOGIT_MAX = 700 };

sb_cnoidal sb_cnoidal_of_parameter(double height, double depth, double gravity, double logit)
{
    const sb_elliptic e = sb_elliptic_of(logit);
    /* C^2 = g d (1 + H/(m d) (2 - m - 3 E/K)); eta_t = H/m (1 - m - E/K); L = d sqrt(16 m d/(3 H)) K. */
    const double square = 1 + height / depth * ((0.5 * e.m - 1 + 3 * e.excess) / e.m);
    return (sb_cnoidal){.height = height,
                        .depth = depth,
                        .length = depth * sqrt(16 * e.m * depth / (3 * height)) * e.k,
                        .celerity = square > 0 ? sqrt(gravity * depth * square) : 0,
                        .trough = height * (e.excess / e.m - 0.5),
                        .elliptic = e};
}

/* Distance that the wave of this parameter lacks to its length: > 0 for waves that are longer than those of the period.
 */
static double surplus(double height, double period, double depth, double gravity, double logit)
{
    const sb_cnoidal wave = sb_cnoidal_of_parameter(height, depth, gravity, logit);
    return wave.celerity > 0 ? wave.length - wave.celerity * period : (double)NAN;
}

sb_status sb_cnoidal_of_period(double height, double period, double depth, double gravity, sb_cnoidal *wave,
                               sb_error *error)
{
    /* Seek the longest wave: at small m, where the celerity tends to 0, the formulas have a second, false root. */
    double high = LOGIT_MAX;
    if (!(surplus(height, period, depth, gravity, high) > 0))
        return sb_fail(
            error, SB_BAD_INPUT,
            "a cnoidal wave of %g m on %g m with a period of %g s: its crests are solitary waves, expected a "
            "shorter period",
            height, depth, period);
    double low = high;
    while (low > -LOGIT_MAX && surplus(height, period, depth, gravity, low) > 0) high = low--;
    if (!(surplus(height, period, depth, gravity, low) <= 0))
        return sb_fail(
            error, SB_BAD_INPUT,
            "no cnoidal wave of %g m on %g m has a period of %g s, expected a longer period or another theory", height,
            depth, period);
    for (int i = 0; i < 100; i++) {
        const double middle = 0.5 * (low + high);
        if (surplus(height, period, depth, gravity, middle) > 0)
            high = middle;
        else
            low = middle;
    }
    *wave = sb_cnoidal_of_parameter(height, depth, gravity, low);
    return SB_OK;
}

/* Derivatives in x of the mean velocity C eta/(d + eta), 0 to 4, from those of the elevation. */
static void mean_velocity(const double eta[5], double depth, double celerity, double v[5])
{
    const double h = depth + eta[0], scale = celerity * depth / (h * h), p = eta[1] / h;
    v[0] = celerity * eta[0] / h;
    v[1] = scale * eta[1];
    v[2] = scale * (eta[2] - 2 * eta[1] * p);
    v[3] = scale * (eta[3] - 6 * eta[2] * p + 6 * eta[1] * p * p);
    v[4] = scale * (eta[4] - 8 * eta[3] * p - 6 * eta[2] * eta[2] / h + 36 * eta[2] * p * p - 24 * eta[1] * p * p * p);
}

/* Derivatives in x of the elevation, 0 to 4: of f = cn^2, which satisfies f'^2 = 4 f (1 - f) (m1 + m f). */
static void elevation(const sb_cnoidal *wave, double phase, double eta[5])
{
    const sb_elliptic *e = &wave->elliptic;
    const double rate = 2 * e->k / wave->length, sum = e->m - e->m1;
    double sn, cn, dn;
    sb_elliptic_at(e, 2 * e->k * phase, &sn, &cn, &dn);
    const double f = cn * cn, f1 = -2 * sn * cn * dn, f2 = 2 * (e->m1 + 2 * sum * f - 3 * e->m * f * f);
    const double pull = 4 * sum - 12 * e->m * f;
    eta[0] = wave->trough + wave->height * f;
    eta[1] = wave->height * rate * f1;
    eta[2] = wave->height * rate * rate * f2;
    eta[3] = wave->height * pow(rate, 3) * pull * f1;
    eta[4] = wave->height * pow(rate, 4) * (pull * f2 - 12 * e->m * f1 * f1);
}

/* Stream function z v + (h^2 z - z^3)/6 v_xx with the mean velocity v: its surface value h v is that of the flux, and
   its vorticity is of the fourth derivative. A wave of constant form has d/dt = -C d/dx. */
void sb_cnoidal_at(const sb_cnoidal *wave, double phase, double z, sb_wave_motion *motion)
{
    double eta[5], v[5];
    elevation(wave, phase, eta);
    mean_velocity(eta, wave->depth, wave->celerity, v);
    const double h = wave->depth + eta[0], c = wave->celerity;
    const double u_bow = h * h / 6 - 0.5 * z * z, w_bow = (h * h * z - z * z * z) / 6;
    const double first = h * eta[1] / 3, second = (eta[1] * eta[1] + h * eta[2]) / 3;
    const double u_x = v[1] + first * v[2] + u_bow * v[3];
    const double minus_w_x = z * v[2] + z * second * v[2] + 2 * z * first * v[3] + w_bow * v[4];
    *motion = (sb_wave_motion){.elevation = eta[0],
                               .u = v[0] + u_bow * v[2],
                               .w = -(z * v[1] + z * first * v[2] + w_bow * v[3]),
                               .u_rate = -c * u_x,
                               .w_rate = c * minus_w_x};
}

/* With b the distance of the piston behind the crest, dX/dt = C eta/(d + eta) and db/dt = C - dX/dt give X = A(b)/d and
   b + A(b)/d = C t, with A the integral of the elevation from the crest, H L/(2 K m) Z(2 K b/L). The left side grows
   with b, and differs from b by at most A's largest value, H L/(2 K m). */
double sb_cnoidal_piston(const sb_cnoidal *wave, double t, double *phase)
{
    const sb_elliptic *e = &wave->elliptic;
    const double scale = wave->height / (2 * e->k * e->m * wave->depth); /* of A/(d L) */
    const double at = remainder(t, wave->length / wave->celerity) * wave->celerity / wave->length;
    double low = fmax(at - scale, -0.5), high = fmin(at + scale, 0.5);
    for (int i = 0; i < 60 && high > low; i++) {
        const double middle = 0.5 * (low + high);
        if (middle + scale * sb_elliptic_zeta(e, 2 * e->k * middle) > at)
            high = middle;
        else
            low = middle;
    }
    const double behind = 0.5 * (low + high);
    if (phase) *phase = -behind;
    return (at - behind) * wave->length;
}
