/* The push-plates of a paddle, and the rows of a flap. */
#include "scene/reader.h"

#include <math.h>
#include <string.h>

/* In spacings: narrower plates would have too few particles in front of them to read the surface. */
static const double NARROWEST = 3;

enum { PLATES_MAX = 100 };

/* In spacings: least height of the rows of a flap, of which there are at most PLATES_MAX. */
static const double ROW = 2;

const sb_body *sb_plates_body(const sb_scene *scene, const sb_wavemaker_use *use)
{
    for (size_t i = 0; i < scene->body_count; i++)
        if (strcmp(scene->bodies[i].name, use->body) == 0) return &scene->bodies[i];
    return NULL;
}

size_t sb_scene_plates(const sb_scene *scene, const sb_wavemaker_use *use, sb_plate_row *row)
{
    const sb_body *body = sb_plates_body(scene, use);
    const bool flap = use->law.motion == SB_PADDLE_FLAP;
    *row = (sb_plate_row){.levels = 1};
    if (!(flap || use->plates.width > 0) || !body) return 0;
    row->axis = flap ? 2 : fabs(use->direction.x) > fabs(use->direction.y) ? 1 : 0;
    const double move = sb_component(body->translate, row->axis);
    row->from = fmax(sb_component(body->min, row->axis) + move, sb_component(scene->domain.min, row->axis));
    row->to = fmin(sb_component(body->max, row->axis) + move, sb_component(scene->domain.max, row->axis));
    if (flap) row->from = scene->sea.level - use->law.depth;
    const double width = flap ? ROW * scene->resolution : use->plates.width;
    const double extent = row->to - row->from;
    const double most = flap ? (double)PLATES_MAX : fmin(floor(extent / (NARROWEST * scene->resolution) + 1e-9), 1e6);
    row->count = (size_t)fmax(fmin(round(extent / width), most), 1);
    if (!flap && use->plates.height > 0)
        row->levels = (size_t)fmax(fmin(round((body->max.z - body->min.z) / use->plates.height), 1e6), 1);
    return row->count;
}

/* Length within the box of a line along a horizontal direction, m. */
static double thickness_along(const sb_body *body, sb_vec3 direction)
{
    const sb_vec3 size = sb_sub(body->max, body->min);
    const double x = fabs(direction.x), y = fabs(direction.y);
    return fmin(x > 0 ? size.x / x : (double)INFINITY, y > 0 ? size.y / y : (double)INFINITY);
}

/* A flap is a stack of rows: each moves along the direction by its share of the motion at the still level. */
static sb_status check_flap(sb_reader *reader, const sb_yaml *map, const sb_wavemaker_use *use, const sb_body *body)
{
    const sb_scene *scene = reader->scene;
    sb_plate_row row;
    if (use->law.absorb)
        return sb_reader_fail(reader, map, "motion", "a flap does not absorb, expected absorb: false, or a piston");
    if (use->plates.width > 0 || use->plates.height > 0)
        return sb_reader_fail(reader, map, "plates", "a flap has no push-plates, expected no plates, or a piston");
    if (!body || body->shape != SB_SHAPE_BOX || sb_norm(body->rotate) > 0)
        return sb_reader_fail(reader, map, "motion", "%s is not a box, expected a body of shape box without rotate",
                              use->body);
    if (!(fabs(use->direction.z) < 1e-9))
        return sb_reader_fail(reader, map, "direction", "is not horizontal, expected one along x or y for a flap");
    if (thickness_along(body, use->direction) < 0.5 * scene->resolution)
        return sb_reader_fail(reader, map, "motion",
                              "the box of the flap is %.3g m thick, and water passes a plate thinner than half the "
                              "spacing, expected at least %.3g m",
                              thickness_along(body, use->direction), 0.5 * scene->resolution);
    if (!scene->sea.present)
        return sb_reader_fail(
            reader, map, "motion",
            "a flap turns about the bed, `depth` below water.level, expected water.level, or a piston");
    (void)sb_scene_plates(scene, use, &row);
    if (!(row.from < row.to) || !(row.to > scene->sea.level) ||
        !(body->min.z + body->translate.z < row.from + 0.5 * scene->resolution))
        return sb_reader_fail(
            reader, map, "motion",
            "the box of the flap is from z = %g to %g m, expected one from its hinge at %g m or below, to "
            "above the water at %g m",
            body->min.z + body->translate.z, row.to, row.from, scene->sea.level);
    return SB_OK;
}

sb_status sb_plates_check(sb_reader *reader, const sb_yaml *map, const sb_wavemaker_use *use)
{
    const sb_scene *scene = reader->scene;
    const sb_body *body = sb_plates_body(scene, use);
    const double least = NARROWEST * scene->resolution;
    sb_plate_row row;
    if (use->law.motion == SB_PADDLE_FLAP) return check_flap(reader, map, use, body);
    if (!(use->plates.width > 0) && use->plates.height > 0)
        return sb_reader_fail(reader, map, "plates",
                              "height without a width, expected the width of one plate in metres");
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
    if (use->plates.height > 0 && use->plates.height < least * (1 - 1e-9))
        return sb_reader_fail(reader, map, "plates", "%g m high, expected at least 3 spacings, %g m",
                              use->plates.height, least);
    if (sb_scene_plates(scene, use, &row) > PLATES_MAX)
        return sb_reader_fail(reader, map, "plates", "%zu plates, expected at most %d: a larger width", row.count,
                              PLATES_MAX);
    return SB_OK;
}
