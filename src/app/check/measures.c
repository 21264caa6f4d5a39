/* Warns of measurements that the run cannot fill: those that begin after its end, without gauges, or with too few rows
   per period. */
#include "app/check/measures.h"

#include "output/tables/overtopping_rate.h"
#include "output/tables/wave_table.h"
#include "physics/records/eurotop.h"
#include "physics/records/reflection.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void warn_of_waves(const sb_scene *scene, sb_warning_visit *visit, void *context)
{
    char text[400];
    const sb_wave_settings *waves = &scene->measure.waves;
    const int harmonics = sb_wave_table_harmonics(scene);
    if (!waves->present) return;
    if (scene->measure.gauge_count == 0)
        visit(context, "measure.waves: there are no gauges, so that waves.csv has no row; expected measure.gauges, or "
                       "no waves");
    if (waves->start >= scene->duration) {
        snprintf(
            text, sizeof text,
            "measure.waves.start: %g s is not before the end of the run at %g s: waves.csv has no values; expected "
            "an earlier start or a longer duration",
            waves->start, scene->duration);
        visit(context, text);
    }
    const double left = scene->duration - waves->start;
    if (left > 0 && SB_LEAST_PERIODS * waves->period > left) {
        snprintf(text, sizeof text,
                 "measure.waves.period: %g s is longer than the %g s from measure.waves.start to the end of the run: "
                 "there are no harmonics; expected an earlier start, a longer duration or a shorter period",
                 waves->period, left);
        visit(context, text);
    }
    if (waves->period > 0 && harmonics < SB_WAVE_HARMONICS) {
        snprintf(text, sizeof text,
                 "measure.waves.period: harmonics of %g s above number %d have two rows of measure.interval %g s in "
                 "their period or fewer: they are not measured; expected a period above %.3g s, or an interval below "
                 "%.3g s",
                 waves->period, harmonics, scene->measure.interval, 2 * SB_WAVE_HARMONICS * scene->measure.interval,
                 waves->period / (2 * SB_WAVE_HARMONICS));
        visit(context, text);
    }
}

/* Rows per period that show heights and crossings within a per cent or two. */
static const double ROWS = 10;

/* Too few rows per period cut the crests. */
static void warn_of_rows(const sb_scene *scene, sb_warning_visit *visit, void *context)
{
    char text[300];
    double least = (double)INFINITY;
    if (!scene->measure.waves.present && scene->measure.reflection_count == 0) return;
    for (size_t w = 0; w < scene->wavemaker_count; w++)
        if (scene->wavemakers[w].law.period > 0) least = fmin(least, scene->wavemakers[w].law.period);
    if (scene->given.source == SB_GIVEN_THEORY && scene->given.wave == SB_GIVEN_REGULAR)
        least = fmin(least, scene->given.period);
    if (!(scene->measure.interval > least / ROWS)) return;
    snprintf(text, sizeof text,
             "measure.interval: %g s gives %.2g rows in a period of %g s: heights and crossings of waves are cut; "
             "expected at most %.3g s",
             scene->measure.interval, least / scene->measure.interval, least, least / ROWS);
    visit(context, text);
}

/* EurOtop has another formula for slopes behind a shallow foreshore, which breaks the waves. */
static void warn_of_foreshore(const sb_scene *scene, const sb_flow_plane *plane, sb_warning_visit *visit, void *context)
{
    char text[400];
    const sb_eurotop_settings *e = &plane->eurotop;
    if (!(e->height > 0 && e->slope > 0 && e->slope <= SB_EUROTOP_STEEP)) return;
    const double breaker = sb_eurotop_breaker(e->height, e->slope, e->period, scene->fluid.gravity);
    if (breaker < SB_EUROTOP_SHALLOW) return;
    snprintf(text, sizeof text,
             "measure.planes %s: eurotop: the breaker parameter of %.3g is that of waves that broke on a shallow "
             "foreshore, for which EurOtop has another formula: the rate is not comparable; expected below %g, by a "
             "shorter period, higher waves or a gentler slope",
             plane->name, breaker, SB_EUROTOP_SHALLOW);
    visit(context, text);
}

/* The formulas are means over irregular waves. */
static void warn_of_regular(const sb_scene *scene, const sb_flow_plane *plane, sb_warning_visit *visit, void *context)
{
    char text[400];
    const char *maker = NULL;
    for (size_t w = 0; w < scene->wavemaker_count; w++) {
        const char *kind = scene->wavemakers[w].law.kind->name;
        if (strcmp(kind, "irregular") == 0 || strcmp(kind, "components") == 0) return;
        if (strcmp(kind, "regular") == 0) maker = scene->wavemakers[w].name;
    }
    if (scene->given.source == SB_GIVEN_THEORY && scene->given.wave == SB_GIVEN_REGULAR) maker = "sea";
    if (!(plane->eurotop.height > 0) || !maker) return;
    snprintf(text, sizeof text,
             "measure.planes %s: eurotop: its formulas are for irregular waves, and those of \"%s\" are regular: the "
             "rates will differ by a factor; expected irregular waves",
             plane->name, maker);
    visit(context, text);
}

static void warn_of_rates(const sb_scene *scene, sb_warning_visit *visit, void *context)
{
    char text[400];
    for (size_t p = 0; p < scene->measure.plane_count; p++) {
        const sb_flow_plane *plane = &scene->measure.planes[p];
        warn_of_foreshore(scene, plane, visit, context);
        warn_of_regular(scene, plane, visit, context);
        if (!(plane->eurotop.height > 0) || plane->eurotop.start < scene->duration) continue;
        snprintf(text, sizeof text,
                 "measure.planes[%zu].eurotop.start: %g s is not before the end of the run at %g s: the rate of \"%s\" "
                 "is not compared; expected an earlier start or a longer duration",
                 p, plane->eurotop.start, scene->duration, plane->name);
        visit(context, text);
    }
}

void sb_measure_warnings(const sb_scene *scene, sb_warning_visit *visit, void *context)
{
    warn_of_waves(scene, visit, context);
    warn_of_rows(scene, visit, context);
    warn_of_rates(scene, visit, context);
}

typedef void visit_rate(const sb_flow_plane *plane, double freeboard, double rate, void *context);

static void visit_rates(const sb_scene *scene, visit_rate *visit, void *context)
{
    for (size_t p = 0; p < scene->measure.plane_count; p++) {
        const sb_flow_plane *plane = &scene->measure.planes[p];
        const sb_eurotop_settings *e = &plane->eurotop;
        if (!(e->height > 0)) continue;
        const double freeboard = e->crest - scene->sea.level;
        visit(plane, freeboard, sb_eurotop_rate(e->height, freeboard, e->slope, e->period, scene->fluid.gravity),
              context);
    }
}

static void print_rate(const sb_flow_plane *plane, double freeboard, double rate, void *context)
{
    (void)context;
    printf("  overtopping of %s: %.3g m^2/s (%.3g l/s per m) by EurOtop, with H_m0 %g m and a freeboard of %.4g m\n",
           plane->name, rate, 1000 * rate, plane->eurotop.height, freeboard);
}

void sb_check_rates_text(const sb_scene *scene)
{
    visit_rates(scene, print_rate, NULL);
}

static void put_rate(const sb_flow_plane *plane, double freeboard, double rate, void *context)
{
    sb_json *json = context;
    sb_json_open(json, NULL, '{');
    sb_json_text(json, "plane", plane->name);
    sb_json_number(json, "eurotop_m2_s", rate);
    sb_json_number(json, "freeboard_m", freeboard);
    sb_json_number(json, "height_m", plane->eurotop.height);
    sb_json_close(json);
}

void sb_check_rates_json(const sb_scene *scene, sb_json *json)
{
    if (!sb_overtopping_wanted(scene)) return;
    sb_json_open(json, "overtopping", '[');
    visit_rates(scene, put_rate, json);
    sb_json_close(json);
}
