/* The sections of the benchmark. Each writes one CSV file; the report is made from all of them. */
#ifndef SB_BENCH_SECTIONS_H
#define SB_BENCH_SECTIONS_H

#include "rows.h"

#include <stddef.h>

/* Parameters of a section. */
typedef struct sb_bench_request {
    const char *assets;      /* folder with benchmark/ and scenes/ */
    int repeats;             /* of each measurement, >= 1 */
    int threads;             /* largest number to use */
    bool quick;              /* small sizes, for a first look and for tests */
    double copy, arithmetic; /* limits of the machine, by sb_bench_limits: B/s, operations on floats per second */
    size_t particles;        /* of the basin, in a section of several sizes */
    const void *of;          /* what is measured, in a section of several subjects */
} sb_bench_request;

typedef sb_status sb_bench_run(const sb_bench_request *request, sb_bench_rows *rows, sb_error *error);

typedef struct sb_bench_section {
    const char *name, *summary;
    bool in_all; /* part of "all" */
    sb_bench_run *run;
} sb_bench_section;

/* Ended by a row with name NULL. */
extern const sb_bench_section sb_bench_sections[];
/* The section of that name, or NULL. */
const sb_bench_section *sb_bench_section_find(const char *name);

sb_bench_run sb_bench_kernels, sb_bench_scaling, sb_bench_scenes, sb_bench_memory, sb_bench_pictures, sb_bench_large,
    sb_bench_runs, sb_bench_island;

/* Writes the spacing with which the basin has about so many particles. */
void sb_bench_basin(size_t particles, char resolution[32]);

/* Names in the rows by which the report finds them. */
#define SB_BENCH_PER_PARTICLE "time per particle"
#define SB_BENCH_STEP "whole step"
#define SB_BENCH_ITERATION "pressure iteration"
#define SB_BENCH_MACHINE "machine"
#define SB_BENCH_COPY "copy bandwidth"
#define SB_BENCH_ARITHMETIC "arithmetic"
#define SB_BENCH_PICTURE "picture"
#define SB_BENCH_PICTURE_PLAIN "picture without shadows and occlusion"
#define SB_BENCH_PICTURE_LARGE "picture of 2 M particles"
#define SB_BENCH_NEXT_PICTURE "next picture"

#endif
