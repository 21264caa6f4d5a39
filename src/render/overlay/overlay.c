/* Draws title, time and colour legend. */
#include "render/overlay/overlay.h"

#include "render/overlay/colormap.h"
#include "render/overlay/font.h"

#include <math.h>
#include <stdio.h>

static const float ink[3] = {0.97f, 0.98f, 0.99f};

double sb_overlay_tick(double range, int most)
{
    double power = pow(10, floor(log10(range / most)));
    static const double steps[] = {1, 2, 5};
    for (int i = 0; i < 3; i++)
        if (range / (steps[i] * power) <= most * (1 + 1e-9)) return steps[i] * power;
    return 10 * power;
}

static void fill(sb_image *image, double x0, double y0, double x1, double y1, const float rgb[3], double alpha)
{
    for (int y = (int)lround(y0); y < (int)lround(y1); y++)
        for (int x = (int)lround(x0); x < (int)lround(x1); x++) {
            if (x < 0 || y < 0 || x >= image->width || y >= image->height) continue;
            unsigned char *pixel = image->rgb + 3 * ((size_t)y * (size_t)image->width + (size_t)x);
            for (int c = 0; c < 3; c++)
                pixel[c] = (unsigned char)(pixel[c] + alpha * (255 * (double)rgb[c] - pixel[c]) + 0.5);
        }
}

void sb_overlay_plate(sb_image *image, double x0, double y0, double x1, double y1)
{
    static const float dark[3] = {0.04f, 0.07f, 0.11f};
    fill(image, x0, y0, x1, y1, dark, 0.45);
}

static double unit_of(const sb_image *image)
{
    const double unit = image->height / 720.0;
    return unit < 0.6 ? 0.6 : unit;
}

sb_status sb_overlay_legend(sb_image *image, int slot, const sb_legend *legend, sb_error *error)
{
    static const float dark[3] = {0.02f, 0.05f, 0.09f};
    if (image->height < SB_OVERLAY_HEIGHT_MIN) return SB_OK;
    const double unit = unit_of(image);
    double width = 300 * unit, thick = 13 * unit;
    width = width < 0.5 * image->width ? width : 0.5 * image->width;
    double x = image->width - 34 * unit - width, y = image->height - (58 + SB_OVERLAY_SLOT * slot) * unit;
    sb_overlay_plate(image, x - 12 * unit, y - 26 * unit, x + width + 14 * unit, y + 36 * unit);
    fill(image, x - 1.5, y - 1.5, x + width + 1.5, y + thick + 1.5, dark, 0.55);
    for (int column = 0; column < (int)lround(width); column++) {
        float rgb[3];
        sb_colormap(legend->map, (column + 0.5) / width, rgb);
        fill(image, x + column, y, x + column + 1, y + thick, rgb, 1);
    }
    const double range = legend->max - legend->min, letters = 11 * unit, step = sb_overlay_tick(range, 5);
    sb_status status = sb_font_draw(image, x, y - 9 * unit, letters, ink, legend->label, error);
    if (!(step > 0 && isfinite(step))) return status;
    const double first = ceil(legend->min / step - 1e-9);
    const int ticks = (int)floor(legend->max / step - first + 1e-9);
    for (int tick = 0; tick <= ticks && status == SB_OK; tick++) {
        char label[32];
        const double value = (first + tick) * step;
        snprintf(label, sizeof label, "%.6g", value);
        double at = x + width * ((value - legend->min) / range);
        fill(image, at - 0.5 * unit, y + thick, at + 0.9 * unit, y + thick + 5 * unit, ink, 0.9);
        status = sb_font_draw(image, at - 0.5 * sb_font_width(label, letters), y + thick + 20 * unit, letters, ink,
                              label, error);
    }
    return status;
}

sb_status sb_overlay_title(sb_image *image, const char *title, double time, sb_error *error)
{
    if (image->height < SB_OVERLAY_HEIGHT_MIN) return SB_OK;
    const double unit = unit_of(image);
    char clock[64];
    snprintf(clock, sizeof clock, "t = %.*f s", time < 10 ? 2 : 1, time);
    const double letters = 17 * unit, room = image->width - 60 * unit,
                 full = sb_font_width(title ? title : "", letters);
    const bool titled = full > 0, shrinks = full > room; /* a long title shrinks until it fits */
    const double wide = shrinks ? room : full, below = sb_font_width(clock, 15 * unit);
    const double line = (titled ? 75 : 44) * unit;
    sb_overlay_plate(image, 18 * unit, 16 * unit, 42 * unit + (wide > below ? wide : below), line + 11 * unit);
    sb_status status = SB_OK;
    if (titled)
        status =
            sb_font_draw(image, 30 * unit, 44 * unit, shrinks ? letters * room / full : letters, ink, title, error);
    return status == SB_OK ? sb_font_draw(image, 30 * unit, line, 15 * unit, ink, clock, error) : status;
}
