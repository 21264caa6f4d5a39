#include "sim/terms/nodes.h"

#include "base/memory.h"
#include "sim/exchange/exchange.h"

#include <string.h>

enum { CELL_BITS = 21, COLOURS = 8 };

static int64_t cell_at(uint64_t code, int axis)
{
    return (int64_t)(code >> (axis * CELL_BITS) & (((uint64_t)1 << CELL_BITS) - 1));
}

sb_nodes sb_nodes_around(const sb_sim *sim)
{
    const sb_cells *cells = &sim->cells;
    sb_nodes nodes = {.shift = sim->space.shift - 1, .flat = sim->constant.dimension == 2, .count = 1};
    const bool none = sim->work.everywhere == 0;
    nodes.width = (double)((uint32_t)1 << nodes.shift) * sim->space.quantum;
    for (int axis = 0; axis < 3; axis++) {
        int64_t low = INT64_MAX, high = 0;
        for (size_t c = 0; c < cells->count; c++) {
            const int64_t cell = cell_at(cells->code[c], axis);
            low = cell < low ? cell : low;
            high = cell > high ? cell : high;
        }
        if (sb_ranks_several(sim->ranks) && !none) {
            low = -(int64_t)sim->exchange->largest(sim, -(double)low);
            high = (int64_t)sim->exchange->largest(sim, (double)high);
        }
        const bool one = none || (nodes.flat && axis == 1);
        nodes.low[axis] = one ? 0 : 2 * low - SB_NODES_MARGIN;
        nodes.size[axis] = one ? 1 : (size_t)(2 * (high - low + 1)) + 2 * SB_NODES_MARGIN;
        nodes.count *= nodes.size[axis];
    }
    if (none) nodes.count = 0;
    return nodes;
}

/* The nodes around a particle: the first one, and the weights along each axis. */
typedef struct share {
    size_t first;
    int across; /* nodes along y */
    double weight[3][3];
} share;

static share share_of(const sb_nodes *nodes, sb_record at)
{
    share s = {.first = 0, .across = nodes->flat ? 1 : 3, .weight = {{0}, {1, 0, 0}, {0}}};
    const uint32_t inside = ((uint32_t)1 << nodes->shift) - 1;
    for (int axis = 0; axis < 3; axis++) {
        if (nodes->flat && axis == 1) continue;
        const double u = (double)(at[axis] & inside) / ((double)inside + 1);
        s.weight[axis][0] = 0.5 * (1 - u) * (1 - u);
        s.weight[axis][2] = 0.5 * u * u;
        s.weight[axis][1] = 1 - s.weight[axis][0] - s.weight[axis][2];
        s.first += (size_t)((int64_t)(at[axis] >> nodes->shift) - nodes->low[axis] - 1) * sb_nodes_stride(nodes, axis);
    }
    return s;
}

static void give_cell(const sb_sim *sim, const sb_nodes *nodes, size_t c, const sb_f4 *field, double factor,
                      double *values)
{
    const size_t row = sb_nodes_stride(nodes, 1), layer = sb_nodes_stride(nodes, 2);
    for (uint32_t i = sim->cells.begin[c]; i < sim->cells.begin[c + 1]; i++) {
        const share s = share_of(nodes, sim->state.position[i]);
        const double own = factor * (double)field[i][3];
        for (size_t z = 0; z < 3; z++)
            for (size_t y = 0; y < (size_t)s.across; y++)
                for (size_t x = 0; x < 3; x++)
                    values[s.first + z * layer + y * row + x] += own * s.weight[0][x] * s.weight[1][y] * s.weight[2][z];
    }
}

static bool has_colour(uint64_t code, int colour)
{
    return ((cell_at(code, 0) & 1) | (cell_at(code, 1) & 1) << 1 | (cell_at(code, 2) & 1) << 2) == colour;
}

/* The nodes that the particles of a cell give to: REACH along each axis, from the first one on. */
enum { REACH = 4 };
typedef struct given {
    uint64_t first;
    double value[REACH * REACH * REACH];
} given;

static void copy_nodes(const sb_nodes *nodes, given *g, double *values, bool out)
{
    const size_t row = sb_nodes_stride(nodes, 1), layer = sb_nodes_stride(nodes, 2), across = nodes->flat ? 1 : REACH;
    double *value = g->value;
    for (size_t z = 0; z < REACH; z++)
        for (size_t y = 0; y < across; y++)
            for (size_t x = 0; x < REACH; x++, value++) {
                double *node = &values[g->first + z * layer + y * row + x];
                *(out ? value : node) = *(out ? node : value);
            }
}

static uint64_t first_node(const sb_nodes *nodes, uint64_t code)
{
    uint64_t first = 0;
    for (int axis = 0; axis < 3; axis++)
        if (!nodes->flat || axis != 1)
            first += (uint64_t)(2 * cell_at(code, axis) - nodes->low[axis] - 1) * sb_nodes_stride(nodes, axis);
    return first;
}

/* Gives all domains the nodes to which each has given in its cells of a colour. Returns 0, or -1 without memory in any
   domain. */
static int share_colour(const sb_sim *sim, const sb_nodes *nodes, int colour, double *values)
{
    const sb_cells *cells = &sim->cells;
    sb_ranks *ranks = sim->ranks;
    size_t sizes[SB_RANKS_MAX], all = 0, count = 0;
    for (size_t c = 0; c < cells->count; c++) count += has_colour(cells->code[c], colour);
    const size_t length = count * sizeof(given);
    sb_ranks_gather(ranks, &length, sizeof length, sizes);
    for (int r = 0; r < ranks->count; r++) all += sizes[r];
    given *own = sb_alloc_untouched(count, sizeof *own), *theirs = sb_alloc_untouched(all, 1);
    const bool failed = sb_ranks_any(ranks, !own || !theirs);
    count = 0;
    for (size_t c = 0; c < cells->count && !failed; c++) {
        if (!has_colour(cells->code[c], colour)) continue;
        own[count].first = first_node(nodes, cells->code[c]);
        copy_nodes(nodes, &own[count++], values, true);
    }
    if (!failed) sb_ranks_spread(ranks, own, theirs, sizes);
    for (size_t k = 0; k < all / sizeof *theirs && !failed; k++) copy_nodes(nodes, &theirs[k], values, false);
    sb_free(own);
    sb_free(theirs);
    return failed ? -1 : 0;
}

/* Cells of one colour are at least two cells apart along each axis and have no node in common. */
int sb_nodes_give(const sb_sim *sim, const sb_nodes *nodes, const sb_f4 *field, double factor, double *values)
{
    const sb_cells *cells = &sim->cells;
    for (int colour = 0; colour < COLOURS; colour++) {
#pragma omp parallel for schedule(dynamic, 64)
        for (size_t c = 0; c < cells->count; c++)
            if (has_colour(cells->code[c], colour)) give_cell(sim, nodes, c, field, factor, values);
        if (sb_ranks_several(sim->ranks) && share_colour(sim, nodes, colour, values) != 0) return -1;
    }
    return 0;
}

void sb_nodes_take(const sb_sim *sim, const sb_nodes *nodes, size_t i, const double *values, int components,
                   double sum[3])
{
    const size_t row = sb_nodes_stride(nodes, 1), layer = sb_nodes_stride(nodes, 2), each = (size_t)components;
    const share s = share_of(nodes, sim->state.position[i]);
    for (int k = 0; k < components; k++) sum[k] = 0;
    for (size_t z = 0; z < 3; z++)
        for (size_t y = 0; y < (size_t)s.across; y++)
            for (size_t x = 0; x < 3; x++) {
                const double weight = s.weight[0][x] * s.weight[1][y] * s.weight[2][z];
                const double *value = values + each * (s.first + z * layer + y * row + x);
                for (int k = 0; k < components; k++) sum[k] += weight * value[k];
            }
}

/* One row of nodes along x: spare holds the values before. */
static void smooth_row(const sb_nodes *nodes, int axis, size_t y, size_t z, double *values, size_t each,
                       const double *spare)
{
    const size_t last = nodes->size[axis] - 1, step = each * sb_nodes_stride(nodes, axis);
    const size_t first = (z * nodes->size[1] + y) * nodes->size[0];
    for (size_t x = 0; x < nodes->size[0]; x++) {
        const size_t along = axis == 0 ? x : axis == 1 ? y : z;
        for (size_t k = 0; k < each; k++) {
            const size_t at = each * (first + x) + k;
            const double before = along > 0 ? spare[at - step] : 0, after = along < last ? spare[at + step] : 0;
            values[at] = 0.25 * (before + after) + 0.5 * spare[at];
        }
    }
}

void sb_nodes_smooth(const sb_nodes *nodes, double *values, int components, double *spare)
{
    const size_t rows = nodes->count > 0 ? nodes->size[1] * nodes->size[2] : 0, each = (size_t)components;
    for (int axis = 0; axis < 3; axis++) {
        if (nodes->flat && axis == 1) continue;
        memcpy(spare, values, nodes->count * each * sizeof *values);
#pragma omp parallel for schedule(static)
        for (size_t r = 0; r < rows; r++)
            smooth_row(nodes, axis, r % nodes->size[1], r / nodes->size[1], values, each, spare);
    }
}
