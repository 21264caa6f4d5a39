/* Computes the density of water on a grid. */
#include "render/water/density.h"

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

/* Adds the particles' shares of the nodes whose layer is in [first, end). */
static void spread_layers(sb_density *density, const sb_frame *frame, size_t first, size_t end)
{
    size_t up = density->n[0], over = density->n[0] * density->n[1];
    double ratio = frame->spacing * (double)density->inverse;
    /* A layer of particles in one plane of nodes, half of which the smoothing moves to the planes beside it. */
    float mass = (float)(density->slice ? 2 * ratio * ratio : ratio * ratio * ratio);
    for (size_t i = 0; i < frame->count; i++) {
        const float *p = frame->position + 3 * i;
        float depth = (p[2] - density->min[2]) * density->inverse;
        if (!(depth + 1 >= (float)first && depth < (float)end)) continue;
        size_t at;
        float s[3];
        if (!sb_density_counts(p) || !locate(density, p, &at, s)) continue;
        float *node = density->node + at;
        float a = (1 - s[0]) * (1 - s[1]), b = s[0] * (1 - s[1]);
        float c = (1 - s[0]) * s[1], d = s[0] * s[1];
        for (size_t k = 0; k < 2; k++, node += over) {
            const size_t layer = at / over + k;
            if (layer < first || layer >= end) continue;
            const float part = mass * (k ? s[2] : 1 - s[2]);
            node[0] += part * a;
            node[1] += part * b;
            node[up] += part * c;
            node[up + 1] += part * d;
        }
    }
}

/* Each thread has its own layers of nodes and reads all particles in their order, so that the sums have one order. */
static void spread(sb_density *density, const sb_frame *frame, int threads)
{
#pragma omp parallel for num_threads(threads) schedule(static)
    for (int part = 0; part < threads; part++) {
        const size_t layers = density->n[2], share = (layers + (size_t)threads - 1) / (size_t)threads;
        const size_t first = (size_t)part * share;
        spread_layers(density, frame, first, first + share < layers ? first + share : layers);
    }
}

/* Smooths along one axis with the weights 1/4, 1/2, 1/4. At the ends of a row the neighbours are the zeros of the
   margin. */
static void smooth(const float *restrict in, float *restrict out, size_t count, size_t stride, int threads)
{
    memset(out, 0, stride * sizeof *out);
    memset(out + count - stride, 0, stride * sizeof *out);
#pragma omp parallel for num_threads(threads) schedule(static)
    for (size_t i = stride; i < count - stride; i++) out[i] = 0.5f * in[i] + 0.25f * (in[i - stride] + in[i + stride]);
}

/* Smooths *field along all axes with the help of *spare. */
static void smooth_all(const sb_density *density, float **field, float **spare, int threads)
{
    size_t stride = 1, count = density->n[0] * density->n[1] * density->n[2];
    for (int a = 0; a < 3; a++) {
        smooth(*field, *spare, count, stride, threads);
        float *other = *field;
        *field = *spare;
        *spare = other;
        stride *= density->n[a];
    }
}

/* The fraction of a cell, which begins half a cell below the node, that is above `low`. */
static float share_above(double at, double cell, double low)
{
    const double share = (at - low) / cell + 0.5;
    return share > 0 ? share < 1 ? (float)share : 1 : 0;
}

/* The same where a node's part is not that of its cell but that of a tent, as wide as two cells: exactly what
   spread_layers gives to a node from even water that ends at `low`. */
static double tent_above(double at, double cell, double low)
{
    const double u = (at - low) / cell;
    if (u <= -1) return 0;
    return u < 0 ? 0.5 * (1 + u) * (1 + u) : u < 1 ? 1 - 0.5 * (1 - u) * (1 - u) : 1;
}

double sb_ground_height(const sb_ground *ground, double x, double y)
{
    const double inward = 0.5 / ground->per_cell;
    double at[2] = {x, y};
    for (int a = 0; a < 2 && ground->sided; a++)
        at[a] = fmax(fmin(at[a], ground->side_max[a] - inward), ground->side_min[a] + inward);
    const double column = (at[0] - ground->origin.x - ground->x) * ground->per_cell;
    const double row = (at[1] - ground->origin.y - ground->y) * ground->per_cell;
    if (!(column >= 0 && row >= 0 && column < ground->side && row < ground->side)) return ground->floor_level;
    const size_t cell = (size_t)row * (size_t)ground->side + (size_t)column;
    return fmax((double)ground->height[cell] + ground->origin.z, ground->floor_level);
}

float sb_density_share(const sb_density *density, int a, size_t node)
{
    const double cell = (double)density->cell, at = (double)density->min[a] + cell * (double)node;
    if (!density->sided) return 1;
    if (a == 2) return (float)tent_above(at, cell, (double)density->floor);
    return (float)(tent_above(at, cell, (double)density->side_min[a]) +
                   tent_above(-at, cell, -(double)density->side_max[a]) - 1);
}

/* Sets open to the fraction of each node's cell where water can be, from four columns of each cell. */
static void find_open(sb_density *density, const sb_frame *frame, const sb_ground *ground, int threads)
{
    const double cell = (double)density->cell;
    const size_t layer = density->n[0] * density->n[1];
#pragma omp parallel for num_threads(threads) schedule(static)
    for (size_t j = 0; j < density->n[1]; j++)
        for (size_t i = 0; i < density->n[0]; i++) {
            double height[4];
            for (int c = 0; c < 4; c++) {
                const double x = (double)density->min[0] + cell * ((double)i + (c & 1 ? 0.25 : -0.25));
                const double y = (double)density->min[1] + cell * ((double)j + (c & 2 ? 0.25 : -0.25));
                height[c] = sb_ground_height(ground, x + frame->origin.x, y + frame->origin.y) - frame->origin.z;
            }
            const float between = sb_density_share(density, 0, i) * sb_density_share(density, 1, j);
            float *open = density->open + j * density->n[0] + i;
            for (size_t k = 0; k < density->n[2]; k++) {
                const double z = (double)density->min[2] + cell * (double)k;
                float share = 0;
                for (int c = 0; c < 4; c++) share += share_above(z, cell, height[c]);
                open[k * layer] = between * (0.25f * share);
            }
        }
}

/* The same, smoothed. */
static float smoothed_share(const sb_density *density, int a, size_t node)
{
    const float at = density->min[a] + density->cell * (float)node, far = 2.1f * density->cell;
    if (!density->sided || (at - density->side_min[a] > far && density->side_max[a] - at > far)) return 1;
    const float low = node > 0 ? sb_density_share(density, a, node - 1) : 0;
    return 0.5f * sb_density_share(density, a, node) + 0.25f * (low + sb_density_share(density, a, node + 1));
}

/* Divides the density of a row of nodes by the open fraction. The least divisor is 0.06 at a wall, because heights are
   known only cell by cell; beyond a side, whose place is exact, it is a part of the fraction that the side leaves. */
static void divide_row(const sb_density *density, size_t j, size_t k, const float *open)
{
    const size_t first = (k * density->n[1] + j) * density->n[0];
    const float least = 0.06f, over = smoothed_share(density, 1, j);
    for (size_t i = 0; i < density->n[0]; i++) {
        const float share = over * smoothed_share(density, 0, i), limit = least * (share > 0.004f ? share : 0.004f);
        density->node[first + i] /= open[first + i] > limit ? open[first + i] : limit;
    }
}

/* Divides the density by the open fraction, smoothed in the same way (a normalised convolution): the density of water
   at a wall is then that of the water in front of it. */
static sb_status extend_to_walls(sb_density *density, const sb_frame *frame, const sb_ground *ground, int threads,
                                 sb_error *error)
{
    const size_t count = density->n[0] * density->n[1] * density->n[2];
    if (sb_grow((void **)&density->open, &density->capacity[2], count, sizeof(float)) != 0)
        return sb_fail_memory(error, "the density of water in a picture");
    find_open(density, frame, ground, threads);
    float *open = density->open, *spare = density->spare;
    smooth_all(density, &open, &spare, threads);
#pragma omp parallel for num_threads(threads) schedule(static)
    for (size_t row = 0; row < density->n[1] * density->n[2]; row++)
        divide_row(density, row % density->n[1], row / density->n[1], open);
    /* An odd number of exchanges: the arrays have changed places, and with them their capacities. */
    density->open = open;
    density->spare = spare;
    const size_t capacity = density->capacity[1];
    density->capacity[1] = density->capacity[2];
    density->capacity[2] = capacity;
    return SB_OK;
}

sb_status sb_density_build(sb_density *density, const sb_frame *frame, const sb_ground *ground, int threads,
                           sb_error *error)
{
    density->n[0] = density->n[1] = density->n[2] = 1;
    float min[3], max[3];
    if (!bounds(frame, min, max)) return SB_OK;
    sb_status status = make_grid(density, min, max, frame->spacing, error);
    if (status != SB_OK) return status;
    density->slice = min[1] >= max[1] && (max[0] > min[0] || max[2] > min[2]);
    density->sided = ground && ground->side > 0 && ground->sided;
    density->floor = density->sided ? (float)(ground->floor_level - frame->origin.z) : 0;
    for (int a = 0; a < 2 && density->sided; a++) {
        const double origin = a ? frame->origin.y : frame->origin.x;
        density->side_min[a] = (float)(ground->side_min[a] - origin);
        density->side_max[a] = (float)(ground->side_max[a] - origin);
    }
    spread(density, frame, threads);
    smooth_all(density, &density->node, &density->spare, threads);
    const size_t capacity = density->capacity[0];
    density->capacity[0] = density->capacity[1];
    density->capacity[1] = capacity;
    return ground && ground->side > 0 ? extend_to_walls(density, frame, ground, threads, error) : SB_OK;
}

void sb_density_free(sb_density *density)
{
    sb_free(density->node);
    sb_free(density->spare);
    sb_free(density->open);
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
