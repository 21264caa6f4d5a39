/* The program itself, run as a user runs it, without pictures, plots or particle files. */
#ifndef SB_BENCHMARK_PROGRAM_H
#define SB_BENCHMARK_PROGRAM_H

#include "base/status.h"

enum { SB_BENCH_SETTINGS_MAX = 16 };

/* One run: KEY=VALUE settings as --set takes them, ended by NULL. preset: NULL: the scene's. */
typedef struct sb_bench_program {
    const char *scene, *preset;
    int threads;
    const char *settings[SB_BENCH_SETTINGS_MAX];
} sb_bench_program;

/* Runs shorebreak, the one beside this program, in a folder that is taken away again. *summary: the text of its
   summary.json; free with sb_free. SB_FAILED with the run's own message. */
sb_status sb_bench_program_run(const sb_bench_program *run, char **summary, sb_error *error);

#endif
