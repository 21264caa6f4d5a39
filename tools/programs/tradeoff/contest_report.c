#include "contest_report.h"

#include "markdown.h"
#include "plot.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *name_of(const sb_entry *e)
{
    return e->choice ? e->choice->name : "reference (default)";
}

static void put_spread(FILE *out, const sb_spread *s, bool seeds)
{
    char mean[48];
    sb_text_number(mean, s->mean);
    fprintf(out, " %s", mean);
    if (seeds && s->high > s->low) fprintf(out, " (%.3g–%.3g)", s->low, s->high);
    fputs(" |", out);
}

static void put_entry(FILE *out, const sb_contest *c, const sb_entry *e)
{
    const sb_result *t = &c->trials[e->first];
    if (isnan(e->time.mean)) return;
    fprintf(out, "| %s | %g |", name_of(e), e->plan.resolution);
    if (t->state == SB_RESULT_DONE)
        fprintf(out, " %zu | %zu | %.1f |", t->run.view.particles, t->run.view.steps, t->run.view.iterations);
    else
        fputs(" – | – | – |", out);
    put_spread(out, &e->time, e->seeds > 1);
    for (size_t k = 0; k < c->error_count; k++) put_spread(out, &e->errors[k], e->seeds > 1);
    fprintf(out, " %s |\n", e->front ? "**yes**" : "");
}

/* What the records of the replays have cost, and were not counted. Returns the number of items. */
static size_t put_records(FILE *out, const sb_contest *c)
{
    size_t count = 0;
    for (const sb_entry *e = c->entries; e < c->entries + c->entry_count; e++) {
        char mean[48];
        if (isnan(e->record_time.mean)) continue;
        sb_text_number(mean, e->record_time.mean);
        fprintf(out,
                "- %s, %g m: its time is that of the replay; the run of the whole scene whose record it replays took "
                "%s s\n",
                name_of(e), e->plan.resolution, mean);
        count++;
    }
    return count;
}

static void put_contest(FILE *out, const sb_contest_report *r, const sb_contest *c)
{
    const bool cpu = sb_contest_cpu(r->store);
    fprintf(out, "## %s\n\n", c->subject->title);
    sb_runs_where(out, r->store, c->trials, c->trial_count);
    fprintf(out,
            "Errors: %s.\n\n"
            "| choice | spacing (m) | particles | steps | sweeps per step | %s (s) |",
            c->subject->what, cpu ? "processor time" : "run time");
    for (size_t k = 0; k < c->error_count; k++)
        fprintf(out, " %s (%s) |", c->subject->errors[k].name, c->subject->errors[k].unit);
    fputs(" front |\n", out);
    sb_put_rule(out, c->error_count + 7);
    for (size_t i = 0; i < c->entry_count; i++) put_entry(out, c, &c->entries[i]);
    fputc('\n', out);
    size_t missing = 0, failed = 0, otherwise = 0, records = put_records(out, c);
    for (size_t i = 0; i < c->trial_count; i++) {
        missing += c->trials[i].state == SB_RESULT_NOT_RUN;
        failed += c->trials[i].state == SB_RESULT_FAILED && sb_runs_problem(out, &c->trials[i]);
    }
    for (size_t i = 0; !cpu && i < c->trial_count; i++)
        otherwise += c->trials[i].state == SB_RESULT_DONE && c->trials[i].run.threads != c->threads;
    if (otherwise)
        fprintf(out, "- %zu runs did not have %d threads: their run times are omitted\n", otherwise, c->threads);
    if (missing) fprintf(out, "- %zu of %zu runs are missing\n", missing, c->trial_count);
    if (missing + failed + otherwise + records) fputc('\n', out);
}

static const char reading[] =
    "Each row is one choice at one spacing. A choice is the preset `default` with one change, or the preset `paper`. "
    "Times and\nerrors are means over the start seeds; brackets contain the smallest and the largest value. Front: no "
    "other row is both\nfaster and has a smaller first error. A difference in error below the spread of the seeds "
    "is "
    "not significant. Errors include\nthat of the discretisation: if all choices at a spacing have the same error, the "
    "spacing causes it.\n\n";

static void plot_front(const sb_contest *c, sb_plot *plot)
{
    sb_curve curve = {0};
    for (size_t i = 0; i < c->entry_count; i++)
        if (c->entries[i].front) sb_curve_add(&curve, c->entries[i].time.mean, c->entries[i].errors[0].mean);
    sb_curve_sort(&curve);
    if (curve.count) sb_plot_curve(plot, SB_PLOT_REFERENCE, "Pareto front", &curve);
    sb_curve_free(&curve);
}

/* Plots the spacings of a choice as marks of one kind, joined from coarse to fine. */
static void plot_choice(const sb_contest *c, const sb_choice *choice, sb_plot *plot)
{
    sb_curve curve = {0};
    for (size_t i = 0; i < c->entry_count; i++) {
        double y = c->entries[i].errors[0].mean;
        if (c->entries[i].choice == choice) sb_curve_add(&curve, c->entries[i].time.mean, y > 0 ? y : (double)NAN);
    }
    if (curve.count) sb_plot_curve(plot, SB_PLOT_CHAIN, choice->name, &curve);
    sb_curve_free(&curve);
}

static bool has_marks(const sb_contest *c)
{
    for (size_t i = 0; i < c->entry_count; i++)
        if (c->entries[i].choice && c->entries[i].errors[0].mean > 0) return true;
    return false;
}

static void plot_contest(const sb_contest *c, bool cpu, sb_plot *plot)
{
    char label[96];
    const sb_error_measure *m = &c->subject->errors[0];
    snprintf(label, sizeof label, "error of %.60s (%s)", m->name, m->unit);
    sb_plot_panel(plot, c->subject->title, cpu ? "processor time (s)" : "run time (s)", label);
    sb_plot_logarithmic(plot);
    plot_front(c, plot);
    for (const sb_choice *choice = sb_choices; choice->name; choice++) plot_choice(c, choice, plot);
}

static sb_status draw(sb_plot *plot, const void *report, sb_error *error)
{
    const sb_contest_report *r = report;
    (void)error;
    for (size_t i = 0; i < r->count; i++)
        if (has_marks(&r->contests[i])) plot_contest(&r->contests[i], sb_contest_cpu(r->store), plot);
    return SB_OK;
}

static void put_report(FILE *out, const void *report)
{
    const sb_contest_report *r = report;
    sb_error no_plot = {0};
    sb_plot_picture(draw, r, r->store->out, "tradeoff", r->store->report, &no_plot);
    fprintf(out, "# Run time against error%s\n\nMade by `tools/tradeoff`. docs/studies.md explains the method.\n\n",
            r->store->options->quick ? ", quick forms" : "");
    fprintf(out, "- command: `%s`\n\n%s", r->store->options->command, reading);
    sb_put_picture(out, &no_plot, "![error over run time](tradeoff.png)\n");
    fputc('\n', out);
    for (size_t i = 0; i < r->count; i++) put_contest(out, r, &r->contests[i]);
}

static void put_csv(FILE *out, const void *report)
{
    const sb_contest_report *r = report;
    fputs("scene,choice,spacing_m,seed,threads,particles,steps,sweeps_per_step,run_time_s,cpu_s,load,error,unit,"
          "value,mean,least,most,front,commit,machine,record_run_time_s,record_cpu_s\n",
          out);
    for (size_t n = 0; n < r->count; n++) {
        const sb_contest *c = &r->contests[n];
        for (size_t i = 0; i < c->entry_count; i++)
            for (size_t t = c->entries[i].first; t < c->entries[i].first + c->entries[i].seeds; t++)
                for (size_t k = 0; k < c->error_count; k++) {
                    const sb_entry *e = &c->entries[i];
                    const sb_finished *run = &c->trials[t].run;
                    const sb_result *record = sb_contest_record(c, e, t);
                    if (c->trials[t].state != SB_RESULT_DONE) continue;
                    fprintf(
                        out,
                        "%s,\"%s\",%g,%d,%d,%zu,%zu,%.3f,%.3f,%.3f,%.2f,\"%s\",%s,%.5g,%.5g,%.5g,%.5g,%s,%s,\"%s\",",
                        c->subject->name, name_of(e), e->plan.resolution, c->trials[t].request.seed, run->threads,
                        run->view.particles, run->view.steps, run->view.iterations, run->view.wall, run->cpu, run->load,
                        c->subject->errors[k].name, c->subject->errors[k].unit, c->trial_errors[t][k],
                        e->errors[k].mean, e->errors[k].low, e->errors[k].high, e->front ? "yes" : "no", run->commit,
                        run->machine);
                    if (record) fprintf(out, "%.3f,%.3f", record->run.view.wall, record->run.cpu);
                    fputs(record ? "\n" : ",\n", out);
                }
    }
}

bool sb_contest_cpu(const sb_store *store)
{
    return store->options->jobs > 1;
}

sb_status sb_contest_write(const sb_contest_report *report, sb_error *error)
{
    static const sb_report_file files[] = {{"tradeoff.csv", put_csv}, {"tradeoff.md", put_report}, {NULL, NULL}};
    return sb_reports_write(report->store, files, report, error);
}
