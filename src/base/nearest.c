/* Finds the name that is most similar to a misspelt one. */
#include "base/nearest.h"

#include <stdint.h>
#include <string.h>

/* Returns the Levenshtein distance of two names, or SIZE_MAX if one of them is long. */
static size_t distance(const char *a, const char *b)
{
    enum { LONGEST = 40 };
    size_t n = strlen(a), m = strlen(b), row[LONGEST + 1];
    if (n > LONGEST || m > LONGEST) return SIZE_MAX;
    for (size_t j = 0; j <= m; j++) row[j] = j;
    for (size_t i = 1; i <= n; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= m; j++) {
            size_t change = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            size_t drop = (row[j] < row[j - 1] ? row[j] : row[j - 1]) + 1;
            row[j] = change < drop ? change : drop;
        }
    }
    return row[m];
}

sb_nearest sb_nearest_to(const char *name)
{
    const size_t length = strlen(name);
    return (sb_nearest){.name = name, .distance = length < 5 ? 3 : length / 2 + 1};
}

void sb_nearest_try(sb_nearest *nearest, const char *candidate)
{
    const size_t changes = distance(nearest->name, candidate);
    if (changes >= nearest->distance) return;
    nearest->distance = changes;
    nearest->found = candidate;
}
