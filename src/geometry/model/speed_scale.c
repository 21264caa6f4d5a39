/* The speed that pictures show at the upper end of their colours. */
#include "geometry/model/model.h"
#include "physics/waves/dispersion.h"

#include <math.h>

/* Over the greatest speed of linear waves: crests are faster than linear ones, and those before a wall are twice as
   high. */
static const double STEEPER = 3;

/* Greatest speed of the water in a linear wave of the number k, at the surface: a omega / tanh kd, m/s. */
static double orbital_speed(double height, double number, double depth, double gravity)
{
    return 0.5 * height * sqrt(gravity * number / tanh(number * depth));
}

static double speed_of_maker(const sb_wavemaker_parameters *law)
{
    sb_paddle paddle = {0};
    if (!law->kind->facts || sb_paddle_create(law, &paddle, NULL) != SB_OK) return (double)INFINITY;
    const sb_wave_facts *f = law->kind->facts(paddle.state);
    const double speed = f->height > 0 ? orbital_speed(f->height, 2 * M_PI / f->length, law->depth, law->gravity) : 0;
    sb_paddle_destroy(&paddle);
    return speed;
}

/* Greatest speed of the water in the waves of a scene that has only trains of waves; INFINITY: it has others. */
static double speed_of_trains(const sb_scene *scene)
{
    const double gravity = scene->fluid.gravity;
    const sb_given_sea *given = &scene->given;
    const sb_initial_wave *wave = &scene->wave;
    double speed = 0;
    if (scene->box_count > 0) return (double)INFINITY;
    for (size_t w = 0; w < scene->wavemaker_count; w++) speed = fmax(speed, speed_of_maker(&scene->wavemakers[w].law));
    if (given->source != SB_GIVEN_NONE && !(given->source == SB_GIVEN_THEORY && given->wave == SB_GIVEN_REGULAR))
        return (double)INFINITY;
    if (given->source == SB_GIVEN_THEORY)
        speed = fmax(speed, orbital_speed(given->height, sb_wave_number(given->period, given->depth, gravity),
                                          given->depth, gravity));
    if (wave->kind != SB_INITIAL_NONE && wave->kind != SB_INITIAL_REGULAR) return (double)INFINITY;
    if (wave->kind == SB_INITIAL_REGULAR)
        speed = fmax(speed, orbital_speed(wave->height, 2 * M_PI / wave->wavelength, wave->depth, gravity));
    return speed > 0 ? speed : (double)INFINITY;
}

double sb_model_speed_scale(const sb_scene *scene, const sb_model *model)
{
    if (scene->render.speed_max > 0) return scene->render.speed_max;
    return fmin(2 * sb_model_wave_speed(scene, model), STEEPER * speed_of_trains(scene));
}
