#include "physics/eurotop.h"

#include <math.h>

static double rate(double factor, double steep, double relative, double height, double gravity)
{
    return factor * exp(-pow(steep * relative, 1.3)) * sqrt(gravity * height * height * height);
}

double sb_eurotop_vertical(double height, double freeboard, double gravity)
{
    return rate(0.047, 2.35, freeboard / height, height, gravity);
}

double sb_eurotop_slope(double height, double freeboard, double slope, double period, double gravity)
{
    const double x = slope / sqrt(2 * M_PI * height / (gravity * period * period)), relative = freeboard / height;
    return fmin(rate(0.023 / sqrt(slope) * x, 2.7 / x, relative, height, gravity),
                rate(0.09, 1.5, relative, height, gravity));
}
