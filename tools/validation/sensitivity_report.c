#include "report.h"
#include "sensitivity_parts.h"

#include <math.h>

/* Writes what a cell says of a run that is done. */
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

/* How many times its reach a judged figure is off; what could not be measured is beyond all. */
static double times_reach(const sb_figure *f)
{
    if (isnan(f->value)) return HUGE_VAL;
    const double off = f->one_sided ? f->error : fabs(f->error);
    return isnan(f->error) || off <= 0 ? 0 : off / f->limit;
}

/* The judged figure that is farthest off, for its reach; NULL: none is judged. */
static const sb_figure *worst_of(const sb_figures *figures, size_t *judged, size_t *passed)
{
    const sb_figure *worst = NULL;
    *judged = *passed = 0;
    for (size_t i = 0; i < figures->count; i++) {
        const sb_figure *f = &figures->rows[i];
        if (isnan(f->limit)) continue;
        *judged += 1;
        *passed += f->pass;
        if (!worst || times_reach(f) > times_reach(worst)) worst = f;
    }
    return worst;
}

static void put_judged(FILE *out, const sb_result *r)
{
    size_t judged, passed;
    const sb_figure *worst = worst_of(&r->figures, &judged, &passed);
    fprintf(out, "%zu of %zu", passed, judged);
    if (worst && isinf(times_reach(worst)))
        fputs(", none", out);
    else if (worst)
        fprintf(out, ", %.2g×", times_reach(worst));
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

static void row_name(char name[96], const sb_sensitivity_study *first, size_t row)
{
    char text[64] = "";
    if (row == 0) {
        snprintf(name, 96, "(start seed 2 / 3) | 1");
        return;
    }
    const sb_sensitivity_key *key = &sb_sensitivity_keys[row - 1];
    if (first->results[0].state == SB_RESULT_DONE)
        sb_sensitivity_text(key, &first->results[0].run.scene.numerics, text);
    snprintf(name, 96, "%.24s | %s", key->key, text);
}

static void put_table(FILE *out, const sb_sensitivity_study *studies, const sb_case *const *cases, size_t count,
                      put_run *put)
{
    fputs("| key | default |", out);
    for (size_t c = 0; c < count; c++) fprintf(out, " %s |", cases[c]->name);
    fputs("\n|---|---|", out);
    for (size_t c = 0; c < count; c++) fputs("---|", out);
    fputs("\n| (as it is) | |", out);
    for (size_t c = 0; c < count; c++) {
        fputc(' ', out);
        put_cell(out, &studies[c].results[0], put);
        fputs(" |", out);
    }
    for (size_t row = 0; row < sb_sensitivity_rows(); row++) {
        char name[96];
        row_name(name, &studies[0], row);
        fprintf(out, "\n| %s |", name);
        for (size_t c = 0; c < count; c++) {
            const sb_result *pair = &studies[c].results[1 + SB_SENSITIVITY_PAIR * row];
            fputc(' ', out);
            put_cell(out, &pair[0], put);
            fputs(" / ", out);
            put_cell(out, &pair[1], put);
            fputs(" |", out);
        }
    }
    fputs("\n\n", out);
}

/* What the headlines are. */
static void put_headlines(FILE *out, const sb_sensitivity_study *studies, const sb_case *const *cases, size_t count)
{
    for (size_t c = 0; c < count; c++) {
        const sb_result *r = &studies[c].results[0];
        const sb_figure *f = r->state == SB_RESULT_DONE ? sb_figures_find(&r->figures, cases[c]->headline) : NULL;
        fprintf(out, "- %s: %s", cases[c]->name, cases[c]->headline);
        if (f && isnan(f->error)) fprintf(out, ", value in %s", f->unit);
        if (f && !isnan(f->error))
            fprintf(out, ", error%s%s, reach %.4g", f->error_unit[0] ? " in " : "", f->error_unit, f->limit);
        fprintf(out, ", at %.6g m\n", r->request.plan->resolution);
    }
}

/* Which figure of the defaults is farthest off. */
static void put_worst(FILE *out, const sb_sensitivity_study *studies, const sb_case *const *cases, size_t count)
{
    for (size_t c = 0; c < count; c++) {
        size_t judged, passed;
        const sb_result *r = &studies[c].results[0];
        const sb_figure *f = r->state == SB_RESULT_DONE ? worst_of(&r->figures, &judged, &passed) : NULL;
        fprintf(out, "- %s: %s\n", cases[c]->name, f ? f->quantity : "–");
    }
}

void sb_sensitivity_report(FILE *out, const sb_store *store, const sb_sensitivity_study *studies,
                           const sb_case *const *cases, size_t count, const char *command)
{
    fprintf(out,
            "# What the numeric defaults do\n\nMade by `tools/validate --sensitivity` from the quick forms of the "
            "cases: each default times 0.75 / times 1.25, all\nothers as they are. A value that would pass its key's "
            "bound stays there; – where the change has no meaning, as of a default of 0.\nThe defaults are those of "
            "the first case. The row of start seeds changes nothing but how the fluid particles lie at t = 0:\nwhat a "
            "default does counts as far as it is beyond that.\n\n- command: `%s`\n- machine: %s\n- commit: `%s`\n\n"
            "## Errors of the headline figures\n\n! marks an error beyond the reach.\n\n",
            command, store->machine, store->commit);
    put_table(out, studies, cases, count, put_headline);
    put_headlines(out, studies, cases, count);
    fputs("\n## All judged figures\n\nHow many of a run's judged figures are within their reach, and by how many times "
          "its reach the one farthest off is off\n(none: one could not be measured). Figures that take several "
          "spacings are not among them.\n\n",
          out);
    put_table(out, studies, cases, count, put_judged);
    fputs("The one farthest off as it is:\n\n", out);
    put_worst(out, studies, cases, count);
    fputs("\n## Run times (s)\n\n", out);
    put_table(out, studies, cases, count, put_time);
}
