/* One band of rows of a picture of the water, while it is drawn. Private to splat.c and splat_band.c. */
#ifndef SB_RENDER_SPLAT_BAND_H
#define SB_RENDER_SPLAT_BAND_H

#include "base/multiversion.h"
#include "render/water/surfels.h"

#include <math.h>

enum { SB_BAND_ROWS = 16, SB_BAND_SUMS = 7, SB_BAND_LANES = 8 };

/* The pixels of a few rows, while they are drawn. Sums: weight, and weight times depth, value, normal, thickness. */
typedef struct sb_band {
    int first_row, rows, width;
    size_t stride;         /* pixels from one row to the next: the width rounded up to whole vectors */
    float *sums;           /* per row SB_BAND_SUMS times `stride` */
    float *second_sums;    /* of the discs near the second surface */
    float *front, *second; /* m, nearest depths of the two surfaces */
    float *drops;          /* per pixel: optical thickness, its product with value, depth */
    int32_t *open;         /* as in find_open */
} sb_band;

/* The view in pixels. */
typedef struct sb_splat_lens {
    int width, height;
    float step, left, bottom; /* slope of a ray: left + (x + 0.5) step */
    float near, spacing;
} sb_splat_lens;

typedef struct sb_splat_box {
    int x0, x1, y0, y1; /* px, the ends are not included */
} sb_splat_box;

static inline int sb_splat_pixel_of(float x, int size)
{
    return x < 0 ? 0 : x > (float)size ? size : (int)x;
}

/* The pixels that a sphere of this radius around an element may touch. */
static inline sb_splat_box sb_splat_box_of(const sb_splat_lens *lens, const sb_surfel *surfel, float radius)
{
    const float depth = surfel->place[2];
    if (!(depth > lens->near)) return (sb_splat_box){0};
    const float scale = 1 / (depth * lens->step), reach = radius * scale + 1.5f;
    const float x = surfel->place[0] * scale - lens->left / lens->step;
    const float y = surfel->place[1] * scale - lens->bottom / lens->step;
    return (sb_splat_box){sb_splat_pixel_of(x - reach, lens->width), sb_splat_pixel_of(x + reach + 1, lens->width),
                          sb_splat_pixel_of(y - reach, lens->height), sb_splat_pixel_of(y + reach + 1, lens->height)};
}

/* Where a disc is seen. A ray is d = c / c_z + w with w = (u, v, 0), c the disc's centre. It meets the disc's plane at
   a distance of |w p - c (n . w)| / |n . d| from c, p = n . c. In a row, v is given, and u lies between the roots of a
   quadratic equation; in the equations below the terms with the greatest powers of c have cancelled out, for |n| = 1.
 */
typedef struct sb_splat_outline {
    sb_splat_box box;          /* around the disc */
    bool bounded;              /* false: the disc may be anywhere in the box */
    float x, y;                /* centre: px; slope */
    float b, b0;               /* u = -(b v + b0) +- reach sqrt(discriminant) */
    float reach, scale;        /* scale: px per slope */
    float e[3], nx, ny, r2, z; /* discriminant: r2 |e + v (ny, -nx, 0)|^2 - v^2 z^2 */
} sb_splat_outline;

/* A disc is at least as wide as a pixel: half its least width, px. All rounding is below the margin, px. */
#define SB_SPLAT_WIDENED 1.3f
#define SB_SPLAT_MARGIN 0.25f

/* Narrows the rows of the outline's box. */
SB_INLINE void sb_splat_narrow_rows(const sb_splat_lens *lens, sb_splat_outline *o)
{
    const float k = o->z * o->z - o->r2 * (o->nx * o->nx + o->ny * o->ny),
                l = o->r2 * (o->e[0] * o->ny - o->e[1] * o->nx);
    const float m = o->r2 * (o->e[0] * o->e[0] + o->e[1] * o->e[1] + o->e[2] * o->e[2]);
    if (!(k > 0.1f * o->z * o->z)) return;
    const float middle = o->scale * l / k, half = o->scale * sqrtf(l * l + k * m) / k;
    const float at = (o->y - lens->bottom) * o->scale - 0.5f;
    const float low = middle - half < -SB_SPLAT_WIDENED ? middle - half : -SB_SPLAT_WIDENED;
    const float high = middle + half > SB_SPLAT_WIDENED ? middle + half : SB_SPLAT_WIDENED;
    if (at + low - SB_SPLAT_MARGIN > (float)o->box.y0) o->box.y0 = (int)ceilf(at + low - SB_SPLAT_MARGIN);
    if (at + high + 1 + SB_SPLAT_MARGIN < (float)o->box.y1) o->box.y1 = (int)(at + high + 1 + SB_SPLAT_MARGIN);
}

/* part: of the square of the disc's radius. */
SB_INLINE sb_splat_outline sb_splat_outline_of(const sb_splat_lens *lens, const sb_surfel *s, float part)
{
    const float cx = s->place[0], cy = s->place[1], cz = s->place[2], r2 = part * s->radius * s->radius;
    const float nx = s->normal[0], ny = s->normal[1], p = nx * cx + ny * cy + s->normal[2] * cz;
    const float u[3] = {p - nx * cx, -nx * cy, -nx * cz}, v[3] = {-ny * cx, p - ny * cy, -ny * cz};
    const float length2 = u[0] * u[0] + u[1] * u[1] + u[2] * u[2], a = length2 - r2 * nx * nx;
    const float inverse = 1 / cz, over = 1 / a;
    sb_splat_outline o = {.box = sb_splat_box_of(lens, s, s->radius), .nx = nx, .ny = ny, .r2 = r2, .z = cz};
    o.bounded = cz > lens->near && a > 0.1f * length2;
    o.scale = 1 / lens->step;
    o.x = (cx * inverse - lens->left) * o.scale - 0.5f;
    o.y = cy * inverse;
    o.b = (u[0] * v[0] + u[1] * v[1] + u[2] * v[2] - r2 * nx * ny) * over;
    o.b0 = -r2 * nx * p * inverse * over;
    o.reach = fabsf(p) * over;
    for (int k = 0; k < 3; k++) o.e[k] = u[k] * inverse;
    if (o.bounded) sb_splat_narrow_rows(lens, &o);
    return o;
}

/* Draws the elements of the list with the indices `bin` into the rows of a band, and writes the band's pixels to
   `surface` and `cover`, which are the whole pictures of sb_splat. */
void sb_band_draw(sb_band *band, const sb_splat_lens *lens, const sb_surfel *list, const uint32_t *bin, size_t count,
                  float *surface, float *cover);

#endif
