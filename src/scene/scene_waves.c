#include "scene/scene_waves.h"

#include "physics/waves/cnoidal.h"
#include "physics/waves/steady_wave.h"
#include "scene/reader.h"

#include <math.h>
#include <string.h>

static const double SAME = 0.005;

typedef struct waves_found {
    sb_scene_waves waves;
    bool differ;
} waves_found;

static bool same(double a, double b)
{
    return fabs(a / b - 1) < SAME;
}

static void add(waves_found *found, sb_scene_waves waves)
{
    if (!(waves.period > 0)) return;
    const bool first = !(found->waves.period > 0);
    found->differ |= !first && !(same(found->waves.period, waves.period) && same(found->waves.depth, waves.depth));
    if (first) found->waves = waves;
}

sb_scene_waves sb_waves_of_maker(const sb_wavemaker_use *maker)
{
    const sb_wavemaker_parameters *law = &maker->law;
    sb_scene_waves waves = {.maker = "", .name = maker->name, .period = law->period, .depth = law->depth, .law = law};
    waves.regular = strcmp(law->kind->name, "regular") == 0;
    sb_paddle paddle = {0};
    if (!law->kind->facts || strcmp(law->kind->name, "absorber") == 0) return (sb_scene_waves){0};
    if (law->kind->needs & SB_WM_PERIOD) return waves;
    if (sb_paddle_create(law, &paddle, NULL) != SB_OK) return (sb_scene_waves){0};
    waves.period = law->kind->facts(paddle.state)->period;
    sb_paddle_destroy(&paddle);
    return waves;
}

sb_scene_waves sb_scene_waves_of(const sb_scene *scene)
{
    const sb_given_sea *sea = &scene->given;
    const sb_initial_wave *start = &scene->wave;
    waves_found found = {0};
    for (size_t w = 0; w < scene->wavemaker_count; w++) add(&found, sb_waves_of_maker(&scene->wavemakers[w]));
    if (sea->source == SB_GIVEN_THEORY && sea->wave == SB_GIVEN_REGULAR)
        add(&found, (sb_scene_waves){"block ", "sea", sea->period, sea->depth, true, NULL});
    if (start->kind == SB_INITIAL_REGULAR)
        add(&found, (sb_scene_waves){"block ", "water.wave", start->wavelength / start->stokes.celerity, start->depth,
                                     true, NULL});
    return found.differ ? (sb_scene_waves){0} : found.waves;
}

sb_flume_length sb_flume_length_of(const sb_wavemaker_parameters *law, double depth)
{
    sb_steady_wave wave;
    sb_cnoidal cnoidal;
    if (sb_steady_wave_of(law->height, law->period, depth, law->gravity, &wave))
        return (sb_flume_length){wave.length, 0.005};
    const bool found = sb_cnoidal_of_period(law->height, law->period, depth, law->gravity, &cnoidal, NULL) == SB_OK;
    return (sb_flume_length){found ? cnoidal.length : (double)NAN, 0.04};
}

sb_status sb_reader_period(sb_reader *reader, const sb_yaml *map, bool regular, double *period, double *depth)
{
    const bool no_period = !sb_yaml_child(map, "period"), no_depth = !sb_yaml_child(map, "depth");
    if (!no_period && !no_depth) return SB_OK;
    const sb_scene_waves waves = sb_scene_waves_of(reader->scene);
    const bool known = waves.period > 0 && (waves.regular || !regular);
    if ((no_period && !known) || (no_depth && !(waves.period > 0)))
        return sb_reader_fail(reader, map, NULL,
                              "%s is missing, and the scene has no %swaves that it could be that of, expected %s > 0",
                              no_period && !known ? "period" : "depth", regular ? "regular " : "",
                              no_period && !known ? "seconds" : "metres");
    if (no_period) *period = waves.period;
    if (no_depth) *depth = waves.depth;
    return SB_OK;
}
