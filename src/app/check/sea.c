#include "app/check/sea.h"

#include "base/per_cent.h"
#include "physics/wavemakers/wavemaker.h"
#include "physics/waves/breaking.h"
#include "physics/waves/dispersion.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Over the height at which waves break: regular waves are lower than theory on their way from about here on. */
static const double NEARLY = 0.8;

/* Over the significant height: the highest of some hundred waves (Rayleigh). */
static const double HIGHEST = 1.5;

void sb_sea_warnings(const sb_scene *scene, sb_warning_visit *visit, void *context)
{
    char text[300];
    const sb_given_sea *given = &scene->given;
    const double left = scene->duration - given->start;
    if (given->source != SB_GIVEN_THEORY) return;
    if (!(left > 0)) {
        snprintf(
            text, sizeof text,
            "sea.start: %g s is not before the end of the run at %g s: no waves come in; expected an earlier start "
            "or a longer duration",
            given->start, scene->duration);
        visit(context, text);
    } else if (given->ramp > left) {
        snprintf(
            text, sizeof text,
            "sea.ramp: the waves grow over %g s, and the run ends after %.4g s of it; expected a shorter ramp or a "
            "longer duration",
            given->ramp, left);
        visit(context, text);
    }
}

/* what: of the waves, with its colon. */
static void warn_of_height(const char *what, double height, double number, double depth, bool regular,
                           sb_warning_visit *visit, void *context)
{
    char text[400], share[32];
    const double most = sb_breaking_height(number, depth), reached = (regular ? height : HIGHEST * height) / most;
    if (!(reached > (regular ? NEARLY : 1))) return;
    if (regular)
        snprintf(text, sizeof text,
                 "%s a height of %g m is %s of that at which such waves break: they may break on their way, and come "
                 "out lower; expected at most %.3g m",
                 what, height, sb_per_cent(reached, share), sb_breaking_shown(NEARLY * most));
    else
        snprintf(text, sizeof text,
                 "%s the highest waves, %g times as high as the significant height of %g m, break: the significant "
                 "height falls on their way; expected at most %.3g m",
                 what, HIGHEST, height, sb_breaking_shown(most / HIGHEST));
    visit(context, text);
}

/* A signal's waves are known: what its file has must come out. */
static void warn_of_highest(const char *what, double highest, double number, double depth, sb_warning_visit *visit,
                            void *context)
{
    char text[400];
    const double most = sb_breaking_height(number, depth);
    if (!(highest > NEARLY * most)) return;
    snprintf(
        text, sizeof text,
        "%s the highest wave of its file, %.3g m, may break on its way: waves of the file's period break at %.3g m; "
        "expected at most %.3g m",
        what, highest, sb_breaking_shown(most), sb_breaking_shown(NEARLY * most));
    visit(context, text);
}

static void warn_of_maker(const sb_wavemaker_use *maker, sb_warning_visit *visit, void *context)
{
    char what[SB_NAME_MAX + 32];
    sb_paddle paddle = {0};
    if (!maker->law.kind->facts || sb_paddle_create(&maker->law, &paddle, NULL) != SB_OK) return;
    const sb_wave_facts *f = maker->law.kind->facts(paddle.state);
    const bool regular = strcmp(f->height_name, "height") == 0;
    snprintf(what, sizeof what, "wave maker \"%s\":", maker->name);
    /* waves that focus are meant to be steep where they do */
    if (f->highest > 0)
        warn_of_highest(what, f->highest, 2 * M_PI / f->length, maker->law.depth, visit, context);
    else if (f->height > 0 && (regular || strcmp(f->height_name, "significant height") == 0))
        warn_of_height(what, f->height, 2 * M_PI / f->length, maker->law.depth, regular, visit, context);
    sb_paddle_destroy(&paddle);
}

void sb_breaking_warnings(const sb_scene *scene, sb_warning_visit *visit, void *context)
{
    const sb_given_sea *given = &scene->given;
    const sb_initial_wave *wave = &scene->wave;
    for (size_t w = 0; w < scene->wavemaker_count; w++) warn_of_maker(&scene->wavemakers[w], visit, context);
    if (given->source == SB_GIVEN_THEORY && given->wave == SB_GIVEN_REGULAR)
        warn_of_height("sea:", given->height, sb_wave_number(given->period, given->depth, scene->fluid.gravity),
                       given->depth, true, visit, context);
    if (wave->kind == SB_INITIAL_REGULAR)
        warn_of_height("water.wave:", wave->height, 2 * M_PI / wave->wavelength, wave->depth, true, visit, context);
}
