/* What was to be reached on two cores of this class, and what was. */
#include "report.h"

#include <math.h>
#include <string.h>

/* A figure that is one row of one table. section NULL: it is worked out of several. */
typedef struct goal {
    const char *figure, *unit;
    double reach, stretch; /* at most; at_least: at least */
    bool at_least;
    const char *section, *subject, *quantity;
    double factor;
} goal;

static const goal goals[] = {
    {"plant at 4 m, 90 s, preset `paper`", "s", 600, 400, false, "runs", "plant at 4 m; paper", "wall time", 1},
    {"plant at 4 m, 90 s, `default`", "s", 220, 90, false, "runs", "plant at 4 m; default", "wall time", 1},
    {"column at 1 cm, held tighter, per simulated second", "s", 40, 20, false, "runs", "column at 1 cm, held tighter",
     "wall time per simulated second", 1},
    {"its compression, mean (asked: the DFSPH peer's)", "%", 0.044, 0.044, false, "runs",
     "column at 1 cm, held tighter", "compression, mean", 1},
    {"pressure iteration, fluid and walls, 1 M particles", "ns per particle", 60, 45, false, "kernels",
     SB_BENCH_ITERATION, SB_BENCH_PER_PARTICLE, 1},
    {"whole step of 10 iterations, 1 M particles", "µs per particle", 0.9, 0.65, false, "kernels", SB_BENCH_STEP,
     SB_BENCH_PER_PARTICLE, 1e-3},
    {"neighbour search and sort, 1 M particles", "ns per particle", 150, 90, false, "kernels", "sort and search",
     SB_BENCH_PER_PARTICLE, 1},
    {"cost per particle, 50 k to 4 M", "×", 1.3, 1.2, false, NULL, "growth", NULL, 1},
    {"parallel efficiency, threads 1 to 2, 1 M particles", "", 0.9, 0.95, true, NULL, "efficiency", NULL, 1},
    {"memory, all in, plant at 4 m", "bytes per fluid particle", 450, 300, false, "memory",
     "plant at 4 m by the program", "peak memory", 1},
    {"plant at 1 m: set-up", "minutes", 5, 5, false, "large", "plant at 1 m", "set-up", 1.0 / 60},
    {"plant at 1 m: 20 steps within", "GiB", 9, 6, false, "large", "plant at 1 m", "peak memory in all",
     1e6 / 1073741824},
    {"ten times more dry terrain adds", "%", 2, 0, false, "memory", "shore with ten times the land", "time added", 1},
    {"conical island, 12 s", "minutes", 90, 45, false, "island", "conical island", "wall time", 1.0 / 60},
};

/* Quick forms are no measure of anything. */
static const sb_bench_table *table_of(const sb_bench_tables *tables, const char *section)
{
    for (size_t t = 0; t < tables->count; t++)
        if (strcmp(tables->table[t].section->name, section) == 0 && !strstr(tables->table[t].origin, SB_BENCH_QUICKLY))
            return &tables->table[t];
    return NULL;
}

static const sb_bench_rows *rows_of(const sb_bench_tables *tables, const char *section)
{
    const sb_bench_table *table = table_of(tables, section);
    return table ? &table->rows : NULL;
}

const sb_bench_row *sb_bench_look_up(const sb_bench_tables *tables, const char *section, const char *subject,
                                     const char *quantity)
{
    const sb_bench_rows *rows = rows_of(tables, section);
    /* Kernels come in sizes: the one nearest a million is meant; of the machine itself, the last, measured with them.
     */
    const sb_bench_row *best = NULL;
    for (size_t i = 0; rows && i < rows->count; i++) {
        const sb_bench_row *row = &rows->rows[i];
        if (strcmp(row->subject, subject) != 0 || strcmp(row->quantity, quantity) != 0) continue;
        if (!best || fabs(log((double)row->particles / 1e6)) <= fabs(log((double)best->particles / 1e6))) best = row;
    }
    return best;
}

double sb_bench_growth(const sb_bench_rows *scaling)
{
    const sb_bench_row *first = NULL, *last = NULL;
    for (size_t i = 0; i < scaling->count; i++) {
        const sb_bench_row *row = &scaling->rows[i];
        if (strcmp(row->quantity, SB_BENCH_PER_PARTICLE) != 0) continue;
        if (!first || row->particles < first->particles ||
            (row->particles == first->particles && row->threads > first->threads))
            first = row;
        if (!last || row->particles > last->particles ||
            (row->particles == last->particles && row->threads > last->threads))
            last = row;
    }
    return first && last && first != last ? last->median / first->median : (double)NAN;
}

double sb_bench_efficiency(const sb_bench_rows *scaling, size_t particles, int threads)
{
    const sb_bench_row *one = sb_bench_find(scaling, SB_BENCH_STEP, particles, 1, SB_BENCH_PER_PARTICLE);
    const sb_bench_row *many = sb_bench_find(scaling, SB_BENCH_STEP, particles, threads, SB_BENCH_PER_PARTICLE);
    return one && many && threads > 1 ? one->median / (threads * many->median) : (double)NAN;
}

/* Of two threads, in the basin of `scaling` nearest to a million particles. */
static double efficiency(const sb_bench_rows *scaling)
{
    size_t nearest = 0;
    for (size_t i = 0; i < scaling->count; i++) {
        const size_t n = scaling->rows[i].particles;
        if (!nearest || fabs(log((double)n / 1e6)) < fabs(log((double)nearest / 1e6))) nearest = n;
    }
    return sb_bench_efficiency(scaling, nearest, 2);
}

/* A figure with the least and the most of its repeats; those equal it where it has none. */
typedef struct figure {
    double value, least, most;
} figure;

static figure measured(const goal *g, const sb_bench_tables *tables)
{
    const sb_bench_rows *scaling = rows_of(tables, "scaling");
    if (!g->section) {
        const double value = !scaling                            ? (double)NAN
                             : strcmp(g->subject, "growth") == 0 ? sb_bench_growth(scaling)
                                                                 : efficiency(scaling);
        return (figure){value, value, value};
    }
    const sb_bench_row *row = sb_bench_look_up(tables, g->section, g->subject, g->quantity);
    if (!row) return (figure){(double)NAN, (double)NAN, (double)NAN};
    return (figure){g->factor * row->median, g->factor * row->least, g->factor * row->most};
}

/* What stands behind "key: " in the lines of where a table is from, up to a comma. */
static void put_from(FILE *file, const sb_bench_table *table, const char *key)
{
    const char *at = table ? strstr(table->origin, key) : NULL;
    if (at) fprintf(file, "%.*s", (int)strcspn(at + strlen(key), ",\n"), at + strlen(key));
}

static void put_figure(FILE *file, figure f)
{
    fprintf(file, "%.3g", f.value);
    if (f.least < f.most) fprintf(file, " (%.3g to %.3g)", f.least, f.most);
}

/* Copying of two threads, beside which times per particle are to be read. */
static void put_bandwidth(FILE *file, const sb_bench_tables *tables)
{
    const sb_bench_row *row = sb_bench_look_up(tables, "kernels", "machine", "copy bandwidth");
    if (!row) return;
    fprintf(file,
            "\nCopy bandwidth of two threads where the kernels were measured: %.3g (%.3g to %.3g) GB/s; where what "
            "is to be reached was set, 18.7.\n",
            row->median, row->least, row->most);
}

static bool within(const goal *g, double value, double limit)
{
    return g->at_least ? value >= limit : value <= limit;
}

void sb_bench_put_reach(FILE *file, const sb_bench_tables *tables)
{
    fputs("| figure | unit | reach | stretch | measured (least to most) | | where, commit "
          "|\n|---|---|---|---|---|---|---|\n",
          file);
    for (size_t i = 0; i < sizeof goals / sizeof goals[0]; i++) {
        const goal *g = &goals[i];
        const figure f = measured(g, tables);
        const sb_bench_table *table = table_of(tables, g->section ? g->section : "scaling");
        const char *sign = g->at_least ? "≥" : "≤";
        fprintf(file, "| %s | %s | %s %g | %g | ", g->figure, g->unit, sign, g->reach, g->stretch);
        if (isnan(f.value)) {
            fputs("not measured | | |\n", file);
            continue;
        }
        put_figure(file, f);
        fprintf(file, " | %s | ",
                within(g, f.value, g->stretch) ? "stretch"
                : within(g, f.value, g->reach) ? "within"
                                               : "**short**");
        put_from(file, table, "machine: ");
        fputs(", ", file);
        put_from(file, table, "commit: ");
        fputs(" |\n", file);
    }
    put_bandwidth(file, tables);
}
