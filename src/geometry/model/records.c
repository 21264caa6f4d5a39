/* Warns of recorded planes in which no wave can be recorded: without water, or in the strip of a side of kind sea. */
#include "geometry/model/parts.h"

#include <math.h>

/* Places along a plane at which water is looked for. */
enum { PLACES = 64 };

static sb_vec3 place_of(const sb_flow_plane *plane, int place)
{
    const double part = (place + 0.5) / PLACES;
    return sb_vec(plane->ax + part * (plane->bx - plane->ax), plane->ay + part * (plane->by - plane->ay), 0);
}

/* The side in whose strip a place is; -1: none. */
static int strip_at(const sb_model *model, sb_vec3 at)
{
    for (int side = 0; side < 4; side++) {
        const double low = sb_component(model->min, side / 2), high = sb_component(model->max, side / 2);
        const double here = sb_component(at, side / 2), inwards = side % 2 ? high - here : here - low;
        if (model->sea[side].along > 0 && inwards < model->sea[side].strip) return side;
    }
    return -1;
}

static sb_status check_plane(const sb_scene *scene, const sb_model_space *space, const sb_flow_plane *plane,
                             sb_model *model, sb_error *error)
{
    int wet = 0, held = 0, side = -1;
    for (int k = 0; k < PLACES; k++) {
        const sb_vec3 at = place_of(plane, k);
        const int strip = strip_at(model, at);
        if (!(sb_model_still_depth(scene, model, space, at.x, at.y) > 0)) continue;
        wet++;
        held += strip >= 0;
        if (strip >= 0) side = strip;
    }
    if (wet == 0 && scene->box_count == 0) /* water of a box may fall on a dry place */
        return sb_model_warn(model, error,
                             "measure.planes \"%s\": no still water stands along it, so that its record has no wave "
                             "that comes from the sea; expected a plane in the water, outside of bodies",
                             plane->name);
    if (wet == 0 || held < wet) return SB_OK;
    return sb_model_warn(model, error,
                         "measure.planes \"%s\": it lies in the strip of %s, whose water is the given one: its record "
                         "lacks the waves that leave; expected at least %g m from the side",
                         plane->name, sb_side_names[side], model->sea[side].strip);
}

sb_status sb_model_warn_records(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t p = 0; p < scene->measure.plane_count && status == SB_OK; p++)
        if (scene->measure.planes[p].record)
            status = check_plane(scene, space, &scene->measure.planes[p], model, error);
    return status;
}
