/* The push-plates of a paddle. */
#include "scene/reader.h"

#include <math.h>
#include <string.h>

/* In spacings: narrower plates would have too few particles in front of them to read the surface. */
static const double NARROWEST = 3;

enum { PLATES_MAX = 500 };

static const sb_body *body_of(const sb_scene *scene, const sb_wavemaker_use *use)
{
    for (size_t i = 0; i < scene->body_count; i++)
        if (strcmp(scene->bodies[i].name, use->body) == 0) return &scene->bodies[i];
    return NULL;
}

static double part(sb_vec3 v, int axis)
{
    return axis == 0 ? v.x : v.y;
}

size_t sb_scene_plates(const sb_scene *scene, const sb_wavemaker_use *use, sb_plate_row *row)
{
    const sb_body *body = body_of(scene, use);
    *row = (sb_plate_row){0};
    if (!(use->plates.width > 0) || !body) return 0;
    row->axis = fabs(use->direction.x) > fabs(use->direction.y) ? 1 : 0;
    const double move = part(body->translate, row->axis);
    row->from = fmax(part(body->min, row->axis) + move, part(scene->domain.min, row->axis));
    row->to = fmin(part(body->max, row->axis) + move, part(scene->domain.max, row->axis));
    row->count = (size_t)fmin(fmax(round((row->to - row->from) / use->plates.width), 1), 1e6);
    return row->count;
}

sb_status sb_plates_check(sb_reader *reader, const sb_yaml *map, const sb_wavemaker_use *use)
{
    const sb_scene *scene = reader->scene;
    const sb_body *body = body_of(scene, use);
    const double least = NARROWEST * scene->resolution;
    sb_plate_row row;
    if (!(use->plates.width > 0)) return SB_OK;
    if (scene->dimensions == 2)
        return sb_reader_fail(reader, map, "plates", "has no effect in 2D, expected a scene in 3D, or no plates");
    if (!use->law.absorb)
        return sb_reader_fail(reader, map, "plates",
                              "plates move on their own only to absorb, expected absorb: true, or no plates");
    if (!body || body->shape != SB_SHAPE_BOX || sb_norm(body->rotate) > 0)
        return sb_reader_fail(reader, map, "plates", "%s is not a box, expected a body of shape box without rotate",
                              use->body);
    if (fabs(use->direction.x * use->direction.y) > 1e-9)
        return sb_reader_fail(reader, map, "direction", "is oblique, expected one along x or y for plates");
    if (use->plates.width < least * (1 - 1e-9))
        return sb_reader_fail(reader, map, "plates", "%g m wide, expected at least 3 spacings, %g m", use->plates.width,
                              least);
    if (sb_scene_plates(scene, use, &row) > PLATES_MAX)
        return sb_reader_fail(reader, map, "plates", "%zu plates, expected at most %d: a larger width", row.count,
                              PLATES_MAX);
    return SB_OK;
}
