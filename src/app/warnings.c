#include "app/warnings.h"

#include "app/check_measures.h"
#include "app/check_numerics.h"
#include "app/check_tension.h"
#include "app/check_zones.h"
#include "app/wave_warnings.h"
#include "base/memory.h"
#include "physics/cnoidal.h"
#include "physics/reflection.h"
#include "physics/steady_wave.h"
#include "physics/wavemaker.h"
#include "sim/sim.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Gauges may not tell free from bound waves: in shallow water both have the same speed. */
static void warn_of_bound(const sb_reflection_set *set, const double *places, int harmonic, double number, double first,
                          sb_warning_visit *visit, void *context)
{
    char text[500];
    const double separation = sb_split_bound_separation(places, set->gauge_count, number, harmonic * first);
    if (separation >= SB_SEPARATION_TRUSTED) return;
    snprintf(
        text, sizeof text,
        "measure.reflections %s: at these gauges free waves of the period %.4g s, which are %.4g m long, and bound "
        "ones of %.4g m can hardly be told apart (separation %.2g): expected 0.05 or more, by gauges over a longer "
        "distance, other distances, fewer harmonics or bound: false",
        set->name, set->period / harmonic, 2 * M_PI / number, 2 * M_PI / (harmonic * first), separation);
    visit(context, text);
}

/* A window that the run does not fill has no row. */
static void warn_of_window(const sb_scene *scene, const sb_reflection_set *set, sb_warning_visit *visit, void *context)
{
    char text[300];
    const double end = set->start + set->window;
    if (end <= scene->duration * (1 + 1e-9)) return;
    snprintf(text, sizeof text,
             "measure.reflections %s: its first window ends at %g s, after the end of the run at %g s: reflections.csv "
             "has no row of it; expected an earlier start, a shorter window or a longer duration",
             set->name, end, scene->duration);
    visit(context, text);
}

/* Length of regular waves in a closed flume, m; by cnoidal theory where no steady wave is found; NaN: not known. */
static double length_of(const sb_wavemaker_parameters *law, double depth)
{
    sb_steady_wave wave;
    sb_cnoidal cnoidal;
    if (sb_steady_wave_of(law->height, law->period, depth, law->gravity, &wave)) return wave.length;
    const bool found = sb_cnoidal_of_period(law->height, law->period, depth, law->gravity, &cnoidal, NULL) == SB_OK;
    return found ? cnoidal.length : (double)NAN;
}

/* Waves of a wave maker that are longer or shorter than the split takes them for seem to be reflected. */
static void warn_of_length(const sb_scene *scene, const sb_reflection_set *set, sb_warning_visit *visit, void *context)
{
    static const double enough = 0.005;
    char text[400];
    for (size_t w = 0; w < scene->wavemaker_count; w++) {
        const sb_wavemaker_parameters *law = &scene->wavemakers[w].law;
        const double length = 2 * M_PI / sb_reflection_number(scene, set, 1);
        if (strcmp(law->kind->name, "regular") != 0 || fabs(law->period / set->period - 1) > enough) continue;
        const double own = length_of(law, set->depth);
        if (!(fabs(length / own - 1) > enough)) continue;
        snprintf(
            text, sizeof text,
            "measure.reflections %s: waves of \"%s\" are %.4g m long in a closed flume of this depth, and the split "
            "has %.4g m: it reports waves that come back where there are none; expected wavelength: %.4g",
            set->name, scene->wavemakers[w].name, own, length, own);
        visit(context, text);
        return;
    }
}

/* The one wave maker of regular waves; NULL: there is none, or several. */
static const sb_wavemaker_use *regular_of(const sb_scene *scene)
{
    const sb_wavemaker_use *found = NULL;
    for (size_t w = 0; w < scene->wavemaker_count; w++) {
        if (strcmp(scene->wavemakers[w].law.kind->name, "regular") != 0) continue;
        if (found) return NULL;
        found = &scene->wavemakers[w];
    }
    return found;
}

/* Harmonics of another period than that of the waves are not theirs. what: the key of the period. */
static void warn_of_period(const sb_scene *scene, const char *what, double period, sb_warning_visit *visit,
                           void *context)
{
    char text[300];
    const sb_wavemaker_use *maker = regular_of(scene);
    const double ratio = maker ? period / maker->law.period : 1;
    if (!(period > 0) || (ratio > 0.5 && fabs(ratio - round(ratio)) < 0.005 * ratio)) return;
    snprintf(text, sizeof text,
             "%s: %g s is not the period of the waves of \"%s\", %g s, so that its harmonics are not theirs; expected "
             "that period",
             what, period, maker->name, maker->law.period);
    visit(context, text);
}

/* Gauges near multiples of half a wavelength apart cannot tell incident from reflected waves. */
static sb_status warn_of_reflections(const sb_scene *scene, sb_warning_visit *visit, void *context, sb_error *error)
{
    for (size_t r = 0; r < scene->measure.reflection_count; r++) {
        const sb_reflection_set *set = &scene->measure.reflections[r];
        warn_of_window(scene, set, visit, context);
        char what[SB_NAME_MAX + 40];
        snprintf(what, sizeof what, "measure.reflections %s: period", set->name);
        warn_of_period(scene, what, set->period, visit, context);
        warn_of_length(scene, set, visit, context);
        double *places = sb_alloc(set->gauge_count, sizeof *places);
        if (!places) return sb_fail_memory(error, "gauges of reflections");
        for (size_t i = 0; i < set->gauge_count; i++) places[i] = sb_reflection_place(scene, set, i);
        const double first = sb_reflection_number(scene, set, 1);
        for (int h = 1; h <= set->harmonics; h++) {
            const double number = sb_reflection_number(scene, set, h);
            char text[400];
            if (set->bound && h > 1) {
                warn_of_bound(set, places, h, number, first, visit, context);
                continue;
            }
            if (sb_split_separation(places, set->gauge_count, number) >= SB_SEPARATION_TRUSTED) continue;
            snprintf(
                text, sizeof text,
                "measure.reflections %s: all gauges lie near multiples of half the wavelength of %.4g m (period %.4g "
                "s): incident and reflected waves cannot be told apart, expected other distances",
                set->name, 2 * M_PI / number, set->period / h);
            visit(context, text);
        }
        sb_free(places);
    }
    return SB_OK;
}

/* The times are in increasing order: the last one decides. */
static void warn_of_stills(const sb_scene *scene, sb_warning_visit *visit, void *context)
{
    const sb_render_settings *render = &scene->render;
    char text[200];
    if (render->still_count == 0 || render->stills[render->still_count - 1].time <= scene->duration) return;
    snprintf(text, sizeof text, "render.stills: %g s is after the end of the run at %g s: it has no still",
             render->stills[render->still_count - 1].time, scene->duration);
    visit(context, text);
}

static void warn_of_foam(const sb_scene *scene, sb_warning_visit *visit, void *context)
{
    if (!scene->foam.enabled || sb_scene_draws(scene) || scene->output.particle_interval > 0 || scene->control.enabled)
        return;
    visit(context,
          "foam.enabled: true, but the run draws no pictures and writes no particle files, so that the foam is "
          "not seen; expected render.interval or output.particle_interval above 0, or foam.enabled: false");
}

static void warn_of_pieces(const sb_scene *scene, sb_warning_visit *visit, void *context)
{
    if (!scene->output.particle_pieces || scene->output.particle_interval > 0) return;
    visit(context,
          "output.particle_pieces: true, but the run writes no particle files; expected output.particle_interval above "
          "0, or output.particle_pieces: false");
}

sb_status sb_scene_warnings(const sb_scene *scene, sb_warning_visit *visit, void *context, sb_error *error)
{
    char text[256];
    warn_of_stills(scene, visit, context);
    warn_of_foam(scene, visit, context);
    warn_of_pieces(scene, visit, context);
    for (size_t w = 0; w < scene->wavemaker_count; w++) {
        const sb_wavemaker_parameters *law = &scene->wavemakers[w].law;
        if (isinf(law->start) && !scene->control.enabled) {
            snprintf(
                text, sizeof text,
                "wave maker \"%s\": its start waits for a command, and commands are off: it makes no waves; expected "
                "control.enabled: true, or --control",
                scene->wavemakers[w].name);
            visit(context, text);
        }
        const char *warning = law->kind->warning ? law->kind->warning(law) : NULL;
        if (!warning) continue;
        snprintf(text, sizeof text, "wave maker \"%s\": %s", scene->wavemakers[w].name, warning);
        visit(context, text);
    }
    const sb_initial_wave *wave = &scene->wave;
    static const char *const names[] = {"third-order", "boussinesq", "serre"};
    const bool first = wave->theory != SB_SOLITARY_THIRD_ORDER;
    const double good = first ? 0.3 : 0.4; /* largest accurate height, as a fraction of the depth */
    if (wave->kind == SB_INITIAL_SOLITARY && wave->height > good * wave->depth) {
        snprintf(text, sizeof text,
                 "water.wave.height: %g m is %.2g of the depth: the theory %s is accurate up to %g; the wave will shed "
                 "water",
                 wave->height, wave->height / wave->depth, names[wave->theory], good);
        visit(context, text);
    }
    const bool train = wave->kind == SB_INITIAL_REGULAR || wave->kind == SB_INITIAL_COMPONENTS;
    if (train && !sb_scene_repeats(scene, 0))
        visit(context, "water.wave: the sides along x are not periodic: the waves are reflected or end there, expected "
                       "sides of kind periodic");
    sb_status status = sb_wave_warnings(scene, visit, context, error);
    if (status == SB_OK) status = warn_of_reflections(scene, visit, context, error);
    sb_numerics_warnings(scene, visit, context);
    sb_tension_warnings(scene, visit, context);
    warn_of_period(scene, "measure.waves.period", scene->measure.waves.period, visit, context);
    sb_measure_warnings(scene, visit, context);
    sb_zone_warnings(scene, visit, context);
    if (scene->measure.interval > scene->duration) {
        snprintf(text, sizeof text,
                 "measure.interval: %g s is longer than the run of %g s: forces.csv gets no row, and the other tables "
                 "only the row at t = 0",
                 scene->measure.interval, scene->duration);
        visit(context, text);
    }
    return status;
}

sb_status sb_facet_warnings(const sb_scene *scene, const sb_model *model, sb_warning_visit *visit, void *context,
                            sb_error *error)
{
    char text[400], more[64] = "";
    sb_crowding found;
    const sb_status status = sb_sim_find_crowding(scene, model, &found, error);
    if (status != SB_OK || found.places == 0) return status;
    if (found.places > 1) snprintf(more, sizeof more, " and in %zu other places", found.places - 1);
    snprintf(
        text, sizeof text,
        "numerics.walls: near (%.4g, %.4g, %.4g)%s there are more than %d facets of walls, or %d edges, within %.3g "
        "m: the run ends when water comes there; expected smoother meshes, or numerics.preset: paper",
        found.first.x, found.first.y, found.first.z, more, found.facets, found.edges, found.width);
    visit(context, text);
    return SB_OK;
}
