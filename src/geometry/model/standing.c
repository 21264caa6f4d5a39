/* Warns of a standing wave at the start that does not stand in its water. */
#include "geometry/model/parts.h"

/* Of half a wavelength, beside half a spacing: how far an end of the water may be from a crest or a trough. */
static const double SLACK = 0.02;

typedef struct reach {
    double low, high; /* m, along x */
} reach;

static void extend(void *context, const sb_water_piece *piece)
{
    reach *r = context;
    for (size_t i = 0; i < piece->count; i++) {
        r->low = fmin(r->low, piece->position[i].x);
        r->high = fmax(r->high, piece->position[i].x);
    }
}

/* Returns whether a wall at x is where the wave has a crest or a trough, and no water crosses it. */
static bool fits(const sb_scene *scene, double x)
{
    const double half = 0.5 * scene->wave.wavelength;
    return fabs(remainder(x - scene->wave.position, half)) <= SLACK * half + 0.5 * scene->resolution;
}

/* Returns the side of the domain if the water ends there, as the particles show it. */
static double end_near(double end, double side, double spacing)
{
    return fabs(end - side) < 0.5 * spacing ? side : end;
}

sb_status sb_model_warn_standing(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error)
{
    const sb_side_kind *side = scene->domain.side;
    reach r = {(double)INFINITY, -(double)INFINITY};
    if (scene->wave.kind != SB_INITIAL_STANDING || side[SB_X_MIN] != SB_SIDE_WALL || side[SB_X_MAX] != SB_SIDE_WALL)
        return SB_OK;
    const sb_status status = sb_model_visit_water(space, model, extend, &r, error);
    if (status != SB_OK || r.low > r.high) return status;
    r.low = end_near(r.low - 0.5 * model->spacing, model->min.x, model->spacing);
    r.high = end_near(r.high + 0.5 * model->spacing, model->max.x, model->spacing);
    if (fits(scene, r.low) && fits(scene, r.high)) return SB_OK;
    const double length = r.high - r.low, halves = fmax(round(2 * length / scene->wave.wavelength), 1);
    return sb_model_warn(
        model, error,
        "water.wave: the water reaches from x = %.4g to %.4g m, and a standing wave with a crest at x = %g m and a "
        "wavelength of %g m has no crest or trough at both ends: it becomes several waves; expected for example a "
        "position of %.4g m and a wavelength of %.4g m",
        r.low, r.high, scene->wave.position, scene->wave.wavelength, r.low, 2 * length / halves);
}
