/* What a run leaves out because its scene needs none of it, and what that saves. */
#ifndef SB_BASE_SKIPPED_H
#define SB_BASE_SKIPPED_H

#include <stddef.h>

typedef struct sb_skipped {
    const char *what; /* "turbulence: none, no strain rates"; NULL ends a list */
    int passes;       /* over all pairs of neighbours, in each step */
    size_t bytes;     /* of memory; 0: nothing that is known beforehand */
} sb_skipped;

#endif
