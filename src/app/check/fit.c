#include "app/check/fit.h"

/* Particle spacings. At 0.1 water passed walls in one scene of seven, at 0 in most scenes, at 0.2 or more in none. */
static const double OFFSET_MIN = 0.25;

sb_status sb_fit_check(const sb_scene *scene, sb_error *error)
{
    const double offset = scene->numerics.wall_offset;
    if (offset >= OFFSET_MIN) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT,
                   "%.500s: numerics.wall_offset: %g spacings: water passes walls whose boundary particles are this "
                   "close to their surface, expected %g or more",
                   scene->path ? scene->path : "the scene", offset, OFFSET_MIN);
}
