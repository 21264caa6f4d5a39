/* Disjoint sets of the numbers below 2^32 - 1, as a forest: parent[i] of each number, i itself for the root of a set.
 */
#ifndef SB_BASE_SETS_H
#define SB_BASE_SETS_H

#include <stdint.h>

/* The root of the set of i. Shortens the way to it. */
static inline uint32_t sb_sets_root(uint32_t *parent, uint32_t i)
{
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

/* Joins the sets of a and b. The smaller root stays one, so that the root is the smallest number of its set. */
static inline void sb_sets_join(uint32_t *parent, uint32_t a, uint32_t b)
{
    a = sb_sets_root(parent, a);
    b = sb_sets_root(parent, b);
    if (a < b)
        parent[b] = a;
    else
        parent[a] = b;
}

#endif
