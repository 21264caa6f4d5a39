#include "physics/records/eurotop.h"

#include <math.h>

static double rate(double factor, double steep, double relative, double height, double gravity)
{
    return factor * exp(-pow(steep * relative, 1.3)) * sqrt(gravity * height * height * height);
}

double sb_eurotop_vertical(double height, double freeboard, double gravity)
{
    return rate(0.047, 2.35, freeboard / height, height, gravity);
}

static double steep_slope(double height, double freeboard, double slope, double gravity)
{
    const double less = 2 - 1 / slope;
    return rate(0.09 - 0.01 * pow(less, 2.1), fmin(1.5 + 0.42 * pow(less, 1.5), 2.35), freeboard / height, height,
                gravity);
}

double sb_eurotop_breaker(double height, double slope, double period, double gravity)
{
    return slope / sqrt(2 * M_PI * height / (gravity * period * period));
}

double sb_eurotop_slope(double height, double freeboard, double slope, double period, double gravity)
{
    if (slope > SB_EUROTOP_STEEP) return steep_slope(height, freeboard, slope, gravity);
    const double x = sb_eurotop_breaker(height, slope, period, gravity), relative = freeboard / height;
    return fmin(rate(0.023 / sqrt(slope) * x, 2.7 / x, relative, height, gravity),
                rate(0.09, 1.5, relative, height, gravity));
}

double sb_eurotop_rate(double height, double freeboard, double slope, double period, double gravity)
{
    return slope > 0 ? sb_eurotop_slope(height, freeboard, slope, period, gravity)
                     : sb_eurotop_vertical(height, freeboard, gravity);
}
