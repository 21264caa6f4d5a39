/* Two neighbours at a time: their 16-byte records side by side in one 32-byte vector. A machine without such vectors
   takes two instructions for each of these operations and gets the same lanes. */
#ifndef SB_SIM_SIMD_WIDE_H
#define SB_SIM_SIMD_WIDE_H

#include "sim/simd.h"

typedef int32_t sb_i8 __attribute__((vector_size(32)));
typedef uint32_t sb_u8 __attribute__((vector_size(32)));

SB_INLINE sb_f8 sb_beside(sb_f4 a, sb_f4 b)
{
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
}

/* As sb_offset and sb_carried, of two records side by side. */
SB_INLINE sb_f8 sb_offset8(sb_f8 a, sb_f8 b)
{
    return __builtin_convertvector((sb_i8)((sb_u8)a - (sb_u8)b), sb_f8);
}

SB_INLINE sb_f8 sb_carried8(sb_f8 records)
{
    return __builtin_shufflevector(records, records, 3, 3, 3, 3, 7, 7, 7, 7);
}

/* Two numbers, each in four lanes. */
SB_INLINE sb_f8 sb_spread(float a, float b)
{
    return (sb_f8){a, a, a, a, b, b, b, b};
}

/* Sum of the two. */
SB_INLINE sb_f4 sb_halves(sb_f8 v)
{
    return __builtin_shufflevector(v, v, 0, 1, 2, 3) + __builtin_shufflevector(v, v, 4, 5, 6, 7);
}

#endif
