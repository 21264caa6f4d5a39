#include "base/exact.h"

#include <math.h>

void sb_exact_merge(sb_exact *sum, const sb_exact *other)
{
    for (int k = 0; k < SB_EXACT_LIMBS; k++) sum->limb[k] += other->limb[k];
    sum->invalid |= other->invalid;
}

double sb_exact_value(const sb_exact *sum)
{
    if (sum->invalid) return (double)NAN;
    /* Unique digits first: all but the highest from 0 to 2^32 - 1. */
    int64_t digit[SB_EXACT_LIMBS], carry = 0;
    for (int k = 0; k < SB_EXACT_LIMBS; k++) {
        const int64_t limb = sum->limb[k] + carry;
        carry = limb >= 0 ? limb >> 32 : -((-limb + UINT32_MAX) >> 32);
        digit[k] = limb - carry * (INT64_C(1) << 32);
    }
    double value = (double)carry * 0x1p32;
    for (int k = SB_EXACT_LIMBS - 1; k >= 0; k--) value = (value + (double)digit[k]) * (k > 0 ? 0x1p32 : 1);
    return ldexp(value, -160);
}
