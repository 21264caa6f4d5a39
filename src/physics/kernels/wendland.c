/* Wendland's kernels for 2D and 3D. In 1D the same polynomials are used (Wendland's own 1D family is of lower degree);
   alpha then follows from the exact integral of the shape, 2/3 for C2 and 16/27 for C4. */
#include "physics/kernels/kernel.h"

#include <math.h>

/* w = (1-q)^4 (1 + 4q) */
static double shape_c2(double q)
{
    double square = (1 - q) * (1 - q);
    return square * square * (1 + 4 * q);
}

static double slope_c2(double q)
{
    double rest = 1 - q;
    return -20 * q * rest * rest * rest;
}

/* w = (1-q)^6 (1 + 6q + 35/3 q^2) */
static double shape_c4(double q)
{
    double cube = (1 - q) * (1 - q) * (1 - q);
    return cube * cube * (1 + q * (6 + 35.0 / 3.0 * q));
}

static double slope_c4(double q)
{
    double square = (1 - q) * (1 - q);
    return -56.0 / 3.0 * q * (1 + 5 * q) * square * square * (1 - q);
}

const sb_kernel sb_kernel_wendland_c2 = {
    .name = "wendland-c2",
    .summary = "Wendland C2, support 3 spacings: no pairing, more than twice the neighbours of the cubic spline",
    .reference = "Wendland 1995; Dehnen & Aly 2012, table 1",
    .support = 3,
    .alpha = {0, 3.0 / 2.0, 7 / M_PI, 21 / (2 * M_PI)},
    .shape = shape_c2,
    .slope = slope_c2,
};

const sb_kernel sb_kernel_wendland_c4 = {
    .name = "wendland-c4",
    .summary = "Wendland C4, support 3.5 spacings: smoothest, highest run time",
    .reference = "Wendland 1995; Dehnen & Aly 2012, table 1",
    .support = 3.5,
    .alpha = {0, 27.0 / 16.0, 9 / M_PI, 495 / (32 * M_PI)},
    .shape = shape_c4,
    .slope = slope_c4,
};
