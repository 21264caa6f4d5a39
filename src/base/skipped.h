/* A calculation that a run skips because its scene does not need it, and what this saves. */
#ifndef SB_BASE_SKIPPED_H
#define SB_BASE_SKIPPED_H

#include <stddef.h>

typedef struct sb_skipped {
    const char *what; /* "turbulence: none, no strain rates"; NULL ends a list */
    int passes;       /* saved passes over all pairs of neighbours, per step */
    size_t bytes;     /* saved memory; 0: not known beforehand */
} sb_skipped;

#endif
