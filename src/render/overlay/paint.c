#include "render/overlay/paint.h"

#include <math.h>

static void mix(sb_image *image, int x, int y, const float rgb[3], double alpha)
{
    unsigned char *pixel = image->rgb + 3 * ((size_t)y * (size_t)image->width + (size_t)x);
    for (int c = 0; c < 3; c++) pixel[c] = (unsigned char)(pixel[c] + alpha * (255 * (double)rgb[c] - pixel[c]) + 0.5);
}

static int within(double value, int most)
{
    return value < 0 ? 0 : value > most ? most : (int)value;
}

void sb_paint_box(sb_image *image, double x0, double y0, double x1, double y1, const float rgb[3], double alpha)
{
    for (int y = within(round(y0), image->height); y < within(round(y1), image->height); y++)
        for (int x = within(round(x0), image->width); x < within(round(x1), image->width); x++)
            mix(image, x, y, rgb, alpha);
}

/* Distance of a pixel's middle from the line. */
static double distance(double px, double py, double x0, double y0, double x1, double y1)
{
    const double dx = x1 - x0, dy = y1 - y0, square = dx * dx + dy * dy;
    double along = square > 0 ? ((px - x0) * dx + (py - y0) * dy) / square : 0;
    along = along < 0 ? 0 : along > 1 ? 1 : along;
    return hypot(px - x0 - along * dx, py - y0 - along * dy);
}

void sb_paint_line(sb_image *image, double x0, double y0, double x1, double y1, double width, const float rgb[3],
                   double alpha)
{
    const double reach = 0.5 * width + 1, left = fmin(x0, x1) - reach, right = fmax(x0, x1) + reach;
    const double slope = x1 - x0 != 0 ? (y1 - y0) / (x1 - x0) : 0, tall = reach * hypot(1, slope) + fabs(slope);
    for (int x = within(left, image->width); x < within(right + 1, image->width); x++) {
        /* Of a column only the part near the line is visited. */
        const double at = fmin(fmax(x + 0.5, fmin(x0, x1)), fmax(x0, x1)), y = y0 + slope * (at - x0);
        const double low = x1 - x0 != 0 ? y - tall : fmin(y0, y1) - reach;
        const double high = x1 - x0 != 0 ? y + tall : fmax(y0, y1) + reach;
        const double top = fmax(low, fmin(y0, y1) - reach), bottom = fmin(high, fmax(y0, y1) + reach);
        for (int row = within(top, image->height); row < within(bottom + 1, image->height); row++) {
            const double cover = 0.5 * width + 0.5 - distance(x + 0.5, row + 0.5, x0, y0, x1, y1);
            if (cover > 0) mix(image, x, row, rgb, alpha * fmin(cover, 1));
        }
    }
}

void sb_paint_disc(sb_image *image, double x, double y, double radius, const float rgb[3], double alpha)
{
    sb_paint_line(image, x, y, x, y, 2 * radius, rgb, alpha);
}
