/* Draws the scale bar and the north arrow. */
#include "render/overlay/marks.h"

#include "render/overlay/font.h"
#include "render/overlay/overlay.h"

#include <stdio.h>

static const float ink[3] = {0.97f, 0.98f, 0.99f}, dark[3] = {0.02f, 0.05f, 0.09f};

static double smaller(double a, double b)
{
    return a < b ? a : b;
}

/* Draws a line with smooth edges. Coordinates in px from the top left corner. */
static void stroke(sb_image *image, double x0, double y0, double x1, double y1, double width, const float rgb[3],
                   double alpha)
{
    const double dx = x1 - x0, dy = y1 - y0, square = dx * dx + dy * dy;
    const int left = (int)(smaller(x0, x1) - width - 2), right = (int)(x0 + x1 - smaller(x0, x1) + width + 2);
    const int top = (int)(smaller(y0, y1) - width - 2), bottom = (int)(y0 + y1 - smaller(y0, y1) + width + 2);
    for (int y = top > 0 ? top : 0; y <= bottom && y < image->height; y++)
        for (int x = left > 0 ? left : 0; x <= right && x < image->width; x++) {
            double s = square > 0 ? ((x + 0.5 - x0) * dx + (y + 0.5 - y0) * dy) / square : 0;
            s = s < 0 ? 0 : s > 1 ? 1 : s;
            const double away = hypot(x + 0.5 - x0 - s * dx, y + 0.5 - y0 - s * dy);
            const double in = 0.5 * width + 0.5 - away, part = alpha * (in < 0 ? 0 : in > 1 ? 1 : in);
            unsigned char *pixel = image->rgb + 3 * ((size_t)y * (size_t)image->width + (size_t)x);
            for (int c = 0; c < 3; c++)
                pixel[c] = (unsigned char)(pixel[c] + part * (255 * (double)rgb[c] - pixel[c]) + 0.5);
        }
}

static void rimmed(sb_image *image, double x0, double y0, double x1, double y1, double width)
{
    stroke(image, x0, y0, x1, y1, width + 2.4, dark, 0.6);
    stroke(image, x0, y0, x1, y1, width, ink, 1);
}

static double unit_of(const sb_image *image)
{
    const double unit = image->height / 720.0;
    return unit < 0.6 ? 0.6 : unit;
}

sb_status sb_marks_scale(sb_image *image, const sb_view *view, sb_vec3 target, sb_error *error)
{
    const double depth = -sb_dot(sb_sub(target, view->eye), view->back), unit = unit_of(image);
    if (image->height < SB_OVERLAY_HEIGHT_MIN || !(depth > 0)) return SB_OK;
    const double per_pixel = 2 * view->tangent * depth / image->height;
    /* One of the intervals of a tick scale: 75 to 190 px. */
    const double length = sb_overlay_tick(190 * unit * per_pixel, 2), long_px = length / per_pixel;
    if (!(long_px > 0) || !isfinite(long_px)) return SB_OK;
    const double x = 34 * unit, y = image->height - 42 * unit, tall = 5 * unit, letters = 11 * unit;
    char label[48];
    if (length >= 1000)
        snprintf(label, sizeof label, "%.6g km", length / 1000);
    else
        snprintf(label, sizeof label, "%.6g m", length);
    const double text = 8 * unit + sb_font_width(label, letters);
    sb_overlay_plate(image, x - 14 * unit, y - 28 * unit, x + 14 * unit + (text > long_px ? text : long_px),
                     y + 13 * unit);
    rimmed(image, x, y, x + long_px, y, 2 * unit);
    rimmed(image, x, y - tall, x, y + tall, 2 * unit);
    rimmed(image, x + long_px, y - tall, x + long_px, y + tall, 2 * unit);
    return sb_font_draw(image, x + 8 * unit, y - 9 * unit, letters, ink, label, error);
}

/* The place of a point in the picture, px. */
static void project(const sb_image *image, const sb_view *view, sb_vec3 point, double at[2])
{
    const sb_vec3 away = sb_sub(point, view->eye);
    const double depth = -sb_dot(away, view->back), scale = image->height / (2 * view->tangent * depth);
    at[0] = scale * sb_dot(away, view->right);
    at[1] = -scale * sb_dot(away, view->up);
}

sb_status sb_marks_north(sb_image *image, const sb_view *view, sb_vec3 target, sb_vec3 north, sb_error *error)
{
    const double depth = -sb_dot(sb_sub(target, view->eye), view->back), unit = unit_of(image);
    if (image->height < SB_OVERLAY_HEIGHT_MIN || !(depth > 0) || !(sb_norm(north) > 0)) return SB_OK;
    double foot[2], tip[2];
    project(image, view, target, foot);
    project(image, view, sb_madd(target, 0.01 * depth, sb_normalize(north)), tip);
    double dx = tip[0] - foot[0], dy = tip[1] - foot[1];
    const double seen = hypot(dx, dy), length = 52 * unit;
    if (!(seen > 0)) return SB_OK;
    dx *= length / seen;
    dy *= length / seen;
    const double x = image->width - 64 * unit, y = 64 * unit;
    const double tip_x = x + 0.5 * dx, tip_y = y + 0.5 * dy;
    sb_overlay_plate(image, x - 46 * unit, y - 46 * unit, x + 46 * unit, y + 46 * unit);
    rimmed(image, x - 0.5 * dx, y - 0.5 * dy, tip_x, tip_y, 2.2 * unit);
    rimmed(image, tip_x, tip_y, tip_x - 0.28 * dx - 0.16 * dy, tip_y - 0.28 * dy + 0.16 * dx, 2.2 * unit);
    rimmed(image, tip_x, tip_y, tip_x - 0.28 * dx + 0.16 * dy, tip_y - 0.28 * dy - 0.16 * dx, 2.2 * unit);
    const double letters = 12 * unit;
    return sb_font_draw(image, tip_x + 0.28 * dx - 0.5 * sb_font_width("N", letters), tip_y + 0.28 * dy + 0.5 * letters,
                        letters, ink, "N", error);
}
