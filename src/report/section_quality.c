/* How far to trust the run: each line is a judgement in words with its figures. */
#include "report/sections.h"

#include "report/html.h"

#include <math.h>
#include <string.h>

typedef enum verdict { GOOD, OPEN, BAD } verdict;

static void begin(FILE *out, verdict v, const char *title)
{
    static const char *const names[] = {"good", "open", "bad"}, *const words[] = {"good", "note", "caution"};
    sb_html_put(out, "<li class=\"%s\"><b class=\"mark\">%s</b><div><b>%s</b> ", names[v], words[v], title);
}

static void finish(FILE *out)
{
    fputs("</div></li>\n", out);
}

static void put_end(FILE *out, const sb_report_run *run)
{
    const char *status = sb_report_status(run), *reason = sb_report_text(run, "reason");
    const bool done = strcmp(status, "done") == 0;
    begin(out, done ? GOOD : BAD, "End of the run.");
    if (done)
        sb_html_put(out, "The run simulated %g s and ended as planned.", sb_report_reached(run));
    else if (strcmp(status, "running") == 0)
        sb_html_put(out,
                    "The run has not ended, or was killed: it has reached %g s. Peaks and impulses may still grow, and "
                    "some checks are made only at the end.",
                    sb_report_reached(run));
    else if (strcmp(status, "unknown") == 0)
        fputs("The summary cannot be read, so it is not known how the run ended.", out);
    else
        sb_html_put(out, "The run %s at %g s%s%s. Later peaks are not in this report.",
                    strcmp(status, "failed") == 0 ? "failed" : "was interrupted", sb_report_reached(run),
                    reason ? ": " : "", reason);
    finish(out);
}

static void put_coarse(FILE *out, const sb_loads *loads)
{
    const char *comma = "";
    fputs(
        "<li>The flow towards the body is too shallow for the particles, expected four or more; the remedy is a finer "
        "resolution. Depth in particles: ",
        out);
    for (size_t i = 0; i < loads->reached; i++) {
        if (!loads->loads[i].coarse) continue;
        sb_html_put(out, "%s<b>%s</b> %g", comma, loads->loads[i].name, round(10 * loads->loads[i].layers) / 10);
        comma = ", ";
    }
    fputs(".</li>", out);
}

static void put_narrow(FILE *out, const sb_loads *loads)
{
    const char *comma = "";
    fputs(
        "<li>A gap beside the body is too narrow for the walls; the remedy is a finer resolution, or to close the gap. "
        "Width of the gap: ",
        out);
    for (size_t i = 0; i < loads->reached; i++) {
        if (!loads->loads[i].narrow) continue;
        sb_html_put(out, "%s<b>%s</b> %g m", comma, loads->loads[i].name, loads->loads[i].gap);
        comma = ", ";
    }
    fputs(".</li>", out);
}

static void put_forces(FILE *out, const sb_loads *loads)
{
    size_t judged = 0, coarse = 0, narrow = 0;
    for (size_t i = 0; i < loads->reached; i++) {
        judged += loads->loads[i].judged;
        coarse += loads->loads[i].coarse;
        narrow += loads->loads[i].narrow;
    }
    if (loads->reached == 0) return;
    begin(out, judged == 0 ? OPEN : coarse + narrow > 0 ? BAD : GOOD, "Forces.");
    if (judged == 0)
        fputs("It is judged only at the end of a run which forces are reliable.", out);
    else if (coarse + narrow == 0)
        sb_html_put(out,
                    "At all %z bodies with a load the flow was at least four particles deep, and no gap beside them "
                    "is too narrow.",
                    judged);
    else {
        sb_html_put(out, "Do not rely on the forces on the following of %z bodies with a load.<ul>", judged);
        if (coarse > 0) put_coarse(out, loads);
        if (narrow > 0) put_narrow(out, loads);
        fputs("</ul>", out);
    }
    finish(out);
}

static void put_density(FILE *out, const sb_report_run *run)
{
    double mean = sb_report_number(run, "compression_mean"), most = sb_report_number(run, "compression_max");
    const double capped = sb_report_number(run, "capped_steps"), steps = sb_report_number(run, "steps");
    const bool last = isnan(mean) && run->step;
    if (last) {
        mean = json_number_value(json_object_get(run->step, "compression_mean"));
        most = json_number_value(json_object_get(run->step, "compression_max"));
    }
    if (isnan(mean)) return;
    const bool pressed = most > 0.1;
    begin(out, mean > 0.01 || capped > 0 ? BAD : pressed ? OPEN : GOOD, "Density.");
    sb_html_put(out,
                "Over all particles%s the water was compressed by %g %% on average: %s. A single particle, in the step "
                "in which it was worst, by %g %%.",
                last ? " in the last step of the log" : " and steps", 100 * mean,
                mean > 0.01 ? "above 1 % pressures are doubtful" : "up to 1 % pressures as a whole are not in doubt",
                100 * most);
    if (pressed)
        fputs(" That is water that hits a wall or other water: do not rely on the pressure at a probe or on a face in "
              "a single moment of an impact, but on means and impulses.",
              out);
    if (capped > 0)
        sb_html_put(out, " In %g of %g steps the pressure solve stopped above its tolerance.", capped, steps);
    else if (capped == 0)
        fputs(" Every pressure solve met its tolerance.", out);
    finish(out);
}

enum {
    KINETIC = 1,
    POTENTIAL = 2,
    BODIES = 7,
    VISCOSITY,
    FRICTION,
    PRESSURE,
    CONTACT,
    INTEGRATION,
    LEFT,
    IMBALANCE,
    STRESS,
    SEA,
    SPONGE,
    TENSION
};

/* A part that most runs do not have. */
static void put_part(FILE *out, const char *name, double percent)
{
    if (percent != 0) sb_html_put(out, ", %s %g %%", name, percent);
}

/* The energy ledger of docs/method.md, section 11. All parts are in per cent of the greatest kinetic energy. */
static void put_energy(FILE *out, const sb_report_run *run)
{
    const sb_series_table *table = &run->tables[SB_REPORT_ENERGY];
    if (table->count == 0 || table->series[0].rows < 2) return;
    const double *values = table->series[0].values;
    const double *first = values, *last = values + (table->series[0].rows - 1) * table->columns;
    double greatest = 0, ledger = 0;
    for (size_t row = 0; row < table->series[0].rows; row++)
        greatest = fmax(greatest, values[row * table->columns + KINETIC]);
    for (int c = BODIES; c <= TENSION; c++)
        if (c != IMBALANCE) ledger += last[c] - first[c];
    const double change = last[KINETIC] + last[POTENTIAL] - first[KINETIC] - first[POTENTIAL];
    const double percent = greatest > 0 ? 100 / greatest : 0;
    const double open = percent * fabs(change - ledger);
    begin(out, open > 1 || !isfinite(open) ? BAD : GOOD, "Energy.");
    sb_html_put(
        out,
        "The itemised changes of the water’s energy add up to its total change within %s%g %%. All parts are in "
        "per cent of the greatest kinetic energy: work of moving bodies %g %%, viscosity and wall friction "
        "%g %%, stress of the particle packing %g %%, pressure solve, impacts and time integration %g %%, water that "
        "left %g %%",
        open < 0.01 ? "less than " : "", fmax(open, 0.01), percent * last[BODIES],
        percent * (last[VISCOSITY] + last[FRICTION]), percent * last[STRESS],
        percent * (last[PRESSURE] + last[CONTACT] + last[INTEGRATION]), percent * last[LEFT]);
    put_part(out, "given sea", percent * last[SEA]);
    put_part(out, "sponges", percent * last[SPONGE]);
    put_part(out, "surface tension", percent * last[TENSION]);
    fputs(".", out);
    finish(out);
}

static void put_lost(FILE *out, const sb_report_run *run)
{
    double lost = sb_report_number(run, "lost_particles"), left = sb_report_number(run, "left_domain");
    const double all = sb_report_number(run, "fluid_particles"), inside = sb_report_number(run, "inside_solids");
    const double through = sb_report_number(run, "through_walls");
    if (isnan(lost) && run->step) {
        lost = json_number_value(json_object_get(run->step, "lost"));
        left = json_number_value(json_object_get(run->step, "left_domain"));
    }
    if (isnan(lost)) return;
    begin(out, lost > 0 || through > 0 ? BAD : GOOD, "Particles.");
    if (lost > 0)
        sb_html_put(out, "%g of %g particles passed through walls of the domain and were lost. ", lost, all);
    else
        fputs("No particle was lost. ", out);
    if (left > 0) sb_html_put(out, "%g left through open sides. ", left);
    if (through > 0)
        sb_html_put(out, "%g are deep inside of a body: water has passed a wall. ", through);
    else if (!isnan(inside))
        fputs("No water has passed the wall of a body. ", out);
    finish(out);
}

static void put_list(FILE *out, verdict v, const char *title, const sb_texts *list)
{
    if (list->count == 0) return;
    begin(out, v, title);
    fputs("<ul>", out);
    for (size_t i = 0; i < list->count; i++) sb_html_put(out, "<li>%s</li>", list->texts[i]);
    fputs("</ul>", out);
    finish(out);
}

static void put_missing(FILE *out, const sb_report_run *run)
{
    const double pictures = sb_report_number(run, "pictures_missing");
    const double files = sb_report_number(run, "particle_files_missing");
    if (!(pictures > 0) && !(files > 0)) return;
    begin(out, BAD, "Files.");
    sb_html_put(out, "%g pictures and %g particle files could not be written.", pictures, files);
    finish(out);
}

void sb_section_quality(FILE *out, const sb_report_page *page)
{
    fputs("<section id=\"quality\"><h2>How far to trust this run</h2>\n<ul class=\"quality\">\n", out);
    put_end(out, page->run);
    put_forces(out, page->loads);
    put_density(out, page->run);
    put_energy(out, page->run);
    put_lost(out, page->run);
    put_missing(out, page->run);
    put_list(out, BAD, "Warnings of the run.", &page->run->warnings);
    put_list(out, BAD, "Missing or damaged files.", &page->run->notes);
    fputs("</ul>\n", out);
    fputs("<p class=\"note\">One run at one particle spacing has no error bars: repeat it at a finer spacing, and with "
          "other start seeds, before a design relies on it. Impulses are more certain than peaks.</p></section>\n",
          out);
}
