#include "sim/search/cells.h"

#include "base/memory.h"
#include "sim/state/space.h"

enum { BLOCK = 16384 };

static int reserve(sb_cells *cells, size_t count)
{
    if (count + 1 > cells->cell_capacity) {
        size_t capacity = count + count / 8 + 64;
        sb_free(cells->begin);
        sb_free(cells->code);
        cells->begin = sb_alloc_untouched(capacity, sizeof *cells->begin);
        cells->code = sb_alloc_untouched(capacity, sizeof *cells->code);
        cells->cell_capacity = cells->begin && cells->code ? capacity : 0;
        if (cells->cell_capacity == 0) return -1;
    }
    size_t slots = 64;
    while (slots < 2 * count) slots *= 2;
    if (slots > cells->slot_capacity) {
        sb_free(cells->slot);
        cells->slot = sb_alloc_untouched(slots, sizeof *cells->slot);
        cells->slot_capacity = cells->slot ? slots : 0;
        if (!cells->slot) return -1;
    }
    cells->slot_mask = slots - 1;
    return 0;
}

static int starts_cell(const sb_record *records, size_t i, int shift)
{
    return i == 0 || sb_cell_code(records[i], shift) != sb_cell_code(records[i - 1], shift);
}

/* The set of occupied slots does not depend on the order of threads; only the order within a probe sequence does. */
static void insert_all(sb_cells *cells)
{
#pragma omp parallel for schedule(static)
    for (size_t s = 0; s <= cells->slot_mask; s++) cells->slot[s] = 0;
#pragma omp parallel for schedule(static)
    for (size_t c = 0; c < cells->count; c++) {
        uint64_t at = sb_cells_hash(cells->code[c]) & cells->slot_mask;
        for (;; at = (at + 1) & cells->slot_mask) {
            uint32_t empty = 0;
            if (__atomic_compare_exchange_n(&cells->slot[at], &empty, (uint32_t)(c + 1), 0, __ATOMIC_RELAXED,
                                            __ATOMIC_RELAXED))
                break;
        }
    }
}

int sb_cells_build(sb_cells *cells, const sb_record *records, size_t count, int shift)
{
    size_t blocks = (count + BLOCK - 1) / BLOCK;
    size_t *first = sb_alloc(blocks + 1, sizeof *first);
    cells->count = 0;
    if (!first) return -1;
#pragma omp parallel for schedule(static)
    for (size_t b = 0; b < blocks; b++) {
        size_t end = (b + 1) * BLOCK < count ? (b + 1) * BLOCK : count, found = 0;
        for (size_t i = b * BLOCK; i < end; i++) found += (size_t)starts_cell(records, i, shift);
        first[b + 1] = found;
    }
    for (size_t b = 0; b < blocks; b++) first[b + 1] += first[b];
    if (reserve(cells, first[blocks]) != 0) {
        sb_free(first);
        return -1;
    }
    cells->count = first[blocks];
#pragma omp parallel for schedule(static)
    for (size_t b = 0; b < blocks; b++) {
        size_t end = (b + 1) * BLOCK < count ? (b + 1) * BLOCK : count, at = first[b];
        for (size_t i = b * BLOCK; i < end; i++)
            if (starts_cell(records, i, shift)) {
                cells->begin[at] = (uint32_t)i;
                cells->code[at++] = sb_cell_code(records[i], shift);
            }
    }
    sb_free(first);
    cells->begin[cells->count] = (uint32_t)count;
    insert_all(cells);
    return 0;
}

void sb_cells_free(sb_cells *cells)
{
    sb_free(cells->begin);
    sb_free(cells->code);
    sb_free(cells->slot);
    *cells = (sb_cells){0};
}

size_t sb_cells_bytes(const sb_cells *cells)
{
    return cells->cell_capacity * (sizeof *cells->begin + sizeof *cells->code) +
           cells->slot_capacity * sizeof *cells->slot;
}
