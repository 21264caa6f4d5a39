/* Positions as 32-bit integers. Differences are exact, results do not depend on the location of the scene, and a cell
   index is one shift. A quantum is cell/2^shift; the origin lies two cells outside of the domain. */
#ifndef SB_SIM_SPACE_H
#define SB_SIM_SPACE_H

#include "base/status.h"
#include "base/vec.h"
#include "sim/state/simd.h"

#include <stdbool.h>

/* All coordinates are below this. */
static const uint32_t SB_POSITION_END = 0x80000000u;

enum {
    SB_SPACE_MARGIN = 2, /* cells around the domain */
    SB_IMAGES_MAX = 26   /* images of one record: two along each axis, in all combinations */
};

typedef struct sb_space {
    sb_vec3 origin;             /* m, the position with coordinates 0 */
    double quantum;             /* m */
    double cell;                /* m, edge of a cell: the support radius */
    int shift;                  /* cell index = position >> shift */
    int bits[3];                /* of the cell index along each axis */
    int key_bits;               /* of the Z-order key */
    bool repeats;               /* along at least one axis */
    uint32_t period[3];         /* period along an axis in quanta; 0: not periodic */
    uint64_t spread[3][3][256]; /* key bits of each byte of an index, by axis and byte */
} sb_space;

/* SB_BAD_INPUT if the domain has more cells than positions can distinguish. */
sb_status sb_space_create(sb_vec3 min, sb_vec3 max, double cell, sb_space *space, sb_error *error);

/* Makes the domain periodic along an axis. length (m): its extent along that axis, at least one cell; it is rounded to
   whole quanta. */
void sb_space_repeat(sb_space *space, int axis, double length);

/* Finds the images of a record of the domain, whole periods away along one or several axes, that are within one cell of
   the domain. Returns their number; the order is always the same. */
int sb_space_images(const sb_space *space, sb_record record, sb_record image[SB_IMAGES_MAX]);

/* Rounds a position to quanta, clamped to the representable range. */
sb_record sb_space_record(const sb_space *space, sb_vec3 position);
sb_vec3 sb_space_position(const sb_space *space, sb_record record);

/* Three cell indices packed with 21 bits each. The code of the neighbour (dx, dy, dz) is code + sb_cell_step. */
SB_INLINE uint64_t sb_cell_code(sb_record record, int shift)
{
    return (uint64_t)(record[0] >> shift) | (uint64_t)(record[1] >> shift) << 21 | (uint64_t)(record[2] >> shift) << 42;
}

SB_INLINE uint64_t sb_cell_step(int dx, int dy, int dz)
{
    return (uint64_t)(int64_t)dx + ((uint64_t)(int64_t)dy << 21) + ((uint64_t)(int64_t)dz << 42);
}

/* Whether the record's cell and its neighbour cells are on the grid. */
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

/* The image that is in the domain along the periodic axes; the last lane does not change. */
SB_INLINE sb_record sb_space_wrap(const sb_space *space, sb_record record)
{
    const uint32_t low = sb_space_low(space);
    for (int axis = 0; axis < 3; axis++) {
        const int64_t period = space->period[axis], at = (int64_t)record[axis] - low;
        if (period > 0 && (at < 0 || at >= period)) record[axis] = low + (uint32_t)((at % period + period) % period);
    }
    return record;
}

/* Whether a neighbour cell of the record's cell extends beyond a periodic side. */
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

/* Key along the Z-curve: the interleaved bits of the three indices. An axis takes part up to its last bit. */
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
