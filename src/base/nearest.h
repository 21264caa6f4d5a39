/* The word that a misspelt one was probably meant to be. */
#ifndef SB_BASE_NEAREST_H
#define SB_BASE_NEAREST_H

#include <stddef.h>

typedef struct sb_nearest {
    const char *name;  /* as it was written */
    const char *found; /* the nearest one so far; NULL: none is near */
    size_t distance;   /* letters to change, of the next one less than that */
} sb_nearest;

sb_nearest sb_nearest_to(const char *name);

/* Compares one more word; of words at the same distance the first one stays. */
void sb_nearest_try(sb_nearest *nearest, const char *word);

#endif
