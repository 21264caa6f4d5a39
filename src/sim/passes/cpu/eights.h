/* Passes over pairs in which each neighbour has a value, eight neighbours at a time: two groups of four of a list side
   by side in 32-byte vectors, which takes half the instructions. The results are added up four after four, so that the
   sums have the same bits as sums over groups of four. */
#ifndef SB_SIM_EIGHTS_H
#define SB_SIM_EIGHTS_H

#include "sim/passes/cpu/simd_wide.h"
#include "sim/search/around.h"

/* Eight records transposed into lanes of x, y, z and w: those of the first four, then those of the second four. */
typedef struct sb_eight {
    sb_f8 x, y, z, w;
} sb_eight;

SB_INLINE sb_f8 sb_two_with(const sb_f4 *around, const sb_four_pairs *one, const sb_four_pairs *other, int k, int part)
{
    return sb_join(sb_at_with(around, one->place[k])[part], sb_at_with(around, other->place[k])[part]);
}

/* The neighbours of two groups of four in the output of sb_around_with. part 0: their records; 1: their values. */
SB_INLINE sb_eight sb_eight_with(const sb_f4 *around, const sb_four_pairs *one, const sb_four_pairs *other, int part)
{
    const sb_f8 a = sb_two_with(around, one, other, 0, part), b = sb_two_with(around, one, other, 1, part);
    const sb_f8 c = sb_two_with(around, one, other, 2, part), d = sb_two_with(around, one, other, 3, part);
    const sb_f8 xy0 = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
    const sb_f8 xy1 = __builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13);
    const sb_f8 zw0 = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
    const sb_f8 zw1 = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
    return (sb_eight){
        .x = __builtin_shufflevector(xy0, xy1, 0, 1, 8, 9, 4, 5, 12, 13),
        .y = __builtin_shufflevector(xy0, xy1, 2, 3, 10, 11, 6, 7, 14, 15),
        .z = __builtin_shufflevector(zw0, zw1, 0, 1, 8, 9, 4, 5, 12, 13),
        .w = __builtin_shufflevector(zw0, zw1, 2, 3, 10, 11, 6, 7, 14, 15),
    };
}

SB_INLINE sb_f8 sb_eight_slopes(const sb_four_pairs *one, const sb_four_pairs *other)
{
    return sb_join(sb_slopes(one), sb_slopes(other));
}

/* One lane of a record in all eight lanes. */
#define sb_spread(record, lane) __builtin_shufflevector(record, record, lane, lane, lane, lane, lane, lane, lane, lane)

/* One half of a vector: the first four lanes, or the last four. */
SB_INLINE sb_f4 sb_first4(sb_f8 v)
{
    return __builtin_shufflevector(v, v, 0, 1, 2, 3);
}

SB_INLINE sb_f4 sb_second4(sb_f8 v)
{
    return __builtin_shufflevector(v, v, 4, 5, 6, 7);
}

/* Lanes of a where the mask is set, of b elsewhere. */
SB_INLINE sb_f8 sb_select8(sb_i8 mask, sb_f8 a, sb_f8 b)
{
    return (sb_f8)(((sb_i8)a & mask) | ((sb_i8)b & ~mask));
}

#endif
