#include "render/bodies/samples.h"

#include "base/memory.h"
#include "render/overlay/font.h"
#include "render/overlay/labels.h"
#include "render/overlay/paint.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double RANGE = 2;               /* spacings */
static const double LEAST = 0.5, MOST = 1.5; /* density at the ends of the colours */
static const double PI = 3.14159265358979323846;

/* ---- density ---- */

/* A particle by its cell of RANGE spacings: the key sorts by z, then y, then x. */
typedef struct placed {
    uint64_t key;
    uint32_t particle;
} placed;

static int by_key(const void *left, const void *right)
{
    const placed *a = left, *b = right;
    if (a->key != b->key) return a->key < b->key ? -1 : 1;
    return a->particle < b->particle ? -1 : a->particle > b->particle;
}

enum { BITS = 21 };

static uint64_t cell(double distance, double size)
{
    const double index = floor(distance / size) + 1;
    return (uint64_t)fmin(fmax(index, 0), (double)((1 << BITS) - 1));
}

static uint64_t key_of(const sb_model *model, sb_vec3 low, size_t i, double size)
{
    const sb_vec3 at = sb_sub(model->wall_position[i], low);
    return cell(at.x, size) | cell(at.y, size) << BITS | cell(at.z, size) << 2 * BITS;
}

/* The first entry whose key is not less. */
static size_t find_key(const placed *sorted, size_t count, uint64_t key)
{
    size_t low = 0, high = count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (sorted[middle].key < key)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Sum over the particles of the three cells in a row about the given one. */
static double sum_row(const sb_model *model, const placed *sorted, uint64_t middle, sb_vec3 at, double range)
{
    double sum = 0;
    for (size_t k = find_key(sorted, model->wall_count, middle - 1);
         k < model->wall_count && sorted[k].key <= middle + 1; k++) {
        const sb_vec3 away = sb_sub(model->wall_position[sorted[k].particle], at);
        const double q = 1 - sb_dot(away, away) / (range * range);
        sum += q > 0 ? q * q : 0;
    }
    return sum;
}

sb_status sb_samples_density(const sb_model *model, double spacing, float *density, sb_error *error)
{
    const double range = RANGE * spacing;
    const double expected = model->dimensions == 2 ? 16 * RANGE / 15 : PI * RANGE * RANGE / 3;
    sb_vec3 low = model->min;
    placed *sorted = sb_alloc(model->wall_count, sizeof *sorted);
    if (!sorted) return sb_fail_memory(error, "the density of boundary particles");
    for (size_t i = 0; i < model->wall_count; i++) low = sb_min(low, model->wall_position[i]);
    for (size_t i = 0; i < model->wall_count; i++) sorted[i] = (placed){key_of(model, low, i, range), (uint32_t)i};
    qsort(sorted, model->wall_count, sizeof *sorted, by_key);
    for (size_t i = 0; i < model->wall_count; i++) {
        double sum = 0;
        for (int dz = -1; dz <= 1; dz++)
            for (int dy = -1; dy <= 1; dy++) {
                const uint64_t row = sorted[i].key + (uint64_t)((int64_t)dy * (1 << BITS)) +
                                     (uint64_t)((int64_t)dz * ((int64_t)1 << 2 * BITS));
                sum += sum_row(model, sorted, row, model->wall_position[sorted[i].particle], range);
            }
        density[sorted[i].particle] = (float)(sum / expected);
    }
    sb_free(sorted);
    return SB_OK;
}

/* ---- picture ---- */

/* Blue for sparse, light for one particle per square, red for dense. */
static void color_of(double density, float rgb[3])
{
    static const float sparse[3] = {0.13f, 0.35f, 0.70f}, right[3] = {0.93f, 0.93f, 0.90f},
                       dense[3] = {0.75f, 0.15f, 0.12f};
    const double at = fmin(fmax((density - LEAST) / (MOST - LEAST), 0), 1);
    const float *a = at < 0.5 ? sparse : right, *b = at < 0.5 ? right : dense;
    const float part = (float)(at < 0.5 ? 2 * at : 2 * at - 1);
    for (int c = 0; c < 3; c++) rgb[c] = a[c] + (b[c] - a[c]) * part;
}

static void clear(sb_image *image)
{
    static const float ground[3] = {0.30f, 0.33f, 0.37f};
    for (size_t p = 0; p < (size_t)image->width * (size_t)image->height; p++)
        for (int c = 0; c < 3; c++) image->rgb[3 * p + (size_t)c] = (unsigned char)(255 * ground[c]);
}

/* Draws a disc that faces the camera, where no nearer one is. */
static void draw_disc(sb_image *image, float *nearest, double x, double y, double radius, double depth,
                      const float rgb[3])
{
    const int x0 = (int)floor(fmax(x - radius, 0)), x1 = (int)ceil(fmin(x + radius, image->width - 1));
    const int y0 = (int)floor(fmax(y - radius, 0)), y1 = (int)ceil(fmin(y + radius, image->height - 1));
    for (int row = y0; row <= y1; row++)
        for (int column = x0; column <= x1; column++) {
            const double away = hypot(column + 0.5 - x, row + 0.5 - y);
            const size_t p = (size_t)row * (size_t)image->width + (size_t)column;
            if (away > fmax(radius, 0.71) || !((float)depth < nearest[p])) continue;
            nearest[p] = (float)depth;
            for (int c = 0; c < 3; c++) image->rgb[3 * p + (size_t)c] = (unsigned char)(255 * fmin((double)rgb[c], 1));
        }
}

static void draw_particles(const sb_model *model, const float *density, const sb_view *view, sb_image *image,
                           float *nearest)
{
    const double scale = 0.5 * image->height / view->tangent; /* px at a distance of 1 m per m */
    for (size_t i = 0; i < model->wall_count; i++) {
        double x, y;
        const sb_vec3 at = model->wall_position[i], from = sb_sub(at, view->eye);
        const double depth = -sb_dot(from, view->back), facing = -sb_dot(model->wall_normal[i], sb_normalize(from));
        if ((model->dimensions == 3 && facing < 0) || !sb_labels_project(view, image, at, &x, &y)) continue;
        const double radius = 0.58 * model->spacing * scale / depth;
        if (x < -radius || y < -radius || x > image->width + radius || y > image->height + radius) continue;
        float rgb[3];
        color_of((double)density[i], rgb);
        const float shade = model->dimensions == 2 ? 1 : (float)(0.55 + 0.45 * fabs(facing));
        for (int c = 0; c < 3; c++) rgb[c] *= shade;
        draw_disc(image, nearest, x, y, radius, depth, rgb);
    }
}

static sb_status draw_legend(sb_image *image, bool flat, sb_error *error)
{
    static const float ink[3] = {0.97f, 0.98f, 0.99f};
    const double unit = fmax(0.7, image->height / 720.0), width = 300 * unit, thick = 10 * unit, letters = 10 * unit;
    const double x = image->width - 26 * unit - width, y = image->height - 44 * unit;
    for (int column = 0; column < (int)width; column++) {
        float rgb[3];
        color_of(LEAST + (MOST - LEAST) * (column + 0.5) / width, rgb);
        sb_paint_box(image, x + column, y, x + column + 1, y + thick, rgb, 1);
    }
    const char *text = flat ? "boundary particles, 1: as on a line" : "boundary particles, 1: as on a plane";
    sb_status status =
        sb_font_draw(image, x + width - sb_font_width(text, letters), y - 8 * unit, letters, ink, text, error);
    for (int tick = 0; tick <= 2 && status == SB_OK; tick++) {
        char label[16];
        snprintf(label, sizeof label, "%.2g", LEAST + (MOST - LEAST) * tick / 2);
        const double wide = sb_font_width(label, letters);
        status =
            sb_font_draw(image, x + width * tick / 2 - 0.5 * wide, y + thick + 16 * unit, letters, ink, label, error);
    }
    return status;
}

sb_status sb_samples_draw(const sb_model *model, const float *density, const sb_view *view, sb_image *image,
                          sb_error *error)
{
    const size_t pixels = (size_t)image->width * (size_t)image->height;
    float *nearest = sb_alloc(pixels, sizeof *nearest);
    if (!nearest) return sb_fail_memory(error, "a picture of boundary particles");
    for (size_t p = 0; p < pixels; p++) nearest[p] = INFINITY;
    clear(image);
    draw_particles(model, density, view, image, nearest);
    sb_free(nearest);
    return draw_legend(image, model->dimensions == 2, error);
}
