#include "app/check/warnings.h"

#include "app/check/measures.h"
#include "app/check/numerics.h"
#include "app/check/reflections.h"
#include "app/check/sea.h"
#include "app/check/tension.h"
#include "app/check/wave_warnings.h"
#include "app/check/zones.h"
#include "physics/wavemakers/wavemaker.h"
#include "sim/sim.h"

#include <math.h>
#include <stdio.h>

/* Values of other units than those of the keys: g/cm^3, cm/s^2 and Pa s are the usual ones. */
static void warn_of_fluid(const sb_scene *scene, sb_warning_visit *visit, void *context)
{
    const sb_fluid_properties *fluid = &scene->fluid;
    const struct {
        const char *key, *unit, *expected;
        double value, least, most;
    } rows[] = {
        {"density", "kg/m3", "1000 for fresh water, 1025 for the sea", fluid->density, 500, 3000},
        {"gravity", "m/s2", "9.81", fluid->gravity, 1, 30},
        {"viscosity", "m2/s", "1e-6 for water; it is the kinematic one, not that in Pa s", fluid->viscosity, 0, 5e-4},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[300];
        if (rows[i].value >= rows[i].least && rows[i].value <= rows[i].most) continue;
        snprintf(text, sizeof text, "fluid.%s: %g %s is that of no water; expected %s", rows[i].key, rows[i].value,
                 rows[i].unit, rows[i].expected);
        visit(context, text);
    }
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
    warn_of_fluid(scene, visit, context);
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
    if (status == SB_OK) status = sb_reflection_warnings(scene, visit, context, error);
    sb_numerics_warnings(scene, visit, context);
    sb_tension_warnings(scene, visit, context);
    sb_period_warning(scene, "measure.waves.period", scene->measure.waves.period, visit, context);
    sb_measure_warnings(scene, visit, context);
    sb_sea_warnings(scene, visit, context);
    sb_breaking_warnings(scene, visit, context);
    if (scene->measure.interval > scene->duration) {
        snprintf(text, sizeof text,
                 "measure.interval: %g s is longer than the run of %g s: forces.csv gets no row, and the other tables "
                 "only the row at t = 0",
                 scene->measure.interval, scene->duration);
        visit(context, text);
    }
    return status;
}

/* Walls that reflect water and have more facets than the simulation can handle. */
static sb_status warn_of_crowding(const sb_scene *scene, const sb_model *model, sb_warning_visit *visit, void *context,
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

sb_status sb_model_warnings(const sb_scene *scene, const sb_model *model, sb_warning_visit *visit, void *context,
                            sb_error *error)
{
    if (scene->sponge_count > 0) sb_zone_warnings(scene, sb_sim_sound_speed(scene, model), visit, context);
    return warn_of_crowding(scene, model, visit, context, error);
}
