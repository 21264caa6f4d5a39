/* Where trials and their outcomes are kept. */
#ifndef SB_BATTERY_BENCH_H
#define SB_BATTERY_BENCH_H

#include "crew.h"

sb_status sb_bench_folder(const sb_bench *bench, const sb_order *order, char folder[SB_PATH_MAX], sb_error *error);
/* What is asked, as a number: the scene's text, the files it names, all that is set. */
uint64_t sb_bench_asked(const sb_bench *bench, const sb_order *order);
/* Whether this very build has an outcome for it. */
bool sb_bench_has(const sb_bench *bench, const sb_order *order);
/* Empties the trial's folder and makes it anew. */
sb_status sb_bench_clear(const char *folder, sb_error *error);
/* Writes outcome.txt. */
sb_status sb_bench_keep(const sb_bench *bench, const sb_order *order, const sb_outcome *outcome, sb_error *error);

#endif
