#include "app/check/reflections.h"

#include "base/memory.h"
#include "physics/records/reflection.h"
#include "scene/scene_waves.h"

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

/* Waves of a wave maker that are longer or shorter than the split takes them for seem to be reflected. */
static void warn_of_length(const sb_scene *scene, const sb_reflection_set *set, sb_warning_visit *visit, void *context)
{
    static const double enough = 0.005;
    char text[400];
    for (size_t w = 0; w < scene->wavemaker_count; w++) {
        const sb_wavemaker_parameters *law = &scene->wavemakers[w].law;
        const double length = 2 * M_PI / sb_reflection_number(scene, set, 1);
        if (strcmp(law->kind->name, "regular") != 0 || fabs(law->period / set->period - 1) > enough) continue;
        const sb_flume_length own = sb_flume_length_of(law, set->depth);
        if (!(fabs(length / own.length - 1) > own.error)) continue;
        snprintf(
            text, sizeof text,
            "measure.reflections %s: waves of \"%s\" are about %.4g m long in a closed flume of this depth, and the "
            "split has %.4g m: it takes a part of them for waves that come back, beside those that do; expected "
            "wavelength: %.4g",
            set->name, scene->wavemakers[w].name, own.length, length, own.length);
        visit(context, text);
        return;
    }
}

void sb_period_warning(const sb_scene *scene, const char *what, double period, sb_warning_visit *visit, void *context)
{
    char text[300];
    const sb_scene_waves waves = sb_scene_waves_of(scene);
    const double ratio = waves.regular ? period / waves.period : 1;
    if (!(period > 0) || (ratio > 0.5 && fabs(ratio - round(ratio)) < 0.005 * ratio)) return;
    snprintf(text, sizeof text,
             "%s: %g s is not the period of the waves of %s\"%s\", %.5g s, so that its harmonics are not theirs; "
             "expected that period",
             what, period, waves.maker, waves.name, waves.period);
    visit(context, text);
}

/* The waves of a set that is given against their direction are called reflected. */
static void warn_of_order(const sb_scene *scene, const sb_reflection_set *set, sb_warning_visit *visit, void *context)
{
    const sb_gauge *first = &scene->measure.gauges[sb_scene_gauge(scene, set->gauges[0].name)];
    const sb_gauge *last = &scene->measure.gauges[sb_scene_gauge(scene, set->gauges[set->gauge_count - 1].name)];
    const sb_vec3 line = sb_vec(last->x - first->x, last->y - first->y, 0);
    const char *against = NULL;
    char text[300];
    if (scene->wave.kind != SB_INITIAL_NONE || sb_scene_has_sea(scene)) return; /* other waves */
    for (size_t w = 0; w < scene->wavemaker_count; w++) {
        const sb_wavemaker_use *maker = &scene->wavemakers[w];
        const bool waves = maker->law.kind->needs & (SB_WM_HEIGHT | SB_WM_TRAIN);
        if (!waves || strcmp(maker->law.kind->name, "absorber") == 0) continue;
        if (!(sb_dot(maker->direction, line) < -0.7 * sb_norm(line))) return;
        against = maker->name;
    }
    if (!against) return;
    snprintf(
        text, sizeof text,
        "measure.reflections %s: its gauges run against the waves of \"%s\", which it will call reflected; expected "
        "the gauges in the order in which the waves come to them",
        set->name, against);
    visit(context, text);
}

/* Gauges near multiples of half a wavelength apart cannot tell incident from reflected waves. */
sb_status sb_reflection_warnings(const sb_scene *scene, sb_warning_visit *visit, void *context, sb_error *error)
{
    for (size_t r = 0; r < scene->measure.reflection_count; r++) {
        const sb_reflection_set *set = &scene->measure.reflections[r];
        warn_of_window(scene, set, visit, context);
        warn_of_order(scene, set, visit, context);
        char what[SB_NAME_MAX + 40];
        snprintf(what, sizeof what, "measure.reflections %s: period", set->name);
        sb_period_warning(scene, what, set->period, visit, context);
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
