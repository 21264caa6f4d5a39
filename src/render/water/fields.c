/* Computes the fields by which the water can be coloured. */
#include "render/water/fields.h"

#include "base/memory.h"
#include "render/overlay/colormap.h"
#include "render/water/density.h"

#include <string.h>

static double speed_range(const sb_scene *scene, double depth, double speed)
{
    (void)depth;
    return scene->render.speed_max > 0 ? scene->render.speed_max : 2 * speed;
}

static double pressure_range(const sb_scene *scene, double depth, double speed)
{
    (void)speed;
    return 1.25 * scene->fluid.density * scene->fluid.gravity * depth;
}

/* A long wave's speed over a tenth of the depth. */
static double vorticity_range(const sb_scene *scene, double depth, double speed)
{
    (void)scene;
    return 10 * speed / depth;
}

static double depth_range(const sb_scene *scene, double depth, double speed)
{
    (void)scene;
    (void)speed;
    return 1.5 * depth;
}

static double flux_range(const sb_scene *scene, double depth, double speed)
{
    (void)scene;
    return depth * speed * speed;
}

/* The solver keeps the mean below a thousandth; single particles in splashes reach some per cent. */
static double density_range(const sb_scene *scene, double depth, double speed)
{
    (void)scene;
    (void)depth;
    (void)speed;
    return 1;
}

const sb_field sb_fields[SB_WATER_COLORS] = {
    [SB_COLOR_SPEED] = {"speed  m/s", SB_COLORMAP_SEA, speed_range},
    [SB_COLOR_PRESSURE] = {"pressure  Pa", SB_COLORMAP_FIRE, pressure_range},
    [SB_COLOR_VORTICITY] = {"vorticity  1/s", SB_COLORMAP_FIRE, vorticity_range},
    [SB_COLOR_DEPTH] = {"depth  m", SB_COLORMAP_DEEP, depth_range},
    [SB_COLOR_MOMENTUM_FLUX] = {"momentum flux  m3/s2", SB_COLORMAP_FIRE, flux_range},
    [SB_COLOR_DENSITY_ERROR] = {"density error  %", SB_COLORMAP_FIRE, density_range},
};

/* A grid over the particles whose nodes have `parts` numbers each. */
struct grid {
    float min[3], inverse; /* m; 1/m */
    size_t n[3], parts;
    float *node;
};

static sb_status make_grid(sb_values *values, const sb_frame *frame, double cell, int axes, size_t parts,
                           struct grid *grid, sb_error *error)
{
    float min[3] = {HUGE_VALF, HUGE_VALF, HUGE_VALF}, max[3] = {-HUGE_VALF, -HUGE_VALF, -HUGE_VALF};
    for (size_t i = 0; i < frame->count; i++)
        for (int a = 0; a < 3 && sb_density_counts(frame->position + 3 * i); a++) {
            const float x = frame->position[3 * i + (size_t)a];
            min[a] = x < min[a] ? x : min[a];
            max[a] = x > max[a] ? x : max[a];
        }
    double total;
    cell = fmax(cell, 1e-30);
    do {
        total = 1;
        for (int a = 0; a < 3; a++) {
            const double length = min[a] <= max[a] ? (double)(max[a] - min[a]) : 0;
            const double nodes = a < axes ? floor(length / cell) + 4 : 1;
            total *= nodes;
            grid->n[a] = nodes < 1e9 ? (size_t)nodes : 1;
            grid->min[a] = (float)((double)min[a] - cell);
        }
        grid->inverse = (float)(1 / cell);
        cell *= 1.25;
    } while (total > 2.5e7);
    grid->parts = parts;
    const size_t count = (size_t)total * parts;
    if (sb_grow((void **)&values->nodes, &values->node_capacity, count, sizeof *values->nodes) != 0)
        return sb_fail_memory(error, "the colours of the water");
    memset(values->nodes, 0, count * sizeof *values->nodes);
    grid->node = values->nodes;
    return SB_OK;
}

/* The eight (four in a map) nodes around a particle, and their weights. */
static int around(const struct grid *grid, const float *p, size_t node[8], float weight[8])
{
    const int corners = grid->n[2] > 1 ? 8 : 4;
    size_t low[3];
    float part[3];
    for (int a = 0; a < 3; a++) {
        const float at = grid->n[a] > 1 ? (p[a] - grid->min[a]) * grid->inverse : 0;
        low[a] = (size_t)at;
        part[a] = at - (float)low[a];
    }
    for (int c = 0; c < corners; c++) {
        size_t at[3];
        float w = 1;
        for (int a = 0; a < 3; a++) {
            const int high = c >> a & 1;
            at[a] = low[a] + (size_t)high;
            w *= a == 2 && corners == 4 ? 1 : high ? part[a] : 1 - part[a];
        }
        node[c] = grid->parts * ((at[2] * grid->n[1] + at[1]) * grid->n[0] + at[0]);
        weight[c] = w;
    }
    return corners;
}

static void add(const struct grid *grid, const float *p, const float *parts)
{
    size_t node[8];
    float weight[8];
    const int corners = around(grid, p, node, weight);
    for (int c = 0; c < corners; c++)
        for (size_t k = 0; k < grid->parts; k++) grid->node[node[c] + k] += weight[c] * parts[k];
}

/* Depth, or depth times the square of the horizontal speed: sums over the column of water. With cells of two spacings,
   the weights of a lattice's particles have the same sum at each node. Columns of a slice have the width of a spacing.
 */
static sb_status compute_columns(sb_values *values, const sb_frame *frame, bool flux, sb_error *error)
{
    struct grid grid;
    const double cell = 2 * frame->spacing;
    sb_status status = make_grid(values, frame, cell, 2, 1, &grid, error);
    if (status != SB_OK) return status;
    const bool slice = grid.n[1] <= 4;
    const double size = 1 / (double)grid.inverse, spacing = frame->spacing;
    const float volume = (float)(slice ? spacing * (spacing / size) : spacing * (spacing / size) * (spacing / size));
    for (size_t i = 0; i < frame->count; i++) {
        const float *p = frame->position + 3 * i, *v = frame->velocity + 3 * i;
        const float part[4] = {flux ? volume * (v[0] * v[0] + v[1] * v[1]) : volume};
        if (sb_density_counts(p)) add(&grid, p, part);
    }
    for (size_t i = 0; i < frame->count; i++) {
        const float *p = frame->position + 3 * i;
        size_t node[8];
        float weight[8], sum = 0;
        if (sb_density_counts(p)) {
            const int corners = around(&grid, p, node, weight);
            for (int c = 0; c < corners; c++) sum += weight[c] * grid.node[node[c]];
        }
        values->list[i] = sum;
    }
    return SB_OK;
}

/* The mean velocity at a node, m/s; false where there is no water. */
static bool node_velocity(const struct grid *grid, size_t node, float v[3])
{
    const float *parts = grid->node + node;
    if (!(parts[3] > 0.02f)) return false;
    for (int a = 0; a < 3; a++) v[a] = parts[a] / parts[3];
    return true;
}

/* The magnitude of the velocity's curl from differences between nodes that are two spacings apart. Differences across
   the surface are left out. */
static float vorticity_at(const struct grid *grid, const float *p)
{
    size_t cell[3];
    float slope[3][3] = {{0}};
    for (int a = 0; a < 3; a++) cell[a] = (size_t)((p[a] - grid->min[a]) * grid->inverse + 0.5f);
    const size_t stride[3] = {grid->parts, grid->parts * grid->n[0], grid->parts * grid->n[0] * grid->n[1]};
    const size_t here = cell[0] * stride[0] + cell[1] * stride[1] + cell[2] * stride[2];
    float middle[3];
    if (!node_velocity(grid, here, middle)) return 0;
    for (int a = 0; a < 3; a++) {
        float low[3], high[3], steps = 2;
        if (cell[a] == 0 || !node_velocity(grid, here - stride[a], low)) {
            memcpy(low, middle, sizeof low);
            steps -= 1;
        }
        if (cell[a] + 1 >= grid->n[a] || !node_velocity(grid, here + stride[a], high)) {
            memcpy(high, middle, sizeof high);
            steps -= 1;
        }
        for (int c = 0; c < 3 && steps > 0; c++) slope[a][c] = (high[c] - low[c]) * grid->inverse / steps;
    }
    const float x = slope[1][2] - slope[2][1], y = slope[2][0] - slope[0][2], z = slope[0][1] - slope[1][0];
    return sqrtf(x * x + y * y + z * z);
}

static sb_status compute_vorticity(sb_values *values, const sb_frame *frame, sb_error *error)
{
    struct grid grid;
    sb_status status = make_grid(values, frame, 2 * frame->spacing, 3, 4, &grid, error);
    if (status != SB_OK) return status;
    for (size_t i = 0; i < frame->count; i++) {
        const float *v = frame->velocity + 3 * i, parts[4] = {v[0], v[1], v[2], 1};
        if (sb_density_counts(frame->position + 3 * i)) add(&grid, frame->position + 3 * i, parts);
    }
    for (size_t i = 0; i < frame->count; i++) {
        const float *p = frame->position + 3 * i;
        values->list[i] = sb_density_counts(p) ? vorticity_at(&grid, p) : 0;
    }
    return SB_OK;
}

static void copy_own(sb_values *values, const sb_frame *frame, bool pressure)
{
    for (size_t i = 0; i < frame->count; i++) {
        const float *v = frame->velocity + 3 * i;
        values->list[i] = pressure ? frame->pressure[i] : sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
}

static sb_status copy_density_error(sb_values *values, const sb_frame *frame, sb_error *error)
{
    if (!frame->density_error)
        return sb_fail(error, SB_BAD_INPUT,
                       "render: color density_error, but the frame has no density error; it has one in a run whose "
                       "scene has a camera with this color");
    for (size_t i = 0; i < frame->count; i++) values->list[i] = 100 * frame->density_error[i];
    return SB_OK;
}

sb_status sb_values_compute(sb_values *values, const sb_frame *frame, sb_water_color color, double min, double max,
                            sb_error *error)
{
    if (sb_grow((void **)&values->list, &values->capacity, frame->count, sizeof *values->list) != 0)
        return sb_fail_memory(error, "the colours of the water");
    sb_status status = SB_OK;
    switch (color) {
    case SB_COLOR_VORTICITY:
        status = compute_vorticity(values, frame, error);
        break;
    case SB_COLOR_DEPTH:
        status = compute_columns(values, frame, false, error);
        break;
    case SB_COLOR_MOMENTUM_FLUX:
        status = compute_columns(values, frame, true, error);
        break;
    case SB_COLOR_DENSITY_ERROR:
        status = copy_density_error(values, frame, error);
        break;
    default:
        copy_own(values, frame, color == SB_COLOR_PRESSURE);
        break;
    }
    const float low = (float)min, scale = (float)(1 / (max - min));
    for (size_t i = 0; i < frame->count && status == SB_OK; i++) {
        const float value = (values->list[i] - low) * scale;
        values->list[i] = value > 0 ? value < 1 ? value : 1 : 0;
    }
    return status;
}

void sb_values_free(sb_values *values)
{
    sb_free(values->list);
    sb_free(values->nodes);
    *values = (sb_values){0};
}
