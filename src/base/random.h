/* A counter-based random number generator: the same seed and index give the same value on any thread. */
#ifndef SB_BASE_RANDOM_H
#define SB_BASE_RANDOM_H

#include "base/hash.h"

/* Returns a number that is uniformly distributed in [0, 1). */
static inline double sb_random(uint64_t seed, uint64_t index)
{
    return (double)(sb_hash_mix(sb_hash_mix(seed + 0x9e3779b97f4a7c15u) ^ index) >> 11) * 0x1.0p-53;
}

#endif
