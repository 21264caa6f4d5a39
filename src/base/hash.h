/* A 64-bit checksum for state hashes and file checks (not for secrets). */
#ifndef SB_BASE_HASH_H
#define SB_BASE_HASH_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

static inline uint64_t sb_hash_mix(uint64_t x)
{
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9u;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/* Continues `seed` (0 to start) over `length` bytes. */
static inline uint64_t sb_hash(uint64_t seed, const void *bytes, size_t length)
{
    const unsigned char *at = bytes;
    uint64_t hash = sb_hash_mix(seed + 0x9e3779b97f4a7c15u + length);
    for (; length >= 8; length -= 8, at += 8) {
        uint64_t word;
        memcpy(&word, at, 8);
        hash = sb_hash_mix(hash ^ word) + 0x9e3779b97f4a7c15u;
    }
    uint64_t tail = 0;
    if (length > 0) /* bytes may be NULL when there are none */
        memcpy(&tail, at, length);
    return sb_hash_mix(hash ^ tail);
}

#endif
