#include "physics/wavemakers/paddle_transfer.h"

#include "physics/waves/dispersion.h"

#include <math.h>

enum { MODES = 200 };

double sb_paddle_gain(sb_paddle_motion motion, double number, double depth)
{
    const double kd = number * depth, piston = sb_piston_height_over_stroke(kd);
    if (motion == SB_PADDLE_PISTON) return piston;
    /* Share of the integral of (z/d) cosh kz in that of cosh kz: 1 - (cosh kd - 1)/(kd sinh kd). */
    return piston * (1 - tanh(0.5 * kd) / kd);
}

double sb_paddle_evanescent(sb_paddle_motion motion, double omega, double depth, double gravity, double distance)
{
    const double y = omega * omega * depth / gravity;
    double sum = 0;
    for (int j = 1; j <= MODES; j++) {
        const double x = sb_evanescent_root(j, y), sine = sin(x);
        const double shape = motion == SB_PADDLE_PISTON ? sine : sine - (1 - cos(x)) / x;
        sum += 4 * shape * sine / (2 * x + sin(2 * x)) * exp(-x * distance / depth);
    }
    return sum;
}

double complex sb_paddle_absorbing(sb_paddle_motion motion, double omega, double depth, double gravity, double distance)
{
    const double number = sb_wave_number(2 * M_PI / omega, depth, gravity);
    const double gain = sb_paddle_gain(motion, number, depth), kx = number * distance;
    const double lag = gain * sin(kx) + sb_paddle_evanescent(motion, omega, depth, gravity, distance);
    return -omega / CMPLX(gain * cos(kx), lag);
}

/* The face is at xi, and by linear theory g eta_x = -xi'' = -dV/dt there, so that the mean beside the moving face is
   <xi eta_x> = <V^2>/g above that at a place. There, Bernoulli's equation at the surface, g <eta> = C - <u^2 + w^2>/2 -
   <eta w_t>, has u = V, w = eta_t and <eta eta_tt> = -<eta_t^2>. Far from the paddle it gives <eta> = C/g - k
   sum a^2/(2 sinh 2kd) for waves in both directions; with the mean level 0 that is C. Sum: <V^2>/(2g) + omega^2/(2g)
   <eta^2> + k/sinh 2kd <eta^2>. */
double sb_paddle_mean_of_square(double number, double depth)
{
    const double kd = number * depth;
    return number * (0.5 * tanh(kd) + 1 / sinh(2 * kd));
}

/* Both filters of the slow part. */
static double complex without_slow(double slow, double omega)
{
    const double complex once = CMPLX(0, omega) / CMPLX(slow, omega);
    return once * once;
}

/* 1/filter = alpha + i omega beta is fitted to without_slow/absorbing. */
sb_absorbing_filter sb_absorbing_filter_of(sb_paddle_motion motion, const sb_band_part *band, size_t count, double slow,
                                           double depth, double gravity, double distance)
{
    double alpha = 0, weight = 0, beta = 0, omega_square = 0, square = 0;
    for (size_t i = 0; i < count; i++) {
        const double omega = band[i].omega, w = band[i].weight;
        const double complex inverse =
            -without_slow(slow, omega) / sb_paddle_absorbing(motion, omega, depth, gravity, distance);
        alpha += w * creal(inverse);
        weight += w;
        beta += w * omega * cimag(inverse);
        omega_square += w * omega * omega;
        square += w * sb_paddle_mean_of_square(sb_wave_number(2 * M_PI / omega, depth, gravity), depth);
    }
    alpha /= weight;
    beta /= omega_square;
    return (sb_absorbing_filter){.gain = 1 / alpha,
                                 .pole = beta > 0 ? alpha / beta : (double)INFINITY,
                                 .slow = slow,
                                 .square = square / weight,
                                 .gravity = gravity};
}

/* With an incident wave a at the paddle, its reflection a + i W X, and the surface at the distance x
   2 a cos kx + (i W exp(-ikx) + c) X, of which X = filter/(i omega) times that surface. */
double sb_absorbing_reflection(const sb_absorbing_filter *filter, sb_paddle_motion motion, double omega, double depth,
                               double gravity, double distance)
{
    const double number = sb_wave_number(2 * M_PI / omega, depth, gravity), kx = number * distance;
    const double gain = sb_paddle_gain(motion, number, depth);
    const double near = sb_paddle_evanescent(motion, omega, depth, gravity, distance);
    const double complex lag = 1 / CMPLX(1, omega / filter->pole), i = CMPLX(0, 1);
    const double complex response = -filter->gain * lag * without_slow(filter->slow, omega) / (i * omega);
    const double complex own = i * gain * cexp(-i * kx) + near;
    return cabs(1 + i * gain * response * 2 * cos(kx) / (1 - response * own));
}
