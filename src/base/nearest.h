/* Finds the known name that is most similar to a misspelt one, for messages. */
#ifndef SB_BASE_NEAREST_H
#define SB_BASE_NEAREST_H

#include <stddef.h>

typedef struct sb_nearest {
    const char *name;  /* the misspelt name */
    const char *found; /* the most similar candidate so far; NULL: none is similar enough */
    size_t distance;   /* number of changed letters; a later candidate must have fewer */
} sb_nearest;

/* Begins a search. Candidates with too many changed letters for the length of `name` are not accepted. */
sb_nearest sb_nearest_to(const char *name);

/* Compares a candidate. Of candidates with equal distances the first one is kept. */
void sb_nearest_try(sb_nearest *nearest, const char *candidate);

#endif
