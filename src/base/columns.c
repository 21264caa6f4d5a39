/* Recognises the header line of a table of numbers. */
#include "base/columns.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

bool sb_columns_header(const char *line, size_t length)
{
    static const char separators[] = " \t\r,;";
    size_t words = 0;
    for (size_t at = 0; at < length;) {
        char word[64] = "", *after;
        size_t used = 0;
        if (strchr(separators, line[at])) {
            ++at;
            continue;
        }
        for (; at < length && !strchr(separators, line[at]); ++at)
            if (used < sizeof word - 1) word[used++] = line[at];
        (void)strtod(word, &after); /* "nan" and "inf" are numbers, so that a line of data is not taken for a header */
        if (*after == '\0') return false;
        ++words;
    }
    return words > 0;
}

const char *sb_columns_unit(const char *line, size_t length)
{
    static const char *const units[] = {"mm", "cm", "km", "ft", "ms", "min", "h"};
    for (size_t at = 0; at < length;) {
        size_t end = at;
        while (end < length && isalnum((unsigned char)line[end])) ++end;
        for (size_t u = 0; u < sizeof units / sizeof *units; ++u)
            if (strlen(units[u]) == end - at && strncasecmp(line + at, units[u], end - at) == 0) return units[u];
        at = end + 1;
    }
    return NULL;
}
