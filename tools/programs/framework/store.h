/* Where a tool keeps finished runs and writes its report, and the records of runs: files with lines "key: value". */
#ifndef SB_FRAMEWORK_STORE_H
#define SB_FRAMEWORK_STORE_H

#include "arguments.h"
#include "base/file.h"

#include <stdint.h>

#define SB_RECORD_NAME "record.txt"

typedef struct sb_store {
    const sb_common_options *options; /* of the tool */
    char out[SB_PATH_MAX];            /* absolute */
    char report[SB_PATH_MAX];         /* folder of the report */
    char program[SB_PATH_MAX];        /* path of shorebreak */
    char assets[SB_PATH_MAX];         /* scenes and reference tables */
    uint64_t build;                   /* hash of the program */
    char commit[64]; /* of the source tree; "unknown": git does not report it; "": the program is from elsewhere */
    char machine[128];
    size_t found, failed; /* stored runs that were read; runs that failed */
} sb_store;

/* Makes the folder --out, or else `out`. assets: relative to the source tree. with_tool: the results depend on this
   tool, too, so that `build` includes it. The report goes to --report, or to OUT/quick with --quick, or else to
   docs/results. SB_BAD_INPUT: the program or the assets do not exist. */
sb_status sb_store_open(sb_store *store, const sb_common_options *options, const char *out, const char *assets,
                        bool with_tool, sb_error *error);
/* Without --report, the report goes to the folder `below` of OUT; NULL: to docs/results. */
sb_status sb_store_report(sb_store *store, const char *below, sb_error *error);

/* The value of a key of the record in this folder; "", NaN: none. */
void sb_record_text(const char *folder, const char *key, char *value, size_t size);
double sb_record_number(const char *folder, const char *key);
/* Writes folder/name, whole or not at all. */
sb_status sb_record_write(const char *folder, const char *name, sb_error *error, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
