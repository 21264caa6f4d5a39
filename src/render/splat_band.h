/* One band of rows of a picture of the water, while it is drawn. Private to splat.c and splat_band.c. */
#ifndef SB_RENDER_SPLAT_BAND_H
#define SB_RENDER_SPLAT_BAND_H

#include "base/multiversion.h"
#include "render/surfels.h"

enum { SB_BAND_ROWS = 16, SB_BAND_SUMS = 8 };

/* The pixels of a few rows, while they are drawn. Sums: weight, and weight times depth, value, normal,
   thickness, 0. */
typedef struct sb_band {
    int first_row, rows, width;
    float *sums;           /* SB_BAND_SUMS per pixel */
    float *second_sums;    /* of the discs near the second surface */
    float *front, *second; /* m, nearest depths of the two surfaces */
    float *drops;          /* per pixel: optical thickness, its product with value, depth */
    float *weight, *depth; /* of one row */
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

/* Draws the elements of the list with the indices `bin` into the rows of a band, and writes the band's pixels to
   `surface` and `cover`, which are the whole pictures of sb_splat. */
void sb_band_draw(sb_band *band, const sb_splat_lens *lens, const sb_surfel *list, const uint32_t *bin, size_t count,
                  float *surface, float *cover);

#endif
