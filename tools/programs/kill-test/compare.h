/* Compares two folders of runs file by file. */
#ifndef SB_KILL_TEST_COMPARE_H
#define SB_KILL_TEST_COMPARE_H

#include "base/status.h"

#include <stddef.h>

/* SB_FAILED names the first file that differs, is missing or is surplus. All bytes are compared, with these exceptions.
   Particle files: no run times. summary.json: no times and memory. run.jsonl: only the state hashes of steps that both
   have. Checkpoints: only the name of the last. *files: number of compared files. */
sb_status sb_kill_compare(const char *whole, const char *other, size_t *files, sb_error *error);

#endif
