#include "app/wave_warnings.h"

#include "base/memory.h"
#include "physics/dispersion.h"
#include "physics/wavemaker.h"

#include <math.h>
#include <stdio.h>

/* Part of a focused crest that must be able to come in time. */
static const double ENOUGH = 0.9;

/* Waves that focus: each leaves the paddle at `focus` less its time of travel. */
typedef struct group {
    size_t count;
    double *amplitude, *travel; /* any unit; s */
    double ramp;                /* s */
} group;

/* Part of the crest that comes in time, with the motion that the paddle has when each wave leaves. */
static double share_in_time(const group *g, double focus)
{
    double sum = 0, all = 0;
    for (size_t i = 0; i < g->count; i++) {
        const double left = focus - g->travel[i], s = g->ramp > 0 ? fmin(left / g->ramp, 1) : left >= 0;
        all += g->amplitude[i];
        if (s > 0) sum += g->amplitude[i] * s * s * (3 - 2 * s);
    }
    return sum / all;
}

/* The share grows with the time, and is 1 after the ramp and the longest travel. */
static double earliest_focus(const group *g)
{
    double low = 0, high = 0;
    for (size_t i = 0; i < g->count; i++) high = fmax(high, g->travel[i] + g->ramp);
    for (int i = 0; i < 60; i++) {
        const double middle = 0.5 * (low + high);
        if (share_in_time(g, middle) < ENOUGH)
            low = middle;
        else
            high = middle;
    }
    return high;
}

static void warn_of_focus(const sb_wavemaker_use *maker, const group *g, sb_warning_visit *visit, void *context)
{
    char text[500];
    const double share = share_in_time(g, maker->law.focus);
    if (share >= ENOUGH) return;
    snprintf(text, sizeof text,
             "wave maker \"%s\": its focus at %g s is too early: by their group speeds waves with %.2g %% of the crest "
             "come %g m far by then; expected a focus of at least %.3g s, or a shorter distance",
             maker->name, maker->law.focus, 100 * share, maker->law.distance, earliest_focus(g));
    visit(context, text);
}

static sb_status visit_group(const sb_wavemaker_use *maker, const sb_paddle *paddle, sb_warning_visit *visit,
                             void *context, sb_error *error)
{
    const sb_wavemaker_parameters *law = &maker->law;
    const sb_wave_facts *facts = paddle->kind->facts(paddle->state);
    sb_band_part *band = sb_alloc(facts->count, sizeof *band);
    group g = {.amplitude = sb_alloc(facts->count, sizeof *g.amplitude),
               .travel = sb_alloc(facts->count, sizeof *g.travel),
               .ramp = facts->ramp};
    const bool made = band && g.amplitude && g.travel;
    if (made) {
        g.count = paddle->kind->band(paddle->state, band, facts->count);
        for (size_t i = 0; i < g.count; i++) {
            g.amplitude[i] = sqrt(band[i].weight);
            const double k = sb_wave_number(2 * M_PI / band[i].omega, law->depth, law->gravity);
            g.travel[i] = law->distance / sb_group_speed(band[i].omega, k, law->depth);
        }
        warn_of_focus(maker, &g, visit, context);
    }
    sb_free(band);
    sb_free(g.amplitude);
    sb_free(g.travel);
    return made ? SB_OK : sb_fail_memory(error, "a wave maker");
}

/* Extent of the domain along a direction, m. */
static double extent_along(const sb_domain *domain, sb_vec3 direction)
{
    const sb_vec3 size = sb_sub(domain->max, domain->min);
    return fabs(direction.x) * size.x + fabs(direction.y) * size.y + fabs(direction.z) * size.z;
}

static void warn_of_distance(const sb_scene *scene, const sb_wavemaker_use *maker, sb_warning_visit *visit,
                             void *context)
{
    char text[400];
    const double extent = extent_along(&scene->domain, maker->direction);
    if (maker->law.distance <= extent) return;
    snprintf(text, sizeof text,
             "wave maker \"%s\": its distance of %g m is outside of the domain, which is %.4g m long along the "
             "direction: the waves never come there; expected a shorter distance or a longer domain",
             maker->name, maker->law.distance, extent);
    visit(context, text);
}

static void warn_of_start(const sb_scene *scene, const sb_wavemaker_use *maker, sb_warning_visit *visit, void *context)
{
    char text[300];
    if (isinf(maker->law.start) || maker->law.start < scene->duration) return;
    snprintf(
        text, sizeof text,
        "wave maker \"%s\": it begins at %g s, and the run ends at %g s: it never moves; expected an earlier start "
        "or a longer duration",
        maker->name, maker->law.start, scene->duration);
    visit(context, text);
}

/* A motion grows over the ramp and falls over the ramp before its end. */
static void warn_of_ramp(const sb_wavemaker_use *maker, sb_warning_visit *visit, void *context)
{
    char text[400];
    const sb_wavemaker_parameters *law = &maker->law;
    if (!(law->kind->needs & SB_WM_TRAIN) || law->lasts >= 2 * law->ramp) return;
    const double s = 0.5 * law->lasts / law->ramp;
    snprintf(
        text, sizeof text,
        "wave maker \"%s\": its motion lasts %g s, with a ramp of %g s at the start and at the end: it reaches %.2g %% "
        "of the full motion; expected lasts of more than %g s, or a shorter ramp",
        maker->name, law->lasts, law->ramp, 100 * s * s * (3 - 2 * s), 2 * law->ramp);
    visit(context, text);
}

sb_status sb_wave_warnings(const sb_scene *scene, sb_warning_visit *visit, void *context, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t w = 0; w < scene->wavemaker_count && status == SB_OK; w++) {
        const sb_wavemaker_use *maker = &scene->wavemakers[w];
        const unsigned needs = maker->law.kind->needs;
        sb_paddle paddle = {0};
        warn_of_start(scene, maker, visit, context);
        warn_of_ramp(maker, visit, context);
        if (needs & SB_WM_DISTANCE) warn_of_distance(scene, maker, visit, context);
        if (!(needs & SB_WM_FOCUS)) continue;
        status = sb_paddle_create(&maker->law, &paddle, error);
        if (status == SB_OK) status = visit_group(maker, &paddle, visit, context, error);
        sb_paddle_destroy(&paddle);
    }
    return status;
}
