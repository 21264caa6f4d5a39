#include "physics/waves/dispersion.h"
#include "scene/reader.h"
#include "scene/scene_waves.h"

#include <math.h>
#include <string.h>

static const char *const side_names[] = {"x_min", "x_max", "y_min", "y_max", NULL};
static const char *const kind_names[] = {"damping", "viscous", NULL};
static const char *const profile_names[] = {"linear", "quadratic", "cubic", NULL};

enum { DAMPING = 1 << SB_SPONGE_DAMPING, VISCOUS = 1 << SB_SPONGE_VISCOUS };

static unsigned variant(const void *item, const sb_yaml *map)
{
    (void)map;
    return 1u << ((const sb_sponge *)item)->kind;
}

/* clang-format off */
static const sb_key keys[] = {
    {.name = "name", .type = SB_KEY_NAME, SB_KEY_AT(sb_sponge, name), .flags = SB_KEY_REQUIRED,
     .doc = "Unique name of the sponge."},
    {.name = "kind", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_sponge, kind), .words = kind_names, .fallback = "damping",
     .flags = SB_KEY_LATER,
     .doc = "`damping` slows water down. `viscous`, with `solver: wcsph` only, is the sponge of Wen et al., for "
            "comparison: it takes less."},
    {.name = "side", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_sponge, side), .words = side_names,
     .flags = SB_KEY_REQUIRED, .doc = "Side of the domain towards which the strength grows."},
    {.name = "end", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_sponge, end), .unit = "m", SB_KEY_ANY,
     .derived = "that of the side", .doc = "Coordinate, x or y, at which the greatest strength is reached. Beyond it the strength stays the same; the predicted reflection has a wall there."},
    {.name = "length", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_sponge, length), .unit = "m", SB_KEY_POSITIVE,
     .derived = "one wavelength by linear theory", .doc = "Length in which the strength grows from 0; one wavelength or more."},
    {.name = "profile", .type = SB_KEY_CHOICE, SB_KEY_AT(sb_sponge, profile), .words = profile_names,
     .fallback = "quadratic", .doc = "How the strength grows along the length."},
    {.name = "period", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_sponge, period), .unit = "s", SB_KEY_POSITIVE,
     .derived = "that of the scene's waves", .doc = "Period of the waves; of a spectrum, that of its peak."},
    {.name = "depth", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_sponge, depth), .unit = "m", SB_KEY_POSITIVE,
     .derived = "that of the scene's waves", .doc = "Still-water depth there."},
    {.name = "strength", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_sponge, strength), .unit = "1/s", SB_KEY_POSITIVE,
     .applies = DAMPING, .only = "kind damping", .derived = "the one with the least reflection by linear theory",
     .doc = "Greatest strength: water loses this share of its velocity per second."},
    {.name = "alpha", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_sponge, alpha), .min = 0, .max = 1, .flags = SB_KEY_ABOVE,
     .applies = VISCOUS, .only = "kind viscous", .fallback = "0.6",
     .doc = "Greatest coefficient of an artificial viscosity, which the water has beside `artificial_viscosity`."},
};
/* clang-format on */

static sb_status finish(sb_reader *reader, const sb_yaml *map, void *item)
{
    sb_sponge *sponge = item;
    const sb_scene *scene = reader->scene;
    const sb_domain *domain = &scene->domain;
    const double sides[] = {domain->min.x, domain->max.x, domain->min.y, domain->max.y};
    const int axis = sponge->side / 2;
    if (scene->dimensions == 2 && axis == 1)
        return sb_reader_fail(reader, map, "side", "%s has no effect in 2D, expected x_min or x_max",
                              side_names[sponge->side]);
    if (sb_scene_repeats(scene, axis))
        return sb_reader_fail(reader, map, "side", "%s is periodic, expected another kind of side",
                              side_names[sponge->side]);
    const sb_status status = sb_reader_period(reader, map, false, &sponge->period, &sponge->depth);
    if (status != SB_OK) return status;
    if (!sb_yaml_child(map, "length"))
        sponge->length = 2 * M_PI / sb_wave_number(sponge->period, sponge->depth, scene->fluid.gravity);
    if (!sb_yaml_child(map, "end")) sponge->end = sides[sponge->side];
    if (!(sponge->end >= sides[2 * axis] && sponge->end <= sides[2 * axis + 1]))
        return sb_reader_fail(reader, map, "end", "%g m is outside of the domain, expected %g to %g", sponge->end,
                              sides[2 * axis], sides[2 * axis + 1]);
    if (!(sponge->length <= sides[2 * axis + 1] - sides[2 * axis]))
        return sb_reader_fail(reader, map, "length", "%g m is longer than the domain, expected at most %g m",
                              sponge->length, sides[2 * axis + 1] - sides[2 * axis]);
    if (sponge->kind == SB_SPONGE_DAMPING && !sb_yaml_child(map, "strength"))
        sponge->strength = sb_sponge_best(sponge->profile, 2 * M_PI / sponge->period, sponge->depth,
                                          scene->fluid.gravity, sponge->length);
    return SB_OK;
}

const sb_table sb_sponge_table = {SB_KEY_ROWS(keys), .size = sizeof(sb_sponge), .variant = variant, .finish = finish};
