/* Tables of a set of boundary particles: its order along the Z-curve with its cells, and the hash set of blocks near
   walls, in which one look-up recognises a place without walls. */
#include "base/hash.h"
#include "base/memory.h"
#include "sim/search/sort.h"
#include "sim/walls/walls.h"

#include <string.h>

enum { NEAR_SHIFT = 6 }; /* 4 x 4 x 4 cells */

static bool near_insert(sb_wall_set *set, uint64_t block)
{
    uint64_t at = sb_hash_mix(block) & set->near_mask;
    for (;; at = (at + 1) & set->near_mask) {
        if (set->near[at] == block + 1) return false;
        if (set->near[at] == 0) {
            set->near[at] = block + 1;
            return true;
        }
    }
}

bool sb_walls_near(const sb_wall_set *set, const sb_space *space, sb_record record)
{
    if (set->count == 0) return false;
    uint64_t block = sb_space_key(space, record) >> NEAR_SHIFT;
    for (uint64_t at = sb_hash_mix(block) & set->near_mask;; at = (at + 1) & set->near_mask) {
        if (set->near[at] == block + 1) return true;
        if (set->near[at] == 0) return false;
    }
}

static uint64_t block_beside(const sb_space *space, sb_record record, int dx, int dy, int dz)
{
    uint32_t cell = (uint32_t)1 << space->shift;
    sb_record beside = record + (sb_record){(uint32_t)dx * cell, (uint32_t)dy * cell, (uint32_t)dz * cell, 0};
    return sb_space_key(space, beside) >> NEAR_SHIFT;
}

int sb_walls_near_build(sb_wall_set *set, const sb_space *space)
{
    size_t slots = 64, used = 0;
    for (;;) {
        sb_free(set->near);
        set->near = sb_alloc(slots, sizeof *set->near);
        set->near_mask = slots - 1;
        if (!set->near) return -1;
        used = 0;
        for (size_t c = 0; c < set->cells.count && 2 * used < slots; c++)
            for (int d = 0; d < 27 && 2 * used < slots; d++)
                used += near_insert(
                    set, block_beside(space, set->record[set->cells.begin[c]], d % 3 - 1, d / 3 % 3 - 1, d / 9 - 1));
        if (2 * used < slots) return 0;
        slots *= 4;
    }
}

int sb_walls_table(sb_wall_set *set, const sb_space *space)
{
    size_t n = set->count;
    uint64_t *words = sb_alloc_untouched(n, sizeof *words), *other = sb_alloc_untouched(n, sizeof *words);
    sb_record *record = sb_alloc_untouched(n, sizeof *record);
    uint32_t *body = sb_alloc_untouched(n, sizeof *body);
    uint32_t *facing = sb_alloc_untouched(n, sizeof *facing);
    int status = -1;
    if (!words || !other || !record || !body || !facing) goto done;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) words[i] = sb_sort_word(sb_space_key(space, set->record[i]), i);
    const uint64_t *sorted = sb_sort(words, other, n, SB_INDEX_BITS, SB_INDEX_BITS + space->key_bits);
    if (!sorted) goto done;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        size_t from = sb_word_index(sorted[i]);
        record[i] = set->record[from];
        body[i] = set->body[from];
        facing[i] = set->facing[from];
    }
    memcpy(set->record, record, n * sizeof *record);
    memcpy(set->body, body, n * sizeof *body);
    memcpy(set->facing, facing, n * sizeof *facing);
    for (size_t i = 0; i < n && set->number; i++) body[i] = set->number[sb_word_index(sorted[i])];
    if (set->number) memcpy(set->number, body, n * sizeof *body);
    status = sb_cells_build(&set->cells, set->record, n, space->shift);
done:
    sb_free(words);
    sb_free(other);
    sb_free(record);
    sb_free(body);
    sb_free(facing);
    return status;
}
