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

/* The hash of bytes that come piece by piece, the same wherever they are cut. Zero-initialised has none so far. */
typedef struct sb_running_hash {
    uint64_t blocks; /* of all whole blocks */
    size_t in_hand;  /* bytes of the next one */
    unsigned char block[1024];
} sb_running_hash;

static inline void sb_hash_add(sb_running_hash *hash, const void *bytes, size_t length)
{
    const unsigned char *at = bytes;
    while (length > 0) {
        const size_t room = sizeof hash->block - hash->in_hand, piece = length < room ? length : room;
        memcpy(hash->block + hash->in_hand, at, piece);
        hash->in_hand += piece;
        at += piece;
        length -= piece;
        if (hash->in_hand < sizeof hash->block) continue;
        hash->blocks = sb_hash(hash->blocks, hash->block, sizeof hash->block);
        hash->in_hand = 0;
    }
}

/* Of all bytes so far; more may come. */
static inline uint64_t sb_hash_sum(const sb_running_hash *hash)
{
    return sb_hash(hash->blocks, hash->block, hash->in_hand);
}

#endif
