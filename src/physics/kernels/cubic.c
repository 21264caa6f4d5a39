/* The cubic B-spline on support h [S16 eq. 4]. */
#include "physics/kernels/kernel.h"

#include <math.h>

/* w = 6q^3 - 6q^2 + 1 below 1/2, 2(1-q)^3 above. */
static double shape(double q)
{
    double rest = 1 - q;
    return q < 0.5 ? 1 - 6 * q * q * rest : 2 * rest * rest * rest;
}

static double slope(double q)
{
    double rest = 1 - q;
    return q < 0.5 ? -6 * q * (2 - 3 * q) : -6 * rest * rest;
}

const sb_kernel sb_kernel_cubic = {
    .name = "cubic",
    .summary = "cubic B-spline, support 2 spacings",
    .reference = "Monaghan 1992; Sampath et al. 2016, eq. 4",
    .support = 2,
    .alpha = {0, 4.0 / 3.0, 40 / (7 * M_PI), 8 / M_PI},
    .shape = shape,
    .slope = slope,
};
