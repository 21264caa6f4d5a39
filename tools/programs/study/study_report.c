#include "study_report.h"

#include "base/memory.h"
#include "markdown.h"
#include "plot.h"

#include <math.h>
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

void sb_study_table(FILE *out, const sb_study *study)
{
    const sb_study_options *o = study->options;
    char text[48];
    fputs("| quantity | unit |", out);
    for (size_t l = 0; l < o->spacing_count; l++) fprintf(out, " %g m |", o->spacings[l]);
    fputs(" order | at spacing 0 | error bar of the finest | remark |\n", out);
    sb_put_rule(out, o->spacing_count + 6);
    for (const sb_study_row *row = study->rows; row < study->rows + study->row_count; row++) {
        fputc('|', out);
        sb_put_cell(out, row->quantity);
        fprintf(out, " %s |", row->unit);
        for (size_t l = 0; l < o->spacing_count; l++) put_with_error(out, row->levels[l].value, row->levels[l].error);
        put_order(out, row, o->seeds > 1);
        sb_put_number(out, row->convergence.extrapolated);
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
        const sb_result *t = &study->runs[i];
        if (t->state != SB_RESULT_DONE) continue;
        fprintf(out, "| %g | %d | %zu | %zu | %.2f | %.4g | %.4g | %.2g |\n", t->run.view.resolution, t->request.seed,
                t->run.view.particles, t->run.view.steps, t->run.view.iterations, t->run.view.wall, t->run.cpu,
                t->run.load);
    }
    fputc('\n', out);
    for (size_t i = 0; i < study->count; i++) sb_runs_problem(out, &study->runs[i]);
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

static void plot_row(const sb_study *study, const sb_study_row *row, sb_plot *plot)
{
    const sb_study_options *o = study->options;
    const double half = row->convergence.uncertainty;
    sb_curves made = {0};
    sb_curve *marks = sb_curve_new(&made), *line = sb_curve_new(&made), *limit = sb_curve_new(&made);
    sb_curve *bar = sb_curve_new(&made);
    for (size_t i = 0; i < study->count; i++) sb_curve_add(marks, o->spacings[i / (size_t)o->seeds], row->values[i]);
    for (const sb_level *l = row->levels; l < row->levels + o->spacing_count; l++) {
        sb_curve_add(line, l->spacing, l->value);
        if (l->spacing != row->finest) continue;
        /* The line from the finest value to that at spacing 0, and its error bar. */
        sb_curve_add(limit, l->spacing, l->value);
        sb_curve_add(limit, 0, row->convergence.extrapolated);
        if (isnan(half)) continue;
        sb_curve_add(bar, l->spacing, l->value - half);
        sb_curve_add(bar, l->spacing, l->value + half);
    }
    sb_plot_panel(plot, row->quantity, "spacing (m)", row->unit);
    sb_plot_range(plot, 0, (double)NAN, (double)NAN, (double)NAN);
    sb_plot_curve(plot, SB_PLOT_MARKS, "seeds", marks);
    sb_plot_curve(plot, SB_PLOT_LINE, "mean", line);
    if (bar->count) sb_plot_curve(plot, SB_PLOT_LINE, "error bar", bar);
    if (!isnan(row->convergence.extrapolated)) sb_plot_curve(plot, SB_PLOT_REFERENCE, "extrapolated", limit);
    sb_curves_free(&made);
}

static sb_status draw(sb_plot *plot, const void *what, sb_error *error)
{
    const sb_study *study = what;
    for (size_t i = 0; i < study->row_count && i < PANELS; i++) plot_row(study, &study->rows[i], plot);
    return study->row_count ? SB_OK : sb_fail(error, SB_FAILED, "nothing was measured");
}

static void put_report(FILE *out, const void *what)
{
    const sb_study *study = what;
    const char *slash = strrchr(study->options->scene, '/');
    sb_error no_plot = {0};
    sb_plot_picture(draw, study, study->store->out, "study", study->store->report, &no_plot);
    fprintf(out, "# Resolution study of %s\n\n", slash ? slash + 1 : study->options->scene);
    sb_runs_origin(out, study->store, study->runs, study->count);
    sb_study_table(out, study);
    fprintf(out, "%s\n", reading);
    sb_put_picture(out, &no_plot, "![value over spacing](study.png)\n");
    if (!no_plot.text[0] && study->row_count > PANELS)
        fputs("\nThe picture shows the first eight quantities; `--quantity` selects others.\n", out);
    put_runs(out, study);
}

static void put_runs_csv(FILE *out, const void *what)
{
    const sb_study *study = what;
    fputs("quantity,unit,spacing_m,seed,value,particles,steps,sweeps_per_step,run_time_s,cpu_s,load,"
          "commit\n",
          out);
    for (size_t q = 0; q < study->row_count; q++)
        for (size_t i = 0; i < study->count; i++) {
            const sb_result *t = &study->runs[i];
            const sb_study_row *row = &study->rows[q];
            if (t->state != SB_RESULT_DONE) continue;
            fprintf(out, "\"%s\",%s,%.9g,%d,", row->quantity, row->unit, t->run.view.resolution, t->request.seed);
            sb_put_field(out, row->values[i]);
            fprintf(out, "%zu,%zu,%.4f,%.3f,", t->run.view.particles, t->run.view.steps, t->run.view.iterations,
                    t->run.view.wall);
            sb_put_field(out, t->run.cpu);
            sb_put_field(out, t->run.load);
            fprintf(out, "%s\n", t->run.commit);
        }
}

static void put_orders_csv(FILE *out, const void *what)
{
    const sb_study *study = what;
    fputs("quantity,unit,order,order_low,order_high,order_share,extrapolated,error_bar,remark\n", out);
    for (const sb_study_row *row = study->rows; row < study->rows + study->row_count; row++) {
        const sb_convergence *c = &row->convergence;
        fprintf(out, "\"%s\",%s,", row->quantity, row->unit);
        sb_put_field(out, c->kind == SB_ORDER_OBSERVED ? c->order : (double)NAN);
        sb_put_field(out, row->range.low);
        sb_put_field(out, row->range.high);
        sb_put_field(out, row->range.share);
        sb_put_field(out, c->extrapolated);
        sb_put_field(out, c->uncertainty);
        fprintf(out, "%s\n", sb_order_remark(c->kind));
    }
}

sb_status sb_study_write(const sb_study *study, sb_error *error)
{
    static const sb_report_file files[] = {
        {"runs.csv", put_runs_csv}, {"orders.csv", put_orders_csv}, {"study.md", put_report}, {NULL, NULL}};
    return sb_reports_write(study->store, files, study, error);
}
