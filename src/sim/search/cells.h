/* Table of the used cells of a sorted set of records, found by compact hashing [I11]. Memory grows with the number of
   used cells, not with the domain's extent. */
#ifndef SB_SIM_CELLS_H
#define SB_SIM_CELLS_H

#include "sim/state/simd.h"

#include <stddef.h>

typedef struct sb_cells {
    size_t count; /* used cells */
    size_t cell_capacity, slot_capacity;
    uint32_t *begin; /* count + 1: records of cell c are [begin[c], begin[c+1]) */
    uint64_t *code;  /* count: packed cell indices */
    uint32_t *slot;  /* hash table: cell + 1, 0 empty */
    uint64_t slot_mask;
} sb_cells;

/* Builds the table over `count` records, which must be sorted so that cells are contiguous. Returns 0, or -1 without
   memory. */
int sb_cells_build(sb_cells *cells, const sb_record *records, size_t count, int shift);
void sb_cells_free(sb_cells *cells);
size_t sb_cells_bytes(const sb_cells *cells);

SB_INLINE uint64_t sb_cells_hash(uint64_t code)
{
    code *= 0x9e3779b97f4a7c15u;
    return code ^ code >> 29;
}

/* Index of the cell with that code, or -1. */
SB_INLINE int64_t sb_cells_find(const sb_cells *cells, uint64_t code)
{
    if (cells->count == 0) return -1;
    for (uint64_t at = sb_cells_hash(code) & cells->slot_mask;; at = (at + 1) & cells->slot_mask) {
        uint32_t entry = cells->slot[at];
        if (entry == 0) return -1;
        if (cells->code[entry - 1] == code) return entry - 1;
    }
}

#endif
