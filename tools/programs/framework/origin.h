/* Origin of figures: commit of the source, machine and its load, hashes of files. */
#ifndef SB_FRAMEWORK_ORIGIN_H
#define SB_FRAMEWORK_ORIGIN_H

#include "base/status.h"

#include <stdint.h>

/* The commit of the source tree, with -dirty appended if files differ; "unknown" if git does not report it. */
void sb_origin_commit(const char *source, char commit[64]);
/* Processor and number of cores. */
void sb_origin_machine(char machine[128]);
/* Continues a hash over a whole file. SB_BAD_INPUT: it cannot be read. */
sb_status sb_hash_file(const char *path, uint64_t *hash, sb_error *error);

/* Number of cores. */
int sb_origin_cores(void);
/* Load average of the machine over the last minute; NaN: unknown. */
double sb_origin_load(void);

#endif
