/* Warns of sponges that begin outside of the domain, of those that overlap, and of those that reflect. */
#include "app/check/zones.h"

#include "base/per_cent.h"
#include "physics/absorption/sponge.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct zone {
    double from, to; /* m, along its axis, within the domain */
} zone;

/* Where a sponge slows water down: from its beginning to the side. */
static zone zone_of(const sb_scene *scene, const sb_sponge *sponge)
{
    const int axis = sponge->side / 2;
    const double low = sb_component(scene->domain.min, axis), high = sb_component(scene->domain.max, axis);
    return sponge->side % 2 ? (zone){fmax(sponge->end - sponge->length, low), high}
                            : (zone){low, fmin(sponge->end + sponge->length, high)};
}

static void warn_of_beginning(const sb_scene *scene, const sb_sponge *sponge, sb_warning_visit *visit, void *context)
{
    char text[400];
    const int axis = sponge->side / 2;
    const bool upper = sponge->side % 2;
    const double side = sb_component(upper ? scene->domain.min : scene->domain.max, axis);
    const double most = fabs(sponge->end - side), from = sponge->end + (upper ? -sponge->length : sponge->length);
    if (sponge->length <= most * (1 + 1e-9)) return;
    snprintf(text, sizeof text,
             "sponge \"%s\": it begins at %c = %.4g m, outside of the domain, so that its strength does not grow from "
             "0 there, and the predicted reflection is not that of what is left; expected a length of at most %.4g m",
             sponge->name, "xy"[axis], from, most);
    visit(context, text);
}

static void warn_of_overlap(const sb_scene *scene, const sb_sponge *a, const sb_sponge *b, sb_warning_visit *visit,
                            void *context)
{
    char text[400];
    if (a->side / 2 != b->side / 2) return;
    const zone one = zone_of(scene, a), other = zone_of(scene, b);
    const double from = fmax(one.from, other.from), to = fmin(one.to, other.to);
    if (!(to - from > 1e-9 * (one.to - one.from))) return;
    snprintf(text, sizeof text,
             "sponges \"%s\" and \"%s\" overlap from %c = %.4g to %.4g m: their strengths add there, and the predicted "
             "reflections are those of each alone; expected one sponge, or zones apart",
             a->name, b->name, "xy"[a->side / 2], from, to);
    visit(context, text);
}

/* Whether waves of a wave maker run towards the sponge's side. An absorber makes none. */
static bool run_to(const sb_wavemaker_use *maker, const sb_sponge *sponge)
{
    if (strcmp(maker->law.kind->name, "absorber") == 0) return false;
    const double along = sb_component(maker->direction, sponge->side / 2);
    return (sponge->side % 2 ? along : -along) > 0.7;
}

/* Period of the waves of a wave maker, at the peak of sums, s; 0: it makes no wave train. */
static double period_of(const sb_wavemaker_use *maker)
{
    sb_paddle paddle = {0};
    if (!maker->law.kind->facts || sb_paddle_create(&maker->law, &paddle, NULL) != SB_OK) return 0;
    const double period = maker->law.kind->facts(paddle.state)->period;
    sb_paddle_destroy(&paddle);
    return period;
}

double sb_zone_viscosity(const sb_scene *scene, const sb_sponge *sponge, double sound)
{
    if (sponge->kind != SB_SPONGE_VISCOUS) return 0;
    return sb_sponge_viscosity(sponge->alpha, scene->numerics.support * scene->resolution, sound, scene->dimensions);
}

double sb_zone_reflection(const sb_scene *scene, const sb_sponge *sponge, double period, double sound)
{
    const double omega = 2 * M_PI / period, gravity = scene->fluid.gravity;
    if (sponge->kind == SB_SPONGE_DAMPING)
        return sb_sponge_reflection(sponge->profile, sponge->strength, omega, sponge->depth, gravity, sponge->length);
    return sb_sponge_viscous_reflection(sponge->profile, sb_zone_viscosity(scene, sponge, sound), omega, sponge->depth,
                                        gravity, sponge->length);
}

/* A sponge made for other waves than those that run to it, or too short or too strong for them. */
static void warn_of_reflection(const sb_scene *scene, const sb_sponge *sponge, double sound, sb_warning_visit *visit,
                               void *context)
{
    static const double most = 0.2;
    char text[400], reflected[32];
    for (size_t w = 0; w < scene->wavemaker_count; w++) {
        if (!run_to(&scene->wavemakers[w], sponge)) continue;
        const double period = period_of(&scene->wavemakers[w]);
        if (!(period > 0)) continue;
        const double share = sb_zone_reflection(scene, sponge, period, sound);
        if (!(share > most)) continue;
        snprintf(text, sizeof text,
                 "sponge \"%s\": by linear theory it reflects %s of waves of %.4g s, those of \"%s\"; expected a "
                 "longer sponge, %s",
                 sponge->name, sb_per_cent(share, reflected), period, scene->wavemakers[w].name,
                 sponge->kind == SB_SPONGE_DAMPING ? "that period, or the strength that follows from it"
                                                   : "or another alpha");
        visit(context, text);
    }
}

/* What a sponge takes between two gauges of a split would seem to be reflected. */
static void warn_of_gauges(const sb_scene *scene, const sb_sponge *sponge, sb_warning_visit *visit, void *context)
{
    const zone z = zone_of(scene, sponge);
    char text[400];
    for (size_t r = 0; r < scene->measure.reflection_count; r++) {
        const sb_reflection_set *set = &scene->measure.reflections[r];
        for (size_t i = 0; i < set->gauge_count; i++) {
            const sb_gauge *gauge = &scene->measure.gauges[sb_scene_gauge(scene, set->gauges[i].name)];
            const double at = sponge->side / 2 == 0 ? gauge->x : gauge->y;
            if (!(at > z.from + 0.05 * sponge->length && at < z.to - 0.05 * sponge->length)) continue;
            snprintf(
                text, sizeof text,
                "measure.reflections %s: gauge \"%s\" is in the sponge \"%s\", from %c = %.4g to %.4g m: waves that "
                "the sponge takes seem to be reflected; expected gauges outside of the sponge",
                set->name, gauge->name, sponge->name, "xy"[sponge->side / 2], z.from, z.to);
            visit(context, text);
            break;
        }
    }
}

/* Waves of a sea come in through the side at which the sponge is strongest. */
static void warn_of_sea(const sb_scene *scene, const sb_sponge *sponge, sb_warning_visit *visit, void *context)
{
    char text[300];
    if (!sb_scene_given_side(scene, sponge->side)) return;
    snprintf(text, sizeof text,
             "sponge \"%s\": the waves of the sea come in through %s, where it is strongest: it takes them; expected "
             "the sponge at another side",
             sponge->name, sb_side_names[sponge->side]);
    visit(context, text);
}

void sb_zone_warnings(const sb_scene *scene, double sound, sb_warning_visit *visit, void *context)
{
    for (size_t s = 0; s < scene->sponge_count; s++) {
        warn_of_beginning(scene, &scene->sponges[s], visit, context);
        warn_of_reflection(scene, &scene->sponges[s], sound, visit, context);
        warn_of_gauges(scene, &scene->sponges[s], visit, context);
        warn_of_sea(scene, &scene->sponges[s], visit, context);
        for (size_t t = 0; t < s; t++) warn_of_overlap(scene, &scene->sponges[t], &scene->sponges[s], visit, context);
    }
}
