#include "app/check/tension.h"

#include <math.h>
#include <stdio.h>

/* Spacing over the capillary length up to which surface tension is resolved. */
static const double RESOLVED = 0.5;

/* Bond numbers rho g L^2/sigma compare weight with surface tension, the Weber number rho U^2 L/sigma inertia. */
typedef struct numbers {
    double length;         /* m, capillary length sqrt(sigma/(rho g)) */
    double spacing, depth; /* Bond numbers with L the spacing, and the still depth */
    double speed, weber;   /* m/s, U; with L the spacing */
} numbers;

static numbers numbers_of(const sb_scene *scene, const sb_model *model)
{
    const double sigma = scene->fluid.surface_tension, rho = scene->fluid.density, dr = scene->resolution;
    const double weight = rho * scene->fluid.gravity;
    /* Falling or surging water has a speed of about 2 sqrt(gD). */
    const double speed = fmax(2 * sb_model_wave_speed(scene, model), sb_model_start_speed(model));
    return (numbers){
        .length = sqrt(sigma / weight),
        .spacing = weight * dr * dr / sigma,
        .depth = weight * model->still_depth * model->still_depth / sigma,
        .speed = speed,
        .weber = rho * speed * speed * dr / sigma,
    };
}

void sb_check_tension_text(const sb_scene *scene, const sb_model *model)
{
    if (!(scene->fluid.surface_tension > 0)) return;
    const numbers n = numbers_of(scene, model);
    printf("  surface tension    %g N/m, capillary length %.3g m (%.3g spacings)\n", scene->fluid.surface_tension,
           n.length, n.length / scene->resolution);
    printf("                     Bond number %.3g of a spacing, %.3g of the depth; Weber number %.3g of a spacing at "
           "%.3g m/s\n",
           n.spacing, n.depth, n.weber, n.speed);
}

void sb_check_tension_json(const sb_scene *scene, const sb_model *model, sb_json *json)
{
    if (!(scene->fluid.surface_tension > 0)) return;
    const numbers n = numbers_of(scene, model);
    sb_json_open(json, "surface_tension", '{');
    sb_json_number(json, "capillary_length_m", n.length);
    sb_json_number(json, "bond_spacing", n.spacing);
    sb_json_number(json, "bond_depth", n.depth);
    sb_json_number(json, "speed_m_s", n.speed);
    sb_json_number(json, "weber_spacing", n.weber);
    sb_json_close(json);
}

void sb_tension_warnings(const sb_scene *scene, sb_warning_visit *visit, void *context)
{
    const double sigma = scene->fluid.surface_tension, weight = scene->fluid.density * scene->fluid.gravity;
    const double length = sqrt(sigma / weight), most = RESOLVED * length;
    if (!(sigma > 0) || scene->resolution <= most) return;
    char text[320];
    snprintf(text, sizeof text,
             "fluid.surface_tension: %g N/m acts below %.3g m, which the resolution of %g m does not resolve: it has "
             "little effect but shorter time steps; expected a resolution below %.3g m, or surface_tension: 0",
             sigma, length, scene->resolution, most);
    visit(context, text);
}
