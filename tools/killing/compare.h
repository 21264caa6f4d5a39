/* Two folders of runs, file by file. */
#ifndef SB_KILLING_COMPARE_H
#define SB_KILLING_COMPARE_H

#include "base/status.h"

#include <stddef.h>

/* SB_FAILED names the first file that differs, is missing or is one too many. All bytes count, except: wall times in
   particle files; times and memory in summary.json; in run.jsonl only states' hashes at steps are compared, of
   steps that both have; of checkpoints only the last one's name is. *files: how many were compared. */
sb_status sb_kill_compare(const char *whole, const char *other, size_t *files, sb_error *error);

#endif
