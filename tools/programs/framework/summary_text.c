#include "summary_text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

double sb_json_number_in(const char *text, const char *key)
{
    size_t length = strlen(key);
    for (const char *at = strchr(text, '"'); at; at = strchr(at + 1, '"')) {
        if (strncmp(at + 1, key, length) != 0 || strncmp(at + 1 + length, "\":", 2) != 0) continue;
        const char *number = at + length + 3;
        char *end;
        double value = strtod(number, &end);
        return end == number ? (double)NAN : value;
    }
    return (double)NAN;
}
