/* Writes a case in the report: summary row, missed figures, table of figures, table of runs. */
#include "report.h"

#include <math.h>
#include <string.h>

static const char *verdict(const sb_case_results *results, size_t *limited, size_t *passed)
{
    bool failed = false;
    sb_results_count(results, limited, passed);
    for (size_t i = 0; i < results->count; i++)
        if (results->runs[i].state == SB_RESULT_FAILED && results->runs[i].request.plan->judged) failed = true;
    if (failed) return "**run failed**";
    if (!sb_results_judged(results)) return "not run";
    if (*passed < *limited) return "**missed**";
    if (sb_results_incomplete(results)) return "**incomplete**: a run that it is compared with is missing";
    return *limited > 0 ? "within" : "reported";
}

void sb_report_missed_rows(FILE *out, const sb_case_results *results)
{
    const sb_result *judged = sb_results_judged(results);
    char error[48], limit[48];
    for (size_t i = 0; judged && i < judged->figures.count + results->across.count; i++) {
        bool single = i < judged->figures.count;
        const sb_figure *f = single ? &judged->figures.rows[i] : &results->across.rows[i - judged->figures.count];
        sb_judgement j = {.figure = f, .worst = f->error, .pass = f->pass};
        if (isnan(f->limit)) continue;
        if (single) j = sb_results_judge(results, i);
        if (j.pass) continue;
        sb_text_error(error, j.worst, f->error_unit);
        sb_text_number(limit, f->limit);
        fprintf(out, "| %s |", results->of->name);
        sb_put_cell(out, f->quantity);
        fprintf(out, " %s | %s%s%s |\n", error, limit, f->error_unit[0] ? " " : "", f->error_unit);
    }
}

/* Quantity, value and error of the headline figure. */
static void put_headline(FILE *out, const sb_case_results *results, const sb_result *judged)
{
    char value[48], error[48];
    for (size_t i = 0; judged && i < judged->figures.count; i++) {
        if (strcmp(judged->figures.rows[i].quantity, results->of->headline) != 0) continue;
        sb_judgement j = sb_results_judge(results, i);
        sb_text_number(value, j.mean);
        sb_text_error(error, j.worst, j.figure->error_unit);
        sb_put_cell(out, j.figure->quantity);
        fprintf(out, " %s%s%s | %s |", value, j.figure->unit[0] ? " " : "", j.figure->unit, error);
        return;
    }
    sb_put_cell(out, results->of->headline);
    fputs(" – | – |", out);
}

void sb_report_summary_row(FILE *out, const sb_case_results *results)
{
    size_t limited, passed;
    const char *result = verdict(results, &limited, &passed);
    const sb_result *judged = sb_results_judged(results), *finest = judged ? NULL : sb_results_finest(results);
    fprintf(out, "| [%s](#%s) |", results->of->title, results->of->name);
    put_headline(out, results, judged);
    if (judged)
        fprintf(out, " %zu of %zu |", passed, limited);
    else
        fputs(" – |", out);
    fprintf(out, " %s", result);
    if (finest) fprintf(out, " at the judged spacing; run at %.6g m", finest->request.plan->resolution);
    fputs(" |\n", out);
}

static void put_reference(FILE *out, const sb_figure *f)
{
    char low[48], high[48], cell[128];
    sb_text_number(low, f->low < f->high ? f->low : f->reference);
    sb_text_number(high, f->high);
    snprintf(cell, sizeof cell, "%s%s%s", low, f->low < f->high ? " to " : "", f->low < f->high ? high : "");
    sb_put_cell(out, cell);
}

/* Value of a figure in one run, with the run's reference if it differs from that of the judged run. */
static void put_value(FILE *out, const sb_result *r, const sb_figure *judged)
{
    char text[48], reference[48], cell[128];
    if (r->state != SB_RESULT_DONE) {
        sb_put_cell(out, r->state == SB_RESULT_FAILED ? "failed" : "not run");
        return;
    }
    const sb_figure *f = sb_figures_find(&r->figures, judged->quantity);
    sb_text_number(text, f ? f->value : (double)NAN);
    snprintf(cell, sizeof cell, "%s", text);
    if (f && fabs(f->reference - judged->reference) > 1e-3 * fabs(judged->reference)) {
        sb_text_number(reference, f->reference);
        snprintf(cell, sizeof cell, "%s (of %s)", text, reference);
    }
    sb_put_cell(out, cell);
}

static bool has_column(const sb_result *r)
{
    return r->request.seed == 1;
}

/* j->seeds is 0 for a run that is not judged. */
static void put_judgement(FILE *out, const sb_judgement *j, const char *spread)
{
    char text[48];
    sb_text_error(text, j->worst, j->figure->error_unit);
    sb_put_cell(out, text);
    if (isnan(j->figure->limit))
        snprintf(text, sizeof text, "–");
    else
        snprintf(text, sizeof text, "%.4g%s%s", j->figure->limit, j->figure->error_unit[0] ? " " : "",
                 j->figure->error_unit);
    sb_put_cell(out, text);
    sb_put_cell(out, spread);
    sb_put_cell(out, isnan(j->figure->limit) ? "reported"
                     : !j->seeds             ? "not judged"
                     : j->pass               ? "within"
                                             : "**missed**");
    fputc('\n', out);
}

/* Names the spacing if it is not the one that the errors belong to. */
static void put_spread(char *text, size_t room, sb_seed_spread spread, const sb_result *of)
{
    char number[48];
    sb_text_number(number, spread.value);
    if (isnan(spread.value) || spread.resolution == of->request.plan->resolution)
        snprintf(text, room, "%s", number);
    else
        snprintf(text, room, "%s at %.6g m", number, spread.resolution);
}

/* One row per figure of this run: the judged run, or else the finest run, whose errors are not judged. */
static void put_figures(FILE *out, const sb_case_results *results, const sb_result *of)
{
    char text[160];
    size_t columns = 7;
    fputs("| quantity | unit | reference |", out);
    for (size_t i = 0; i < results->count; i++) {
        const sb_request *request = &results->runs[i].request;
        if (!has_column(&results->runs[i])) continue;
        snprintf(text, sizeof text, "%.6g m%s%s%s%s%s", request->plan->resolution, request->plan->variant ? ", " : "",
                 request->plan->variant ? request->plan->variant : "", request->preset ? ", " : "",
                 request->preset ? request->preset : "", request->plan->judged && !request->preset ? " (judged)" : "");
        sb_put_cell(out, text);
        columns++;
    }
    fputs(" error | target | spread | result |\n", out);
    sb_put_rule(out, columns);
    for (size_t i = 0; i < of->figures.count; i++) {
        const sb_figure *f = &of->figures.rows[i];
        const sb_judgement j =
            sb_results_judged(results) ? sb_results_judge(results, i) : (sb_judgement){.figure = f, .worst = f->error};
        fputc('|', out);
        sb_put_cell(out, j.figure->quantity);
        sb_put_cell(out, j.figure->unit);
        put_reference(out, j.figure);
        for (size_t k = 0; k < results->count; k++)
            if (has_column(&results->runs[k])) put_value(out, &results->runs[k], j.figure);
        put_spread(text, sizeof text, sb_results_spread(results, f->quantity), of);
        put_judgement(out, &j, text);
    }
    fputc('\n', out);
}

static void put_across(FILE *out, const sb_case_results *results)
{
    if (results->problem[0]) fprintf(out, "Across spacings: %s.\n\n", results->problem);
    if (results->across.count == 0) return;
    fputs("| across spacings | unit | reference | value | error | target | spread | result |\n"
          "|---|---|---|---|---|---|---|---|\n",
          out);
    for (size_t i = 0; i < results->across.count; i++) {
        const sb_figure *f = &results->across.rows[i];
        sb_judgement j = {.figure = f, .worst = f->error, .pass = f->pass, .seeds = 1};
        fputc('|', out);
        sb_put_cell(out, f->quantity);
        sb_put_cell(out, f->unit);
        sb_put_number(out, f->reference);
        sb_put_number(out, f->value);
        put_judgement(out, &j, "–");
    }
    if (results->across_builds)
        fputs("\nThese runs were made by several programs. The table of runs names their commits.\n", out);
    fputc('\n', out);
}

static void put_notes(FILE *out, const sb_figures *figures)
{
    for (size_t i = 0; i < figures->count; i++)
        if (figures->rows[i].note[0]) fprintf(out, "- %s: %s\n", figures->rows[i].quantity, figures->rows[i].note);
}

static const char *threads(const sb_result *r, char text[48])
{
    sb_text_number(text, r->run.threads > 0 ? r->run.threads : (double)NAN);
    return text;
}

static void put_runs(FILE *out, const sb_case_results *results)
{
    char text[48];
    fputs("| spacing (m) | preset | seed | particles | steps | sweeps per step | run time (s) | "
          "threads | commit |\n|---|---|---|---|---|---|---|---|---|\n",
          out);
    for (size_t i = 0; i < results->count; i++) {
        const sb_result *r = &results->runs[i];
        const char *variant = r->request.plan->variant;
        fprintf(out, "| %.6g%s%s | %s | %d |", r->request.plan->resolution, variant ? ", " : "", variant ? variant : "",
                sb_request_preset(&r->request), r->request.seed);
        if (r->state == SB_RESULT_DONE)
            fprintf(out, " %zu | %zu | %.1f | %.1f | %s | %s%s |\n", r->run.view.particles, r->run.view.steps,
                    r->run.view.iterations, r->run.view.wall, threads(r, text), r->run.commit,
                    r->kept ? " (kept)" : "");
        else
            fprintf(out, " %s%.200s | | | | | |\n", r->state == SB_RESULT_FAILED ? "**failed**: " : "not run",
                    r->problem);
    }
    fputc('\n', out);
}

void sb_report_case(FILE *out, const sb_case_results *results, const char *picture)
{
    const sb_result *judged = sb_results_judged(results), *shown = judged ? judged : sb_results_finest(results);
    fprintf(out, "<a id=\"%s\"></a>\n\n## %s\n\nCase `%s`. Targets:\n\n", results->of->name, results->of->title,
            results->of->name);
    sb_put_items(out, results->of->targets, false);
    fprintf(out, "\n%s\n\n", results->of->method);
    if (picture) fprintf(out, "![%s](%s)\n\n", results->of->title, picture);
    if (!judged) fputs("Not run at the judged spacing", out);
    if (!judged && shown) fprintf(out, "; errors are those at %.6g m", shown->request.plan->resolution);
    if (!judged) fputs(".\n\n", out);
    if (shown) put_figures(out, results, shown);
    put_across(out, results);
    if (shown) put_notes(out, &shown->figures);
    put_notes(out, &results->across);
    fputc('\n', out);
    put_runs(out, results);
}
