/* Recognises the header line of a table of numbers. */
#include "base/columns.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

bool sb_columns_header(const char *line, size_t length)
{
    static const char separators[] = " \t\r,;\"";
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
    static const char *const units[] = {"mm", "cm", "km", "ft", "ms", "min", "h", "Hz", "rad"};
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

/* Whether the name is that of an expected column, perhaps cut short. */
static bool is_name(const char *name, size_t length, const char *expected, size_t expected_length)
{
    return length > 0 && length <= expected_length && strncasecmp(name, expected, length) == 0;
}

/* Whether the name is a quantity of which `expected` has none. */
static bool is_foreign(const char *name, size_t length, const char *expected)
{
    static const char *const quantities[] = {"frequency", "omega", "wavelength", "height", "velocity", "speed"};
    for (size_t q = 0; q < sizeof quantities / sizeof *quantities; q++)
        if (strlen(quantities[q]) == length && strncasecmp(quantities[q], name, length) == 0)
            return strcmp(quantities[q], "height") != 0 || strstr(expected, "amplitude");
    return false;
}

/* The number, from 1, of the expected column that has the name, the one at `column` first; 0: none. */
static size_t column_of(const char *name, size_t length, const char *expected, size_t column)
{
    size_t found = 0, number = 0;
    for (const char *at = expected; *at; number++) {
        const size_t end = strcspn(at, " (");
        if (is_name(name, length, at, end) && (found == 0 || number + 1 == column)) found = number + 1;
        at += strcspn(at, ")");
        at += *at ? strspn(at, ") ") : 0;
    }
    return found;
}

/* The name of a column. */
typedef struct name {
    const char *at;
    size_t length;
} name;

/* Splits the line into at most `most` names. Returns their number; 0 if blanks alone separate words, and these are not
   one per column. */
static size_t split(const char *line, size_t length, name *names, size_t most)
{
    size_t marks = 0, words = 0, count = 0;
    for (size_t i = 0; i < length; ++i) {
        marks += strchr(",;\t", line[i]) != NULL;
        words += !strchr(" \r", line[i]) && (i == 0 || strchr(" \r", line[i - 1]));
    }
    if (!marks && words != most) return 0;
    const char *separators = marks ? ",;\t" : " \r";
    for (size_t at = 0; at < length && count < most; ++count) {
        while (at < length && strchr(" \r", line[at])) ++at;
        size_t end = at;
        while (end < length && !strchr(separators, line[end])) ++end;
        names[count] = (name){line + at, end - at};
        at = end + 1;
    }
    return count;
}

enum { COLUMNS_MAX = 16 };

size_t sb_columns_misnamed(const char *line, size_t length, const char *expected)
{
    name names[COLUMNS_MAX];
    size_t columns = 0;
    for (const char *at = expected; columns < COLUMNS_MAX && (at = strchr(at, '(')); at++) columns++;
    const size_t count = split(line, length, names, columns);
    for (size_t c = 0; c < count; c++) {
        size_t word = 0;
        while (word < names[c].length && isalpha((unsigned char)names[c].at[word])) ++word;
        const bool unit = word == 1 && (names[c].at[0] == 'm' || names[c].at[0] == 's');
        const size_t found = column_of(names[c].at, word, expected, c + 1);
        if (!unit && ((found > 0 && found != c + 1) || is_foreign(names[c].at, word, expected))) return c + 1;
    }
    return 0;
}

size_t sb_columns_misplaced(const char *line, size_t length, const char *units)
{
    name names[COLUMNS_MAX];
    const size_t columns = strlen(units),
                 count = split(line, length, names, columns < COLUMNS_MAX ? columns : COLUMNS_MAX);
    for (size_t c = 0; c < count; c++) {
        const char unit = unit_in(names[c].at, names[c].length);
        if (unit && unit != units[c]) return c + 1;
    }
    return 0;
}
