/* stability.md: what was asked of each trial, what came of it. */
#include "battery.h"

#include <math.h>
#include <string.h>

static void put_cell(FILE *out, const char *text)
{
    fputc(' ', out);
    for (; *text; text++) fputs(*text == '|' ? "\\|" : (char[]){*text, '\0'}, out);
    fputs(" |", out);
}

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

static void put_summary(FILE *out, const sb_stress_results *cases, size_t count)
{
    fputs("| case | what must hold, beside the common rules | passed | |\n|---|---|---|---|\n", out);
    for (size_t c = 0; c < count; c++) {
        const sb_stress_results *r = &cases[c];
        fprintf(out, "| [%s](#%s) |", r->of->title, r->of->name);
        put_cell(out, r->of->rule);
        fprintf(out, " %zu of %zu | %s |\n", r->run - r->failed, r->trials.count, verdict_of(r));
    }
    fputc('\n', out);
}

static void put_head(FILE *out, const sb_workbench *bench, const sb_stress_results *cases, size_t count, bool quick,
                     const char *command)
{
    size_t run = 0, failed = 0, asked = 0;
    for (size_t c = 0; c < count; c++) {
        run += cases[c].run;
        failed += cases[c].failed;
        asked += cases[c].trials.count;
    }
    fprintf(out,
            "# Stability%s\n\nCommit %s, %s.\nMade by `%s`; [how to read and repeat it](%s).\n\n"
            "%zu trials asked for, %zu run, %zu passed, **%zu failed**.\n\n",
            quick ? ", quick forms" : "", bench->commit, bench->machine, command,
            quick ? "../../stability.md" : "../stability.md", asked, run, run - failed, failed);
    fputs(
        "Common rules, for every trial: it ends as it should and in time, or says why not in one line; no table and "
        "no particle\nholds a number that is none; no particle is lost or within a solid deeper than its boundary "
        "particles; all particles are\naccounted for; contact with walls makes no more than 1e-4 of the energy at the "
        "start; solves that stop at their cap are counted (`capped`).\nTrials run with one thread each; run times are "
        "those of the machine and load they were made on.\n\n",
        out);
}

static void put_row(FILE *out, const sb_judged *j, const char *commit)
{
    char figure[700];
    fputc('|', out);
    put_cell(out, j->trial->name);
    if (!j->outcome.there) {
        fputs(" | | | | | | not run |\n", out);
        return;
    }
    snprintf(figure, sizeof figure, "%s%s%s", j->figure, j->fails && j->figure[0] ? "; " : "", j->fails ? j->why : "");
    put_cell(out, figure[0] ? figure : j->outcome.ended);
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
    fprintf(out, "<a id=\"%s\"></a>\n\n## %s\n\nCase `%s`. %s\n\n", r->of->name, r->of->title, r->of->name,
            r->of->rule);
    fputs("| variant | figure | particles | steps | capped | inside | run time (s) | |\n"
          "|---|---|---|---|---|---|---|---|\n",
          out);
    for (size_t i = 0; i < r->trials.count; i++) put_row(out, &r->judged[i], commit);
    fputc('\n', out);
}

sb_status sb_stability_write(const sb_workbench *bench, const sb_stress_results *cases, size_t count, bool quick,
                             const char *command, const char *folder, sb_error *error)
{
    sb_atomic_file file;
    sb_status status = sb_make_directories(folder, error);
    if (status == SB_OK) status = sb_atomic_open_in(&file, folder, "stability.md", error);
    if (status != SB_OK) return status;
    put_head(file.stream, bench, cases, count, quick, command);
    put_summary(file.stream, cases, count);
    for (size_t c = 0; c < count; c++) put_case(file.stream, &cases[c], bench->commit);
    return sb_atomic_commit(&file, 0, error);
}
