#include "report/map_figure.h"

#include "base/memory.h"
#include "report/html.h"

#include <math.h>

/* A step of 1, 2 or 5 times a power of ten, of which about four fit into the length. */
static double tick_of(double length)
{
    const double rough = length / 4, power = pow(10, floor(log10(rough))), ratio = rough / power;
    return power * (ratio < 1.5 ? 1 : ratio < 3.5 ? 2 : ratio < 7.5 ? 5 : 10);
}

/* Coordinates of the drawing: px, 100 per shorter side or more; y points down. */
typedef struct frame {
    double x_min, y_max, scale, width, height;
} frame;

static double px(const frame *f, double x)
{
    return (x - f->x_min) * f->scale;
}

static double py(const frame *f, double y)
{
    return (f->y_max - y) * f->scale;
}

static void put_axes(FILE *out, const frame *f)
{
    char figure[SB_FIGURE_MAX];
    const double length_x = f->width / f->scale, length_y = f->height / f->scale;
    const double tick = tick_of(fmax(length_x, length_y)), y_min = f->y_max - length_y;
    fputs("<g class=\"axes\">", out);
    for (double x = ceil(f->x_min / tick) * tick; x <= f->x_min + length_x * 1.0001; x += tick)
        fprintf(out, "<path d=\"M%.1f %.1fv6\"/><text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%s</text>", px(f, x),
                f->height, px(f, x), f->height + 22, sb_figure(figure, x));
    for (double y = ceil(y_min / tick) * tick; y <= f->y_max * 1.0001; y += tick)
        fprintf(out, "<path d=\"M0 %.1fh-6\"/><text x=\"-10\" y=\"%.1f\" text-anchor=\"end\">%s</text>", py(f, y),
                py(f, y) + 5, sb_figure(figure, y));
    fputs("</g>", out);
}

static bool inside(const frame *f, double x, double y)
{
    return px(f, x) >= 0 && px(f, x) <= f->width && py(f, y) >= 0 && py(f, y) <= f->height;
}

static void put_marks(FILE *out, const frame *f, const sb_map_mark *marks, size_t count)
{
    fputs("<g class=\"marks\">", out);
    for (size_t i = 0; i < count; i++) {
        if (!inside(f, marks[i].x, marks[i].y)) continue;
        const double x = px(f, marks[i].x), y = py(f, marks[i].y);
        if (marks[i].gauge)
            fprintf(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"5\">", x, y);
        else
            fprintf(out, "<rect x=\"%.1f\" y=\"%.1f\" width=\"8\" height=\"8\">", x - 4, y - 4);
        sb_html_put(out, "<title>%s%s</title>", marks[i].gauge ? "gauge " : "", marks[i].name);
        fputs(marks[i].gauge ? "</circle>" : "</rect>", out);
    }
    fputs("</g>", out);
}

static void put_legend(FILE *out, const sb_stops *stops, const char *label, double low, double high)
{
    sb_html_put(out, "<div class=\"scale\"><span>%g</span><i style=\"background:linear-gradient(90deg", low);
    for (size_t k = 0; k < stops->count; k++)
        fprintf(out, ",#%02x%02x%02x %.0f%%", stops->rgb[k][0], stops->rgb[k][1], stops->rgb[k][2], 100 * stops->at[k]);
    sb_html_put(out, ")\"></i><span>%g</span></div><figcaption>%s</figcaption>", high, label);
}

sb_status sb_map_figure(FILE *out, const sb_grid *grid, const sb_map_look *look, const sb_map_mark *marks, size_t count,
                        sb_error *error)
{
    const sb_stops stops = sb_stops_of(look->palette);
    sb_image image = {0};
    unsigned char *bytes = NULL;
    size_t size = 0;
    sb_status status = sb_grid_draw(grid, &stops, look->low, look->high, &image, error);
    if (status == SB_OK) status = sb_png_encode(&image, &bytes, &size, error);
    sb_image_free(&image);
    if (status != SB_OK) return status;
    const double wide = grid->cell * (double)grid->columns, high = grid->cell * (double)grid->rows;
    const double scale = 600 / fmax(wide, high);
    const frame f = {grid->x_min, grid->y_min + high, scale, scale * wide, scale * high};
    fprintf(out, "<figure class=\"map\"><svg viewBox=\"-64 -10 %.1f %.1f\" role=\"img\">", f.width + 84, f.height + 42);
    fprintf(out, "<image width=\"%.1f\" height=\"%.1f\" preserveAspectRatio=\"none\" href=\"data:image/png;base64,",
            f.width, f.height);
    sb_html_base64(out, bytes, size);
    fprintf(out, "\"/><rect class=\"edge\" width=\"%.1f\" height=\"%.1f\"/>", f.width, f.height);
    put_axes(out, &f);
    put_marks(out, &f, marks, count);
    fputs("</svg>", out);
    put_legend(out, &stops, look->label, look->low, look->high);
    fputs("</figure>\n", out);
    sb_free(bytes);
    return SB_OK;
}
