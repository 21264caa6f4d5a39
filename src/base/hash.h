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

/* The three parts of sb_hash, for words of 8 bytes that are not in memory at once: begin with the length in bytes of
   all, add words, end without a tail (0). */
static inline uint64_t sb_hash_begin(uint64_t seed, size_t length)
{
    return sb_hash_mix(seed + 0x9e3779b97f4a7c15u + length);
}

static inline uint64_t sb_hash_words(uint64_t hash, const void *bytes, size_t words)
{
    for (const unsigned char *at = bytes; words > 0; words--, at += 8) {
        uint64_t word;
        memcpy(&word, at, 8);
        hash = sb_hash_mix(hash ^ word) + 0x9e3779b97f4a7c15u;
    }
    return hash;
}

static inline uint64_t sb_hash_end(uint64_t hash, uint64_t tail)
{
    return sb_hash_mix(hash ^ tail);
}

/* Continues `seed` (0 to start) over `length` bytes. */
static inline uint64_t sb_hash(uint64_t seed, const void *bytes, size_t length)
{
    const size_t words = length / 8;
    const uint64_t hash = sb_hash_words(sb_hash_begin(seed, length), bytes, words);
    uint64_t tail = 0;
    length -= 8 * words;
    if (length > 0) /* bytes may be NULL when there are none */
        memcpy(&tail, (const unsigned char *)bytes + 8 * words, length);
    return sb_hash_end(hash, tail);
}

/* A hash over bytes that are added piece by piece; it does not depend on how they are divided into pieces. A
   zero-initialised struct contains no bytes. */
typedef struct sb_running_hash {
    uint64_t blocks; /* hash of all complete blocks */
    size_t pending;  /* bytes in the block that is being filled */
    unsigned char block[1024];
} sb_running_hash;

static inline void sb_hash_add(sb_running_hash *hash, const void *bytes, size_t length)
{
    const unsigned char *at = bytes;
    while (length > 0) {
        const size_t room = sizeof hash->block - hash->pending, piece = length < room ? length : room;
        memcpy(hash->block + hash->pending, at, piece);
        hash->pending += piece;
        at += piece;
        length -= piece;
        if (hash->pending < sizeof hash->block) continue;
        hash->blocks = sb_hash(hash->blocks, hash->block, sizeof hash->block);
        hash->pending = 0;
    }
}

/* Returns the hash of all bytes so far. More bytes may be added afterwards. */
static inline uint64_t sb_hash_sum(const sb_running_hash *hash)
{
    return sb_hash(hash->blocks, hash->block, hash->pending);
}

#endif
