/* The targets, and the results of one machine's tables. */
#include "report.h"

#include <math.h>
#include <string.h>

/* A time is judged as the kilobytes that the machine could have copied meanwhile, per fluid particle: a ratio that
   machines of different bandwidth share. The targets of times were set in seconds for a machine that copied 18.7 GB/s
   and are converted with that bandwidth and the scene's fluid particles; the pressure iteration's was set as bytes. */
typedef struct target {
    const char *figure, *unit;
    double target, stretch; /* at most; at_least: at least */
    bool at_least, is_time;
    const char *section, *subject, *quantity;
    double factor; /* from the row's unit */
} target;

static const target targets[] = {
    {"plant at 4 m, preset `paper`, per simulated second", "kB per particle", 447, 298, false, true, "runs",
     "plant at 4 m; paper", "run time per simulated second", 1},
    {"plant at 4 m, preset `default`, per simulated second", "kB per particle", 164, 67, false, true, "runs",
     "plant at 4 m; default", "run time per simulated second", 1},
    {"column at 1 cm, shorter step, per simulated second", "kB per particle", 9310, 4650, false, true, "runs",
     "column at 1 cm, shorter step", "run time per simulated second", 1},
    {"column at 1 cm, shorter step: mean compression (target: that of SPlisHSPlasH's DFSPH)", "%", 0.044, 0.044, false,
     false, "runs", "column at 1 cm, shorter step", "compression, mean", 1},
    {"pressure iteration, fluid and walls, 1 M particles", "kB per particle", 0.95, 0.84, false, true, "kernels",
     SB_BENCH_ITERATION, SB_BENCH_PER_PARTICLE, 1},
    {"whole step of 10 iterations, 1 M particles", "kB per particle", 16.8, 12.2, false, true, "kernels", SB_BENCH_STEP,
     SB_BENCH_PER_PARTICLE, 1},
    {"neighbour search and sort, 1 M particles", "kB per particle", 2.8, 1.7, false, true, "kernels", "sort and search",
     SB_BENCH_PER_PARTICLE, 1},
    {"cost per particle, 50 k to 4 M particles", "×", 1.3, 1.2, false, false, "scaling", "growth", NULL, 1},
    {"parallel efficiency, threads 1 to 2, 1 M particles", "", 0.9, 0.95, true, false, "scaling", "efficiency", NULL,
     1},
    {"memory of the whole program, plant at 4 m", "B per particle", 450, 300, false, false, "memory",
     "plant at 4 m by the program", "peak memory", 1},
    {"plant at 1 m: set-up", "kB per particle", 314, 314, false, true, "large", "plant at 1 m", "set-up", 1},
    {"plant at 1 m: peak memory of 20 steps", "GiB", 9, 6, false, false, "large", "plant at 1 m", "total peak memory",
     1e6 / 1073741824},
    {"time added by ten times more dry terrain", "%", 2, 0, false, false, "memory", "shore with ten times the land",
     "time added", 1},
    {"next picture: 200 k particles, everything on", "ms", 300, 300, false, false, "pictures", SB_BENCH_PICTURE,
     SB_BENCH_NEXT_PICTURE, 1},
    {"next picture: 200 k particles, shadows and occlusion off", "ms", 150, 150, false, false, "pictures",
     SB_BENCH_PICTURE_PLAIN, SB_BENCH_NEXT_PICTURE, 1},
    {"next picture: 2 M particles, everything on", "ms", 900, 900, false, false, "pictures", SB_BENCH_PICTURE_LARGE,
     SB_BENCH_NEXT_PICTURE, 1},
    {"conical island, per simulated second", "kB per particle", 2910, 1450, false, true, "island", "conical island",
     "run time per simulated second", 1},
};

/* The table of a section; quick forms are not judged. */
static const sb_bench_table *table_of(const sb_bench_tables *tables, const char *section)
{
    for (size_t t = 0; t < tables->count; t++)
        if (strcmp(tables->table[t].section->name, section) == 0 && tables->table[t].found &&
            !strstr(tables->table[t].origin, SB_BENCH_QUICKLY))
            return &tables->table[t];
    return NULL;
}

/* Of several sizes, the row nearest to a million particles; of rows without particles, the last. */
static const sb_bench_row *look_up(const sb_bench_rows *rows, const char *subject, const char *quantity)
{
    const sb_bench_row *best = NULL;
    for (size_t i = 0; i < rows->count; i++) {
        const sb_bench_row *row = &rows->rows[i];
        if (strcmp(row->subject, subject) != 0 || strcmp(row->quantity, quantity) != 0) continue;
        if (!best || fabs(log((double)row->particles / 1e6)) <= fabs(log((double)best->particles / 1e6))) best = row;
    }
    return best;
}

const sb_bench_row *sb_bench_copy(const sb_bench_tables *tables, const sb_bench_table *table)
{
    const sb_bench_row *row = table ? look_up(&table->rows, SB_BENCH_MACHINE, SB_BENCH_COPY) : NULL;
    for (size_t t = 0; t < tables->count && !row; t++)
        row = look_up(&tables->table[t].rows, SB_BENCH_MACHINE, SB_BENCH_COPY);
    return row;
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

/* A figure with the smallest and the largest value of its repeats; both equal it if there are none. */
typedef struct figure {
    double value, least, most;
} figure;

/* Figures that are computed from several rows. */
static figure derived(const target *g, const sb_bench_rows *scaling)
{
    const sb_bench_row *row = look_up(scaling, SB_BENCH_STEP, SB_BENCH_PER_PARTICLE);
    const double value = strcmp(g->subject, "growth") == 0 ? sb_bench_growth(scaling)
                         : row                             ? sb_bench_efficiency(scaling, row->particles, 2)
                                                           : (double)NAN;
    return (figure){value, value, value};
}

static figure scaled(const sb_bench_row *row, double factor)
{
    return (figure){factor * row->median, factor * row->least, factor * row->most};
}

static void put_figure(FILE *file, figure f)
{
    const int digits = f.most < 1000 ? 3 : 5;
    fprintf(file, "%.*g", digits, f.value);
    if (f.least < f.most) fprintf(file, " (%.*g to %.*g)", digits, f.least, digits, f.most);
}

/* Writes the commit from the origin of a table. */
static void put_commit(FILE *file, const sb_bench_table *table)
{
    static const char key[] = "commit: ";
    const char *at = strstr(table->origin, key);
    if (at) fprintf(file, "%.*s", (int)strcspn(at + strlen(key), "\n"), at + strlen(key));
}

static const char *verdict(const target *g, double value)
{
    const double sign = g->at_least ? -1 : 1;
    return isnan(value)                        ? ""
           : sign * value <= sign * g->stretch ? "within stretch target"
           : sign * value <= sign * g->target  ? "within"
                                               : "**missed**";
}

/* Writes one row, or nothing if the figure was not measured. A time is also written in its unit. */
static void put_target(FILE *file, const target *g, const sb_bench_tables *tables)
{
    const sb_bench_table *table = table_of(tables, g->section);
    if (!table) return;
    const sb_bench_row *row = g->quantity ? look_up(&table->rows, g->subject, g->quantity) : NULL;
    if (g->quantity && !row) return;
    figure f = row ? scaled(row, g->factor) : derived(g, &table->rows);
    if (isnan(f.value)) return;
    fprintf(file, "| %s | ", g->figure);
    if (g->is_time) {
        const sb_bench_row *copy = sb_bench_copy(tables, table);
        const double seconds = strcmp(row->unit, "ns") == 0 ? 1e-9 : 1 / (double)row->particles; /* per particle */
        put_figure(file, f);
        fprintf(file, " %s", row->unit);
        f = scaled(row, copy ? seconds * copy->median * 1e6 : (double)NAN);
    }
    fputs(" | ", file);
    if (isnan(f.value))
        fputs("bandwidth not measured", file);
    else
        put_figure(file, f);
    fprintf(file, " | %s | %s %g | %g | %s | ", g->unit, g->at_least ? "≥" : "≤", g->target, g->stretch,
            verdict(g, f.value));
    put_commit(file, table);
    fputs(" |\n", file);
}

void sb_bench_put_targets(FILE *file, const sb_bench_tables *tables)
{
    fputs("| figure | time (smallest to largest) | judged value (smallest to largest) | unit | target | stretch target "
          "| result | commit "
          "|\n|---|---|---|---|---|---|---|---|\n",
          file);
    for (size_t i = 0; i < sizeof targets / sizeof targets[0]; i++) put_target(file, &targets[i], tables);
}
