/* Stable parallel sort of packed (key, index) words: the same result for any number of threads. */
#ifndef SB_SIM_SORT_H
#define SB_SIM_SORT_H

#include <stddef.h>
#include <stdint.h>

enum { SB_SORT_DIGIT = 8, SB_INDEX_BITS = 27 };

/* A sort word: the key in the upper bits, and in the last bits an index below 2^SB_INDEX_BITS. */
static inline uint64_t sb_sort_word(uint64_t key, size_t index)
{
    return key << SB_INDEX_BITS | index;
}

static inline uint64_t sb_word_key(uint64_t word)
{
    return word >> SB_INDEX_BITS;
}

static inline size_t sb_word_index(uint64_t word)
{
    return word & (((uint64_t)1 << SB_INDEX_BITS) - 1);
}

/* Sorts words by bits [low, high), least significant digit first; `other` is scratch of equal size.
   Returns the array that holds the result (words or other), or NULL without memory. */
uint64_t *sb_sort(uint64_t *words, uint64_t *other, size_t count, int low, int high);

#endif
