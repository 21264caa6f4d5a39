#include "sim/state/constants.h"

#include "physics/kernels/tait.h"
#include "sim/state/lattice.h"

#include <math.h>

/* Circular frequency of the slowest oscillation of the water: half a wavelength over its longest horizontal extent,
   with the speed of waves on its mean depth, or without gravity with the given speed. 1/s. */
static double slowest(const sb_scene *scene, const sb_model *model, double weightless)
{
    const double dr = scene->resolution;
    sb_vec3 low, high;
    if (!sb_model_extent(model, &low, &high)) return 0;
    const double x = high.x - low.x + dr, y = scene->dimensions == 2 ? dr : high.y - low.y + dr;
    const double depth = (double)model->fluid_count * dr * dr * dr / (x * y), g = scene->fluid.gravity;
    return acos(-1) * (g > 0 ? sqrt(g * depth) : weightless) / fmax(x, y);
}

/* Speed that the pressure of surface tension gives to water that is a ball (2D: a disc): sqrt(2 sigma/(rho R)). */
static double capillary_speed(const sb_scene *scene, const sb_model *model)
{
    const double pi = acos(-1), dr = scene->resolution,
                 volume = (double)model->fluid_count * pow(dr, scene->dimensions);
    const double radius = scene->dimensions == 2 ? sqrt(volume / pi) : cbrt(0.75 * volume / pi);
    return sqrt(2 * scene->fluid.surface_tension / (scene->fluid.density * fmax(radius, dr)));
}

sb_constants sb_constants_of(const sb_scene *scene, const sb_model *model)
{
    double dr = scene->resolution, g = scene->fluid.gravity;
    double mass = scene->fluid.density * (scene->dimensions == 2 ? dr * dr : dr * dr * dr);
    double wave_speed = g > 0 ? sb_model_wave_speed(scene, model) : 1;
    if (scene->fluid.surface_tension > 0) wave_speed = fmax(g > 0 ? wave_speed : 0, capillary_speed(scene, model));
    double sound = scene->numerics.sound_speed > 0 ? scene->numerics.sound_speed : 10 * wave_speed;
    if (scene->numerics.solver == SB_SOLVER_WCSPH && !(scene->numerics.sound_speed > 0))
        sound = fmax(sound, 10 * sb_model_start_speed(model));
    return (sb_constants){
        .dimension = scene->dimensions,
        .spacing = (float)dr,
        .support = (float)(scene->numerics.support * dr),
        .rest_density = (float)scene->fluid.density,
        .mass = (float)mass,
        .gravity = (float)g,
        .wave_speed = (float)wave_speed,
        .slowest = (float)slowest(scene, model, wave_speed),
        .sound_speed = (float)sound,
        .stiffness = (float)sb_tait_stiffness(scene->fluid.density, sound),
        .viscosity = (float)scene->fluid.viscosity,
        .surface_tension = (float)scene->fluid.surface_tension,
        .full_diagonal = (float)sb_lattice_diagonal(scene, mass),
        .spectrum = sb_lattice_spectrum(scene),
        .lattice_slopes = (float)sb_lattice_slopes(scene, mass),
        .bulk_deficit = (float)(scene->fluid.density * (1 - sb_lattice_density(scene))),
        .surface_deficit =
            (float)(sb_lattice_truncation(scene) * pow(scene->numerics.support * dr, 2) / scene->fluid.density),
        .speed_limit = (float)fmax(100 * wave_speed, sb_scene_speed_limit(scene)),
    };
}
