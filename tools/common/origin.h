/* Where figures come from: the source's commit, the machine, the files that were used. */
#ifndef SB_COMMON_ORIGIN_H
#define SB_COMMON_ORIGIN_H

#include "base/status.h"

#include <stdint.h>

/* The commit of the source tree, with -dirty behind it when files differ; "unknown" where git
 * cannot tell. */
void sb_origin_commit(const char *source, char commit[64]);
/* Processor and number of cores. */
void sb_origin_machine(char machine[128]);
/* Continues a hash over a whole file. SB_BAD_INPUT when it cannot be read. */
sb_status sb_hash_file(const char *path, uint64_t *hash, sb_error *error);

#endif
