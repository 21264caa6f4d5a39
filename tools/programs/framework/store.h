/* Where finished runs are kept, and their records: files with lines "key: value". */
#ifndef SB_FRAMEWORK_STORE_H
#define SB_FRAMEWORK_STORE_H

#include "base/file.h"

#include <stdbool.h>
#include <stdint.h>

#define SB_RECORD_NAME "record.txt"

typedef struct sb_store {
    char out[SB_PATH_MAX];     /* absolute */
    char program[SB_PATH_MAX]; /* path of shorebreak */
    char assets[SB_PATH_MAX];  /* scenes and reference tables */
    uint64_t build;            /* hash of the program */
    char commit[64]; /* of the source tree; "unknown": git does not report it; "": the program is from elsewhere */
    char machine[128];
} sb_store;

/* Makes the folder `out`. program: NULL: the shorebreak beside this tool. assets: relative to the source tree.
   with_tool: the results depend on this tool, too, so that `build` includes it. SB_BAD_INPUT: the program or the assets
   do not exist. */
sb_status sb_store_open(sb_store *store, const char *out, const char *program, const char *assets, bool with_tool,
                        sb_error *error);

/* The value of a key of the record in this folder; "", NaN: none. */
void sb_record_text(const char *folder, const char *key, char *value, size_t size);
double sb_record_number(const char *folder, const char *key);
/* Writes folder/name, whole or not at all. */
sb_status sb_record_write(const char *folder, const char *name, sb_error *error, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
