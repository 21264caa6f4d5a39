#include "surface/march.h"

#include "base/memory.h"
#include "surface/cubes.h"
#include "surface/eight.h"
#include "surface/level.h"

#include <math.h>
#include <string.h>

enum { SIDE = SB_BLOCK_SIDE, WIDE = SB_BLOCK_SIDE + 1, WORDS = 3 * SIDE };

/* Which edges of a block's nodes cross the surface: a word for each axis and z, a bit for each y and x. The vertices of
   a block are numbered in the order of these bits, so that the number of an edge's vertex need not be stored. */
typedef struct crossings {
    uint64_t words[WORDS];
    uint32_t before[WORDS]; /* vertices of the block in the words before */
    uint32_t first;         /* vertex of the mesh */
    uint32_t first_triangle;
    uint32_t vertices, triangles;
} crossings;

typedef struct march {
    const sb_frame *frame;
    const sb_blocks *blocks;
    const float *value;
    crossings *crossings; /* of each block */
    uint32_t *node;       /* of each vertex, the node in the water */
    sb_cube_case cases[256];
} march;

/* Nodes of a block and those at the low sides of its neighbours. */
typedef struct nodes {
    int64_t block[8]; /* bit 0: neighbour along x, 1: y, 2: z */
    float value[WIDE][WIDE][WIDE];
} nodes;

static void collect(const march *m, size_t block, nodes *n)
{
    for (int s = 0; s < 8; s++)
        n->block[s] = s ? sb_blocks_at(m->blocks, block, s & 1, s >> 1 & 1, s >> 2) : (int64_t)block;
    for (int z = 0; z < WIDE; z++)
        for (int y = 0; y < WIDE; y++)
            for (int x = 0; x < WIDE; x++) {
                const int64_t in = n->block[(x == SIDE) | (y == SIDE) << 1 | (z == SIDE) << 2];
                const int at = ((z % SIDE) * SIDE + y % SIDE) * SIDE + x % SIDE;
                n->value[z][y][x] = in < 0 ? 0 : m->value[(size_t)in * SB_BLOCK_NODES + (size_t)at];
            }
}

/* Whether a block with its neighbours can contain a piece of the surface. */
static bool has_surface(const nodes *n)
{
    const float *values = &n->value[0][0][0];
    int wet = 0;
    for (int i = 0; i < WIDE * WIDE * WIDE; i++) wet += values[i] > SB_LEVEL;
    return wet > 0 && wet < WIDE * WIDE * WIDE;
}

static unsigned case_at(const nodes *n, int x, int y, int z)
{
    unsigned water = 0;
    for (int c = 0; c < 8; c++)
        water |= (unsigned)(n->value[z + (c >> 2)][y + (c >> 1 & 1)][x + (c & 1)] > SB_LEVEL) << c;
    return water;
}

static void count_block(const march *m, size_t block, crossings *out)
{
    nodes n;
    memset(out, 0, sizeof *out);
    collect(m, block, &n);
    if (!has_surface(&n)) return;
    for (int z = 0; z < SIDE; z++)
        for (int y = 0; y < SIDE; y++)
            for (int x = 0; x < SIDE; x++) {
                const unsigned water = case_at(&n, x, y, z);
                out->triangles += m->cases[water].count;
                for (int axis = 0; axis < 3; axis++)
                    out->words[axis * SIDE + z] |= (uint64_t)((water ^ water >> (1 << axis)) & 1) << (y * SIDE + x);
            }
    for (int w = 0; w < WORDS; w++) {
        out->before[w] = out->vertices;
        out->vertices += (uint32_t)__builtin_popcountll(out->words[w]);
    }
}

/* The vertex on the edge of a cube. */
static uint32_t vertex_of(const march *m, const nodes *n, int x, int y, int z, int edge)
{
    const int corner = sb_cube_edge_corner(edge), at[3] = {x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2)};
    const int64_t in = n->block[(at[0] == SIDE) | (at[1] == SIDE) << 1 | (at[2] == SIDE) << 2];
    const crossings *c = &m->crossings[in];
    const int word = edge / 4 * SIDE + at[2] % SIDE, bit = at[1] % SIDE * SIDE + at[0] % SIDE;
    return c->first + c->before[word] + (uint32_t)__builtin_popcountll(c->words[word] & (((uint64_t)1 << bit) - 1));
}

static void write_triangles(const march *m, const nodes *n, const crossings *c, sb_water_mesh *mesh)
{
    size_t made = c->first_triangle;
    for (int z = 0; z < SIDE; z++)
        for (int y = 0; y < SIDE; y++)
            for (int x = 0; x < SIDE; x++) {
                const sb_cube_case *cube = &m->cases[case_at(n, x, y, z)];
                for (int t = 0; t < cube->count; t++, made++)
                    for (int k = 0; k < 3; k++) mesh->corner[made][k] = vertex_of(m, n, x, y, z, cube->corners[t][k]);
            }
}

/* Means of velocity and pressure at a place in the block, by weight x kernel. Returns the field there. */
static float interpolate(const march *m, const sb_near *near, const float at[3], float velocity[3], float *pressure)
{
    const sb_blocks *b = m->blocks;
    const float scale = 1 / (b->reach * b->reach);
    sb_eight_floats sums[5] = {{0}};
    int bin[3];
    for (int a = 0; a < 3; a++) {
        const int inner = (int)(at[a] * (float)b->bins / SIDE);
        bin[a] = (inner < b->bins ? inner : b->bins - 1) + 1;
    }
    for (int row = 0; row < 9; row++) {
        const int middle = ((bin[2] + row / 3 - 1) * near->bins + bin[1] + row % 3 - 1) * near->bins + bin[0];
        const uint32_t end = near->first[middle + 2];
        for (uint32_t j = near->first[middle - 1]; j < end; j += 8) {
            /* Values from `end` on have a weight of 0, but may not be finite. */
            const sb_eight_ints within = sb_eight_before(end - j);
            const sb_eight_floats kernel = sb_eight_kernel(near, j, end, at, scale);
            const sb_eight_floats w = kernel * (sb_eight_floats)((sb_eight_ints)sb_eight_at(near->weight + j) & within);
            for (int c = 0; c < 4; c++)
                sums[c] += w * (sb_eight_floats)((sb_eight_ints)sb_eight_at(near->carried[c] + j) & within);
            sums[4] += w;
        }
    }
    const float sum = sb_eight_sum(sums[4]), part = sum > 0 ? 1 / sum : 0;
    for (int a = 0; a < 3; a++) velocity[a] = sb_eight_sum(sums[a]) * part;
    *pressure = sb_eight_sum(sums[3]) * part;
    return (float)SB_LEVEL_NORM * sum;
}

/* Not in the nodes themselves, where vertices of several edges would coincide. */
static float within(float part)
{
    return fminf(fmaxf(part, 0.01F), 0.99F);
}

/* Where the parabola through the field at the ends of an edge and at `part` of it has the level. A straight line would
   make sheets of one layer some 7 % too thin, because the field curves within a cell. */
static float refine(float here, float there, float part, float field)
{
    const float slope = there - here, curve = (field - here - part * slope) / (part * (part - 1));
    const float b = slope - curve, c = here - SB_LEVEL, root = sqrtf(fmaxf(b * b - 4 * curve * c, 0));
    const float q = -0.5F * (b + (b < 0 ? -root : root)), one = c / q, other = q / curve;
    /* The field crosses the level once between the ends. Divisions by 0 give values that are not between them. */
    if (one >= 0 && one <= 1) return one;
    return other >= 0 && other <= 1 ? other : part;
}

static uint32_t node_of(const nodes *n, int x, int y, int z)
{
    const size_t in = (size_t)n->block[(x == SIDE) | (y == SIDE) << 1 | (z == SIDE) << 2];
    return (uint32_t)(in * SB_BLOCK_NODES + (size_t)(((z % SIDE) * SIDE + y % SIDE) * SIDE + x % SIDE));
}

static void write_vertices(const march *m, size_t block, const nodes *n, const sb_near *near, sb_water_mesh *mesh)
{
    const crossings *c = &m->crossings[block];
    double start[3];
    size_t v = c->first;
    sb_blocks_start(m->blocks, block, start);
    for (int w = 0; w < WORDS; w++)
        for (uint64_t bits = c->words[w]; bits; bits &= bits - 1, v++) {
            const int bit = __builtin_ctzll(bits), x = bit % SIDE, y = bit / SIDE, z = w % SIDE, axis = w / SIDE;
            const float here = n->value[z][y][x], there = n->value[z + (axis == 2)][y + (axis == 1)][x + (axis == 0)];
            const float part = within((SB_LEVEL - here) / (there - here));
            float at[3] = {(float)x, (float)y, (float)z};
            at[axis] += part;
            const float field = interpolate(m, near, at, mesh->velocity[v], &mesh->pressure[v]);
            at[axis] += within(refine(here, there, part, field)) - part;
            m->node[v] = node_of(n, x + (axis == 0 && !(here > SB_LEVEL)), y + (axis == 1 && !(here > SB_LEVEL)),
                                 z + (axis == 2 && !(here > SB_LEVEL)));
            for (int a = 0; a < 3; a++) mesh->position[v][a] = (float)(start[a] + (double)at[a] * m->blocks->cell);
        }
}

static sb_status allocate(march *m, sb_water_mesh *mesh, sb_error *error)
{
    size_t vertices = 0, triangles = 0;
    for (size_t block = 0; block < m->blocks->count; block++) {
        m->crossings[block].first = (uint32_t)vertices;
        m->crossings[block].first_triangle = (uint32_t)triangles;
        vertices += m->crossings[block].vertices;
        triangles += m->crossings[block].triangles;
        if (vertices > INT32_MAX || triangles > INT32_MAX)
            return sb_fail(error, SB_BAD_INPUT, "the surface has more than %d vertices or triangles: use larger cells",
                           INT32_MAX);
    }
    mesh->vertices = vertices;
    mesh->triangles = triangles;
    m->node = sb_alloc_untouched(vertices, sizeof *m->node);
    mesh->position = sb_alloc_untouched(vertices, sizeof *mesh->position);
    mesh->normal = sb_alloc(vertices, sizeof *mesh->normal);
    mesh->velocity = sb_alloc_untouched(vertices, sizeof *mesh->velocity);
    mesh->pressure = sb_alloc_untouched(vertices, sizeof *mesh->pressure);
    mesh->corner = sb_alloc_untouched(triangles, sizeof *mesh->corner);
    return m->node && mesh->position && mesh->normal && mesh->velocity && mesh->pressure && mesh->corner
               ? SB_OK
               : sb_fail_memory(error, "a surface");
}

/* Returns 0, or -1 if memory runs out. */
static int write_mesh(const march *m, sb_water_mesh *mesh)
{
    int failed = 0;
#pragma omp parallel reduction(| : failed)
    {
        sb_near near = {0};
#pragma omp for schedule(dynamic, 16)
        for (size_t block = 0; block < m->blocks->count; block++) {
            const crossings *c = &m->crossings[block];
            if (failed || (c->vertices == 0 && c->triangles == 0)) continue;
            nodes n;
            collect(m, block, &n);
            write_triangles(m, &n, c, mesh);
            failed |= sb_near_fill(m->blocks, block, m->frame, &near) != 0;
            if (!failed) write_vertices(m, block, &n, &near, mesh);
        }
        sb_near_free(&near);
    }
    return failed ? -1 : 0;
}

sb_status sb_march(const sb_frame *frame, const sb_blocks *blocks, const float *value, sb_water_mesh *mesh,
                   uint32_t **node, sb_error *error)
{
    *node = NULL;
    if (blocks->count > UINT32_MAX / SB_BLOCK_NODES)
        return sb_fail(error, SB_BAD_INPUT,
                       "the surface has %zu blocks of cells, expected at most %u: use larger cells", blocks->count,
                       UINT32_MAX / SB_BLOCK_NODES);
    march m = {.frame = frame, .blocks = blocks, .value = value};
    m.crossings = sb_alloc_untouched(blocks->count, sizeof *m.crossings);
    if (!m.crossings) return sb_fail_memory(error, "a surface");
    sb_cube_cases(m.cases);
#pragma omp parallel for schedule(dynamic, 16)
    for (size_t block = 0; block < blocks->count; block++) count_block(&m, block, &m.crossings[block]);
    sb_status status = allocate(&m, mesh, error);
    if (status == SB_OK && write_mesh(&m, mesh) != 0) status = sb_fail_memory(error, "a surface");
    sb_free(m.crossings);
    if (status == SB_OK)
        *node = m.node;
    else
        sb_free(m.node);
    return status;
}
