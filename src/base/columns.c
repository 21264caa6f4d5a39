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

/* 'm' or 's' if the name contains this unit as a word, or 0. */
static char unit_in(const char *name, size_t length)
{
    for (size_t at = 0; at < length;) {
        size_t end = at;
        while (end < length && isalnum((unsigned char)name[end])) ++end;
        if (end - at == 1 && (name[at] == 'm' || name[at] == 's')) return name[at];
        at = end + 1;
    }
    return 0;
}

size_t sb_columns_misplaced(const char *line, size_t length, const char *units)
{
    size_t at = 0, marks = 0, words = 0;
    for (size_t i = 0; i < length; ++i) {
        marks += strchr(",;\t", line[i]) != NULL;
        words += !strchr(" \r", line[i]) && (i == 0 || strchr(" \r", line[i - 1]));
    }
    if (!marks && words != strlen(units)) return 0;
    const char *separators = marks ? ",;\t" : " \r";
    for (size_t column = 0; at < length && units[column]; ++column) {
        while (!marks && at < length && strchr(separators, line[at])) ++at;
        size_t end = at;
        while (end < length && !strchr(separators, line[end])) ++end;
        const char unit = unit_in(line + at, end - at);
        if (unit && unit != units[column]) return column + 1;
        at = end + 1;
    }
    return 0;
}
