#include "surface/blocks.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { KEY_BITS = 19, KEY_MOST = (1 << KEY_BITS) - 4, BIN_BITS = 6, BINS_MOST = 4 };

/* Surfaces of lattices at rest are at multiples of half the spacing. Nodes lie beside these planes, so that a surface
   does not run through nodes and have slivers there. */
static const double beside = 0.37;

typedef struct entry {
    uint64_t key; /* block and bin */
    uint32_t index;
} entry;

static int compare(const void *a, const void *b)
{
    const entry *p = a, *q = b;
    if (p->key != q->key) return p->key < q->key ? -1 : 1;
    return (p->index > q->index) - (p->index < q->index);
}

static uint64_t step_of(int x, int y, int z)
{
    /* Two's complement: subtracting works too. */
    return (((uint64_t)(int64_t)z << KEY_BITS) + (uint64_t)(int64_t)y) * (1u << KEY_BITS) + (uint64_t)(int64_t)x;
}

/* Sets the grid: the blocks' coordinates of all particles are from 2 to KEY_MOST. */
static sb_status place_grid(const sb_frame *frame, sb_blocks *b, sb_error *error)
{
    const double origin[3] = {frame->origin.x, frame->origin.y, frame->origin.z}, side = SB_BLOCK_SIDE * b->cell;
    for (int a = 0; a < 3; a++) {
        float low = frame->position[a], high = low;
        for (size_t i = 1; i < frame->count; i++) {
            const float at = frame->position[3 * i + (size_t)a];
            low = at < low ? at : low;
            high = at > high ? at : high;
        }
        if (((double)high - (double)low) / side > KEY_MOST - 4)
            return sb_fail(error, SB_BAD_INPUT,
                           "the water is %g m long along %c, expected at most %g m for a spacing of %g m",
                           (double)high - (double)low, "xyz"[a], (KEY_MOST - 4) * side, frame -> spacing);
        const double first = floor((origin[a] + (double)low) / side - beside) - 2;
        b->start[a] = (first + beside / SB_BLOCK_SIDE) * side - origin[a];
    }
    return SB_OK;
}

static void make_entries(const sb_frame *frame, const sb_blocks *b, entry *entries)
{
    const double scale = 1 / b->cell;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < frame->count; i++) {
        int at[3], bin[3];
        for (size_t a = 0; a < 3; a++) {
            const double cells = ((double)frame->position[3 * i + a] - b->start[a]) * scale;
            at[a] = (int)(cells / SB_BLOCK_SIDE);
            const int inner = (int)((cells - (double)at[a] * SB_BLOCK_SIDE) * b->bins / SB_BLOCK_SIDE);
            bin[a] = inner < b->bins ? inner : b->bins - 1;
        }
        entries[i].key =
            step_of(at[0], at[1], at[2]) << BIN_BITS | (uint64_t)((bin[2] * b->bins + bin[1]) * b->bins + bin[0]);
        entries[i].index = (uint32_t)i;
    }
    qsort(entries, frame->count, sizeof *entries, compare);
}

/* out: the keys, those one step below and those one step above, ascending and without repetition. Returns their number.
 */
static size_t widen(const uint64_t *keys, size_t count, uint64_t step, uint64_t *out)
{
    size_t at[3] = {0, 0, 0}, made = 0;
    const uint64_t shift[3] = {0 - step, 0, step};
    for (;;) {
        uint64_t least = UINT64_MAX;
        for (int s = 0; s < 3; s++)
            if (at[s] < count && keys[at[s]] + shift[s] < least) least = keys[at[s]] + shift[s];
        if (least == UINT64_MAX) return made;
        for (int s = 0; s < 3; s++) at[s] += at[s] < count && keys[at[s]] + shift[s] == least;
        out[made++] = least;
    }
}

/* Lists the blocks that contain particles and all their neighbours. */
static sb_status list_blocks(sb_blocks *b, const entry *entries, sb_error *error)
{
    size_t count = 0;
    for (size_t i = 0; i < b->particles; i++)
        count += i == 0 || entries[i].key >> BIN_BITS != entries[i - 1].key >> BIN_BITS;
    uint64_t *keys = sb_alloc(count, sizeof *keys);
    count = 0;
    for (size_t i = 0; keys && i < b->particles; i++)
        if (i == 0 || entries[i].key >> BIN_BITS != entries[i - 1].key >> BIN_BITS)
            keys[count++] = entries[i].key >> BIN_BITS;
    const uint64_t steps[3] = {step_of(1, 0, 0), step_of(0, 1, 0), step_of(0, 0, 1)};
    for (int a = 0; keys && a < 3; a++) {
        uint64_t *wider = sb_alloc_untouched(3 * count, sizeof *wider);
        if (wider) count = widen(keys, count, steps[a], wider);
        sb_free(keys);
        keys = wider;
    }
    b->keys = keys;
    b->count = count;
    return keys ? SB_OK : sb_fail_memory(error, "the blocks of a surface");
}

static void sort_particles(const sb_frame *frame, sb_blocks *b, const entry *entries)
{
    const size_t per_block = b->all_bins;
    size_t next = 0;
    for (size_t block = 0; block < b->count; block++)
        for (size_t bin = 0; bin < per_block; bin++) {
            b->bin_first[block * per_block + bin] = (uint32_t)next;
            while (next < b->particles && entries[next].key == (b->keys[block] << BIN_BITS | bin)) next++;
        }
    b->bin_first[b->count * per_block] = (uint32_t)next;
    const double scale = 1 / b->cell;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < b->particles; i++) {
        const size_t from = entries[i].index;
        b->source[i] = (uint32_t)from;
        for (size_t a = 0; a < 3; a++) {
            const double cells = ((double)frame->position[3 * from + a] - b->start[a]) * scale;
            b->place[a][i] = (float)(cells - floor(cells / SB_BLOCK_SIDE) * SB_BLOCK_SIDE);
        }
    }
}

static sb_status allocate(sb_blocks *b, sb_error *error)
{
    const size_t n = b->particles;
    for (int a = 0; a < 3; a++) b->place[a] = sb_alloc_untouched(n, sizeof(float));
    b->weight = sb_alloc_untouched(n, sizeof(float));
    b->source = sb_alloc_untouched(n, sizeof *b->source);
    b->bin_first = sb_alloc_untouched(b->count * b->all_bins + 1, sizeof *b->bin_first);
    return b->place[0] && b->place[1] && b->place[2] && b->weight && b->source && b->bin_first
               ? SB_OK
               : sb_fail_memory(error, "the particles of a surface");
}

sb_status sb_blocks_build(const sb_frame *frame, double cell, double reach, sb_blocks *blocks, sb_error *error)
{
    const double bins = floor(SB_BLOCK_SIDE * cell / reach);
    sb_blocks b = {.cell = cell * frame->spacing, .reach = (float)(reach / cell), .particles = frame->count};
    b.bins = bins < BINS_MOST ? (int)bins : BINS_MOST;
    b.all_bins = (size_t)b.bins * (size_t)b.bins * (size_t)b.bins;
    *blocks = (sb_blocks){0};
    if (frame->count == 0 || frame->count > UINT32_MAX)
        return sb_fail(error, SB_BAD_INPUT, "%zu particles, expected 1 to %u", frame->count, UINT32_MAX);
    entry *entries = sb_alloc_untouched(frame->count, sizeof *entries);
    sb_status status = entries ? place_grid(frame, &b, error) : sb_fail_memory(error, "the particles of a surface");
    if (status == SB_OK) {
        make_entries(frame, &b, entries);
        status = list_blocks(&b, entries, error);
    }
    if (status == SB_OK) status = allocate(&b, error);
    if (status == SB_OK) sort_particles(frame, &b, entries);
    sb_free(entries);
    if (status == SB_OK)
        *blocks = b;
    else
        sb_blocks_free(&b);
    return status;
}

void sb_blocks_free(sb_blocks *blocks)
{
    for (int a = 0; a < 3; a++) sb_free(blocks->place[a]);
    sb_free(blocks->keys);
    sb_free(blocks->weight);
    sb_free(blocks->source);
    sb_free(blocks->bin_first);
    *blocks = (sb_blocks){0};
}

int64_t sb_blocks_at(const sb_blocks *blocks, size_t block, int x, int y, int z)
{
    const uint64_t key = blocks->keys[block] + step_of(x, y, z);
    size_t low = 0, high = blocks->count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (blocks->keys[middle] < key)
            low = middle + 1;
        else
            high = middle;
    }
    return low < blocks->count && blocks->keys[low] == key ? (int64_t)low : SB_BLOCK_NONE;
}

bool sb_blocks_has_particles(const sb_blocks *blocks, size_t block)
{
    const size_t bins = blocks->all_bins;
    return blocks->bin_first[block * bins] < blocks->bin_first[(block + 1) * bins];
}

void sb_blocks_start(const sb_blocks *blocks, size_t block, double start[3])
{
    const uint64_t mask = ((uint64_t)1 << KEY_BITS) - 1;
    for (int a = 0; a < 3; a++)
        start[a] =
            blocks->start[a] + (double)(blocks->keys[block] >> (a * KEY_BITS) & mask) * SB_BLOCK_SIDE * blocks->cell;
}

static int grow(sb_near *near, size_t needed)
{
    if (needed <= near->capacity) return 0;
    sb_near_free(near);
    const size_t capacity = needed + needed / 2, longer = capacity + 8;
    near->x = sb_alloc_untouched(longer, sizeof(float));
    near->y = sb_alloc_untouched(longer, sizeof(float));
    near->z = sb_alloc_untouched(longer, sizeof(float));
    near->weight = sb_alloc_untouched(longer, sizeof(float));
    near->particle = sb_alloc_untouched(longer, sizeof *near->particle);
    bool complete = near->x && near->y && near->z && near->weight && near->particle;
    for (int c = 0; c < 4; c++) complete &= (near->carried[c] = sb_alloc_untouched(longer, sizeof(float))) != NULL;
    if (!complete) return -1;
    near->capacity = capacity;
    return 0;
}

/* One bin beside or within a block: its block, the shift of its places and its particles. */
typedef struct bin {
    float shift[3];
    uint32_t first, end;
} bin;

/* Lists the bins of a block and around it; returns the number of their particles. */
static size_t list_bins(const sb_blocks *b, size_t block, int wide, bin *bins)
{
    int64_t around[27];
    size_t total = 0;
    for (int k = 0; k < 27; k++) around[k] = sb_blocks_at(b, block, k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    for (int i = 0; i < wide * wide * wide; i++) {
        const int at[3] = {i % wide - 1, i / wide % wide - 1, i / (wide * wide) - 1};
        int side[3], inner[3];
        for (int a = 0; a < 3; a++) {
            side[a] = at[a] < 0 ? -1 : at[a] >= b->bins ? 1 : 0;
            inner[a] = at[a] - side[a] * b->bins;
            bins[i].shift[a] = (float)(side[a] * SB_BLOCK_SIDE);
        }
        const int64_t in = around[13 + side[0] + 3 * side[1] + 9 * side[2]];
        const int index = (inner[2] * b->bins + inner[1]) * b->bins + inner[0];
        const uint32_t *first = b->bin_first + (in < 0 ? 0 : (size_t)in * b->all_bins + (size_t)index);
        bins[i].first = in < 0 ? 0 : first[0];
        bins[i].end = in < 0 ? 0 : first[1];
        total += bins[i].end - bins[i].first;
    }
    return total;
}

int sb_near_fill(const sb_blocks *blocks, size_t block, const sb_frame *frame, sb_near *near)
{
    bin bins[(BINS_MOST + 2) * (BINS_MOST + 2) * (BINS_MOST + 2)];
    const int wide = blocks->bins + 2, all = wide * wide * wide;
    near->count = 0;
    near->bins = wide;
    if (grow(near, list_bins(blocks, block, wide, bins)) != 0) return -1;
    for (int i = 0; i < all; i++) {
        near->first[i] = (uint32_t)near->count;
        for (uint32_t p = bins[i].first; p < bins[i].end; p++) {
            const size_t n = near->count++;
            near->x[n] = blocks->place[0][p] + bins[i].shift[0];
            near->y[n] = blocks->place[1][p] + bins[i].shift[1];
            near->z[n] = blocks->place[2][p] + bins[i].shift[2];
            near->weight[n] = blocks->weight[p];
            near->particle[n] = p;
            if (!frame) continue;
            const size_t of = blocks->source[p];
            for (size_t c = 0; c < 3; c++) near->carried[c][n] = frame->velocity[3 * of + c];
            near->carried[3][n] = frame->pressure[of];
        }
    }
    near->first[all] = (uint32_t)near->count;
    return 0;
}

void sb_near_free(sb_near *near)
{
    sb_free(near->x);
    sb_free(near->y);
    sb_free(near->z);
    sb_free(near->weight);
    sb_free(near->particle);
    for (int c = 0; c < 4; c++) sb_free(near->carried[c]);
    *near = (sb_near){.bins = near->bins};
}
