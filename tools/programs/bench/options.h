/* Command line of tools/bench. */
#ifndef SB_BENCH_OPTIONS_H
#define SB_BENCH_OPTIONS_H

#include "arguments.h"
#include "sections.h"

enum { SB_BENCH_SECTIONS_MAX = 16 };

typedef struct sb_bench_options {
    sb_common_options common;
    const sb_bench_section *sections[SB_BENCH_SECTIONS_MAX];
    size_t count;
    const char *machine; /* --machine; NULL: not given */
    int repeats, threads;
} sb_bench_options;

/* SB_BAD_INPUT: the error names the argument. */
sb_status sb_bench_parse(int count, char **arguments, sb_bench_options *options, sb_error *error);

#endif
