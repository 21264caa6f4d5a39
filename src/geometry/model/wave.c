/* Warns of initial waves that are cut off: beyond a side, inside a body, or on land. */
#include "base/per_cent.h"
#include "geometry/model/parts.h"

#include <stdio.h>

/* Fraction of the wave's volume that may be missing without a warning. */
static const double MISSING = 0.01;

/* Writes a position at which the whole wave is within the water, or why there is none. */
static void advise(const sb_scene *scene, const sb_wave_room *room, char *text, size_t size)
{
    const double step = scene->resolution, least = step * ceil((room->low + room->extent) / step),
                 most = step * floor((room->high - room->extent) / step);
    if (least > most)
        snprintf(text, size, "the wave is %.3g m long, the water %.3g m: expected longer water", 2 * room->extent,
                 room->high - room->low);
    else if (scene->wave.position < least)
        snprintf(text, size, "expected water.wave.position %g m or more", least);
    else if (scene->wave.position > most)
        snprintf(text, size, "expected water.wave.position %g m or less", most);
    else
        snprintf(text, size, "expected a position with nothing but water within %.3g m of the crest", room->extent);
}

sb_status sb_model_warn_wave(const sb_scene *scene, const sb_wave_room *room, sb_model *model, sb_error *error)
{
    char advice[160], part[32];
    if (!room->wet || !(room->area > 0)) return SB_OK;
    const double missing = room->width > 0 ? 1 - room->held / (room->area * room->width) : 1;
    if (!(missing > MISSING)) return SB_OK;
    advise(scene, room, advice, sizeof advice);
    return sb_model_warn(model, error,
                         "water.wave: %s of the wave's volume above the still-water level is cut off: it lies "
                         "beyond a side, in a body or on land, and the water extends from x = %g m to %g m; %s",
                         sb_per_cent(missing, part), room->low, room->high, advice);
}
