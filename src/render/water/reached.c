#include "render/water/reached.h"

#include "render/bodies/light.h"
#include "render/camera/bounds.h"

#include <math.h>

enum { SIDE_MAX = 1024 };

static const float density_least = 0.14f; /* of water that wets; single drops have less */

bool sb_reached_shown(const sb_scene *scene)
{
    return scene->render.wet_ground || scene->render.greatest_depth;
}

int sb_reached_side(double size, double spacing)
{
    /* Cells of about a spacing, so that no water falls between them. */
    const double side = size / (1.3 * spacing);
    return side < 8 ? 8 : side > SIDE_MAX ? SIDE_MAX : (int)side;
}

sb_status sb_reached_add(sb_reached *reached, int side, const sb_frame *frame, const sb_density *density, bool flat,
                         float map[3][4], sb_error *error)
{
    const bool begun = reached->changes > 0;
    if (begun && !(frame->status.time != reached->time)) return SB_OK;
    if (reached->tops.side == 0) {
        const sb_status status = sb_tops_create(side, &reached->tops, error);
        if (status != SB_OK) return status;
    }
    if (reached->tops.side != side)
        return sb_fail(error, SB_BAD_INPUT, "pictures: the highest water has %d cells on each side, expected %d",
                       reached->tops.side, side);
    if (begun && frame->status.time < reached->time) sb_tops_clear(&reached->tops);
    reached->time = frame->status.time;
    reached->changes++;
    if (!flat) return sb_tops_add_areas(&reached->tops, frame, density, density_least, map, error);
    sb_tops_add(&reached->tops, frame, density, density_least, map);
    return SB_OK;
}

void sb_reached_save(const sb_reached *reached, sb_archive_out *out)
{
    const size_t side = (size_t)reached->tops.side;
    sb_put_flag(out, reached->changes > 0);
    if (reached->changes == 0) return;
    sb_put_real(out, reached->time);
    sb_put_list(out, reached->tops.top, side * side, sizeof *reached->tops.top);
}

sb_status sb_reached_load(sb_reached *reached, const sb_scene *scene, const sb_model *model, sb_archive_in *in,
                          sb_error *error)
{
    sb_vec3 min, max;
    sb_reached_free(reached);
    if (!sb_take_flag(in)) return SB_OK;
    sb_bounds_find(scene, model, &min, &max);
    /* The light's origin is the model's lowest corner. */
    const double size = sb_light_size(sb_sub(min, model->min), sb_sub(max, model->min));
    const int side = sb_reached_side(size, scene->resolution);
    const size_t cells = (size_t)side * (size_t)side;
    const sb_status status = sb_tops_create(side, &reached->tops, error);
    if (status != SB_OK) return status;
    reached->changes = 1;
    reached->time = sb_take_real(in);
    sb_take_list(in, reached->tops.top, cells, sizeof *reached->tops.top);
    if (!isfinite(reached->time))
        sb_archive_refuse(in, "the highest water is of %g s, expected a finite time", reached->time);
    for (size_t c = 0; c < cells; c++)
        if (!isfinite(reached->tops.top[c])) {
            sb_archive_refuse(in, "cell %zu of the highest water has %g m, expected a finite height", c,
                              (double)reached->tops.top[c]);
            break;
        }
    return SB_OK;
}

void sb_reached_free(sb_reached *reached)
{
    sb_tops_free(&reached->tops);
    *reached = (sb_reached){0};
}
