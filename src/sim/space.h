/* Positions as 32-bit integers: exact differences, the same bits wherever the scene lies, and a cell
   index by one shift. A quantum is cell/2^shift, the origin lies two cells outside the domain. */
#ifndef SB_SIM_SPACE_H
#define SB_SIM_SPACE_H

#include "base/status.h"
#include "base/vec.h"
#include "sim/simd.h"

#include <stdbool.h>

/* Positions are kept below this. */
static const uint32_t SB_POSITION_END = 0x80000000u;

enum {
    SB_SPACE_MARGIN = 2, /* cells around the domain */
    SB_IMAGES_MAX = 26   /* of one record: two along each axis, in all combinations */
};

typedef struct sb_space {
    sb_vec3 origin;             /* m, where the integers are zero */
    double quantum;             /* m */
    double cell;                /* m, edge of a cell: the support radius */
    int shift;                  /* cell index = position >> shift */
    int bits[3];                /* of the cell index along each axis */
    int key_bits;               /* of the Z-order key */
    bool repeats;               /* along one axis at least */
    uint32_t period[3];         /* quanta after which the domain repeats along an axis; 0: it does not */
    uint64_t spread[3][3][256]; /* key bits of each byte of an index, by axis and byte */
} sb_space;

/* SB_BAD_INPUT when the domain has more cells than positions can tell apart. */
sb_status sb_space_create(sb_vec3 min, sb_vec3 max, double cell, sb_space *space, sb_error *error);

/* Makes the domain repeat along an axis after `length` (m), its extent there and at least a cell; rounded to
   whole quanta, so off by half a quantum at most. */
void sb_space_repeat(sb_space *space, int axis, double length);

/* The images of a record of the domain, whole periods away along one axis or several, that are within a
   cell's edge of the domain. Returns how many; always in one order. */
int sb_space_images(const sb_space *space, sb_record record, sb_record image[SB_IMAGES_MAX]);

/* Nearest quanta; clamped to the representable range. */
sb_record sb_space_record(const sb_space *space, sb_vec3 position);
sb_vec3 sb_space_position(const sb_space *space, sb_record record);

/* Three cell indices packed 21 bits each: the neighbour (dx, dy, dz) is code + sb_cell_step. */
SB_INLINE uint64_t sb_cell_code(sb_record record, int shift)
{
    return (uint64_t)(record[0] >> shift) | (uint64_t)(record[1] >> shift) << 21 | (uint64_t)(record[2] >> shift) << 42;
}

SB_INLINE uint64_t sb_cell_step(int dx, int dy, int dz)
{
    return (uint64_t)(int64_t)dx + ((uint64_t)(int64_t)dy << 21) + ((uint64_t)(int64_t)dz << 42);
}

/* Whether the record's cell is on the grid, with a cell to spare on each side. */
SB_INLINE int sb_space_inside(const sb_space *space, sb_record record)
{
    for (int axis = 0; axis < 3; axis++) {
        uint32_t index = record[axis] >> space->shift;
        if (index < 1 || index + 1 >= (uint32_t)1 << space->bits[axis]) return 0;
    }
    return 1;
}

/* The domain's lower corner in quanta, the same along each axis. */
SB_INLINE uint32_t sb_space_low(const sb_space *space)
{
    return (uint32_t)SB_SPACE_MARGIN << space->shift;
}

/* The image that is in the domain, along the axes that repeat; the last lane is kept. */
SB_INLINE sb_record sb_space_wrap(const sb_space *space, sb_record record)
{
    const uint32_t low = sb_space_low(space);
    for (int axis = 0; axis < 3; axis++) {
        const int64_t period = space->period[axis], at = (int64_t)record[axis] - low;
        if (period > 0 && (at < 0 || at >= period)) record[axis] = low + (uint32_t)((at % period + period) % period);
    }
    return record;
}

/* Whether the cells around the record's reach beyond a side at which the domain repeats. */
SB_INLINE bool sb_space_at_edge(const sb_space *space, sb_record record)
{
    const uint32_t low = sb_space_low(space);
    for (int axis = 0; axis < 3; axis++) {
        uint32_t index = record[axis] >> space->shift;
        if (space->period[axis] > 0 &&
            (index <= SB_SPACE_MARGIN || index + 1 >= (low + space->period[axis]) >> space->shift))
            return true;
    }
    return false;
}

/* Place along the Z-curve: the bits of the three indices interleaved, an axis ending with its last bit. */
SB_INLINE uint64_t sb_space_key(const sb_space *space, sb_record record)
{
    uint64_t key = 0;
    for (int axis = 0; axis < 3; axis++) {
        uint32_t index = record[axis] >> space->shift;
        key |= space->spread[axis][0][index & 255] | space->spread[axis][1][index >> 8 & 255] |
               space->spread[axis][2][index >> 16 & 255];
    }
    return key;
}

#endif
