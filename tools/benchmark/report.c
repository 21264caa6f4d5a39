#include "report.h"

#include "base/file.h"
#include "plot_draw.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* "12.4 (12.3, +8 %)": median, least, and how far the most is above that; of what may be negative the most itself. */
static void put_spread(FILE *file, const sb_bench_row *row)
{
    fprintf(file, "%.4g", row->median);
    if (row->repeats > 1 && row->least > 0)
        fprintf(file, " (%.4g, +%.0f %%)", row->least, 100 * (row->most / row->least - 1));
    else if (row->repeats > 1)
        fprintf(file, " (%.4g to %.4g)", row->least, row->most);
}

static void put_cell(FILE *file, const sb_bench_row *row)
{
    if (row)
        fprintf(file, " %.3g |", row->median);
    else
        fputs(" |", file);
}

/* One table per number of particles: a row per kernel. */
static void put_kernels(FILE *file, const sb_bench_rows *rows)
{
    size_t before = 0;
    for (size_t i = 0; i < rows->count; i++) {
        const sb_bench_row *row = &rows->rows[i];
        if (strcmp(row->quantity, SB_BENCH_PER_PARTICLE) != 0) continue;
        if (row->particles != before) {
            const sb_bench_row *pairs = sb_bench_find(rows, "basin", row->particles, 0, "pairs per particle");
            fprintf(file, "\n%zu particles, %d threads, %.1f pairs per particle:\n\n", row->particles, row->threads,
                    pairs ? pairs->median : (double)NAN);
            fputs("| kernel | ns per particle | ns per pair | of bandwidth, % | of arithmetic, % |\n"
                  "|---|---|---|---|---|\n",
                  file);
        }
        before = row->particles;
        fprintf(file, "| %s | ", row->subject);
        put_spread(file, row);
        fputs(" |", file);
        put_cell(file, sb_bench_find(rows, row->subject, row->particles, row->threads, "time per pair"));
        put_cell(file, sb_bench_find(rows, row->subject, row->particles, row->threads, "share of bandwidth"));
        put_cell(file, sb_bench_find(rows, row->subject, row->particles, row->threads, "share of arithmetic"));
        fputc('\n', file);
    }
    fputs("\nThe machine in the same processes:\n\n| limit | unit | median (least, spread) |\n|---|---|---|\n", file);
    for (size_t i = 0; i < rows->count; i++)
        if (strcmp(rows->rows[i].subject, "machine") == 0) {
            fprintf(file, "| %s, %d threads | %s | ", rows->rows[i].quantity, rows->rows[i].threads,
                    rows->rows[i].unit);
            put_spread(file, &rows->rows[i]);
            fputs(" |\n", file);
        }
}

/* One table per subject: a row per quantity. */
static void put_subjects(FILE *file, const sb_bench_rows *rows)
{
    const char *before = "";
    for (size_t i = 0; i < rows->count; i++) {
        const sb_bench_row *row = &rows->rows[i];
        if (strcmp(row->subject, before) != 0)
            fprintf(file, "\n%s: %zu fluid particles, %d threads\n\n| quantity | unit | |\n|---|---|---|\n",
                    row->subject, row->particles, row->threads);
        before = row->subject;
        fprintf(file, "| %s | %s | ", row->quantity, strcmp(row->unit, "1") == 0 ? "" : row->unit);
        put_spread(file, row);
        fputs(" |\n", file);
    }
}

static void put_scaling(FILE *file, const sb_bench_rows *rows)
{
    fputs("\n| particles | threads | ns per particle and step | parallel efficiency |\n|---|---|---|---|\n", file);
    for (size_t i = 0; i < rows->count; i++) {
        const sb_bench_row *row = &rows->rows[i];
        const double share = sb_bench_efficiency(rows, row->particles, row->threads);
        fprintf(file, "| %zu | %d | ", row->particles, row->threads);
        put_spread(file, row);
        if (isnan(share))
            fputs(" | |\n", file);
        else
            fprintf(file, " | %.3f |\n", share);
    }
    fprintf(file, "\nFrom the smallest to the largest the cost per particle grows %.2f times.\n",
            sb_bench_growth(rows));
}

/* What gnuplot was given stands in the table already. */
static void remove_plot_input(const char *folder)
{
    static const char *const names[] = {"scaling.gp", "scaling.dat"};
    char path[SB_PATH_MAX];
    for (size_t n = 0; n < sizeof names / sizeof *names; n++)
        if (sb_path_join(path, folder, names[n], NULL) == SB_OK) remove(path);
}

static sb_status draw_scaling(const sb_bench_rows *rows, const char *folder, const char *picture, sb_error *error)
{
    sb_plot *plot = sb_plot_create();
    if (!plot) return sb_fail_memory(error, "a plot");
    sb_status status = sb_plot_panel(plot, "Whole steps of ten iterations", "log10 of the number of particles",
                                     "ns per particle and step", error);
    sb_plot_range(plot, (double)NAN, (double)NAN, 0, (double)NAN);
    for (int threads = 1; threads <= 1024 && status == SB_OK; threads *= 2) {
        sb_curve curve = {.count = 0};
        char label[64];
        snprintf(label, sizeof label, "%d thread%s", threads, threads > 1 ? "s" : "");
        for (size_t i = 0; i < rows->count && status == SB_OK; i++)
            if (rows->rows[i].threads == threads)
                status = sb_curve_add(&curve, log10((double)rows->rows[i].particles), rows->rows[i].median, error);
        if (status == SB_OK && curve.count > 0) status = sb_plot_curve(plot, SB_PLOT_LINE, label, &curve, error);
        sb_curve_free(&curve);
    }
    if (status == SB_OK) status = sb_plot_draw(plot, folder, "scaling", picture, error);
    remove_plot_input(folder);
    sb_plot_destroy(plot);
    return status;
}

static void put_table(FILE *file, const sb_bench_table *table)
{
    fprintf(file, "\n## %s\n\n%s.\n\n", table->section->name, table->section->summary);
    if (!table->found) {
        fprintf(file, "Not measured: `tools/bench %s` does.\n", table->section->name);
        return;
    }
    fprintf(file, "```\n%s```\n", table->origin);
    if (strcmp(table->section->name, "kernels") == 0)
        put_kernels(file, &table->rows);
    else if (strcmp(table->section->name, "scaling") == 0)
        put_scaling(file, &table->rows);
    else
        put_subjects(file, &table->rows);
}

static sb_status read_all(const char *out, sb_bench_tables *tables, sb_error *error)
{
    char folder[SB_PATH_MAX], path[SB_PATH_MAX], name[SB_BENCH_NAME];
    sb_status status = sb_path_join(folder, out, "bench", error);
    for (const sb_bench_section *s = sb_bench_sections; s->name && status == SB_OK; s++) {
        sb_bench_table *table = &tables->table[tables->count++];
        table->section = s;
        snprintf(name, sizeof name, "%s.csv", s->name);
        status = sb_path_join(path, folder, name, error);
        if (status == SB_OK)
            status = sb_bench_read(&table->rows, table->origin, sizeof table->origin, &table->found, path, error);
    }
    return status;
}

/* Scaling has a picture; where it cannot be drawn the reason stands in its place. */
static void put_picture(FILE *file, const sb_bench_table *table, const char *out)
{
    char folder[SB_PATH_MAX], absolute[SB_PATH_MAX], picture[SB_PATH_MAX];
    sb_error reason = {0};
    if (strcmp(table->section->name, "scaling") != 0 || !table->found) return;
    sb_status status = sb_path_join(folder, out, "bench", &reason);
    if (status == SB_OK && !realpath(folder, absolute)) /* as the plot wants it */
        status = sb_fail(&reason, SB_FAILED, "%.400s: no such folder", folder);
    if (status == SB_OK) status = sb_path_join(picture, absolute, "scaling.png", &reason);
    if (status == SB_OK) status = draw_scaling(&table->rows, absolute, picture, &reason);
    if (status == SB_OK)
        fputs("\n![cost per particle by size and threads](bench/scaling.png)\n", file);
    else
        fprintf(file, "\nNo plot: %s.\n", reason.text);
}

static void put_all(FILE *file, const sb_bench_tables *tables, const char *out)
{
    fputs("# Benchmarks\n\nMade by `tools/bench`; how to read and repeat them: [performance.md](../performance.md). "
          "Medians; in\n"
          "brackets the least and how far the most lies above it. A section's lines say where and when it was "
          "measured: where\n"
          "other programs kept cores busy, its times are not to be trusted.\n\n## What was to be reached, on two "
          "cores\n\n",
          file);
    sb_bench_put_reach(file, tables);
    for (size_t t = 0; t < tables->count; t++) {
        put_table(file, &tables->table[t]);
        put_picture(file, &tables->table[t], out);
    }
}

sb_status sb_bench_report(const char *out, sb_error *error)
{
    static sb_bench_tables tables;
    sb_atomic_file file;
    tables = (sb_bench_tables){.count = 0};
    sb_status status = read_all(out, &tables, error);
    if (status == SB_OK) status = sb_atomic_open_in(&file, out, "benchmarks.md", error);
    if (status == SB_OK) {
        put_all(file.stream, &tables, out);
        status = sb_atomic_commit(&file, 0, error);
    }
    for (size_t t = 0; t < tables.count; t++) sb_bench_rows_free(&tables.table[t].rows);
    return status;
}
