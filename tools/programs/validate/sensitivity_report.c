/* Writes the report of the sensitivity study. */
#include "markdown.h"
#include "sensitivity.h"

#include <math.h>

/* Writes the cell of a finished run. */
typedef void put_run(FILE *out, const sb_result *r);

static void put_headline(FILE *out, const sb_result *r)
{
    char text[48];
    const sb_figure *f = sb_figures_find(&r->figures, r->request.of->headline);
    if (f)
        sb_text_error(text, isnan(f->error) ? f->value : f->error, "");
    else
        sb_text_number(text, (double)NAN);
    fprintf(out, "%s%s", text, f && !f->pass ? "!" : "");
}

/* Error of a judged figure divided by its target; HUGE_VAL if it could not be measured. */
static double over_target(const sb_figure *f)
{
    if (isnan(f->value)) return HUGE_VAL;
    const double off = f->one_sided ? f->error : fabs(f->error);
    return isnan(f->error) || off <= 0 ? 0 : off / f->limit;
}

/* The judged figure with the largest error relative to its target; NULL: none is judged. */
static const sb_figure *worst_of(const sb_figures *figures, size_t *judged, size_t *passed)
{
    const sb_figure *worst = NULL;
    *judged = *passed = 0;
    for (size_t i = 0; i < figures->count; i++) {
        const sb_figure *f = &figures->rows[i];
        if (isnan(f->limit)) continue;
        *judged += 1;
        *passed += f->pass;
        if (!worst || over_target(f) > over_target(worst)) worst = f;
    }
    return worst;
}

static void put_judged(FILE *out, const sb_result *r)
{
    size_t judged, passed;
    const sb_figure *worst = worst_of(&r->figures, &judged, &passed);
    fprintf(out, "%zu of %zu", passed, judged);
    if (worst && isinf(over_target(worst)))
        fputs(", none", out);
    else if (worst)
        fprintf(out, ", %.2g×", over_target(worst));
}

static void put_time(FILE *out, const sb_result *r)
{
    fprintf(out, "%.3g", r->run.view.wall);
}

static void put_cell(FILE *out, const sb_result *r, put_run *put)
{
    if (r->state == SB_RESULT_DONE)
        put(out, r);
    else
        fputs(r->request.of && r->state == SB_RESULT_FAILED ? "failed" : "–", out);
}

static void put_table(FILE *out, const sb_sensitivity_study *s, put_run *put)
{
    char text[64];
    fputs("| key | default |", out);
    for (size_t c = 0; c < s->count; c++) sb_put_cell(out, s->runs[c].request.of->name);
    fputc('\n', out);
    sb_put_rule(out, 2 + s->count);
    fputs("| (defaults) | |", out);
    for (size_t c = 0; c < s->count; c++) {
        fputc(' ', out);
        put_cell(out, &s->runs[c], put);
        fputs(" |", out);
    }
    for (size_t row = 0; row < sb_sensitivity_rows(); row++) {
        const sb_sensitivity_key *key = row ? &sb_sensitivity_keys[row - 1] : NULL;
        snprintf(text, sizeof text, "%s", key ? "" : "1");
        if (key && s->runs[0].state == SB_RESULT_DONE) sb_sensitivity_text(key, &s->runs[0].run.scene.numerics, text);
        fprintf(out, "\n| %s | %s |", key ? key->key : "(start seed 2 / 3)", text);
        for (size_t c = 0; c < s->count; c++) {
            const sb_result *pair = sb_sensitivity_pair(s, c, row);
            fputc(' ', out);
            put_cell(out, &pair[0], put);
            fputs(" / ", out);
            put_cell(out, &pair[1], put);
            fputs(" |", out);
        }
    }
    fputs("\n\n", out);
}

/* Lists the headline figures. */
static void put_headlines(FILE *out, const sb_sensitivity_study *s)
{
    for (const sb_result *r = s->runs; r < s->runs + s->count; r++) {
        const sb_case *of = r->request.of;
        const sb_figure *f = r->state == SB_RESULT_DONE ? sb_figures_find(&r->figures, of->headline) : NULL;
        fprintf(out, "- %s: %s", of->name, of->headline);
        if (f && isnan(f->error)) fprintf(out, ", value in %s", f->unit);
        if (f && !isnan(f->error))
            fprintf(out, ", error%s%s, target %.4g", f->error_unit[0] ? " in " : "", f->error_unit, f->limit);
        fprintf(out, ", at %.6g m\n", r->request.plan->resolution);
    }
}

/* Lists the figure with the largest error relative to its target. */
static void put_worst(FILE *out, const sb_sensitivity_study *s)
{
    for (const sb_result *r = s->runs; r < s->runs + s->count; r++) {
        size_t judged, passed;
        const sb_figure *f = r->state == SB_RESULT_DONE ? worst_of(&r->figures, &judged, &passed) : NULL;
        fprintf(out, "- %s: %s\n", r->request.of->name, f ? f->quantity : "–");
    }
}

void sb_sensitivity_report(FILE *out, const void *study)
{
    const sb_sensitivity_study *s = study;
    fprintf(
        out,
        "# Sensitivity to the numeric defaults\n\n"
        "Made by `tools/validate --sensitivity` from the quick forms of the cases. Each default is multiplied by 0.75 "
        "and by\n1.25; a cell shows both results, separated by a slash. All other defaults stay the same. A value "
        "stays within the\nbounds of its key. – marks a change without effect, as of a default of 0. The column "
        "`default` is that of the first case.\n\nThe row of start seeds changes only the positions of the fluid "
        "particles at t = 0. The effect of a default is\nsignificant only if it exceeds that of the start seeds.\n\n"
        "- command: `%s`\n- machine: %s\n- commit: `%s`\n\n"
        "## Errors of the headline figures\n\n! marks an error beyond the target.\n\n",
        s->store->options->command, s->store->machine, s->store->commit);
    put_table(out, s, put_headline);
    put_headlines(out, s);
    fputs("\n## All judged figures\n\nEach cell shows how many of a run's judged figures are within their targets, and "
          "the "
          "largest error divided by its target\n(none: a figure could not be measured). Figures that need several "
          "spacings are not included.\n\n",
          out);
    put_table(out, s, put_judged);
    fputs("Figure with the largest error relative to its target, with the defaults:\n\n", out);
    put_worst(out, s);
    fputs("\n## Run times (s)\n\n", out);
    put_table(out, s, put_time);
}
