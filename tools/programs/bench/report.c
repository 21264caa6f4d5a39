#include "report.h"

#include "markdown.h"
#include "plot.h"
#include "process.h"

#include <dirent.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Writes "12.4 (12.3, +8 %)": median, smallest, and how far the largest is above it; if values may be negative, the
 * largest. */
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
            fputs("| kernel | ns per particle | ns per pair | % of bandwidth | % of arithmetic |\n"
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
}

static bool is_machine(const sb_bench_row *row)
{
    return strcmp(row->subject, SB_BENCH_MACHINE) == 0;
}

/* Limits of the machine at that time, in one line. */
static void put_machine(FILE *file, const sb_bench_rows *rows)
{
    const char *between = "\nMachine limits:";
    for (size_t i = 0; i < rows->count; i++) {
        const sb_bench_row *row = &rows->rows[i];
        if (!is_machine(row)) continue;
        fprintf(file, "%s %s ", between, row->quantity);
        put_spread(file, row);
        fprintf(file, " %s", row->unit);
        between = ",";
    }
    if (*between == ',') fputs(".\n", file);
}

/* One table per subject: a row per quantity. */
static void put_subjects(FILE *file, const sb_bench_rows *rows)
{
    const char *before = "";
    for (size_t i = 0; i < rows->count; i++) {
        const sb_bench_row *row = &rows->rows[i];
        if (is_machine(row)) continue;
        if (strcmp(row->subject, before) != 0)
            fprintf(file, "\n%s: %zu fluid particles, %d threads\n\n| quantity | unit | value |\n|---|---|---|\n",
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
        if (is_machine(row)) continue;
        const double share = sb_bench_efficiency(rows, row->particles, row->threads);
        fprintf(file, "| %zu | %d | ", row->particles, row->threads);
        put_spread(file, row);
        if (isnan(share))
            fputs(" | |\n", file);
        else
            fprintf(file, " | %.3f |\n", share);
    }
    fprintf(file, "\nThe cost per particle of the largest size is %.2f times that of the smallest.\n",
            sb_bench_growth(rows));
}

static sb_status draw_scaling(sb_plot *plot, const void *what, sb_error *error)
{
    const sb_bench_rows *rows = what;
    (void)error;
    sb_plot_panel(plot, "Whole steps of ten iterations", "log10 of the number of particles",
                  "ns per particle and step");
    sb_plot_range(plot, (double)NAN, (double)NAN, 0, (double)NAN);
    for (int threads = 1; threads <= 1024; threads *= 2) {
        sb_curve curve = {.count = 0};
        char label[64];
        snprintf(label, sizeof label, "%d thread%s", threads, threads > 1 ? "s" : "");
        for (size_t i = 0; i < rows->count; i++)
            if (rows->rows[i].threads == threads && !is_machine(&rows->rows[i]))
                sb_curve_add(&curve, log10((double)rows->rows[i].particles), rows->rows[i].median);
        if (curve.count > 0) sb_plot_curve(plot, SB_PLOT_LINE, label, &curve);
        sb_curve_free(&curve);
    }
    return SB_OK;
}

/* Writes the picture of the scaling, or the reason why it cannot be drawn. The table contains the input of gnuplot. */
static void put_picture(FILE *file, const sb_bench_table *table, const char *folder, const char *name)
{
    char plots[SB_PATH_MAX], text[SB_BENCH_NAME + 128];
    sb_error reason = {0};
    sb_plot_picture(draw_scaling, &table->rows, folder, "scaling", folder, &reason);
    if (sb_path_join(plots, folder, "plots", NULL) == SB_OK) sb_folder_remove(plots, NULL);
    snprintf(text, sizeof text, "![cost per particle by size and threads](bench/%.127s/scaling.png)\n", name);
    fputc('\n', file);
    sb_put_picture(file, &reason, text);
}

static void put_table(FILE *file, const sb_bench_table *table, const char *folder, const char *name)
{
    if (!table->found) return;
    fprintf(file, "\n### %s: %s\n\n```\n%s```\n", table->section->name, table->section->summary, table->origin);
    put_machine(file, &table->rows);
    if (strcmp(table->section->name, "kernels") == 0)
        put_kernels(file, &table->rows);
    else if (strcmp(table->section->name, "scaling") == 0) {
        put_scaling(file, &table->rows);
        put_picture(file, table, folder, name);
    } else
        put_subjects(file, &table->rows);
}

sb_status sb_bench_tables_read(sb_bench_tables *tables, const char *folder, sb_error *error)
{
    char path[SB_PATH_MAX], name[SB_BENCH_NAME];
    sb_status status = SB_OK;
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

void sb_bench_tables_free(sb_bench_tables *tables)
{
    for (size_t t = 0; t < tables->count; t++) sb_bench_rows_free(&tables->table[t].rows);
    tables->count = 0;
}

/* Writes all sections of one machine, after its name, bandwidth and targets. Nothing if there are no tables. */
static void put_all(FILE *file, const sb_bench_tables *tables, const char *folder, const char *name)
{
    static const char key[] = "machine: ";
    const sb_bench_row *copy = sb_bench_copy(tables, NULL);
    const char *machine = name;
    size_t found = 0;
    for (size_t t = 0; t < tables->count; t++) {
        const char *at = strstr(tables->table[t].origin, key);
        if (at) machine = at + strlen(key);
        found += tables->table[t].found;
    }
    if (found == 0) return;
    fprintf(file, "\n## %.*s; ", (int)strcspn(machine, "\n"), machine);
    if (copy)
        fprintf(file, "copy bandwidth %.3g GB/s on %d threads\n\n", copy->median, copy->threads);
    else
        fputs("copy bandwidth not measured\n\n", file);
    sb_bench_put_targets(file, tables);
    for (size_t t = 0; t < tables->count; t++) put_table(file, &tables->table[t], folder, name);
}

static int is_machines_folder(const struct dirent *entry)
{
    return entry->d_name[0] != '.' && !strchr(entry->d_name, '.');
}

static sb_status put_machines(FILE *file, const char *out, sb_error *error)
{
    static sb_bench_tables tables;
    char bench[SB_PATH_MAX], folder[SB_PATH_MAX];
    struct dirent **names = NULL;
    sb_status status = sb_path_join(bench, out, "bench", error);
    const int count = status == SB_OK ? scandir(bench, &names, is_machines_folder, alphasort) : 0;
    if (count < 0) status = sb_fail(error, SB_BAD_INPUT, "%.400s: cannot be read, expected a folder", bench);
    for (int m = 0; m < count; m++) {
        if (status == SB_OK) status = sb_path_join(folder, bench, names[m]->d_name, error);
        if (status == SB_OK) status = sb_bench_tables_read(&tables, folder, error);
        if (status == SB_OK) put_all(file, &tables, folder, names[m]->d_name);
        sb_bench_tables_free(&tables);
        free(names[m]);
    }
    free(names);
    return status;
}

sb_status sb_bench_report(const char *out, sb_error *error)
{
    sb_atomic_file file;
    sb_status status = sb_atomic_open_in(&file, out, "benchmarks.md", error);
    if (status != SB_OK) return status;
    fputs(
        "# Benchmarks\n\n"
        "Run time and memory of the simulation, machine by machine. Made by `tools/bench`; "
        "[performance.md](../performance.md) explains\nhow to read and repeat the figures.\n\n"
        "- Each table is of one machine.\n"
        "- Figures are medians. Brackets contain the smallest value and by how much the largest exceeds it.\n"
        "- Each section names its commit and the load of the machine. If other programs used cores, its times are not "
        "reliable.\n"
        "- A time is judged as a ratio, so that targets hold on any machine: time × copy bandwidth per fluid particle. "
        "This is\n  the number of kilobytes that the machine could have copied in the same time.\n",
        file.stream);
    status = put_machines(file.stream, out, error);
    if (status == SB_OK) return sb_atomic_commit(&file, 0, error);
    sb_atomic_abort(&file);
    return status;
}
