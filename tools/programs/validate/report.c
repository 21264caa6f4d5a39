#include "report.h"

#include "base/memory.h"
#include "plot.h"

#include <string.h>
#include <unistd.h>

/* The commit of the shown runs, or a remark that there are several. */
static void put_commits(FILE *out, const sb_report *report)
{
    const char *first = NULL;
    bool several = false;
    for (size_t c = 0; c < report->count; c++)
        for (size_t i = 0; i < report->cases[c].count; i++) {
            const sb_result *r = &report->cases[c].runs[i];
            if (r->state != SB_RESULT_DONE) continue;
            if (first && strcmp(first, r->run.commit) != 0) several = true;
            first = first ? first : r->run.commit;
        }
    if (!first)
        fputs("- commit: nothing has run\n", out);
    else if (several)
        fputs("- commit: the runs have several commits; the tables of runs name them\n", out);
    else
        fprintf(out, "- commit of all runs: `%s`\n", first);
}

/* The machines of the shown runs. results.csv names the machine of each run. */
static void put_machines(FILE *out, const sb_report *report)
{
    const char *listed[8];
    size_t count = 0;
    for (size_t c = 0; c < report->count; c++)
        for (size_t i = 0; i < report->cases[c].count; i++) {
            const sb_result *r = &report->cases[c].runs[i];
            size_t k = 0;
            if (r->state != SB_RESULT_DONE || !r->run.machine[0]) continue;
            while (k < count && strcmp(listed[k], r->run.machine) != 0) k++;
            if (k == count && count < sizeof listed / sizeof *listed) listed[count++] = r->run.machine;
        }
    fputs(count > 1 ? "- machines (results.csv names the machine of each run): " : "- machine: ", out);
    for (size_t k = 0; k < count; k++) fprintf(out, "%s%s", k ? "; " : "", listed[k]);
    fprintf(out, "%s\n", count ? "" : report->store->machine);
}

static const char reading[] =
    "How to read the tables:\n\n"
    "- Error: simulated value minus reference. If the reference is a measured band, the error is the distance from\n"
    "  its nearer edge in % of that edge, and 0 inside the band.\n"
    "- Start seeds: if one program ran a spacing with several seeds, the error is the largest in magnitude. A figure\n"
    "  is within its target if it is so with every seed. The summary shows the mean value of the seeds.\n"
    "- Spread: largest minus smallest value over the seeds at the judged spacing. If that spacing has one seed, it is\n"
    "  the spread at the finest spacing with several seeds, which is named.\n"
    "- `x (of y)`: at this spacing the reference is y.\n"
    "- `(kept)` after a commit: the figures come from an earlier report. The run's files are not available, and plots\n"
    "  omit the run.\n\n";

static void put_summary(FILE *out, const sb_report *report, size_t missed)
{
    fputs("| case | headline figure | value | error | within target | result |\n|---|---|---|---|---|---|\n", out);
    for (size_t c = 0; c < report->count; c++) sb_report_summary_row(out, &report->cases[c]);
    if (missed)
        fputs("\nFigures that missed their targets:\n\n| case | figure | error | target |\n|---|---|---|---|\n", out);
    for (size_t c = 0; c < report->count; c++) sb_report_missed_rows(out, &report->cases[c]);
    fputc('\n', out);
}

static void put_head(FILE *out, const sb_report *report)
{
    size_t limited = 0, passed = 0;
    for (size_t c = 0; c < report->count; c++) {
        size_t l, p;
        sb_results_count(&report->cases[c], &l, &p);
        limited += l;
        passed += p;
    }
    fprintf(
        out,
        "# Validation%s\n\nMade by `tools/validate`. docs/validation.md explains how cases run and how figures are "
        "judged.\nAll cases use the same defaults. Columns marked `paper` or `wen` show the preset of that name.\n\n",
        report->store->options->quick ? ", quick forms" : "");
    fprintf(out, "- command: `%s`\n", report->store->options->command);
    put_machines(out, report);
    put_commits(out, report);
    fprintf(out, "- %zu of %zu judged figures are within their targets\n\n", passed, limited);
    fputs(reading, out);
    put_summary(out, report, limited - passed);
}

/* Draws the finished runs of the case. SB_FAILED: no run, or no plot; the error says which. */
static sb_status draw(sb_plot *plot, const void *what, sb_error *error)
{
    const sb_case_results *results = what;
    size_t count = 0;
    sb_case_run *views = sb_alloc(results->count, sizeof *views);
    if (!views) return sb_fail_memory(error, "a plot");
    for (size_t i = 0; i < results->count; i++)
        if (results->runs[i].state == SB_RESULT_DONE && !results->runs[i].kept)
            views[count++] = results->runs[i].run.view;
    sb_status status = count ? SB_OK : sb_fail(error, SB_FAILED, "nothing has run");
    if (count) results->of->plot(views, count, plot);
    for (size_t i = 0; i < count; i++) {
        const sb_status closed = sb_run_close(&views[i], status == SB_OK ? error : NULL);
        if (status == SB_OK) status = closed;
    }
    sb_free(views);
    return status;
}

/* Whether all finished runs are kept ones: there is nothing to draw from, and the earlier picture is still right. */
static bool all_kept(const sb_case_results *results)
{
    bool any = false, all = true;
    for (size_t i = 0; i < results->count; i++) {
        const sb_result *r = &results->runs[i];
        any = any || r->state == SB_RESULT_DONE;
        all = all && (r->state != SB_RESULT_DONE || r->kept);
    }
    return any && all;
}

static void put_case(FILE *out, const sb_report *report, const sb_case_results *results)
{
    char folder[SB_PATH_MAX], picture[SB_PATH_MAX], relative[160];
    const char *name = results->of->name;
    sb_error why = {0};
    snprintf(relative, sizeof relative, "validation/%.100s.png", name);
    sb_status status = sb_path_join(picture, report->store->report, relative, &why);
    sb_path_folder(folder, picture);
    if (status == SB_OK && !(all_kept(results) && access(picture, R_OK) == 0))
        sb_plot_picture(draw, results, report->store->out, name, folder, &why);
    sb_report_case(out, results, why.text[0] ? NULL : relative);
    if (why.text[0]) fprintf(out, "No plot: %s.\n\n", why.text);
}

static void put_report(FILE *out, const void *what)
{
    const sb_report *report = what;
    put_head(out, report);
    for (size_t c = 0; c < report->count; c++) put_case(out, report, &report->cases[c]);
}

sb_status sb_validation_write(const sb_report *report, sb_error *error)
{
    static const sb_report_file files[] = {
        {"validation/results.csv", sb_report_csv}, {"validation.md", put_report}, {NULL, NULL}};
    return sb_reports_write(report->store, files, report, error);
}
