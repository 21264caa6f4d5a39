/* Computes the density of water on a grid. */
#include "render/density.h"

#include "base/memory.h"

#include <string.h>

static const double cell_spacings = 1.5;
static const double nodes_max = 2.5e7;
/* Empty nodes on each side: one for the distribution to nodes, one for the smoothing, and one that keeps the smoothing
   from mixing neighbouring rows. */
enum { MARGIN = 3 };

static bool bounds(const sb_frame *frame, float min[3], float max[3])
{
    for (int a = 0; a < 3; a++) {
        min[a] = INFINITY;
        max[a] = -INFINITY;
    }
    for (size_t i = 0; i < frame->count; i++) {
        const float *p = frame->position + 3 * i;
        if (!sb_density_counts(p)) continue;
        for (int a = 0; a < 3; a++) {
            min[a] = p[a] < min[a] ? p[a] : min[a];
            max[a] = p[a] > max[a] ? p[a] : max[a];
        }
    }
    return min[0] <= max[0];
}

static sb_status make_grid(sb_density *density, const float min[3], const float max[3], double spacing, sb_error *error)
{
    const double least = 1e-30; /* single precision cannot resolve smaller cells */
    double cell = fmax(cell_spacings * spacing, least);
    /* A single distant particle may enlarge the box. A coarser grid remains correct, but less sharp. */
    for (double total = HUGE_VAL;; cell *= 1.25) {
        total = 1;
        for (int a = 0; a < 3; a++) total *= floor((double)(max[a] - min[a]) / cell) + 2 * MARGIN + 1;
        if (total <= nodes_max) break;
    }
    for (int a = 0; a < 3; a++) {
        density->n[a] = (size_t)((double)(max[a] - min[a]) / cell) + (size_t)2 * MARGIN + 1;
        density->min[a] = (float)((double)min[a] - MARGIN * cell);
    }
    density->cell = (float)cell;
    density->inverse = (float)(1 / cell);
    size_t count = density->n[0] * density->n[1] * density->n[2];
    if (sb_grow((void **)&density->node, &density->capacity[0], count, sizeof(float)) != 0 ||
        sb_grow((void **)&density->spare, &density->capacity[1], count, sizeof(float)) != 0)
        return sb_fail_memory(error, "the density of water in a picture");
    memset(density->node, 0, count * sizeof(float));
    return SB_OK;
}

/* Finds the grid cell of a point: its lowest node, and the position within the cell as fractions of its side. Returns
   false outside of the grid. */
static bool locate(const sb_density *density, const float place[3], size_t *node, float share[3])
{
    size_t stride = 1;
    *node = 0;
    for (int a = 0; a < 3; a++) {
        float at = (place[a] - density->min[a]) * density->inverse;
        if (!(at >= 0 && at < (float)(density->n[a] - 1))) return false;
        size_t below = (size_t)at;
        share[a] = at - (float)below;
        *node += below * stride;
        stride *= density->n[a];
    }
    return true;
}

static void spread(sb_density *density, const sb_frame *frame)
{
    size_t up = density->n[0], over = density->n[0] * density->n[1];
    double ratio = frame->spacing * (double)density->inverse;
    float mass = (float)(ratio * ratio * ratio);
    for (size_t i = 0; i < frame->count; i++) {
        const float *p = frame->position + 3 * i;
        size_t at;
        float s[3];
        if (!sb_density_counts(p) || !locate(density, p, &at, s)) continue;
        float *node = density->node + at;
        float low = mass * (1 - s[2]), high = mass * s[2];
        float a = (1 - s[0]) * (1 - s[1]), b = s[0] * (1 - s[1]);
        float c = (1 - s[0]) * s[1], d = s[0] * s[1];
        node[0] += low * a;
        node[1] += low * b;
        node[up] += low * c;
        node[up + 1] += low * d;
        node[over] += high * a;
        node[over + 1] += high * b;
        node[over + up] += high * c;
        node[over + up + 1] += high * d;
    }
}

/* Smooths along one axis with the weights 1/4, 1/2, 1/4. At the ends of a row the neighbours are the zeros of the
   margin. */
static void smooth(const float *restrict in, float *restrict out, size_t count, size_t stride)
{
    memset(out, 0, stride * sizeof *out);
    memset(out + count - stride, 0, stride * sizeof *out);
    for (size_t i = stride; i < count - stride; i++) out[i] = 0.5f * in[i] + 0.25f * (in[i - stride] + in[i + stride]);
}

sb_status sb_density_build(sb_density *density, const sb_frame *frame, sb_error *error)
{
    density->n[0] = density->n[1] = density->n[2] = 1;
    float min[3], max[3];
    if (!bounds(frame, min, max)) return SB_OK;
    sb_status status = make_grid(density, min, max, frame->spacing, error);
    if (status != SB_OK) return status;
    spread(density, frame);
    size_t stride = 1, count = density->n[0] * density->n[1] * density->n[2];
    for (int a = 0; a < 3; a++) {
        smooth(density->node, density->spare, count, stride);
        float *other = density->node;
        density->node = density->spare;
        density->spare = other;
        size_t capacity = density->capacity[0];
        density->capacity[0] = density->capacity[1];
        density->capacity[1] = capacity;
        stride *= density->n[a];
    }
    return SB_OK;
}

void sb_density_free(sb_density *density)
{
    sb_free(density->node);
    sb_free(density->spare);
    *density = (sb_density){0};
}

float sb_density_at(const sb_density *density, float x, float y, float z)
{
    const float place[3] = {x, y, z};
    size_t at;
    float s[3];
    if (!locate(density, place, &at, s)) return 0;
    const float *node = density->node + at;
    size_t up = density->n[0], over = density->n[0] * density->n[1];
    float low = node[0] + s[0] * (node[1] - node[0]);
    float low_up = node[up] + s[0] * (node[up + 1] - node[up]);
    float high = node[over] + s[0] * (node[over + 1] - node[over]);
    float high_up = node[over + up] + s[0] * (node[over + up + 1] - node[over + up]);
    low += s[1] * (low_up - low);
    high += s[1] * (high_up - high);
    return low + s[2] * (high - low);
}
