/* Warns of a speed of sound at which weakly compressible water is compressed much, and refuses one without sense. */
#include "geometry/model/parts.h"

#include <math.h>

/* In times of sqrt(g D), or of the greatest speed at the start. At rest the water at the bed is compressed by g D/c^2:
   a per cent at ENOUGH. Below LEAST surging water is as fast as its sound, and steps diverge. */
static const double ENOUGH = 10, LEAST = 2;

sb_status sb_model_check_sound(const sb_scene *scene, sb_model *model, sb_error *error)
{
    const double sound = scene->numerics.sound_speed;
    const double wave = sb_model_wave_speed(scene, model), fastest = fmax(wave, sb_model_start_speed(model));
    if (scene->numerics.solver != SB_SOLVER_WCSPH || !(sound > 0) || sound >= ENOUGH * fastest * (1 - 1e-3))
        return SB_OK;
    if (sound < LEAST * fastest)
        return sb_fail(error, SB_BAD_INPUT,
                       "%.300s: numerics.sound_speed: %g m/s is less than twice the speed of waves or of the water, "
                       "%.3g m/s, with solver wcsph: expected %.3g m/s, 10 times that speed, or 0",
                       scene->path ? scene->path : "the scene", sound, fastest, ENOUGH * fastest);
    return sb_model_warn(model, error,
                         "numerics.sound_speed: with %g m/s and solver wcsph the water is compressed by about %.2g %%: "
                         "expected %.3g m/s or more, 10 times the speed of waves or of the water, or 0",
                         sound, 100 * fastest * fastest / (sound * sound), ENOUGH * fastest);
}
