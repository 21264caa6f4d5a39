#include "app/check/wave_warnings.h"

#include "base/memory.h"
#include "base/per_cent.h"
#include "physics/wavemakers/wavemaker.h"
#include "physics/waves/dispersion.h"
#include "physics/waves/regular_wave.h"
#include "physics/waves/steady_wave.h"
#include "scene/scene_waves.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Part of a focused crest that must be able to come in time. */
static const double ENOUGH = 0.9;

/* Waves that focus: each leaves the paddle at `focus` less its time of travel. */
typedef struct group {
    size_t count;
    double *amplitude, *travel; /* any unit; s */
    double ramp, lasts;         /* s */
} group;

/* Part of the crest that comes in time, with the motion that the paddle has when each wave leaves. */
static double share_in_time(const group *g, double focus)
{
    double sum = 0, all = 0;
    for (size_t i = 0; i < g->count; i++) {
        const double left = focus - g->travel[i], until = fmin(left, g->lasts - left);
        const double s = g->ramp > 0 ? fmin(until / g->ramp, 1) : until >= 0;
        all += g->amplitude[i];
        if (s > 0) sum += g->amplitude[i] * s * s * (3 - 2 * s);
    }
    return sum / all;
}

static group without_end(const group *g)
{
    return (group){g->count, g->amplitude, g->travel, g->ramp, (double)INFINITY};
}

/* Rounded up to three digits, so that the value shown is enough. */
static double shown_above(double value)
{
    const double unit = value > 0 ? pow(10, floor(log10(value)) - 2) : 1;
    return ceil(value / unit * (1 - 1e-12)) * unit;
}

/* The share of a motion without end grows with the time, and is 1 after the ramp and the longest travel. */
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
    char text[500], part[32];
    const double share = share_in_time(g, maker->law.focus);
    if (share >= ENOUGH) return;
    const group endless = without_end(g);
    if (share_in_time(&endless, maker->law.focus) >= ENOUGH) {
        snprintf(
            text, sizeof text,
            "wave maker \"%s\": its motion ends after %g s: by then waves with %s of the crest that is to focus at "
            "%g s have left; expected an earlier focus, or a motion that lasts longer",
            maker->name, g->lasts, sb_per_cent(share, part), maker->law.focus);
        visit(context, text);
        return;
    }
    snprintf(text, sizeof text,
             "wave maker \"%s\": its focus at %g s is too early: by their group speeds waves with %s of the crest "
             "come %g m far by then; expected a focus of at least %.4g s, or a shorter distance",
             maker->name, maker->law.focus, sb_per_cent(share, part), maker->law.distance,
             shown_above(earliest_focus(&endless)));
    visit(context, text);
}

static sb_status visit_group(const sb_wavemaker_use *maker, const sb_paddle *paddle, sb_warning_visit *visit,
                             void *context, sb_error *error)
{
    const sb_wavemaker_parameters *law = &maker->law;
    size_t count;
    sb_band_part *band = sb_paddle_band(paddle, &count);
    group g = {.count = count,
               .amplitude = sb_alloc(count, sizeof *g.amplitude),
               .travel = sb_alloc(count, sizeof *g.travel),
               .ramp = paddle->kind->facts(paddle->state)->ramp,
               .lasts = law->lasts};
    const bool made = band && g.amplitude && g.travel;
    for (size_t i = 0; made && i < count; i++) {
        const double k = sb_wave_number(2 * M_PI / band[i].omega, law->depth, law->gravity);
        g.amplitude[i] = sqrt(band[i].weight);
        g.travel[i] = law->distance / sb_group_speed(band[i].omega, k, law->depth);
    }
    if (made) warn_of_focus(maker, &g, visit, context);
    sb_free(band);
    sb_free(g.amplitude);
    sb_free(g.travel);
    return made ? SB_OK : sb_fail_memory(error, "a wave maker");
}

/* The paddle of a linear sum does not make the waves that are bound to its groups and crests, which are high in shallow
   water. Regular waves have theories for shallow water, and a warning of their own. */
static void warn_of_long_waves(const sb_wavemaker_use *maker, const sb_paddle *paddle, sb_warning_visit *visit,
                               void *context)
{
    char text[400];
    const sb_wave_facts *facts = maker->law.kind->facts(paddle->state);
    if (maker->law.kind->needs & SB_WM_THEORY || facts->ursell < SB_URSELL_LIMIT) return;
    snprintf(text, sizeof text,
             "wave maker \"%s\": its waves are linear, but H L^2/d^3 = %.4g is above %.3g: free long waves and free "
             "waves of twice the frequency will come with them; expected lower or shorter waves, or deeper water",
             maker->name, facts->ursell, SB_URSELL_LIMIT);
    visit(context, text);
}

/* Relative error of the length from which a wave of cnoidal theory counts as another than the steady wave. */
static const double CNOIDAL_ERROR = 0.01;

/* kd from which that error says that a wave is too short; below it, that it is high. */
static const double MIDDLE = 0.5;

/* High waves of middle depth are beyond second-order theory, and still too short for cnoidal theory. */
static void warn_of_middle_waves(const sb_wavemaker_use *maker, sb_warning_visit *visit, void *context)
{
    char text[400];
    const sb_wavemaker_parameters *law = &maker->law;
    sb_regular_wave wave;
    sb_steady_wave steady;
    if (!(law->kind->needs & SB_WM_THEORY) || law->theory != SB_WAVE_AUTO || law->motion != SB_PADDLE_PISTON) return;
    if (sb_regular_wave_create(law->theory, law->height, law->period, law->depth, law->gravity, &wave, NULL) != SB_OK)
        return;
    if (wave.order != SB_WAVE_CNOIDAL || wave.number * law->depth < MIDDLE) return;
    if (!sb_steady_wave_of(law->height, law->period, law->depth, law->gravity, &steady)) return;
    if (fabs(wave.length / steady.length - 1) < CNOIDAL_ERROR) return;
    snprintf(
        text, sizeof text,
        "wave maker \"%s\": its waves are too high for second-order theory and too short for cnoidal theory, which "
        "is used: their length is %.4g m, that of the steady wave %.4g m, and free waves will come with them; "
        "expected lower or longer waves, or deeper water",
        maker->name, wave.length, steady.length);
    visit(context, text);
}

/* Cnoidal theory is one of long waves: its short ones are several per cent too short. */
static void warn_of_short_waves(const sb_wavemaker_use *maker, sb_warning_visit *visit, void *context)
{
    char text[400];
    const sb_wavemaker_parameters *law = &maker->law;
    sb_regular_wave wave;
    if (!(law->kind->needs & SB_WM_THEORY) || law->theory != SB_WAVE_CNOIDAL) return;
    if (sb_regular_wave_create(law->theory, law->height, law->period, law->depth, law->gravity, &wave, NULL) != SB_OK)
        return;
    if (wave.ursell >= SB_URSELL_LIMIT) return;
    snprintf(text, sizeof text,
             "wave maker \"%s\": theory cnoidal is for long waves, and H L^2/d^3 of linear theory is %.4g, below %.3g: "
             "the waves will differ from the theory in length and form; expected theory: auto or second-order",
             maker->name, wave.ursell, SB_URSELL_LIMIT);
    visit(context, text);
}

static void warn_of_start(const sb_scene *scene, const sb_wavemaker_use *maker, sb_warning_visit *visit, void *context)
{
    char text[300];
    if (isinf(maker->law.start) || maker->law.start < scene->duration) return;
    snprintf(
        text, sizeof text,
        "wave maker \"%s\": it begins at %g s, and the run ends at %g s: it makes no waves; expected an earlier start "
        "or a longer duration",
        maker->name, maker->law.start, scene->duration);
    visit(context, text);
}

static void warn_of_late_focus(const sb_scene *scene, const sb_wavemaker_use *maker, sb_warning_visit *visit,
                               void *context)
{
    char text[300];
    const sb_wavemaker_parameters *law = &maker->law;
    if (isinf(law->start) || law->start >= scene->duration || law->start + law->focus <= scene->duration) return;
    snprintf(
        text, sizeof text,
        "wave maker \"%s\": its waves focus at %g s, after the end of the run at %g s; expected an earlier focus or "
        "a longer duration",
        maker->name, law->start + law->focus, scene->duration);
    visit(context, text);
}

/* A motion grows over the ramp, and falls over the ramp before its end. duration: of the paddle's motion, s. */
static void warn_of_ramp(const sb_scene *scene, const sb_wavemaker_use *maker, double duration, sb_warning_visit *visit,
                         void *context)
{
    char text[400];
    const sb_wavemaker_parameters *law = &maker->law;
    const double left = isinf(law->start) ? (double)INFINITY : scene->duration - law->start;
    const double most = fmin(0.5 * duration, left);
    if (strcmp(law->kind->name, "absorber") == 0) return;
    if (!(law->ramp > 0) || !(left > 0) || law->ramp <= most * (1 + 1e-9)) return;
    const double s = most / law->ramp, reached = 100 * s * s * (3 - 2 * s);
    if (left < 0.5 * duration)
        snprintf(
            text, sizeof text,
            "wave maker \"%s\": its motion has a ramp of %g s, and the run ends after %.4g s of it: it reaches %.2g %% "
            "of the full motion; expected a shorter ramp, or a longer duration",
            maker->name, law->ramp, left, reached);
    else
        snprintf(
            text, sizeof text,
            "wave maker \"%s\": its motion lasts %.4g s, with a ramp of %g s at the start and at the end: it reaches "
            "%.2g %% of the full motion; expected a motion of more than %g s, or a shorter ramp",
            maker->name, duration, law->ramp, reached, 2 * law->ramp);
    visit(context, text);
}

/* Waves of a signal leave the paddle before they come to its distance: what the file has before the first of them comes
   is lost. */
static void warn_of_way(const sb_wavemaker_use *maker, const sb_paddle *paddle, sb_warning_visit *visit, void *context)
{
    enum { SAMPLES = 400 };
    static const double lost = 0.02;
    char text[400], part[32];
    const sb_wavemaker_parameters *law = &maker->law;
    const sb_wave_facts *facts = law->kind->facts(paddle->state);
    const double omega = 2 * M_PI / facts->period, number = sb_wave_number(facts->period, law->depth, law->gravity);
    const double way = law->distance / sb_group_speed(omega, number, law->depth);
    double early = 0, all = 0;
    law->kind->place(paddle->state, law->distance);
    for (int i = 0; i < SAMPLES; i++) {
        const double t = paddle->duration * (i + 0.5) / SAMPLES, z = law->kind->surface(paddle->state, t);
        all += z * z;
        if (t < way) early += z * z;
    }
    if (!(early > lost * all)) return;
    snprintf(
        text, sizeof text,
        "wave maker \"%s\": %s of the energy of its file is in the first %.3g s, and waves of %.3g s take that "
        "long for the %g m: they do not come; expected still water before the first waves of the file, or a shorter "
        "distance",
        maker->name, sb_per_cent(early / all, part), way, facts->period, law->distance);
    visit(context, text);
}

/* Waves of periods longer than these of the highest wave count as slow, and a paddle that they move more than all
   others do although they have less than this share of the energy follows the drift of a gauge rather than waves. */
static const double SLOW = 8, SLOW_ENERGY = 0.1;

static sb_status warn_of_slow(const sb_wavemaker_use *maker, const sb_paddle *paddle, sb_warning_visit *visit,
                              void *context, sb_error *error)
{
    char text[400], part[32];
    const sb_wavemaker_parameters *law = &maker->law;
    const double from = SLOW * law->kind->facts(paddle->state)->period;
    double energy[2] = {0}, motion[2] = {0}; /* of all other waves, and of slow ones */
    size_t count;
    sb_band_part *band = sb_paddle_band(paddle, &count);
    if (!band) return sb_fail_memory(error, "a wave maker");
    for (size_t i = 0; i < count; i++) {
        const double period = 2 * M_PI / band[i].omega, number = sb_wave_number(period, law->depth, law->gravity);
        const bool slow = period > from;
        energy[slow] += band[i].weight;
        motion[slow] += band[i].weight / pow(sb_paddle_gain(law->motion, number, law->depth), 2);
    }
    sb_free(band);
    const double share = energy[1] / (energy[0] + energy[1]);
    if (!(motion[1] > motion[0]) || !(share < SLOW_ENERGY)) return SB_OK;
    snprintf(text, sizeof text,
             "wave maker \"%s\": waves of more than %.3g s have %s of the energy of its file and move the paddle by "
             "%.3g m (two standard deviations), all others by %.3g m; expected a surface without the drift of its "
             "gauge, unless these are waves",
             maker->name, from, sb_per_cent(share, part), sqrt(2 * motion[1]), sqrt(2 * motion[0]));
    visit(context, text);
    return SB_OK;
}

/* An absorber knows one period. */
static void warn_of_absorber(const sb_scene *scene, const sb_wavemaker_use *absorber, sb_warning_visit *visit,
                             void *context)
{
    sb_scene_waves other = {0};
    char text[300];
    for (size_t w = 0; w < scene->wavemaker_count; w++) {
        const sb_scene_waves waves = sb_waves_of_maker(&scene->wavemakers[w]);
        if (!(waves.period > 0)) continue;
        if (fabs(absorber->law.period / waves.period - 1) < 0.1) return;
        other = waves;
    }
    if (!(other.period > 0)) return;
    snprintf(
        text, sizeof text,
        "wave maker \"%s\": it absorbs waves of %g s, and those of \"%s\" have %g s: it reflects more of them than "
        "predicted; expected period: %g",
        absorber->name, absorber->law.period, other.name, other.period, other.period);
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
        if (strcmp(maker->law.kind->name, "absorber") == 0) warn_of_absorber(scene, maker, visit, context);
        if (!(needs & SB_WM_TRAIN)) continue;
        status = sb_paddle_create(&maker->law, &paddle, error);
        if (status == SB_OK) warn_of_ramp(scene, maker, paddle.duration, visit, context);
        if (status == SB_OK) warn_of_long_waves(maker, &paddle, visit, context);
        if (status == SB_OK) warn_of_short_waves(maker, visit, context);
        if (status == SB_OK) warn_of_middle_waves(maker, visit, context);
        if (status == SB_OK && needs & SB_WM_FOCUS) warn_of_late_focus(scene, maker, visit, context);
        if (status == SB_OK && needs & SB_WM_FOCUS) status = visit_group(maker, &paddle, visit, context, error);
        if (status == SB_OK && needs & SB_WM_FILE && needs & SB_WM_DISTANCE)
            warn_of_way(maker, &paddle, visit, context);
        if (status == SB_OK && needs & SB_WM_FILE) status = warn_of_slow(maker, &paddle, visit, context, error);
        sb_paddle_destroy(&paddle);
    }
    return status;
}
