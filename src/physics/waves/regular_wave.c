/* Linear and second-order waves, and the choice among the theories. */
#include "physics/waves/regular_wave.h"

#include "physics/waves/breaking.h"

#include <math.h>
#include <stdbool.h>

static sb_status check_height(const sb_regular_wave *wave, sb_error *error)
{
    const double most = sb_breaking_height(wave->number, wave->depth);
    if (wave->height <= most) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT,
                   "a wave of %g m with a period of %g s on %g m breaks, expected a height of at most %.3g m",
                   wave->height, wave->period, wave->depth, sb_breaking_shown(most));
}

static sb_status prepare(sb_regular_wave *wave, sb_error *error)
{
    if (wave->order == SB_WAVE_AUTO) wave->order = wave->ursell < SB_URSELL_LIMIT ? SB_WAVE_STOKES2 : SB_WAVE_CNOIDAL;
    if (wave->order == SB_WAVE_CNOIDAL) {
        sb_status status =
            sb_cnoidal_of_period(wave->height, wave->period, wave->depth, wave->gravity, &wave->cnoidal, error);
        wave->length = wave->cnoidal.length;
        wave->celerity = wave->cnoidal.celerity;
        wave->number = 2 * M_PI / wave->length;
        return status;
    }
    if (wave->order == SB_WAVE_LINEAR) return SB_OK;
    if (!(wave->ursell < SB_URSELL_LIMIT))
        return sb_fail(error, SB_BAD_INPUT,
                       "a second-order wave of %g m with a period of %g s on %g m has H L^2/d^3 = %.4g, expected less "
                       "than %.3g; a cnoidal wave is valid there",
                       wave->height, wave->period, wave->depth, wave->ursell, SB_URSELL_LIMIT);
    /* eta2 = k H^2/16 cosh kd (2 + cosh 2kd)/sinh^3 kd = k H^2/16 (3 - T^2)/T^3 with T = tanh kd. */
    const double t = tanh(wave->number * wave->depth), a = 0.5 * wave->height;
    wave->second = 0.25 * wave->number * a * a * (3 - t * t) / (t * t * t);
    wave->current = -0.5 * a * a * (2 * M_PI / wave->period) / (t * wave->depth);
    return SB_OK;
}

sb_status sb_regular_wave_create(sb_wave_order order, double height, double period, double depth, double gravity,
                                 sb_regular_wave *wave, sb_error *error)
{
    sb_regular_wave made = {.order = order, .height = height, .period = period, .depth = depth, .gravity = gravity};
    made.number = sb_wave_number(period, depth, gravity);
    made.length = 2 * M_PI / made.number;
    made.celerity = made.length / period;
    made.ursell = height * made.length * made.length / (depth * depth * depth);
    sb_status status = check_height(&made, error);
    if (status == SB_OK) status = prepare(&made, error);
    if (status == SB_OK) *wave = made;
    return status;
}

/* cosh 2kz/sinh^4 kd and, with sign -1, sinh 2kz/sinh^4 kd. */
static double second_profile(double k, double z, double depth, double sign)
{
    const double rest = -expm1(-2 * k * depth);
    return 8 * (exp(2 * k * (z - 2 * depth)) + sign * exp(-2 * k * (z + 2 * depth))) / (rest * rest * rest * rest);
}

static void harmonic_at(const sb_regular_wave *wave, double phase, double z, sb_wave_motion *motion)
{
    const double theta = 2 * M_PI * phase, c = cos(theta), s = sin(theta), c2 = cos(2 * theta), s2 = sin(2 * theta);
    const double a = 0.5 * wave->height, k = wave->number, omega = 2 * M_PI / wave->period;
    const bool second = wave->order == SB_WAVE_STOKES2;
    const double elevation = a * c + wave->second * c2;
    z = fmin(z, second ? wave->depth + elevation : wave->depth);
    const double u = a * omega * sb_cosh_over_sinh(k, z, wave->depth);
    const double w = a * omega * sb_sinh_over_sinh(k, z, wave->depth);
    *motion = (sb_wave_motion){elevation, u * c, w * s, omega * u * s, -omega * w * c};
    if (!second) return;
    const double scale = 0.75 * a * a * omega * k;
    const double u2 = scale * second_profile(k, z, wave->depth, 1), w2 = scale * second_profile(k, z, wave->depth, -1);
    motion->u += u2 * c2 + wave->current;
    motion->w += w2 * s2;
    motion->u_rate += 2 * omega * u2 * s2;
    motion->w_rate -= 2 * omega * w2 * c2;
}

void sb_regular_wave_at(const sb_regular_wave *wave, double s, double t, double z, sb_wave_motion *motion)
{
    /* Each part is reduced alone, so that long times cost no digits. */
    double phase = remainder(s, wave->length) / wave->length - remainder(t, wave->period) / wave->period;
    phase -= round(phase);
    z = fmax(z, 0);
    if (wave->order == SB_WAVE_CNOIDAL) {
        sb_cnoidal_at(&wave->cnoidal, phase, 0, motion);
        sb_cnoidal_at(&wave->cnoidal, phase, fmin(z, wave->depth + motion->elevation), motion);
    } else {
        harmonic_at(wave, phase, z, motion);
    }
}

double sb_regular_wave_crest(const sb_regular_wave *wave)
{
    if (wave->order == SB_WAVE_CNOIDAL) return wave->cnoidal.trough + wave->height;
    return 0.5 * wave->height + wave->second;
}

/* The speed is greatest at the surface; 256 phases find it to a thousandth. */
double sb_regular_wave_speed(const sb_regular_wave *wave)
{
    double speed = 0;
    for (int i = 0; i < 256; i++) {
        sb_wave_motion motion;
        sb_regular_wave_at(wave, wave->length * i / 256, 0, HUGE_VAL, &motion);
        speed = fmax(speed, hypot(motion.u, motion.w));
    }
    return speed;
}
