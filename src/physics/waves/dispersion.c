/* Linear waves on water of constant depth. */
#include "physics/waves/dispersion.h"

#include <math.h>

double sb_wave_number(double period, double depth, double gravity)
{
    const double omega = 2 * M_PI / period, y = omega * omega * depth / gravity;
    /* Newton on x tanh x = y from the limits of deep and of shallow water: at most six steps for any y. */
    double x = y > 1 ? y / sqrt(tanh(y)) : sqrt(y) * (1 + y / 5);
    for (int i = 0; i < 60; i++) {
        const double t = tanh(x), slope = t + x * (1 - t * t), next = x - (x * t - y) / slope;
        if (!(fabs(next - x) > 2e-16 * x)) break;
        x = next;
    }
    return x / depth;
}

double sb_group_speed(double omega, double k, double depth)
{
    const double twice = 2 * k * depth;
    return omega / k * 0.5 * (1 + twice / sinh(twice));
}

double sb_cosh_over_sinh(double k, double z, double depth)
{
    return (exp(k * (z - depth)) + exp(-k * (z + depth))) / -expm1(-2 * k * depth);
}

double sb_sinh_over_sinh(double k, double z, double depth)
{
    return exp(k * (z - depth)) * expm1(-2 * k * z) / expm1(-2 * k * depth);
}

double sb_piston_height_over_stroke(double kd)
{
    const double q = exp(-2 * kd), rest = -expm1(-2 * kd); /* sinh kd = e^kd (1 - q)/2, sinh 2kd = e^2kd (1 - q^2)/2 */
    return 2 * rest * rest / (4 * kd * q + rest * (1 + q));
}

double sb_evanescent_root(int j, double y)
{
    enum { NEWTON = 60 };
    double x = j * M_PI - atan2(y, (j - 0.5) * M_PI);
    for (int i = 0; i < NEWTON; i++) {
        const double step = (x + atan(y / x) - j * M_PI) / (1 - y / (x * x + y * y));
        x -= step;
        if (fabs(step) < 1e-15 * x) break;
    }
    return x;
}
