/* Two 16-byte records side by side in one 32-byte vector: those of two neighbours, or the record and the value of one.
   A processor without such vectors takes two instructions for each of these operations and gets the same lanes. */
#ifndef SB_SIM_SIMD_WIDE_H
#define SB_SIM_SIMD_WIDE_H

#include "sim/state/simd.h"

typedef int32_t sb_i8 __attribute__((vector_size(32)));

SB_INLINE sb_f8 sb_join(sb_f4 a, sb_f4 b)
{
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
}

SB_INLINE sb_f8 sb_splat8(float value)
{
    return (sb_f8){value, value, value, value, value, value, value, value};
}

SB_INLINE sb_f8 sb_carried8(sb_f8 records)
{
    return __builtin_shufflevector(records, records, 3, 3, 3, 3, 7, 7, 7, 7);
}

/* The first halves of two vectors, side by side. sb_upper: the second halves. */
SB_INLINE sb_f8 sb_lower(sb_f8 a, sb_f8 b)
{
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11);
}

SB_INLINE sb_f8 sb_upper(sb_f8 a, sb_f8 b)
{
    return __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
}

#endif
