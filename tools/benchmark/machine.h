/* The machine that figures are taken on, and whether it has other things to do. */
#ifndef SB_BENCHMARK_MACHINE_H
#define SB_BENCHMARK_MACHINE_H

#include <stddef.h>

/* Cores that others may keep busy before figures are called unreliable. */
#define SB_BENCH_QUIET 0.1

/* Where processor time went, of the whole machine and of this program with its ended children, since it began. */
typedef struct sb_bench_clock {
    double wall, busy, own; /* s; busy and own over all cores */
} sb_bench_clock;
sb_bench_clock sb_bench_clock_now(void);

/* Cores that other programs kept busy between two readings, on average; negative where the system does not tell. */
double sb_bench_others(sb_bench_clock from, sb_bench_clock to);

/* The load average over the last minute; negative where the system does not tell. */
double sb_bench_load(void);

/* The folder of a machine's rows, made of "AMD EPYC (R), 2 cores": amd-epyc-2-cores. */
void sb_bench_folder(const char *machine, char name[128]);

/* Lines about where figures come from: processor, memory, compiler and flags, commit of the source tree. */
void sb_bench_origin(char *text, size_t size, const char *source);

#endif
