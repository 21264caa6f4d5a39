#include "study_report.h"

#include "base/memory.h"
#include "plot_draw.h"
#include "report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PANELS = 8 };

/* Writes "1.234 ± 0.005", or the value alone if the error is unknown. */
static void put_with_error(FILE *out, double value, double error)
{
    char text[48];
    sb_text_number(text, value);
    fprintf(out, " %s", text);
    sb_text_number(text, error);
    if (!isnan(error)) fprintf(out, " ± %s", text);
    fputs(" |", out);
}

static void put_order(FILE *out, const sb_study_row *row, bool seeds)
{
    const sb_order_range *r = &row->range;
    const double observed = row->convergence.kind == SB_ORDER_OBSERVED ? row->convergence.order : (double)NAN;
    char order[48];
    sb_text_number(order, observed);
    fprintf(out, " %s%s", observed >= SB_ORDER_LARGEST ? "at least " : "", order);
    if (seeds && !isnan(r->low)) fprintf(out, " (%.2g to %.2g in %.0f %%)", r->low, r->high, 100 * r->share);
    fputs(" |", out);
}

void sb_study_table(FILE *out, const sb_study *study, const sb_study_row *rows, size_t count)
{
    const sb_study_options *o = study->options;
    char text[48];
    fputs("| quantity | unit |", out);
    for (size_t l = 0; l < o->spacing_count; l++) fprintf(out, " %g m |", o->spacings[l]);
    fputs(" order | at spacing 0 | error bar of the finest | remark |\n|---|---|", out);
    for (size_t l = 0; l < o->spacing_count + 4; l++) fputs("---|", out);
    fputc('\n', out);
    for (size_t i = 0; i < count; i++) {
        const sb_study_row *row = &rows[i];
        fputs("| ", out);
        sb_text_cell(out, row->quantity);
        fprintf(out, " | %s |", row->unit);
        for (size_t l = 0; l < o->spacing_count; l++) put_with_error(out, row->levels[l].value, row->levels[l].error);
        put_order(out, row, o->seeds > 1);
        sb_text_number(text, row->convergence.extrapolated);
        fprintf(out, " %s |", text);
        sb_text_number(text, row->convergence.uncertainty);
        fprintf(out, " ± %s", text);
        if (row->finest > o->spacings[o->spacing_count - 1]) fprintf(out, " (at %g m)", row->finest);
        fprintf(out, " | %s |\n", sb_order_remark(row->convergence.kind));
    }
}

static void put_runs(FILE *out, const sb_study *study)
{
    fputs("\n## Runs\n\n| spacing (m) | seed | particles | steps | sweeps per step | run time (s) | "
          "processor time (s) | load |\n|---|---|---|---|---|---|---|---|\n",
          out);
    for (size_t i = 0; i < study->count; i++) {
        const sb_result *t = &study->trials[i];
        if (t->state != SB_RESULT_DONE) continue;
        fprintf(out, "| %g | %d | %zu | %zu | %.2f | %.4g | %.4g | %.2g |\n", t->run.view.resolution, t->request.seed,
                t->run.view.particles, t->run.view.steps, t->run.view.iterations, t->run.view.wall, t->run.cpu,
                t->run.load);
    }
    fputc('\n', out);
    for (size_t i = 0; i < study->count; i++) sb_trial_problem(out, &study->trials[i]);
}

static const char reading[] =
    "\n- Values are means over the start seeds, ± the standard error of the mean.\n"
    "- The order is that of the differences between the three finest spacings (Celik et al. 2008). Brackets contain "
    "its\n"
    "  range over all combinations of single seeds, and the percentage of combinations that have an order.\n"
    "- The value at spacing 0 is Richardson's extrapolation.\n"
    "- The error bar is 1.25 times the distance to that value (Roache's grid convergence index). Above order 2 it is "
    "what\n"
    "  the coarser difference leads to expect at order 2. With two spacings it is 3 times the first-order estimate. If "
    "no\n"
    "  order is observable, or one below 0.5, it is 3 times the range of the three values or more. Within the scatter "
    "of\n"
    "  the seeds it is their range plus twice the standard error.\n"
    "- Peaks are those of forces averaged over `measure.interval`: use the same interval for all spacings.\n";

/* Adds the line from the finest value to that at spacing 0, and the error bar of the finest value. */
static sb_status add_bar(const sb_study_row *row, const sb_level *finest, sb_curve *limit, sb_curve *bar,
                         sb_error *error)
{
    const double half = row->convergence.uncertainty;
    sb_status status = sb_curve_add(limit, finest->spacing, finest->value, error);
    if (status == SB_OK) status = sb_curve_add(limit, 0, row->convergence.extrapolated, error);
    if (isnan(half)) return status;
    if (status == SB_OK) status = sb_curve_add(bar, finest->spacing, finest->value - half, error);
    return status == SB_OK ? sb_curve_add(bar, finest->spacing, finest->value + half, error) : status;
}

static sb_status plot_row(const sb_study *study, const sb_study_row *row, sb_plot *plot, sb_error *error)
{
    const sb_study_options *o = study->options;
    sb_curve marks = {0}, line = {0}, limit = {0}, bar = {0};
    sb_status status = sb_plot_panel(plot, row->quantity, "spacing (m)", row->unit, error);
    if (status == SB_OK) sb_plot_range(plot, 0, (double)NAN, (double)NAN, (double)NAN);
    for (size_t i = 0; status == SB_OK && i < study->count; i++)
        status = sb_curve_add(&marks, o->spacings[i / (size_t)o->seeds], row->values[i], error);
    for (size_t l = 0; status == SB_OK && l < o->spacing_count; l++)
        status = sb_curve_add(&line, o->spacings[l], row->levels[l].value, error);
    for (size_t l = 0; status == SB_OK && l < o->spacing_count; l++)
        if (row->levels[l].spacing == row->finest) status = add_bar(row, &row->levels[l], &limit, &bar, error);
    if (status == SB_OK) status = sb_plot_curve(plot, SB_PLOT_MARKS, "seeds", &marks, error);
    if (status == SB_OK) status = sb_plot_curve(plot, SB_PLOT_LINE, "mean", &line, error);
    if (status == SB_OK && bar.count) status = sb_plot_curve(plot, SB_PLOT_LINE, "error bar", &bar, error);
    if (status == SB_OK && !isnan(row->convergence.extrapolated))
        status = sb_plot_curve(plot, SB_PLOT_REFERENCE, "extrapolated", &limit, error);
    sb_curve_free(&marks);
    sb_curve_free(&line);
    sb_curve_free(&limit);
    sb_curve_free(&bar);
    return status;
}

static sb_status draw(const sb_study *study, const sb_study_row *rows, size_t count, const char *folder,
                      sb_error *error)
{
    char plots[SB_PATH_MAX], picture[SB_PATH_MAX], real[SB_PATH_MAX];
    sb_plot *plot = sb_plot_create();
    sb_status status = plot ? SB_OK : sb_fail_memory(error, "a plot");
    if (status == SB_OK) status = sb_path_join(plots, folder, "plots", error);
    if (status == SB_OK) status = sb_make_directories(plots, error);
    if (status == SB_OK && !realpath(folder, real))
        status = sb_fail(error, SB_FAILED, "%.400s: no such folder", folder);
    if (status == SB_OK) status = sb_path_join(picture, real, "study.png", error);
    if (status == SB_OK && !count) status = sb_fail(error, SB_FAILED, "nothing was measured");
    for (size_t i = 0; status == SB_OK && i < count && i < PANELS; i++) status = plot_row(study, &rows[i], plot, error);
    if (status == SB_OK) status = sb_plot_draw(plot, plots, "study", picture, error);
    sb_plot_destroy(plot);
    return status;
}

static void put_report(FILE *out, const sb_study *study, const sb_study_row *rows, size_t count,
                       const sb_error *no_plot)
{
    const char *slash = strrchr(study->options->scene, '/');
    fprintf(out, "# Resolution study of %s\n\n", slash ? slash + 1 : study->options->scene);
    sb_trials_origin(out, study->store, study->trials, study->count, study->options->command);
    sb_study_table(out, study, rows, count);
    fputs(reading, out);
    if (no_plot->text[0])
        fprintf(out, "\nNo plot: %s.\n", no_plot->text);
    else
        fprintf(out, "\n![value over spacing](study.png)\n%s",
                count > PANELS ? "\nThe picture shows the first eight quantities; `--quantity` selects others.\n" : "");
    put_runs(out, study);
}

static void put_number(FILE *out, double value, const char *after)
{
    if (!isnan(value)) fprintf(out, "%.9g", value);
    fputs(after, out);
}

static void put_runs_csv(FILE *out, const sb_study *study, const sb_study_row *rows, size_t count)
{
    fputs("quantity,unit,spacing_m,seed,value,particles,steps,sweeps_per_step,run_time_s,cpu_s,load,"
          "commit\n",
          out);
    for (size_t q = 0; q < count; q++)
        for (size_t i = 0; i < study->count; i++) {
            const sb_result *t = &study->trials[i];
            if (t->state != SB_RESULT_DONE) continue;
            fprintf(out, "\"%s\",%s,%.9g,%d,", rows[q].quantity, rows[q].unit, t->run.view.resolution, t->request.seed);
            put_number(out, rows[q].values[i], ",");
            fprintf(out, "%zu,%zu,%.4f,%.3f,", t->run.view.particles, t->run.view.steps, t->run.view.iterations,
                    t->run.view.wall);
            put_number(out, t->run.cpu, ",");
            put_number(out, t->run.load, ",");
            fprintf(out, "%s\n", t->run.commit);
        }
}

static void put_orders_csv(FILE *out, const sb_study_row *rows, size_t count)
{
    fputs("quantity,unit,order,order_low,order_high,order_share,extrapolated,error_bar,remark\n", out);
    for (size_t q = 0; q < count; q++) {
        const sb_convergence *c = &rows[q].convergence;
        fprintf(out, "\"%s\",%s,", rows[q].quantity, rows[q].unit);
        put_number(out, c->kind == SB_ORDER_OBSERVED ? c->order : (double)NAN, ",");
        put_number(out, rows[q].range.low, ",");
        put_number(out, rows[q].range.high, ",");
        put_number(out, rows[q].range.share, ",");
        put_number(out, c->extrapolated, ",");
        put_number(out, c->uncertainty, ",");
        fprintf(out, "%s\n", sb_order_remark(c->kind));
    }
}

sb_status sb_study_write(const sb_study *study, const sb_study_row *rows, size_t count, const char *folder,
                         sb_error *error)
{
    sb_atomic_file file;
    sb_error no_plot = {0};
    draw(study, rows, count, folder, &no_plot);
    sb_status status = sb_atomic_open_in(&file, folder, "runs.csv", error);
    if (status == SB_OK) {
        put_runs_csv(file.stream, study, rows, count);
        status = sb_atomic_commit(&file, 0, error);
    }
    if (status == SB_OK) status = sb_atomic_open_in(&file, folder, "orders.csv", error);
    if (status == SB_OK) {
        put_orders_csv(file.stream, rows, count);
        status = sb_atomic_commit(&file, 0, error);
    }
    if (status == SB_OK) status = sb_atomic_open_in(&file, folder, "study.md", error);
    if (status != SB_OK) return status;
    put_report(file.stream, study, rows, count, &no_plot);
    return sb_atomic_commit(&file, 0, error);
}
