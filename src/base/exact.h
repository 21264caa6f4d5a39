/* Sums of doubles that have the same bits in any order of the terms, however they are divided among threads or domains:
   each term is added to a wide fixed-point number, so no addition rounds. Terms are truncated to multiples of 2^-160.
   Compare Demmel and Nguyen 2015, Parallel reproducible summation. */
#ifndef SB_BASE_EXACT_H
#define SB_BASE_EXACT_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

enum { SB_EXACT_LIMBS = 11 };

/* The sum of limb[k] 2^(32 k - 160). Zero-initialised it is 0; it takes 2^31 terms. */
typedef struct sb_exact {
    int64_t limb[SB_EXACT_LIMBS];
    bool invalid; /* a term was no finite number, or above 2^180 */
} sb_exact;

static inline void sb_exact_add(sb_exact *sum, double term)
{
    enum { LEAST = 160, MANTISSA = 52, BIAS = 1023 };
    uint64_t bits;
    memcpy(&bits, &term, sizeof bits);
    int low = (int)(bits >> MANTISSA & 0x7ff) - BIAS - MANTISSA + LEAST; /* place of the mantissa's last bit */
    uint64_t mantissa = (bits & ((UINT64_C(1) << MANTISSA) - 1)) | UINT64_C(1) << MANTISSA;
    if (low < 0) {
        if (low <= -MANTISSA - 1) return;
        mantissa >>= -low;
        low = 0;
    }
    const int limb = low / 32, shift = low % 32;
    if (limb > SB_EXACT_LIMBS - 3) {
        sum->invalid = true;
        return;
    }
    const uint64_t lower = (mantissa & UINT32_MAX) << shift, upper = (lower >> 32) + (mantissa >> 32 << shift);
    const int64_t sign = bits >> 63 ? -1 : 1;
    sum->limb[limb] += sign * (int64_t)(lower & UINT32_MAX);
    sum->limb[limb + 1] += sign * (int64_t)(upper & UINT32_MAX);
    sum->limb[limb + 2] += sign * (int64_t)(upper >> 32);
}

/* Adds another sum; both together have at most 2^31 terms. */
void sb_exact_merge(sb_exact *sum, const sb_exact *other);

/* Returns the sum as a double, within one unit in the last place; NaN if it is invalid. */
double sb_exact_value(const sb_exact *sum);

#endif
