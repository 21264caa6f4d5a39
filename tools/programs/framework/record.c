#include "record.h"

#include "base/file.h"

#include <stdio.h>
#include <string.h>

void sb_record_recall(const char *folder, const char *key, char *value, size_t size)
{
    char path[SB_PATH_MAX], line[512];
    size_t length = strlen(key);
    value[0] = '\0';
    FILE *in = sb_path_join(path, folder, SB_RECORD_NAME, NULL) == SB_OK ? fopen(path, "r") : NULL;
    while (in && fgets(line, sizeof line, in)) {
        if (strncmp(line, key, length) != 0 || strncmp(line + length, ": ", 2) != 0) continue;
        line[strcspn(line, "\n")] = '\0';
        snprintf(value, size, "%s", line + length + 2);
    }
    if (in) fclose(in);
}
