/* The machine on which figures are measured, and its use by other programs. */
#ifndef SB_BENCH_MACHINE_H
#define SB_BENCH_MACHINE_H

#include <stddef.h>

/* Number of cores that other programs may use before figures count as unreliable. */
#define SB_BENCH_QUIET 0.1

/* Processor time of the whole machine, and of this program with its ended child processes. */
typedef struct sb_bench_clock {
    double wall, busy, own; /* s; busy and own over all cores */
} sb_bench_clock;
sb_bench_clock sb_bench_clock_now(void);

/* Mean number of cores that other programs used between two readings; negative: unknown. */
double sb_bench_others(sb_bench_clock from, sb_bench_clock to);

/* Name of the folder of a machine: "AMD EPYC (R), 2 cores" gives amd-epyc-2-cores. */
void sb_bench_folder(const char *machine, char name[128]);

/* Writes lines with processor, memory, compiler and flags, and commit of the source tree. */
void sb_bench_origin(char *text, size_t size, const char *source);

#endif
