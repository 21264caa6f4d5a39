#include "render/overlay/inset.h"

#include "render/overlay/font.h"
#include "render/overlay/overlay.h"
#include "render/overlay/paint.h"

#include <math.h>
#include <stdio.h>

/* Sizes in px of a picture that is 720 px high. The scale bar with its label is below the plots. */
static const double WIDTH = 300, HEIGHT = 134, LEFT = 30, BOTTOM = 72, GAP = 10, LETTERS = 10.5;
static const double PAD_LEFT = 54, PAD_RIGHT = 26, PAD_TOP = 33, PAD_BOTTOM = 24;
static const float ink[3] = {0.95f, 0.96f, 0.98f}, faint[3] = {0.62f, 0.67f, 0.73f}, dark[3] = {0.04f, 0.07f, 0.11f},
                   curve[3] = {1.0f, 0.72f, 0.22f};

/* The plot's area in px, and the values at its sides. */
typedef struct area {
    double unit, left, right, top, bottom;
    double t_step, t_max, v_step, v_min, v_max;
    double factor; /* of the values that are written */
    const char *prefix;
} area;

static double across(const area *a, double time)
{
    return a->left + (a->right - a->left) * time / a->t_max;
}

static double down(const area *a, double value)
{
    return a->bottom - (a->bottom - a->top) * (value - a->v_min) / (a->v_max - a->v_min);
}

/* The end of the time axis: 1, 2 or 5 times a power of ten, so that the curve grows along an axis that stands still. */
static double time_end(double time)
{
    if (!(time > 0)) return 1;
    const double power = pow(10, floor(log10(time)));
    static const double ends[] = {1, 2, 5, 10};
    for (int i = 0; i < 4; i++)
        if (time <= ends[i] * power * (1 + 1e-9)) return ends[i] * power;
    return 10 * power;
}

/* Round ends of the value axis that enclose 0 and all values. */
static void find_values(area *a, const sb_inset_plot *plot)
{
    double least = 0, most = 0;
    for (size_t i = 0; i < plot->count; i++) {
        if (!isfinite(plot->rows[i][1])) continue;
        least = fmin(least, plot->rows[i][1]);
        most = fmax(most, plot->rows[i][1]);
    }
    if (!(most - least > 0)) most = 1;
    a->v_step = sb_overlay_tick(most - least, 3);
    /* The curve may pass an end by a twentieth of a step, so that noise about 0 does not add a whole step. */
    a->v_min = floor(least / a->v_step + 0.05) * a->v_step;
    a->v_max = ceil(most / a->v_step - 0.05) * a->v_step;
    const double largest = fmax(fabs(a->v_min), a->v_max);
    static const struct {
        double factor;
        const char *prefix;
    } units[] = {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}};
    a->factor = 1;
    a->prefix = "";
    for (size_t i = 0; i < sizeof units / sizeof *units && a->factor <= 1; i++)
        if (largest >= units[i].factor) {
            a->factor = units[i].factor;
            a->prefix = units[i].prefix;
        }
}

static sb_status draw_axes(sb_image *image, const area *a, sb_error *error)
{
    const double letters = LETTERS * a->unit;
    char label[32];
    sb_status status = SB_OK;
    const int lines = (int)lround((a->v_max - a->v_min) / a->v_step);
    for (int i = 0; i <= lines && status == SB_OK; i++) {
        const double value = a->v_min + i * a->v_step, y = down(a, value);
        const bool zero = fabs(value) < 1e-6 * a->v_step;
        sb_paint_line(image, a->left, y, a->right, y, a->unit, faint, zero ? 0.8 : 0.25);
        snprintf(label, sizeof label, "%.6g", zero ? 0 : value / a->factor);
        status = sb_font_draw(image, a->left - 7 * a->unit - sb_font_width(label, letters), y + 0.4 * letters, letters,
                              ink, label, error);
    }
    const int ticks = (int)lround(a->t_max / a->t_step);
    for (int i = 0; i <= ticks && status == SB_OK; i++) {
        const double x = across(a, i * a->t_step);
        sb_paint_line(image, x, a->bottom, x, a->bottom + 4 * a->unit, a->unit, faint, 0.8);
        snprintf(label, sizeof label, i == ticks ? "%.6g s" : "%.6g", i * a->t_step);
        /* The unit stands beside the last number, which is in the middle below its tick as the others are. */
        const double unit = i == ticks ? sb_font_width(" s", letters) : 0;
        status = sb_font_draw(image, x - 0.5 * (sb_font_width(label, letters) - unit), a->bottom + 17 * a->unit,
                              letters, ink, label, error);
    }
    return status;
}

static void draw_curve(sb_image *image, const area *a, const sb_inset_plot *plot)
{
    double x0 = 0, y0 = 0;
    bool begun = false;
    for (size_t i = 0; i < plot->count; i++) {
        const bool there = isfinite(plot->rows[i][1]);
        const double x = across(a, plot->rows[i][0]), y = there ? down(a, plot->rows[i][1]) : 0;
        if (there && begun) sb_paint_line(image, x0, y0, x, y, 1.8 * a->unit, curve, 1);
        begun = there;
        x0 = x;
        y0 = y;
    }
    if (begun) sb_paint_disc(image, x0, y0, 3.2 * a->unit, curve, 1);
}

static sb_status draw_title(sb_image *image, const area *a, const sb_inset_plot *plot, sb_error *error)
{
    const double letters = LETTERS * 1.1 * a->unit, y = a->top - 11 * a->unit;
    const double left = a->left - (PAD_LEFT - 10) * a->unit;
    char now[64] = "no value yet";
    const double value = plot->count > 0 ? plot->rows[plot->count - 1][1] : (double)NAN;
    if (isfinite(value))
        snprintf(now, sizeof now, "%.3g %s%s", value / a->factor, a->prefix, plot->unit);
    else if (plot->count > 0)
        snprintf(now, sizeof now, "dry");
    const double wide = sb_font_width(now, letters), room = a->right - left - wide - 8 * a->unit;
    const double title = sb_font_width(plot->title, letters);
    sb_status status =
        sb_font_draw(image, left, y, title > room ? letters * room / title : letters, ink, plot->title, error);
    return status == SB_OK ? sb_font_draw(image, a->right - wide, y, letters, curve, now, error) : status;
}

sb_status sb_inset_draw(sb_image *image, size_t slot, const sb_inset_plot *plot, sb_error *error)
{
    if (image->height < SB_OVERLAY_HEIGHT_MIN) return SB_OK;
    const double unit = fmax(0.6, image->height / 720.0);
    const double bottom = image->height - (BOTTOM + (double)slot * (HEIGHT + GAP)) * unit;
    const double top = bottom - HEIGHT * unit, left = LEFT * unit, right = left + WIDTH * unit;
    area a = {.unit = unit,
              .left = left + PAD_LEFT * unit,
              .right = right - PAD_RIGHT * unit,
              .top = top + PAD_TOP * unit,
              .bottom = bottom - PAD_BOTTOM * unit,
              .t_max = time_end(plot->time)};
    a.t_step = sb_overlay_tick(a.t_max, 5);
    find_values(&a, plot);
    sb_paint_box(image, left, top, right, bottom, dark, 0.62);
    sb_status status = draw_axes(image, &a, error);
    if (status == SB_OK) draw_curve(image, &a, plot);
    return status == SB_OK ? draw_title(image, &a, plot, error) : status;
}
