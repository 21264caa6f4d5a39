/* Finds connected nodes of the grid, and counts the particles beside them. */
#include "surface/waters.h"

#include "base/memory.h"
#include "base/sets.h"
#include "surface/level.h"

enum { SIDE = SB_BLOCK_SIDE, WIDE = SB_BLOCK_SIDE + 1 };
static const uint32_t none = UINT32_MAX;

/* Node numbers of a block and of those at the low sides of its neighbours; `none` outside of the water. */
typedef uint32_t cube[WIDE][WIDE][WIDE];

/* Each node's parent: the first of its row in the block, as far as the water goes. */
static void join_rows(const float *value, size_t nodes, uint32_t *parent)
{
#pragma omp parallel for schedule(static)
    for (size_t row = 0; row < nodes / SIDE; row++)
        for (size_t n = SIDE * row; n < SIDE * (row + 1); n++)
            parent[n] = !(value[n] > SB_LEVEL)                      ? none
                        : n > SIDE * row && value[n - 1] > SB_LEVEL ? parent[n - 1]
                                                                    : (uint32_t)n;
}

/* Returns whether there is water in the block or beside it. */
static bool collect(const sb_blocks *blocks, size_t block, const uint32_t *parent, cube out)
{
    int64_t in[8];
    bool wet = false;
    for (int s = 0; s < 8; s++) in[s] = s ? sb_blocks_at(blocks, block, s & 1, s >> 1 & 1, s >> 2) : (int64_t)block;
    for (int z = 0; z < WIDE; z++)
        for (int y = 0; y < WIDE; y++)
            for (int x = 0; x < WIDE; x++) {
                const int64_t b = in[(x == SIDE) | (y == SIDE) << 1 | (z == SIDE) << 2];
                const int at = ((z % SIDE) * SIDE + y % SIDE) * SIDE + x % SIDE;
                const size_t node = b < 0 ? 0 : (size_t)b * SB_BLOCK_NODES + (size_t)at;
                out[z][y][x] = b < 0 || parent[node] == none ? none : (uint32_t)node;
                wet |= out[z][y][x] != none;
            }
    return wet;
}

/* Joins two opposite corners of the face a, b, d, c that alone are in the water. Others are joined along edges. */
static void join_diagonal(uint32_t *parent, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    if (a != none && d != none && b == none && c == none) sb_sets_join(parent, a, d);
    if (b != none && c != none && a == none && d == none) sb_sets_join(parent, b, c);
}

static void join_block(uint32_t *parent, cube at)
{
    for (int z = 0; z < SIDE; z++)
        for (int y = 0; y < SIDE; y++)
            for (int x = 0; x < SIDE; x++) {
                const uint32_t a = at[z][y][x], px = at[z][y][x + 1], py = at[z][y + 1][x], pz = at[z + 1][y][x];
                const bool follows = /* the rows beside may be joined one node before */
                    x > 0 && at[z][y][x - 1] != none;
                if (a != none) {
                    if (x == SIDE - 1 && px != none) sb_sets_join(parent, a, px);
                    if (py != none && !(follows && at[z][y + 1][x - 1] != none)) sb_sets_join(parent, a, py);
                    if (pz != none && !(follows && at[z + 1][y][x - 1] != none)) sb_sets_join(parent, a, pz);
                }
                join_diagonal(parent, a, px, py, at[z][y + 1][x + 1]);
                join_diagonal(parent, a, px, pz, at[z + 1][y][x + 1]);
                join_diagonal(parent, a, py, pz, at[z + 1][y + 1][x]);
            }
}

/* Numbers the waters of the vertices; number: of each root, `none` before. */
static sb_status number_waters(const uint32_t *node, size_t vertices, uint32_t *parent, uint32_t *number,
                               sb_waters *waters, sb_error *error)
{
    for (size_t v = 0; v < vertices; v++) {
        const uint32_t root = sb_sets_root(parent, node[v]);
        if (number[root] == none) number[root] = (uint32_t)waters->count++;
        waters->water[v] = number[root];
    }
    waters->first = sb_alloc_untouched(waters->count, sizeof *waters->first);
    waters->particles = sb_alloc(waters->count, sizeof *waters->particles);
    if (!waters->first || !waters->particles) return sb_fail_memory(error, "the parts of a surface");
    for (size_t v = vertices; v-- > 0;) waters->first[waters->water[v]] = (uint32_t)v;
    return SB_OK;
}

/* The nearest corner of a particle's cell in the water, or `none`. */
static uint32_t node_of(const sb_blocks *blocks, size_t block, size_t particle, const uint32_t *parent)
{
    uint32_t nearest = none;
    float least = 4;
    for (int corner = 0; corner < 8; corner++) {
        int at[3], out[3];
        float square = 0;
        for (int a = 0; a < 3; a++) {
            const float place = blocks->place[a][particle];
            const int low = place < SIDE - 1 ? (int)place : SIDE - 1;
            at[a] = low + (corner >> a & 1);
            out[a] = at[a] / SIDE;
            square += (place - (float)at[a]) * (place - (float)at[a]);
        }
        if (!(square < least)) continue;
        const int64_t in =
            out[0] + out[1] + out[2] > 0 ? sb_blocks_at(blocks, block, out[0], out[1], out[2]) : (int64_t)block;
        if (in < 0) continue;
        const size_t node =
            (size_t)in * SB_BLOCK_NODES + (size_t)(((at[2] % SIDE) * SIDE + at[1] % SIDE) * SIDE + at[0] % SIDE);
        if (parent[node] == none) continue;
        nearest = (uint32_t)node;
        least = square;
    }
    return nearest;
}

static void count_particles(const sb_blocks *blocks, uint32_t *parent, const uint32_t *number, double *particles)
{
    for (size_t block = 0; block < blocks->count; block++)
        for (uint32_t p = blocks->bin_first[block * blocks->all_bins];
             p < blocks->bin_first[(block + 1) * blocks->all_bins]; p++) {
            const uint32_t node = node_of(blocks, block, p, parent);
            const uint32_t water = node == none ? none : number[sb_sets_root(parent, node)];
            if (water != none) particles[water]++;
        }
}

sb_status sb_waters_find(const sb_blocks *blocks, const float *value, const uint32_t *node, size_t vertices,
                         sb_waters *waters, sb_error *error)
{
    const size_t nodes = blocks->count * SB_BLOCK_NODES;
    cube at;
    *waters = (sb_waters){0};
    uint32_t *parent = sb_alloc_untouched(nodes, sizeof *parent), *number = sb_alloc_untouched(nodes, sizeof *number);
    sb_waters made = {.water = sb_alloc_untouched(vertices, sizeof *made.water)};
    sb_status status = SB_OK;
    if (!parent || !number || !made.water) {
        status = sb_fail_memory(error, "the parts of a surface");
        goto done;
    }
    join_rows(value, nodes, parent);
    for (size_t block = 0; block < blocks->count; block++)
        if (collect(blocks, block, parent, at)) join_block(parent, at);
    for (size_t n = 0; n < nodes; n++) number[n] = none;
    status = number_waters(node, vertices, parent, number, &made, error);
    if (status == SB_OK) count_particles(blocks, parent, number, made.particles);
done:
    sb_free(parent);
    sb_free(number);
    if (status == SB_OK)
        *waters = made;
    else
        sb_waters_free(&made);
    return status;
}

void sb_waters_free(sb_waters *waters)
{
    sb_free(waters->water);
    sb_free(waters->first);
    sb_free(waters->particles);
    *waters = (sb_waters){0};
}
