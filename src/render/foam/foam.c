/* Draws the discs of foam, a band of rows at a time. */
#include "render/foam/foam.h"

#include "base/memory.h"
#include "base/multiversion.h"

#include <string.h>

enum { BAND = 16 };

/* Pixels [x0, x1) of rows [y0, y1). */
struct box {
    int x0, x1, y0, y1;
};

static int pixel_of(float x, int size)
{
    return x < 0 ? 0 : x > (float)size ? size : (int)x;
}

static struct box box_of(const sb_foam_lens *lens, const sb_foam_ground *ground, const sb_foam_mark *mark)
{
    if (!(mark->strength > 0)) return (struct box){0};
    const float scale = 1 / (mark->place[2] * lens->step), reach = mark->radius * scale + 0.5f;
    const float x = mark->place[0] * scale - lens->left / lens->step;
    const float y = mark->place[1] * scale - lens->bottom / lens->step;
    return (struct box){pixel_of(x - reach, ground->width), pixel_of(x + reach + 1, ground->width),
                        pixel_of(y - reach, ground->height), pixel_of(y + reach + 1, ground->height)};
}

/* Adds a disc to the pixels of one row. z: depth of the disc at a pixel is that of the surface, or its own. */
SB_INLINE void add_row(const sb_foam_lens *lens, const sb_foam_ground *ground, const sb_foam_mark *mark, int y, int x0,
                       int x1, float hidden, float *row)
{
    const float inverse = 1 / (mark->radius * mark->radius), slope_y = lens->bottom + ((float)y + 0.5f) * lens->step;
    const bool in_air = mark->layer == 1;
    for (int x = x0; x < x1; x++) {
        const size_t pixel = (size_t)y * (size_t)ground->width + (size_t)x;
        const float water = sb_foam_water_depth(lens, ground, pixel);
        const float z = in_air ? mark->place[2] : water;
        if (in_air && (z > sb_foam_body_depth(lens, ground, pixel) || (water > 0 && z > water + hidden))) continue;
        const float dx = (lens->left + ((float)x + 0.5f) * lens->step) * z - mark->place[0];
        const float dy = slope_y * z - mark->place[1], dz = z - mark->place[2];
        const float in = 1 - (dx * dx + dy * dy + dz * dz) * inverse;
        if (!(in > 0) || !(z > 0)) continue;
        float *to = row + 4 * x;
        to[mark->layer] += mark->strength * in * in;
        if (in_air) to[2] = to[2] > 0 && to[2] < z ? to[2] : z;
    }
}

SB_MULTIVERSION
static void draw_band(const sb_foam_lens *lens, const sb_foam_ground *ground, int band, const sb_foam_mark *marks,
                      const uint32_t *bin, size_t count, float hidden, float *pixels)
{
    const int low = band * BAND, high = low + BAND < ground->height ? low + BAND : ground->height;
    const size_t row = 4 * (size_t)ground->width;
    memset(pixels + (size_t)low * row, 0, (size_t)(high - low) * row * sizeof *pixels);
    for (size_t k = 0; k < count; k++) {
        const sb_foam_mark *mark = &marks[bin[k]];
        const struct box box = box_of(lens, ground, mark);
        const int y0 = box.y0 > low ? box.y0 : low, y1 = box.y1 < high ? box.y1 : high;
        for (int y = y0; y < y1; y++) add_row(lens, ground, mark, y, box.x0, box.x1, hidden, pixels + (size_t)y * row);
    }
    for (float *p = pixels + (size_t)low * row; p < pixels + (size_t)high * row; p += 4) {
        if (p[0] > 0) p[0] = 1 - expf(-p[0]);
        if (p[1] > 0) p[1] = 1 - expf(-p[1]);
        if (p[3] > 0) p[3] = 1 - expf(-p[3]);
    }
}

/* Sorts the discs by the bands that they touch, each band in their order. */
static sb_status sort(sb_foam_layer *layer, size_t marks, const sb_foam_lens *lens, const sb_foam_ground *ground,
                      size_t bands, sb_error *error)
{
    if (sb_grow((void **)&layer->first, &layer->first_capacity, bands + 2, sizeof *layer->first) != 0)
        return sb_fail_memory(error, "the foam of a picture");
    memset(layer->first, 0, (bands + 2) * sizeof *layer->first);
    for (size_t i = 0; i < marks; i++) {
        const struct box box = box_of(lens, ground, &layer->marks[i]);
        for (int b = box.y0 / BAND; b * BAND < box.y1; b++) layer->first[b + 2]++;
    }
    for (size_t b = 2; b < bands + 2; b++) layer->first[b] += layer->first[b - 1];
    if (sb_grow((void **)&layer->bins, &layer->bin_capacity, layer->first[bands + 1], sizeof *layer->bins) != 0)
        return sb_fail_memory(error, "the foam of a picture");
    for (size_t i = 0; i < marks; i++) {
        const struct box box = box_of(lens, ground, &layer->marks[i]);
        for (int b = box.y0 / BAND; b * BAND < box.y1; b++) layer->bins[layer->first[b + 1]++] = (uint32_t)i;
    }
    return SB_OK;
}

sb_status sb_foam_draw(sb_foam_layer *layer, const sb_frame *frame, const sb_view *view, const sb_foam_ground *ground,
                       int threads, sb_error *error)
{
    const size_t count = frame->foam.count, pixels = (size_t)ground->width * (size_t)ground->height;
    const sb_foam_lens lens = sb_foam_lens_of(view, ground);
    const int bands = (ground->height + BAND - 1) / BAND;
    const float hidden = 0.3f * (float)frame->spacing;
    if (sb_grow((void **)&layer->pixels, &layer->pixel_capacity, pixels, 4 * sizeof *layer->pixels) != 0 ||
        sb_grow((void **)&layer->marks, &layer->mark_capacity, count, sizeof *layer->marks) != 0)
        return sb_fail_memory(error, "the foam of a picture");
    sb_foam_marks(frame, view, ground, threads, layer->marks);
    const sb_status status = sort(layer, count, &lens, ground, (size_t)bands, error);
    if (status != SB_OK) return status;
#pragma omp parallel for num_threads(threads) schedule(dynamic)
    for (int b = 0; b < bands; b++)
        draw_band(&lens, ground, b, layer->marks, layer->bins + layer->first[b], layer->first[b + 1] - layer->first[b],
                  hidden, layer->pixels);
    return SB_OK;
}

void sb_foam_layer_free(sb_foam_layer *layer)
{
    sb_free(layer->pixels);
    sb_free(layer->marks);
    sb_free(layer->bins);
    sb_free(layer->first);
    *layer = (sb_foam_layer){0};
}
