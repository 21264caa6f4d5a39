#include "machine.h"

#include "base/clock.h"
#include "origin.h"

#include <ctype.h>
#include <stdio.h>
#include <sys/resource.h>
#include <unistd.h>

/* Busy time of the machine, without idle and disk-wait time, from the first line of /proc/stat. */
static double machine_busy(void)
{
    unsigned long long user = 0, nice = 0, system = 0, idle = 0, wait = 0, irq = 0, soft = 0, steal = 0;
    FILE *in = fopen("/proc/stat", "r");
    if (!in) return -1;
    const int found = fscanf(in, "cpu %llu %llu %llu %llu %llu %llu %llu %llu", &user, &nice, &system, &idle, &wait,
                             &irq, &soft, &steal);
    fclose(in);
    return found == 8 ? (double)(user + nice + system + irq + soft + steal) / (double)sysconf(_SC_CLK_TCK) : -1;
}

static double seconds_of(int who)
{
    struct rusage usage;
    if (getrusage(who, &usage) != 0) return 0;
    return (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

sb_bench_clock sb_bench_clock_now(void)
{
    return (sb_bench_clock){
        .wall = sb_clock(), .busy = machine_busy(), .own = seconds_of(RUSAGE_SELF) + seconds_of(RUSAGE_CHILDREN)};
}

double sb_bench_others(sb_bench_clock from, sb_bench_clock to)
{
    const double wall = to.wall - from.wall, others = (to.busy - from.busy) - (to.own - from.own);
    if (from.busy < 0 || to.busy < 0 || !(wall > 0)) return -1;
    return others > 0 ? others / wall : 0;
}

static double gigabytes(void)
{
    return (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE) / 1e9;
}

/* Keeps letters and digits, with one '-' for other characters; omits parentheses and their contents. */
void sb_bench_folder(const char *machine, char name[128])
{
    size_t used = 0;
    int depth = 0;
    for (const char *c = machine; *c && used < 127; c++) {
        depth += (*c == '(') - (*c == ')');
        if (depth == 0 && isalnum((unsigned char)*c))
            name[used++] = (char)tolower((unsigned char)*c);
        else if (used > 0 && name[used - 1] != '-')
            name[used++] = '-';
    }
    while (used > 0 && name[used - 1] == '-') used--;
    name[used] = '\0';
}

void sb_bench_origin(char *text, size_t size, const char *source)
{
    char machine[128], commit[64];
    sb_origin_machine(machine);
    sb_origin_commit(source, commit);
    snprintf(text, size, "machine: %s, %.1f GB\ncompiler: %s, flags %s\ncommit: %s\n", machine, gigabytes(),
             SB_BENCH_COMPILER, SB_BENCH_FLAGS, commit);
}
