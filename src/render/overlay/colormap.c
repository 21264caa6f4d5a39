/* Colour maps for fields of the water. */
#include "render/overlay/colormap.h"

#include <math.h>

/* The maps in CIELAB: L* is linear by construction; a* and b* stay within the sRGB gamut, so that no colour is
   clipped. */
enum { KNOTS = 6 };
struct map {
    double low, high; /* L* */
    double a[KNOTS], b[KNOTS];
};
static const struct map maps[SB_COLORMAPS] = {
    [SB_COLORMAP_SEA] = {21, 97, {9, 3, -6, -17, -14, -1}, {-34, -38, -34, -24, -12, -1}},
    [SB_COLORMAP_FIRE] = {17, 95, {22, 42, 48, 36, 12, -6}, {-24, -12, 24, 48, 56, 30}},
    [SB_COLORMAP_DEEP] = {18, 95, {22, 8, -18, -36, -38, -10}, {-30, -24, -8, 14, 44, 40}},
};

static const double white_x = 0.95047, white_z = 1.08883; /* D65, Y = 1 */

static double spline(const double *knots, double t)
{
    double at = t * (KNOTS - 1);
    int k = (int)at;
    if (k > KNOTS - 2) k = KNOTS - 2;
    double s = at - k, a = knots[k], b = knots[k + 1];
    double slope_a = k > 0 ? (b - knots[k - 1]) / 2 : b - a;
    double slope_b = k < KNOTS - 2 ? (knots[k + 2] - a) / 2 : b - a;
    return a + (b - a) * s * s * (3 - 2 * s) + slope_a * s * (1 - s) * (1 - s) + slope_b * s * s * (s - 1);
}

static double from_lab(double f)
{
    return f > 6.0 / 29 ? f * f * f : 3 * (6.0 / 29) * (6.0 / 29) * (f - 4.0 / 29);
}

static float encode(double linear)
{
    double value = linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
    return (float)(value < 0 ? 0 : value > 1 ? 1 : value);
}

void sb_colormap(int map, double t, float rgb[3])
{
    const struct map *m = &maps[map];
    t = t > 0 ? t < 1 ? t : 1 : 0;
    double f = (m->low + (m->high - m->low) * t + 16) / 116;
    double x = white_x * from_lab(f + spline(m->a, t) / 500), y = from_lab(f);
    double z = white_z * from_lab(f - spline(m->b, t) / 200);
    rgb[0] = encode(3.2404542 * x - 1.5371385 * y - 0.4985314 * z);
    rgb[1] = encode(-0.9692660 * x + 1.8760108 * y + 0.0415560 * z);
    rgb[2] = encode(0.0556434 * x - 0.2040259 * y + 1.0572252 * z);
}
