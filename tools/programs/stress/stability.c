/* Writes stability.md: the rules and the outcome of every trial. */
#include "battery.h"
#include "markdown.h"

#include <math.h>
#include <string.h>

static void put_count(FILE *out, double value)
{
    if (isnan(value))
        fputs(" – |", out);
    else
        fprintf(out, " %.0f |", value);
}

static const char *verdict_of(const sb_stress_results *r)
{
    return r->failed ? "**FAIL**" : r->run == 0 ? "not run" : r->run < r->trials.count ? "pass so far" : "pass";
}

static void put_summary(FILE *out, const sb_stability *s)
{
    fputs("| case | passed | result |\n|---|---|---|\n", out);
    for (const sb_stress_results *r = s->cases; r < s->cases + s->count; r++)
        fprintf(out, "| [%s](#%s) | %zu of %zu | %s |\n", r->of->title, r->of->name, r->run - r->failed,
                r->trials.count, verdict_of(r));
    fputc('\n', out);
}

static void put_head(FILE *out, const sb_stability *s)
{
    size_t run = 0, failed = 0, planned = 0;
    for (size_t c = 0; c < s->count; c++) {
        run += s->cases[c].run;
        failed += s->cases[c].failed;
        planned += s->cases[c].trials.count;
    }
    fprintf(out,
            "# Stability%s\n\nCommit %s, %s.\nMade by `%s` ([explanation](%s)).\n\n"
            "%zu trials planned, %zu run, %zu passed, **%zu failed**.\n\n",
            s->store->options->quick ? ", quick forms" : "", s->store->commit, s->store->machine,
            s->store->options->command, s->store->options->quick ? "../../stability.md" : "../stability.md", planned,
            run, run - failed, failed);
    fputs("Common rules for every trial:\n\n"
          "- It ends in time and in an allowed way. A refusal or failure gives its reason in one line.\n"
          "- No table and no particle contains a value that is not a number.\n"
          "- No particle is lost (at most 1 % with time steps that a run warns of), or within a solid deeper than its "
          "boundary particles.\n"
          "- All particles are accounted for.\n"
          "- Contact with walls adds at most 1e-4 of the energy at the start.\n"
          "- Solves that stop at `max_iterations` are counted (`capped`).\n\n"
          "Trials run with one thread each. Run times depend on the machine and its load.\n\n",
          out);
}

static void put_row(FILE *out, const sb_judged *j, const char *commit)
{
    char figure[700];
    fputc('|', out);
    sb_put_cell(out, j->trial->name);
    if (!j->outcome.there) {
        fputs(" | | | | | | not run |\n", out);
        return;
    }
    snprintf(figure, sizeof figure, "%s%s%s", j->figure, j->fails && j->figure[0] ? "; " : "", j->fails ? j->why : "");
    sb_put_cell(out, figure[0] ? figure : j->outcome.ended);
    const bool ran = j->outcome.summary != NULL;
    put_count(out, ran ? sb_outcome_number(&j->outcome, "fluid_particles") : (double)NAN);
    put_count(out, ran ? sb_outcome_number(&j->outcome, "steps") : (double)NAN);
    put_count(out, ran ? sb_outcome_number(&j->outcome, "capped_steps") : (double)NAN);
    put_count(out, ran ? sb_outcome_number(&j->outcome, "inside_solids") : (double)NAN);
    fprintf(out, " %.1f | %s", j->outcome.wall, j->fails ? "**FAIL**" : "pass");
    if (strcmp(commit, j->outcome.commit) != 0) fprintf(out, " (%s)", j->outcome.commit);
    fputs(" |\n", out);
}

static void put_case(FILE *out, const sb_stress_results *r, const char *commit)
{
    fprintf(out, "<a id=\"%s\"></a>\n\n## %s\n\nCase `%s`. Rules:\n\n", r->of->name, r->of->title, r->of->name);
    sb_put_items(out, r->of->rules, true);
    fputs("\n| trial | measured | particles | steps | capped | inside | run time (s) | result |\n"
          "|---|---|---|---|---|---|---|---|\n",
          out);
    for (size_t i = 0; i < r->trials.count; i++) put_row(out, &r->judged[i], commit);
    fputc('\n', out);
}

static void put_report(FILE *out, const void *stability)
{
    const sb_stability *s = stability;
    put_head(out, s);
    put_summary(out, s);
    for (size_t c = 0; c < s->count; c++) put_case(out, &s->cases[c], s->store->commit);
}

sb_status sb_stability_write(const sb_stability *stability, sb_error *error)
{
    static const sb_report_file files[] = {{"stability.md", put_report}, {NULL, NULL}};
    return sb_reports_write(stability->store, files, stability, error);
}
