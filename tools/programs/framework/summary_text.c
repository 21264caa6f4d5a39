#include "summary_text.h"

#include "base/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

sb_status sb_summary_read(const char *folder, char **text, sb_error *error)
{
    char path[SB_PATH_MAX];
    size_t length;
    sb_status status = sb_path_join(path, folder, "summary.json", error);
    return status == SB_OK ? sb_file_read(path, (size_t)1 << 26, text, &length, error) : status;
}

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
