/* Draws surface elements into a band of rows: discs whose depths, normals and values are blended by smooth weights. */
#include "render/water/splat_band.h"

#include <math.h>
#include <string.h>

enum { LANES = SB_BAND_LANES };

static const float drop_spacings = 0.3f; /* radius of a single drop */
/* Weights above this define the nearest depths. */
static const float front_weight = 0.16f, front_share = 0.3f; /* of discs; of their element in a surface */
static const float front_part = 0.6001f; /* of the square of a disc's radius: where its weight is above front_weight */
/* The sum of weights at the edge of a surface: no water and only water. An unbroken layer of discs has about 2.7. */
static const float cover_none = 0.22f, cover_all = 0.62f;
static const float drop_opacity = 1.4f; /* optical thickness at the centre of a drop */

/* The sums of a row of the band, one quantity after the other. */
SB_INLINE float *sums_of(const sb_band *band, float *sums, int y)
{
    return sums + (size_t)SB_BAND_SUMS * (size_t)y * band->stride;
}

/* The pixels of a row that the disc touches. False: there are none. */
SB_INLINE bool row_of(const sb_splat_lens *lens, const sb_splat_outline *o, int row, int *first, int *last)
{
    *first = o->box.x0;
    *last = o->box.x1;
    if (!o->bounded) return true;
    const float v = lens->bottom + ((float)row + 0.5f) * lens->step - o->y;
    const float ex = o->e[0] + v * o->ny, ey = o->e[1] - v * o->nx;
    const float d = o->r2 * (ex * ex + ey * ey + o->e[2] * o->e[2]) - v * v * o->z * o->z;
    const float middle = o->x - o->scale * (o->b * v + o->b0), half = d > 0 ? o->scale * o->reach * sqrtf(d) : 0;
    float low = d > 0 ? middle - half : HUGE_VALF, high = d > 0 ? middle + half : -HUGE_VALF;
    if (fabsf(v) * o->scale < SB_SPLAT_WIDENED) {
        low = low < o->x - SB_SPLAT_WIDENED ? low : o->x - SB_SPLAT_WIDENED;
        high = high > o->x + SB_SPLAT_WIDENED ? high : o->x + SB_SPLAT_WIDENED;
    }
    if (!(low <= high)) return false;
    if (low - SB_SPLAT_MARGIN > (float)*first) *first = (int)ceilf(low - SB_SPLAT_MARGIN);
    if (high + 1 + SB_SPLAT_MARGIN < (float)*last) *last = (int)(high + 1 + SB_SPLAT_MARGIN);
    return *first < *last;
}

/* Computes the weights and depths of a disc in LANES pixels of a row from x on: (1 - r^2 / R^2)^2 at the point where
   the ray hits the disc's plane. A disc that is smaller than a pixel is widened to one. */
SB_INLINE void weigh(const sb_splat_lens *lens, const sb_surfel *s, const sb_splat_box *box, int row, int x,
                     float weight[LANES], float depth[LANES])
{
    const float slope_y = lens->bottom + ((float)row + 0.5f) * lens->step;
    const float cx = s->place[0], cy = s->place[1], cz = s->place[2];
    const float nx = s->normal[0], nz = s->normal[2] + s->normal[1] * slope_y;
    const float plane = nx * cx + s->normal[1] * cy + s->normal[2] * cz;
    const float inverse = 1 / (s->radius * s->radius), left = lens->left + 0.5f * lens->step, step = lens->step;
    const float small = 1 / (1.6f * cz * cz * step * step);
    const float off_y = slope_y * cz - cy;
    const int x0 = box->x0, x1 = box->x1;
#pragma omp simd
    for (int k = 0; k < LANES; k++) {
        const float slope = left + (float)(x + k) * step, facing = nx * slope + nz;
        const float z = plane / (facing < -1e-6f ? facing : -1e-6f);
        const float dx = slope * z - cx, dy = slope_y * z - cy, dz = z - cz;
        const float in = 1 - (dx * dx + dy * dy + dz * dz) * inverse, inside = in > 0 ? in : 0;
        const float off_x = slope * cz - cx, near = 1 - (off_x * off_x + off_y * off_y) * small;
        const float w = inside * inside, v = near > 0 ? 0.5f * near * near : 0, most = w > v ? w : v;
        weight[k] = x + k >= x0 && x + k < x1 ? most : 0;
        depth[k] = w > v ? z : cz;
    }
}

/* Counts the pixels of each row up to each column that the first surface does not cover: only there is the second
   surface needed. Returns their number. */
static int32_t find_open(sb_band *band)
{
    int32_t all = 0;
    for (int y = 0; y < band->rows; y++) {
        int32_t *open = band->open + (size_t)y * ((size_t)band->width + 1);
        const float *sum = sums_of(band, band->sums, y);
        open[0] = 0;
        for (int x = 0; x < band->width; x++) open[x + 1] = open[x] + (sum[x] < cover_all);
        all += open[band->width];
    }
    return all;
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

/* The rows of a band that a disc touches. */
struct rows {
    sb_splat_outline disc;
    int low, high;
};

SB_INLINE struct rows rows_of(const sb_band *band, const sb_splat_lens *lens, const sb_surfel *s, float part)
{
    const sb_splat_outline disc = sb_splat_outline_of(lens, s, part);
    const int top = band->first_row + band->rows;
    return (struct rows){disc, disc.box.y0 > band->first_row ? disc.box.y0 : band->first_row,
                         disc.box.y1 < top ? disc.box.y1 : top};
}

/* Finds the nearest depth of the first surface. */
SB_INLINE void find_front(sb_band *band, const sb_splat_lens *lens, const sb_surfel *s)
{
    if (s->share < front_share) return;
    const struct rows r = rows_of(band, lens, s, front_part);
    int first, last;
    for (int y = r.low; y < r.high; y++) {
        if (!row_of(lens, &r.disc, y, &first, &last)) continue;
        float *restrict front = band->front + (size_t)(y - band->first_row) * band->stride;
        for (int x = first; x < last; x += LANES) {
            float weight[LANES], depth[LANES];
            weigh(lens, s, &r.disc.box, y, x, weight, depth);
#pragma omp simd
            for (int k = 0; k < LANES; k++)
                front[x + k] = weight[k] > front_weight && depth[k] < front[x + k] ? depth[k] : front[x + k];
        }
    }
}

/* Finds the nearest depth of the second surface, which is behind the first. */
SB_INLINE void find_second(sb_band *band, const sb_splat_lens *lens, const sb_surfel *s)
{
    if (s->share < front_share) return;
    const struct rows r = rows_of(band, lens, s, front_part);
    const float room = room_of(lens, s);
    int first, last;
    for (int y = r.low; y < r.high; y++) {
        const size_t row = (size_t)(y - band->first_row) * band->stride;
        if (!is_open(band, y, r.disc.box.x0, r.disc.box.x1) || !row_of(lens, &r.disc, y, &first, &last)) continue;
        float *restrict second = band->second + row;
        const float *restrict front = band->front + row;
        for (int x = first; x < last; x += LANES) {
            float weight[LANES], depth[LANES];
            weigh(lens, s, &r.disc.box, y, x, weight, depth);
#pragma omp simd
            for (int k = 0; k < LANES; k++)
                second[x + k] = weight[k] > front_weight && depth[k] < second[x + k] && depth[k] > front[x + k] + room
                                    ? depth[k]
                                    : second[x + k];
        }
    }
}

/* Adds a disc to the sums of the first surface, or to those of the second one. */
SB_INLINE void add_disc(sb_band *band, const sb_splat_lens *lens, const sb_surfel *s, bool second)
{
    const struct rows r = rows_of(band, lens, s, 1);
    const float narrow = 1 / room_of(lens, s), share = s->share;
    int first, last;
    for (int y = r.low; y < r.high; y++) {
        const size_t row = (size_t)(y - band->first_row) * band->stride;
        if ((second && !is_open(band, y, r.disc.box.x0, r.disc.box.x1)) || !row_of(lens, &r.disc, y, &first, &last))
            continue;
        const float *restrict front = band->front + row, *restrict nearest =
                                                             (second ? band->second : band->front) + row;
        float *restrict sums = sums_of(band, second ? band->second_sums : band->sums, y - band->first_row);
        for (int x = first; x < last; x += LANES) {
            float weight[LANES], depth[LANES], w[LANES];
            weigh(lens, s, &r.disc.box, y, x, weight, depth);
#pragma omp simd
            for (int k = 0; k < LANES; k++) {
                const bool behind = depth[k] > front[x + k] && (depth[k] - front[x + k]) * narrow >= 1;
                const float past = (depth[k] - nearest[x + k]) * narrow, off = past > 0 ? past : 0;
                w[k] = off < 1 && behind == second ? share * weight[k] * (1 - off * off) : 0;
            }
            const float parts[SB_BAND_SUMS] = {1, 0, s->value, s->normal[0], s->normal[1], s->normal[2], s->thickness};
            for (int part = 0; part < SB_BAND_SUMS; part++) {
                float *restrict sum = sums + (size_t)part * band->stride + x;
#pragma omp simd
                for (int k = 0; k < LANES; k++) sum[k] += w[k] * (part == 1 ? depth[k] : parts[part]);
            }
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
            const size_t at = (size_t)(y - band->first_row) * band->stride + (size_t)x;
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
    cover[2] = drops[0] > 0 ? 1 - expf(-drops[0]) : 0;
    cover[3] = drops[2];
}

/* open: whether there is a second surface. */
static void resolve(const sb_band *band, bool open, float *surface, float *cover)
{
    for (int y = 0; y < band->rows; y++) {
        const float *first = sums_of(band, band->sums, y), *second = sums_of(band, band->second_sums, y);
        const float *drops = band->drops + 3 * (size_t)y * band->stride;
        float *to[2] = {surface, cover};
        for (int k = 0; k < 2; k++) to[k] += 4 * (size_t)(band->first_row + y) * (size_t)band->width;
        for (int x = 0; x < band->width; x++) {
            float one[SB_BAND_SUMS], two[SB_BAND_SUMS] = {0};
            for (int k = 0; k < SB_BAND_SUMS; k++) one[k] = first[(size_t)k * band->stride + (size_t)x];
            for (int k = 0; open && k < SB_BAND_SUMS; k++) two[k] = second[(size_t)k * band->stride + (size_t)x];
            resolve_pixel(one, two, drops + 3 * x, to[0] + 4 * x, to[1] + 4 * x);
        }
    }
}

static void clear(sb_band *band)
{
    const size_t pixels = (size_t)band->rows * band->stride;
    memset(band->sums, 0, SB_BAND_SUMS * pixels * sizeof *band->sums);
    memset(band->drops, 0, 3 * pixels * sizeof *band->drops);
    for (size_t i = 0; i < pixels; i++) band->front[i] = HUGE_VALF;
}

static void clear_second(sb_band *band)
{
    const size_t pixels = (size_t)band->rows * band->stride;
    memset(band->second_sums, 0, SB_BAND_SUMS * pixels * sizeof *band->second_sums);
    for (size_t i = 0; i < pixels; i++) band->second[i] = HUGE_VALF;
}

SB_MULTIVERSION void sb_band_draw(sb_band *band, const sb_splat_lens *lens, const sb_surfel *list, const uint32_t *bin,
                                  size_t count, float *surface, float *cover)
{
    const size_t from = 4 * (size_t)band->first_row * (size_t)band->width;
    const size_t bytes = 4 * (size_t)band->rows * (size_t)band->width * sizeof *surface;
    const float drop = drop_spacings * lens->spacing;
    if (count == 0) {
        memset(surface + from, 0, bytes);
        memset(cover + from, 0, bytes);
        return;
    }
    clear(band);
    for (size_t k = 0; k < count; k++) find_front(band, lens, &list[bin[k]]);
    for (size_t k = 0; k < count; k++) {
        const sb_surfel *s = &list[bin[k]];
        if (s->share > 0) add_disc(band, lens, s, false);
        if (s->share < 1) add_drop(band, lens, s, drop);
    }
    const bool open = find_open(band) > 0;
    if (open) clear_second(band);
    for (size_t k = 0; open && k < count; k++) find_second(band, lens, &list[bin[k]]);
    for (size_t k = 0; open && k < count; k++)
        if (list[bin[k]].share > 0) add_disc(band, lens, &list[bin[k]], true);
    resolve(band, open, surface, cover);
}
