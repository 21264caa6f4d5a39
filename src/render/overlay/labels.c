#include "render/overlay/labels.h"

#include "render/overlay/font.h"
#include "render/overlay/paint.h"

#include <math.h>

static const double LETTERS = 11; /* px in a picture that is 720 px high */
static const float dark[3] = {0.04f, 0.07f, 0.11f}, ink[3] = {0.97f, 0.98f, 0.99f};

static double unit_of(const sb_image *image)
{
    return fmax(0.7, image->height / 720.0);
}

bool sb_labels_project(const sb_view *view, const sb_image *image, sb_vec3 at, double *x, double *y)
{
    const sb_vec3 from = sb_sub(at, view->eye);
    const double depth = -sb_dot(from, view->back);
    if (!(depth > 0.5 * view->near)) return false;
    *x = 0.5 * image->width * (1 + sb_dot(from, view->right) / (depth * view->tangent * view->aspect));
    *y = 0.5 * image->height * (1 - sb_dot(from, view->up) / (depth * view->tangent));
    return true;
}

/* Moves a place behind the eye along the line to one before it. */
static sb_vec3 before_eye(const sb_view *view, sb_vec3 at, sb_vec3 other)
{
    const double depth = -sb_dot(sb_sub(at, view->eye), view->back);
    const double ahead = -sb_dot(sb_sub(other, view->eye), view->back);
    if (depth > view->near || !(ahead > depth)) return at;
    return sb_madd(at, (view->near - depth) / (ahead - depth), sb_sub(other, at));
}

void sb_labels_line(sb_image *image, const sb_view *view, sb_vec3 from, sb_vec3 to, const float rgb[3])
{
    double x0, y0, x1, y1;
    const sb_vec3 a = before_eye(view, from, to), b = before_eye(view, to, from);
    if (!sb_labels_project(view, image, a, &x0, &y0) || !sb_labels_project(view, image, b, &x1, &y1)) return;
    /* Coordinates far outside of the picture are the same line with more px to visit. */
    const double far = 1e4;
    if (fabs(x0) > far || fabs(x1) > far || fabs(y0) > far || fabs(y1) > far) return;
    sb_paint_line(image, x0, y0, x1, y1, 3 * unit_of(image), dark, 0.35);
    sb_paint_line(image, x0, y0, x1, y1, 1.5 * unit_of(image), rgb, 1);
}

static bool is_free(const sb_labels *labels, const sb_image *image, double x0, double y0, double x1, double y1)
{
    if (x0 < 2 || y0 < 2 || x1 > image->width - 2 || y1 > image->height - 2) return false;
    for (size_t i = 0; i < labels->count; i++)
        if (x0 < labels->box[i].x1 && x1 > labels->box[i].x0 && y0 < labels->box[i].y1 && y1 > labels->box[i].y0)
            return false;
    return true;
}

/* Finds a free box near a place, to its right or left, nearer ones first. */
static bool find_box(const sb_labels *labels, const sb_image *image, double x, double y, double width, double height,
                     double *left, double *top)
{
    enum { ROWS = 16 };
    for (int row = 0; row < ROWS; row++)
        for (int side = 0; side < 4; side++) {
            const double dx = (12 + 6 * row) * unit_of(image), dy = (row + 0.9) * 1.15 * height;
            *left = side % 2 ? x - dx - width : x + dx;
            *top = (side < 2 ? y - dy : y + dy) - 0.5 * height;
            if (is_free(labels, image, *left, *top, *left + width, *top + height)) return true;
        }
    return false;
}

sb_status sb_labels_add(sb_labels *labels, sb_image *image, const sb_view *view, sb_vec3 at, const float rgb[3],
                        const char *text, sb_error *error)
{
    const double unit = unit_of(image), letters = LETTERS * unit, pad = 5 * unit;
    const double width = sb_font_width(text, letters) + 2 * pad, height = letters + 2 * pad;
    double x, y, left, top;
    if (!sb_labels_project(view, image, at, &x, &y) || x < 0 || y < 0 || x > image->width || y > image->height)
        return SB_OK;
    sb_paint_disc(image, x, y, 4.5 * unit, dark, 0.5);
    sb_paint_disc(image, x, y, 3.2 * unit, rgb, 1);
    if (labels->count == SB_LABELS_MAX || !find_box(labels, image, x, y, width, height, &left, &top)) {
        labels->left_out++;
        return SB_OK;
    }
    labels->box[labels->count].x0 = left;
    labels->box[labels->count].y0 = top;
    labels->box[labels->count].x1 = left + width;
    labels->box[labels->count++].y1 = top + height;
    sb_paint_line(image, x, y, left > x ? left : left + width, top + 0.5 * height, 1.2 * unit, rgb, 0.9);
    sb_paint_box(image, left, top, left + width, top + height, dark, 0.72);
    sb_paint_box(image, left, top, left + 2 * unit, top + height, rgb, 1);
    return sb_font_draw(image, left + pad, top + height - pad, letters, ink, text, error);
}
