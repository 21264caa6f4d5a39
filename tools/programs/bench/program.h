/* Runs shorebreak as a user does, without pictures, plots or particle files. */
#ifndef SB_BENCH_PROGRAM_H
#define SB_BENCH_PROGRAM_H

#include "base/status.h"

enum { SB_BENCH_SETTINGS_MAX = 16 };

/* One run. settings: KEY=VALUE as for --set, ended by NULL. preset: NULL: that of the scene. */
typedef struct sb_bench_program {
    const char *scene, *preset;
    int threads;
    const char *settings[SB_BENCH_SETTINGS_MAX];
} sb_bench_program;

/* Runs the shorebreak beside this program in a temporary folder. *summary: text of its summary.json; free with sb_free.
   SB_FAILED: the run failed; the error contains its message. */
sb_status sb_bench_program_run(const sb_bench_program *run, char **summary, sb_error *error);

#endif
