/* Title, state, results at a glance, and the facts of the scene. */
#include "report/sections.h"

#include "base/memory.h"
#include "frame/records.h"
#include "report/html.h"
#include "scene/presets.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

/* ---- head ---- */

static void put_tile(FILE *out, const char *value, const char *unit, const char *label)
{
    sb_html_put(out, "<div class=\"tile\"><b>%s</b> <span>%s</span><p>%s</p></div>\n", value, unit, label);
}

static void put_load_tiles(FILE *out, const sb_report_page *page)
{
    const sb_load *load = &page->loads->loads[0];
    char figure[SB_FIGURE_MAX], label[160];
    const char *unit;
    if (page->loads->reached == 0) return;
    const double scale = sb_force_unit(load->horizontal, page->run->flat, &unit);
    snprintf(label, sizeof label, "greatest horizontal force, on %.64s", load->name);
    put_tile(out, sb_figure(figure, scale * load->horizontal), unit, label);
    snprintf(figure, sizeof figure, "%zu of %zu", page->loads->reached, page->loads->count);
    put_tile(out, figure, "", "bodies with a load");
}

/* The greatest value of a column over all series; NaN: there is none. */
static double greatest_of(const sb_series_table *table, size_t column, const char **name)
{
    double most = NAN;
    for (size_t i = 0; i < table->count; i++)
        for (size_t row = 0; row < table->series[i].rows; row++) {
            const double value = sb_series_table_value(table, &table->series[i], row, column);
            if (isnan(value) || value <= most) continue;
            most = value;
            *name = table->series[i].name;
        }
    return most;
}

static void put_water_tile(FILE *out, const sb_series_table *table, size_t column, const char *what)
{
    const char *name = "";
    char figure[SB_FIGURE_MAX], label[160];
    const double most = greatest_of(table, column, &name);
    if (isnan(most)) return;
    snprintf(label, sizeof label, "%s %.64s", what, name);
    put_tile(out, sb_figure(figure, most), "m", label);
}

static void put_trust_tile(FILE *out, const sb_loads *loads)
{
    size_t bad = 0, judged = 0;
    char figure[SB_FIGURE_MAX];
    for (size_t i = 0; i < loads->reached; i++) {
        judged += loads->loads[i].judged;
        bad += loads->loads[i].coarse || loads->loads[i].narrow;
    }
    if (judged == 0) return;
    snprintf(figure, sizeof figure, "%zu of %zu", bad, judged);
    put_tile(out, figure, "", "loaded bodies whose force is not reliable");
}

static int by_size(const void *a, const void *b)
{
    const double one = *(const double *)a, other = *(const double *)b;
    return (one > other) - (one < other);
}

/* The spacings, in increasing order, at which the flow towards each loaded body would be as deep as its force needs.
   Returns their number. The depth in m is taken to be that of this run. */
static size_t needed_spacings(const sb_report_page *page, double *spacings)
{
    const double spacing = sb_report_number(page->run, "resolution_m");
    size_t count = 0;
    for (size_t i = 0; i < page->loads->reached; i++) {
        const sb_load *load = &page->loads->loads[i];
        if (load->coarse && load->layers > 0 && spacing > 0)
            spacings[count++] = spacing * load->layers / SB_LAYERS_TRUSTED;
    }
    if (count > 1) qsort(spacings, count, sizeof *spacings, by_size);
    return count;
}

/* As much as the depth of a coarse flow can tell. */
static double two_digits(double value)
{
    char text[32];
    snprintf(text, sizeof text, "%.1e", value);
    return strtod(text, NULL);
}

static void put_remedy(FILE *out, const sb_report_page *page)
{
    double *spacings = sb_alloc(page->loads->reached, sizeof *spacings);
    const bool flat = page->run->has_scene && page->run->scene.dimensions == 2;
    const size_t count = spacings ? needed_spacings(page, spacings) : 0;
    if (count > 0)
        sb_html_put(
            out,
            " <b>What to change:</b> a finer <code>resolution</code>. By the depths of this run, about %g m resolves "
            "the flow at half of these bodies and %g m at all of them. Half the spacing costs %s times the "
            "particles and about %s times the run time; a smaller domain, or a coarse run that gives the "
            "water for a fine one, saves most of it.",
            two_digits(spacings[(count - 1) / 2]), two_digits(spacings[0]), flat ? "four" : "eight",
            flat ? "eight" : "sixteen");
    sb_free(spacings);
}

/* Where most forces are not reliable: what can be read from the run all the same. */
static void put_reading(FILE *out, const sb_report_page *page)
{
    size_t bad = 0, judged = 0;
    for (size_t i = 0; i < page->loads->reached; i++) {
        judged += page->loads->loads[i].judged;
        bad += page->loads->loads[i].coarse || page->loads->loads[i].narrow;
    }
    if (bad == 0 || 2 * bad < judged) return;
    sb_html_put(
        out,
        "<section id=\"reading\"><h2>What this run can tell</h2><p>The forces on %z of %z loaded bodies are not "
        "reliable: do not design with them, nor with their moments. <b>What can be read:</b> the course of the "
        "event, the water levels offshore and the wave’s arrival, and which bodies are loaded much more than "
        "others. Not whether a wall keeps water away: flow over a crest that is thinner than about four spacings is "
        "not "
        "resolved, and can be missing.",
        bad, judged);
    put_remedy(out, page);
    fputs("</p></section>\n", out);
}

void sb_section_head(FILE *out, const sb_report_page *page)
{
    const char *status = sb_report_status(page->run);
    const bool done = strcmp(status, "done") == 0;
    fputs("<header><p class=\"brand\">shorebreak · run report</p>", out);
    sb_html_put(out, "<h1>%s</h1><p class=\"state %s\">%s, %g s simulated</p></header>\n<main>\n", page->title,
                done ? "good" : "bad",
                done                             ? "Run complete"
                : strcmp(status, "running") == 0 ? "Run not finished"
                : strcmp(status, "failed") == 0  ? "Run failed"
                : strcmp(status, "unknown") == 0 ? "State of the run unknown"
                                                 : "Run interrupted",
                sb_report_reached(page->run));
    fputs("<section class=\"tiles\">\n", out);
    put_load_tiles(out, page);
    put_water_tile(out, &page->run->tables[SB_REPORT_RUNUP], 3, "highest run-up (z), on line");
    put_water_tile(out, &page->run->tables[SB_REPORT_GAUGES], 2, "highest water (z), at gauge");
    put_trust_tile(out, page->loads);
    fputs("</section>\n", out);
    put_reading(out, page);
}

/* ---- facts ---- */

static void begin(FILE *out, const char *name)
{
    sb_html_put(out, "<div><dt>%s</dt><dd>", name);
}

static void finish(FILE *out)
{
    fputs("</dd></div>\n", out);
}

static void put_number(FILE *out, const char *name, double value, const char *unit)
{
    if (isnan(value)) return;
    begin(out, name);
    sb_html_put(out, "%g %s", value, unit);
    finish(out);
}

static void put_text(FILE *out, const char *name, const char *value)
{
    if (!value || !*value) return;
    begin(out, name);
    sb_html_text(out, value);
    finish(out);
}

static void put_water(FILE *out, const sb_scene *scene)
{
    const bool flat = scene->dimensions == 2;
    begin(out, "Domain");
    sb_html_put(out, "x %g to %g m, ", scene->domain.min.x, scene->domain.max.x);
    if (!flat) sb_html_put(out, "y %g to %g m, ", scene->domain.min.y, scene->domain.max.y);
    sb_html_put(out, "z %g to %g m", scene->domain.min.z, scene->domain.max.z);
    finish(out);
    if (scene->sea.present) put_number(out, "Still-water level", scene->sea.level, "m");
    for (size_t w = 0; w < scene->wavemaker_count; w++) {
        const sb_wavemaker_use *maker = &scene->wavemakers[w];
        begin(out, "Wave maker");
        sb_html_put(out, "%s: %s", maker->name, maker->law.kind ? maker->law.kind->name : "");
        if (maker->law.height > 0) sb_html_put(out, ", height %g m", maker->law.height);
        if (maker->law.period > 0) sb_html_put(out, ", period %g s", maker->law.period);
        if (maker->law.depth > 0) sb_html_put(out, ", depth %g m", maker->law.depth);
        finish(out);
    }
    if (scene->wave.kind != SB_INITIAL_NONE) {
        begin(out, "Initial wave");
        static const char *const kinds[] = {"none", "solitary", "standing", "regular", "sum of waves"};
        sb_html_put(out, "%s, ", kinds[scene->wave.kind]);
        if (scene->wave.kind != SB_INITIAL_COMPONENTS) sb_html_put(out, "height %g m, ", scene->wave.height);
        sb_html_put(out, "depth %g m", scene->wave.depth);
        finish(out);
    }
    begin(out, "Fluid");
    sb_html_put(out, "%g kg/m³, g = %g m/s²", scene->fluid.density, scene->fluid.gravity);
    finish(out);
}

/* The time of the last change of the summary, or of the log. */
static void put_date(FILE *out, const sb_report_run *run)
{
    char path[SB_PATH_MAX], text[64];
    struct stat info;
    struct tm utc;
    if (sb_path_join(path, run->directory, run->summary ? "summary.json" : "run.jsonl", NULL) != SB_OK) return;
    if (stat(path, &info) != 0 || !gmtime_r(&info.st_mtime, &utc)) return;
    if (strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &utc) > 0) put_text(out, "Last written", text);
}

void sb_section_facts(FILE *out, const sb_report_page *page)
{
    const sb_report_run *run = page->run;
    double fluid = sb_report_number(run, "fluid_particles"), walls = sb_report_number(run, "boundary_particles");
    double spacing = sb_report_number(run, "resolution_m"), threads = sb_report_number(run, "threads");
    const double wall = sb_report_number(run, "wall_s");
    if (run->start && isnan(fluid)) {
        fluid = json_number_value(json_object_get(run->start, "fluid_particles"));
        walls = json_number_value(json_object_get(run->start, "boundary_particles"));
        spacing = json_number_value(json_object_get(run->start, "resolution"));
        threads = json_number_value(json_object_get(run->start, "threads"));
    }
    fputs("<section id=\"facts\"><h2>Scene and run</h2>\n<dl>\n", out);
    put_text(out, "Scene", run->has_scene ? run->scene.title : sb_report_text(run, "title"));
    if (run->has_scene) put_water(out, &run->scene);
    put_number(out, "Particle spacing", spacing, "m");
    put_number(out, "Water particles", fluid, "");
    put_number(out, "Boundary particles", walls, "");
    if (run->has_scene) put_number(out, "Planned duration", run->scene.duration, "s");
    put_number(out, "Steps", sb_report_number(run, "steps"), "");
    if (run->has_scene) {
        begin(out, "Method");
        const sb_numerics *n = &run->scene.numerics;
        static const char *const forms[] = {
            [SB_WALLS_PARTICLES] = "particles", [SB_WALLS_IMAGES] = "images", [SB_WALLS_DYNAMIC] = "dynamic particles"};
        sb_html_put(out, "%s SPH, kernel %s, walls by %s, preset %s",
                    n->solver == SB_SOLVER_WCSPH ? "weakly compressible" : "incompressible", n->kernel->name,
                    forms[n->walls], sb_preset_names[n->preset]);
        finish(out);
    }
    put_number(out, "Run time", isnan(wall) ? (double)NAN : wall / 60, "min");
    put_number(out, "Threads", threads, "");
    put_date(out, run);
    fputs("</dl></section>\n", out);
}
