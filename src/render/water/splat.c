/* Draws surface elements band by band (surface splatting [Zwicker et al. 2001], with the blending of all discs near the
   first and near the second surface along a ray). */
#include "render/water/splat.h"

#include "base/memory.h"
#include "render/water/splat_band.h"

#include <string.h>

static sb_splat_lens lens_of(const sb_splat *splat, const sb_view *view, double spacing)
{
    const float step = (float)(2 * view->tangent / splat->height);
    return (sb_splat_lens){
        splat->width,      splat->height, step, -0.5f * step * (float)splat->width, -0.5f * step * (float)splat->height,
        (float)view->near, (float)spacing};
}

sb_status sb_splat_create(int width, int height, sb_splat *splat, sb_error *error)
{
    const size_t pixels = (size_t)width * (size_t)height;
    sb_splat made = {.width = width, .height = height};
    made.surface = sb_alloc(pixels, 4 * sizeof *made.surface);
    made.cover = sb_alloc(pixels, 4 * sizeof *made.cover);
    if (!made.surface || !made.cover) {
        sb_splat_free(&made);
        return sb_fail_memory(error, "the water of a picture");
    }
    *splat = made;
    return SB_OK;
}

void sb_splat_free(sb_splat *splat)
{
    sb_free(splat->surface);
    sb_free(splat->cover);
    sb_free(splat->bins);
    sb_free(splat->first);
    *splat = (sb_splat){0};
}

/* The pixels of an element: of its disc, or also of its drop. */
static sb_splat_box box_of(const sb_splat_lens *lens, const sb_surfel *s)
{
    return s->share < 1 ? sb_splat_box_of(lens, s, s->radius) : sb_splat_outline_of(lens, s, 1).box;
}

/* Sorts the elements by the bands that they touch, each band in the order of the list. */
static sb_status sort(sb_splat *splat, const sb_surfels *surfels, const sb_splat_lens *lens, size_t bands,
                      sb_error *error)
{
    if (sb_grow((void **)&splat->first, &splat->first_capacity, bands + 2, sizeof *splat->first) != 0)
        return sb_fail_memory(error, "the water of a picture");
    memset(splat->first, 0, (bands + 2) * sizeof *splat->first);
    for (size_t i = 0; i < surfels->count; i++) {
        const sb_splat_box box = box_of(lens, &surfels->list[i]);
        for (int b = box.y0 / SB_BAND_ROWS; b * SB_BAND_ROWS < box.y1; b++) splat->first[b + 2]++;
    }
    for (size_t b = 2; b < bands + 2; b++) splat->first[b] += splat->first[b - 1];
    const size_t total = splat->first[bands + 1];
    if (sb_grow((void **)&splat->bins, &splat->bin_capacity, total, sizeof *splat->bins) != 0)
        return sb_fail_memory(error, "the water of a picture");
    for (size_t i = 0; i < surfels->count; i++) {
        const sb_splat_box box = box_of(lens, &surfels->list[i]);
        for (int b = box.y0 / SB_BAND_ROWS; b * SB_BAND_ROWS < box.y1; b++)
            splat->bins[splat->first[b + 1]++] = (uint32_t)i;
    }
    return SB_OK;
}

static size_t stride_of(int width)
{
    return ((size_t)width + SB_BAND_LANES - 1) / SB_BAND_LANES * SB_BAND_LANES;
}

/* The memory of one thread: the parts of a band one after the other. */
static sb_band band_at(float *memory, int width)
{
    const size_t pixels = stride_of(width) * SB_BAND_ROWS;
    sb_band band = {.width = width, .stride = stride_of(width), .sums = memory};
    band.second_sums = band.sums + SB_BAND_SUMS * pixels;
    band.front = band.second_sums + SB_BAND_SUMS * pixels;
    band.second = band.front + pixels;
    band.drops = band.second + pixels;
    band.open = (int32_t *)(band.drops + 3 * pixels);
    return band;
}

sb_status sb_splat_draw(sb_splat *splat, const sb_surfels *surfels, const sb_view *view, double spacing, int threads,
                        sb_error *error)
{
    const sb_splat_lens lens = lens_of(splat, view, spacing);
    const int bands = (splat->height + SB_BAND_ROWS - 1) / SB_BAND_ROWS;
    const size_t size = stride_of(splat->width) * (2 * SB_BAND_SUMS + 6) * SB_BAND_ROWS + SB_BAND_ROWS + SB_BAND_LANES;
    float *memory = sb_alloc(size * (size_t)threads, sizeof *memory);
    if (!memory) return sb_fail_memory(error, "the water of a picture");
    sb_status status = sort(splat, surfels, &lens, (size_t)bands, error);
    if (status == SB_OK) {
        int next = 0;
#pragma omp parallel for num_threads(threads) schedule(static)
        for (int t = 0; t < threads; t++) {
            sb_band band = band_at(memory + size * (size_t)t, splat->width);
            for (;;) {
                int b;
#pragma omp atomic capture
                b = next++;
                if (b >= bands) break;
                band.first_row = b * SB_BAND_ROWS;
                band.rows =
                    splat->height - band.first_row < SB_BAND_ROWS ? splat->height - band.first_row : SB_BAND_ROWS;
                sb_band_draw(&band, &lens, surfels->list, splat->bins + splat->first[b],
                             splat->first[b + 1] - splat->first[b], splat->surface, splat->cover);
            }
        }
    }
    sb_free(memory);
    return status;
}
