/* Draws surface elements into a band of rows: discs whose depths, normals and values are blended by smooth weights. */
#include "render/splat_band.h"

#include <math.h>
#include <string.h>

static const float drop_spacings = 0.3f; /* radius of a single drop */
/* Weights above this define the nearest depths. */
static const float front_weight = 0.16f, front_share = 0.3f; /* of discs; of their element in a surface */
/* The sum of weights at the edge of a surface: no water and only water. An unbroken layer of discs has about 2.7. */
static const float cover_none = 0.22f, cover_all = 0.62f;
static const float drop_opacity = 1.4f; /* optical thickness at the centre of a drop */

/* Computes the weights and depths of a disc in the pixels [x0, x1) of a row: (1 - r^2 / R^2)^2 at the point where the
   ray hits the disc's plane. A disc that is smaller than a pixel is widened to one. */
SB_INLINE void weigh_row(const sb_splat_lens *lens, const sb_surfel *s, int row, int x0, int x1, float radius,
                         float *restrict weight, float *restrict depth)
{
    const float slope_y = lens->bottom + ((float)row + 0.5f) * lens->step;
    const float cx = s->place[0], cy = s->place[1], cz = s->place[2];
    const float nx = s->normal[0], nz = s->normal[2] + s->normal[1] * slope_y;
    const float plane = nx * cx + s->normal[1] * cy + s->normal[2] * cz;
    const float inverse = 1 / (radius * radius), left = lens->left + 0.5f * lens->step, step = lens->step;
    const float small = 1 / (1.6f * cz * cz * step * step);
    const float off_y = slope_y * cz - cy;
#pragma omp simd
    for (int x = x0; x < x1; x++) {
        const float slope = left + (float)x * step, facing = nx * slope + nz;
        const float z = plane / (facing < -1e-6f ? facing : -1e-6f);
        const float dx = slope * z - cx, dy = slope_y * z - cy, dz = z - cz;
        const float in = 1 - (dx * dx + dy * dy + dz * dz) * inverse, inside = in > 0 ? in : 0;
        const float off_x = slope * cz - cx, near = 1 - (off_x * off_x + off_y * off_y) * small;
        const float w = inside * inside, v = near > 0 ? 0.5f * near * near : 0;
        weight[x] = w > v ? w : v;
        depth[x] = w > v ? z : cz;
    }
}

/* Counts the pixels of each row up to each column that the first surface does not cover: only there is the second
   surface needed. */
static void find_open(sb_band *band)
{
    for (int y = 0; y < band->rows; y++) {
        int32_t *open = band->open + (size_t)y * ((size_t)band->width + 1);
        const float *sums = band->sums + SB_BAND_SUMS * (size_t)y * (size_t)band->width;
        open[0] = 0;
        for (int x = 0; x < band->width; x++) open[x + 1] = open[x] + (sums[SB_BAND_SUMS * (size_t)x] < cover_all);
    }
}

/* Whether the first surface leaves a pixel of [x0, x1) in a row. */
SB_INLINE bool is_open(const sb_band *band, int y, int x0, int x1)
{
    const int32_t *open = band->open + (size_t)(y - band->first_row) * ((size_t)band->width + 1);
    return x1 > x0 && open[x1] > open[x0];
}

/* Distance along the ray within which discs are parts of one surface. It is larger where the surface is seen at a small
   angle. */
SB_INLINE float room_of(const sb_splat_lens *lens, const sb_surfel *s)
{
    const float distance = sqrtf(s->place[0] * s->place[0] + s->place[1] * s->place[1] + s->place[2] * s->place[2]);
    const float facing = -(s->normal[0] * s->place[0] + s->normal[1] * s->place[1] + s->normal[2] * s->place[2]);
    return lens->spacing * (0.7f + 0.6f * distance / (facing > 0.1f * distance ? facing : 0.1f * distance));
}

/* The rows of a band that an element touches. */
struct rows {
    sb_splat_box box;
    int low, high;
};

SB_INLINE struct rows rows_of(const sb_band *band, const sb_splat_lens *lens, const sb_surfel *s)
{
    const sb_splat_box box = sb_splat_box_of(lens, s, s->radius);
    const int top = band->first_row + band->rows;
    return (struct rows){box, box.y0 > band->first_row ? box.y0 : band->first_row, box.y1 < top ? box.y1 : top};
}

/* Finds the nearest depth of the first surface. */
SB_INLINE void find_front(sb_band *band, const sb_splat_lens *lens, const sb_surfel *s)
{
    const struct rows r = rows_of(band, lens, s);
    if (s->share < front_share) return;
    for (int y = r.low; y < r.high; y++) {
        float *restrict front = band->front + (size_t)(y - band->first_row) * (size_t)band->width;
        const float *restrict weight = band->weight, *restrict depth = band->depth;
        weigh_row(lens, s, y, r.box.x0, r.box.x1, s->radius, band->weight, band->depth);
#pragma omp simd
        for (int x = r.box.x0; x < r.box.x1; x++)
            front[x] = weight[x] > front_weight && depth[x] < front[x] ? depth[x] : front[x];
    }
}

/* Finds the nearest depth of the second surface, which is behind the first. */
SB_INLINE void find_second(sb_band *band, const sb_splat_lens *lens, const sb_surfel *s)
{
    const struct rows r = rows_of(band, lens, s);
    const float room = room_of(lens, s);
    if (s->share < front_share) return;
    for (int y = r.low; y < r.high; y++) {
        const size_t row = (size_t)(y - band->first_row) * (size_t)band->width;
        if (!is_open(band, y, r.box.x0, r.box.x1)) continue;
        float *restrict second = band->second + row;
        const float *restrict front = band->front + row, *restrict weight = band->weight, *restrict depth = band->depth;
        weigh_row(lens, s, y, r.box.x0, r.box.x1, s->radius, band->weight, band->depth);
#pragma omp simd
        for (int x = r.box.x0; x < r.box.x1; x++)
            second[x] =
                weight[x] > front_weight && depth[x] < second[x] && depth[x] > front[x] + room ? depth[x] : second[x];
    }
}

/* Adds a disc to the sums of the first surface, or to those of the second one. */
SB_INLINE void add_disc(sb_band *band, const sb_splat_lens *lens, const sb_surfel *s, bool second)
{
    const struct rows r = rows_of(band, lens, s);
    const float narrow = 1 / room_of(lens, s);
    for (int y = r.low; y < r.high; y++) {
        const size_t row = (size_t)(y - band->first_row) * (size_t)band->width;
        if (second && !is_open(band, y, r.box.x0, r.box.x1)) continue;
        const float *restrict front = band->front + row, *restrict nearest =
                                                             (second ? band->second : band->front) + row;
        const float *restrict weight = band->weight, *restrict depth = band->depth;
        weigh_row(lens, s, y, r.box.x0, r.box.x1, s->radius, band->weight, band->depth);
        for (int x = r.box.x0; x < r.box.x1; x++) {
            if (!(weight[x] > 0)) continue;
            const bool behind = depth[x] > front[x] && (depth[x] - front[x]) * narrow >= 1;
            const float past = (depth[x] - nearest[x]) * narrow, off = past > 0 ? past : 0;
            const float w = off < 1 ? s->share * weight[x] * (1 - off * off) : 0;
            if (behind != second || !(w > 0)) continue;
            float *restrict sums = (second ? band->second_sums : band->sums) + SB_BAND_SUMS * (row + (size_t)x);
            const float parts[SB_BAND_SUMS] = {
                1, depth[x], s->value, s->normal[0], s->normal[1], s->normal[2], s->thickness, 0};
            for (int k = 0; k < SB_BAND_SUMS; k++) sums[k] += w * parts[k];
        }
    }
}

SB_INLINE void add_drop(sb_band *band, const sb_splat_lens *lens, const sb_surfel *s, float radius)
{
    const float pixel = s->place[2] * lens->step, wide = radius > 0.9f * pixel ? radius : 0.9f * pixel;
    const float strength = (1 - s->share) * drop_opacity * (radius * radius) / (wide * wide);
    const sb_splat_box box = sb_splat_box_of(lens, s, wide);
    const int low = box.y0 > band->first_row ? box.y0 : band->first_row;
    const int top = band->first_row + band->rows, high = box.y1 < top ? box.y1 : top;
    const float inverse = 1 / (wide * wide);
    for (int y = low; y < high; y++)
        for (int x = box.x0; x < box.x1; x++) {
            const size_t at = (size_t)(y - band->first_row) * (size_t)band->width + (size_t)x;
            const float dx = (lens->left + ((float)x + 0.5f) * lens->step) * s->place[2] - s->place[0];
            const float dy = (lens->bottom + ((float)y + 0.5f) * lens->step) * s->place[2] - s->place[1];
            const float in = 1 - (dx * dx + dy * dy) * inverse;
            if (in <= 0 || s->place[2] > band->front[at] + lens->spacing) continue;
            float *drops = band->drops + 3 * at;
            drops[0] += strength * in;
            drops[1] += strength * in * s->value;
            drops[2] = drops[2] > 0 && drops[2] < s->place[2] ? drops[2] : s->place[2];
        }
}

static float ramp(float low, float high, float x)
{
    const float t = (x - low) / (high - low), s = t < 0 ? 0 : t > 1 ? 1 : t;
    return s * s * (3 - 2 * s);
}

/* Blends the first surface with the second one where it does not cover the pixel. */
static void resolve_pixel(const float *first, const float *second, const float *drops, float *surface, float *cover)
{
    const float share = ramp(cover_none, cover_all, first[0]), rest = ramp(cover_none, cover_all, second[0]);
    const float back = (1 - share) * rest, covered = share + back;
    const float one = share > 0 ? share / first[0] : 0, two = back > 0 ? back / second[0] : 0;
    float mixed[SB_BAND_SUMS];
    for (int k = 0; k < SB_BAND_SUMS; k++) mixed[k] = one * first[k] + two * second[k];
    float length = sqrtf(mixed[3] * mixed[3] + mixed[4] * mixed[4] + mixed[5] * mixed[5]);
    length = length > 0 ? 1 / length : 0;
    const float inverse = covered > 0 ? 1 / covered : 0;
    /* Depths are not blended: between two surfaces there is nothing. */
    surface[0] = covered > 0 ? share >= back ? first[1] / first[0] : second[1] / second[0] : 0;
    surface[1] = covered > 0 ? mixed[2] * inverse : drops[0] > 0 ? drops[1] / drops[0] : 0;
    surface[2] = mixed[3] * length;
    surface[3] = mixed[4] * length;
    cover[0] = covered;
    cover[1] = mixed[6] * inverse;
    cover[2] = 1 - expf(-drops[0]);
    cover[3] = drops[2];
}

static void resolve(const sb_band *band, float *surface, float *cover)
{
    const size_t count = (size_t)band->rows * (size_t)band->width,
                 start = (size_t)band->first_row * (size_t)band->width;
    for (size_t i = 0; i < count; i++)
        resolve_pixel(band->sums + SB_BAND_SUMS * i, band->second_sums + SB_BAND_SUMS * i, band->drops + 3 * i,
                      surface + 4 * (start + i), cover + 4 * (start + i));
}

SB_MULTIVERSION void sb_band_draw(sb_band *band, const sb_splat_lens *lens, const sb_surfel *list, const uint32_t *bin,
                                  size_t count, float *surface, float *cover)
{
    const size_t pixels = (size_t)band->rows * (size_t)band->width;
    const float drop = drop_spacings * lens->spacing;
    memset(band->sums, 0, SB_BAND_SUMS * pixels * sizeof *band->sums);
    memset(band->second_sums, 0, SB_BAND_SUMS * pixels * sizeof *band->second_sums);
    memset(band->drops, 0, 3 * pixels * sizeof *band->drops);
    for (size_t i = 0; i < pixels; i++) band->front[i] = band->second[i] = HUGE_VALF;
    for (size_t k = 0; k < count; k++) find_front(band, lens, &list[bin[k]]);
    for (size_t k = 0; k < count; k++) {
        const sb_surfel *s = &list[bin[k]];
        if (s->share > 0) add_disc(band, lens, s, false);
        if (s->share < 1) add_drop(band, lens, s, drop);
    }
    find_open(band);
    for (size_t k = 0; k < count; k++) find_second(band, lens, &list[bin[k]]);
    for (size_t k = 0; k < count; k++)
        if (list[bin[k]].share > 0) add_disc(band, lens, &list[bin[k]], true);
    resolve(band, surface, cover);
}
