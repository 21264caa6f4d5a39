/* Writes our figures beside the published ones. */
#include "studies.h"

#include "markdown.h"

#include <math.h>

/* A row of a table: ours, or that of the paper. */
typedef struct line {
    const char *source;
    double varied; /* parameter that the set varies */
    double fluid, boundary, step, sweeps, total, structure, query, advection, pressure, settling, other, steps, cores;
} line;

static double varied_of(const sb_published *p, int set)
{
    const double values[] = {[SB_SET_LAMBDA] = p->lambda,
                             [SB_SET_TABLE] = p->table,
                             [SB_SET_TOLERANCE] = 100 * p->tolerance,
                             [SB_SET_SPACING] = p->spacing};
    return values[set];
}

/* A value that the set does not print is that of the run that all sets share. */
static double or_shared(double value, double shared)
{
    return isnan(value) ? shared : value;
}

static line published_line(const sb_published *p, int set)
{
    const sb_published *shared = sb_published_find(SB_PUBLISHED_DEFAULT);
    double step = or_shared(p->step, shared->step);
    return (line){"paper",           varied_of(p, set),
                  p->fluid,          p->boundary,
                  p->step,           p->sweeps,
                  p->total,          p->structure,
                  p->query,          p->advection,
                  p->pressure,       0,
                  (double)NAN,       SB_PUBLISHED_SECONDS / step,
                  SB_PUBLISHED_CORES};
}

static line our_line(const sb_cost *c, const char *source, double varied)
{
    return (line){source,      varied,      c->fluid,     c->boundary, c->simulated / c->steps,
                  c->sweeps,   c->total,    c->structure, c->query,    c->advection,
                  c->pressure, c->settling, c->other,     c->steps,    c->threads};
}

static void put_count(FILE *out, double value)
{
    if (isnan(value))
        fputs(" – |", out);
    else
        fprintf(out, " %.0f k |", value / 1000);
}

static void put_line(FILE *out, const line *l)
{
    double work = sb_cost_per_particle_step(l->total, l->fluid, l->steps);
    double query = sb_cost_per_particle_step(l->query, l->fluid, l->steps);
    double sweep = 1e9 * l->pressure / (l->fluid * l->steps * l->sweeps);
    fputs("|", out);
    sb_put_number(out, l->varied);
    fprintf(out, " %s |", l->source);
    put_count(out, l->fluid);
    put_count(out, l->boundary);
    const double numbers[] = {l->step,     l->sweeps,
                              l->settling, l->other,
                              l->total,    l->structure,
                              l->query,    l->advection,
                              l->pressure, 100 * l->pressure / l->total,
                              work,        work * l->cores,
                              query,       query * l->cores,
                              sweep,       sweep * l->cores};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) sb_put_number(out, numbers[i]);
    fputc('\n', out);
}

static void put_table_head(FILE *out, const char *varied)
{
    fprintf(
        out,
        "| %s | source | N_f | N_b | Δt (s) | sweeps | settling (s) | other (s) | T (s) | T_c | T_q | T_a | T_p | T_p "
        "(%%) | ns per particle and step | × cores | neighbours only | × cores | ns per particle and sweep | × "
        "cores |\n",
        varied);
    sb_put_rule(out, 20);
}

/* Extrapolates the run at the finest spacing from its few steps, with the steps and sweeps of the next spacing. */
static bool extrapolate(const sb_paper_studies *s, sb_cost *whole)
{
    const sb_paper_trial *few = sb_paper_row(s, 12, true), *next = sb_paper_row(s, 13, true);
    if (!few || !next) return false;
    *whole = sb_cost_extrapolate(&few->cost, next->cost.steps * next->spacing / few->spacing, next->cost.sweeps);
    return true;
}

static void put_extrapolated(FILE *out, const sb_paper_studies *s)
{
    const sb_paper_trial *few = sb_paper_row(s, 12, true), *next = sb_paper_row(s, 13, true);
    sb_cost whole;
    if (!extrapolate(s, &whole)) {
        fputs("\nThe finest spacing is not extrapolated: its steps or the run at the next spacing are missing.\n", out);
        return;
    }
    fprintf(out,
            "\n**Extrapolated**, not run: %g m, 90 s. %.0f steps at %g m took %.3g s each, with %.1f sweeps. With the "
            "steps "
            "of the %g m run\ntimes %g and its %.1f sweeps, the whole run takes %.3g s (%.3g h), plus %.3g s of set-up "
            "(paper: 233317 s on %d cores).\n",
            few->spacing, few->cost.steps, few->spacing, few->cost.total / few->cost.steps, few->cost.sweeps,
            next->spacing, next->spacing / few->spacing, next->cost.sweeps, whole.total, whole.total / 3600,
            few->cost.setup, SB_PUBLISHED_CORES);
}

static void put_set(FILE *out, const sb_paper_studies *s, int set)
{
    static const char *const varied[] = {"λ_max (1/s)", "slots", "ξ (%)", "δr (m)"};
    fprintf(out, "\n## %s (%s)\n\n", sb_published_sets[set].title, sb_published_sets[set].tables);
    if (set == SB_SET_TABLE)
        fputs(
            "shorebreak has no such parameter. Cells have the edge of the support radius. The number of slots in the "
            "table of used cells\nis the smallest power of two that is at least twice the number of cells, so that the "
            "table is at most half full and has at\nmost four slots per used cell. Static walls have their own table, "
            "built once. The table below compares the cost of the\nneighbour search per particle (*neighbours only*) "
            "with the published cost at every size:\n\n",
            out);
    sb_cost whole;
    put_table_head(out, varied[set]);
    for (const int *n = sb_published_sets[set].numbers; *n; n++) {
        const sb_published *p = sb_published_find(*n);
        line l = published_line(p, set);
        double ours = set == SB_SET_SPACING ? p->spacing * s->scale : l.varied;
        put_line(out, &l);
        const sb_paper_trial *row = sb_paper_row(s, *n, true);
        const sb_paper_trial *other = set == SB_SET_SPACING ? sb_paper_row(s, *n, false) : NULL;
        if (row) {
            l = our_line(&row->cost, row->few ? "ours, `paper`, first steps only" : "ours, `paper`",
                         set == SB_SET_TABLE ? (double)NAN : ours);
            put_line(out, &l);
        }
        if (row && row->few && extrapolate(s, &whole)) {
            l = our_line(&whole, "ours, `paper`, **extrapolated**", ours);
            put_line(out, &l);
        }
        if (other) {
            l = our_line(&other->cost, "ours, `default`", ours);
            put_line(out, &l);
        }
    }
    if (set == SB_SET_SPACING) put_extrapolated(out, s);
}

static const char reading[] =
    "Published figures: Sampath, Montanari, Akinci, Prescott and Smith (2016), *Large-scale solitary wave "
    "simulation with implicit\nincompressible SPH*, on 20 cores at 2.8 GHz. Ours run `assets/scenes/"
    "plant.yaml` without pictures and stream.\n\n"
    "- The meshes of the two plants differ. Our sea has the same volume at every spacing, theirs loses a gap along its "
    "walls.\n  Compare figures per particle and per core (*× cores*).\n"
    "- The machines differ: a ratio of two times compares machines and programs together.\n"
    "- T_c: sort. T_q: neighbours (ours computes densities in the same pass). T_p: the solve. T_a: all other stages. "
    "T: "
    "their\n  sum. Settling, which the published runs and the preset `paper` do not have, is separate, and so are "
    "set-up, "
    "measuring\n  and files (*other*).\n"
    "- If the paper prints no mean time step, figures per particle use that of its run No. 2.\n"
    "- Sweeps are iterations of the solver. The paper's average error balances under-dense particles against "
    "compressed "
    "ones.\n  Ours counts only compression and is stricter at the same ξ (docs/method.md, section 5).\n";

static void put_report(FILE *out, const void *studies)
{
    const sb_paper_studies *s = studies;
    fprintf(out,
            "# The published studies on our plant%s\n\nMade by `tools/paper-studies`. docs/studies.md explains the "
            "method.\n\n",
            s->scale > 1 ? ", quick form" : "");
    sb_runs_origin(out, s->store, s->trials, s->count);
    fputs(reading, out);
    if (s->scale != 1)
        fprintf(out,
                "\n**Quick form**: all our spacings are %g times the published ones (Table 8: %g m is compared with "
                "4 m). Compare only\nfigures per particle.\n",
                s->scale, 4 * s->scale);
    for (int set = 0; sb_published_sets[set].title; set++) put_set(out, s, set);
    fputc('\n', out);
    for (size_t i = 0; i < s->count; i++) sb_runs_problem(out, &s->trials[i]);
}

static void put_csv_row(FILE *out, const sb_paper_studies *s, size_t i, const char *which, const sb_cost *c)
{
    const sb_paper_trial *r = &s->rows[i];
    const sb_finished *run = &s->trials[i].run;
    fprintf(out,
            "%d,%g,%s,%s,%.0f,%.0f,%.0f,%.0f,%.6g,%.4f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%.2f,%s,\"%s\"\n",
            r->number, r->spacing, r->paper ? "paper" : "default", which, c->fluid, c->boundary, c->threads, c->steps,
            c->simulated, c->sweeps, c->settling, c->setup, c->other, c->total, c->structure, c->query, c->advection,
            c->pressure, run->cpu, run->load, run->commit, run->machine);
}

static void put_csv(FILE *out, const void *studies)
{
    const sb_paper_studies *s = studies;
    sb_cost whole;
    fputs("published_no,spacing_m,preset,run,fluid,boundary,threads,steps,simulated_s,"
          "sweeps_per_step,settling_s,setup_s,other_s,total_s,structure_s,query_s,advection_s,pressure_s,cpu_s,load,"
          "commit,machine\n",
          out);
    for (size_t i = 0; i < s->count; i++) {
        const sb_paper_trial *r = &s->rows[i];
        if (s->trials[i].state != SB_RESULT_DONE) continue;
        put_csv_row(out, s, i, r->few ? "first steps" : "whole", &r->cost);
        if (r->few && extrapolate(s, &whole)) put_csv_row(out, s, i, "extrapolated", &whole);
    }
}

sb_status sb_paper_write(const sb_paper_studies *studies, sb_error *error)
{
    static const sb_report_file files[] = {
        {"paper-studies.csv", put_csv}, {"paper-studies.md", put_report}, {NULL, NULL}};
    return sb_reports_write(studies->store, files, studies, error);
}
