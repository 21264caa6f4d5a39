/* Four-lane vectors, and the 16-byte records made of them. A record takes one 128-bit load per neighbour; gathers from
   separate arrays are slower (docs/decisions/0002). */
#ifndef SB_SIM_SIMD_H
#define SB_SIM_SIMD_H

#include "base/multiversion.h"

#include <stdint.h>
#include <string.h>
#ifdef __SSE2__
#include <emmintrin.h>
#else
#include <math.h>
#endif

typedef float sb_f4 __attribute__((vector_size(16)));
typedef int32_t sb_i4 __attribute__((vector_size(16)));
typedef uint32_t sb_u4 __attribute__((vector_size(16)));
typedef float sb_f8 __attribute__((vector_size(32), aligned(4)));

/* Position record: x, y, z in quanta, and in the last lane the bits of a float: argument of the pressure operator. */
typedef sb_u4 sb_record;

/* A function with this mark is compiled once, for any processor. Otherwise the compiler might inline it into the caller
   in one build and not in another, and the two would round differently. */
#define SB_APART static __attribute__((noinline))

SB_INLINE sb_f4 sb_splat(float value)
{
    return (sb_f4){value, value, value, value};
}

/* a - b in quanta as floats; exact within three cells. The last lane is finite but has no meaning. */
SB_INLINE sb_f4 sb_offset(sb_record a, sb_record b)
{
    return __builtin_convertvector((sb_i4)(a - b), sb_f4);
}

SB_INLINE float sb_carried_value(sb_record record)
{
    return ((sb_f4)record)[3];
}

SB_INLINE void sb_carry(sb_record *record, float value)
{
    memcpy((char *)record + 12, &value, 4);
}

SB_INLINE float sb_sum8(const sb_f8 *p)
{
    const sb_f8 v = *p;
    return ((v[0] + v[4]) + (v[1] + v[5])) + ((v[2] + v[6]) + (v[3] + v[7]));
}

SB_INLINE float sb_sum3(sb_f4 v)
{
    return v[0] + v[1] + v[2];
}

/* Square roots, lane by lane. */
SB_INLINE sb_f4 sb_sqrt4(sb_f4 v)
{
#ifdef __SSE2__
    return (sb_f4)_mm_sqrt_ps((__m128)v);
#else
    return (sb_f4){sqrtf(v[0]), sqrtf(v[1]), sqrtf(v[2]), sqrtf(v[3])};
#endif
}

/* Lanes of a where the mask is set, of b elsewhere. */
SB_INLINE sb_f4 sb_select(sb_i4 mask, sb_f4 a, sb_f4 b)
{
    return (sb_f4)(((sb_i4)a & mask) | ((sb_i4)b & ~mask));
}

/* Four records transposed into four lanes of x, y, z and w. */
typedef struct sb_four {
    sb_f4 x, y, z, w;
} sb_four;

SB_INLINE sb_four sb_transpose(sb_f4 a, sb_f4 b, sb_f4 c, sb_f4 d)
{
    sb_f4 xy0 = __builtin_shufflevector(a, b, 0, 4, 1, 5), xy1 = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    sb_f4 zw0 = __builtin_shufflevector(a, b, 2, 6, 3, 7), zw1 = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    return (sb_four){
        .x = __builtin_shufflevector(xy0, xy1, 0, 1, 4, 5),
        .y = __builtin_shufflevector(xy0, xy1, 2, 3, 6, 7),
        .z = __builtin_shufflevector(zw0, zw1, 0, 1, 4, 5),
        .w = __builtin_shufflevector(zw0, zw1, 2, 3, 6, 7),
    };
}

#endif
