/* A paddle that makes waves by a theory or absorbs: its flat face must push the water from the bed to the surface. */
#include "base/turn.h"
#include "scene/reader.h"

#include <math.h>

/* Sine of the angle between a direction and a face's normal up to which they are the same: rounding of a scene's
   numbers. */
static const double OBLIQUE = 0.01;

/* Whether a direction is along a normal of the body's flat faces. A mesh may have any; a cylinder has none, a grid's
   and a basin's are no paddles. */
static bool along_face(const sb_body *body, sb_vec3 direction)
{
    const bool plane = body->shape == SB_SHAPE_PLANE;
    const sb_vec3 normals[] = {plane ? body->normal : sb_vec(1, 0, 0), sb_vec(0, 1, 0), sb_vec(0, 0, 1)};
    const sb_turn turn = sb_turn_of(body->rotate);
    if (body->shape != SB_SHAPE_BOX && !plane) return body->shape == SB_SHAPE_MESH;
    for (int n = 0; n < (plane ? 1 : 3); n++)
        if (sb_norm(sb_cross(sb_turned(&turn, normals[n]), direction)) < OBLIQUE) return true;
    return false;
}

static sb_status check_direction(sb_reader *reader, const sb_yaml *map, const sb_wavemaker_use *use,
                                 const sb_body *body)
{
    if (fabs(use->direction.z) > OBLIQUE)
        return sb_reader_fail(reader, map, "direction",
                              "is not horizontal, expected the direction from the paddle's flat face into the water");
    if (!body || along_face(body, use->direction)) return SB_OK;
    if (body->shape != SB_SHAPE_BOX && body->shape != SB_SHAPE_PLANE)
        return sb_reader_fail(
            reader, map, "body",
            "%s has no flat face with which it would push the water, expected a box, a plane or a mesh", use->body);
    return sb_reader_fail(
        reader, map, "direction",
        "is oblique to the flat faces of %s, so that the paddle would slide along the water, expected "
        "the direction from its face into the water",
        use->body);
}

/* Only a box without rotate has its height in the scene. */
static sb_status check_height(sb_reader *reader, const sb_yaml *map, const sb_wavemaker_use *use, const sb_body *body)
{
    const sb_scene *scene = reader->scene;
    if (!body || body->shape != SB_SHAPE_BOX || sb_norm(body->rotate) > 0 || !scene->sea.present) return SB_OK;
    const double low = body->min.z + body->translate.z, high = body->max.z + body->translate.z;
    const double bed = fmax(scene->sea.level - use->law.depth, scene->domain.min.z);
    if (high > scene->sea.level && low < bed + 0.5 * scene->resolution) return SB_OK;
    return sb_reader_fail(reader, map, "body",
                          "the box of the piston is from z = %g to %g m, and water would pass %s it, expected one from "
                          "the bed at %g m or below to above the water at %g m",
                          low, high, high > scene->sea.level ? "below" : "above", bed, scene->sea.level);
}

sb_status sb_piston_check(sb_reader *reader, const sb_yaml *map, const sb_wavemaker_use *use)
{
    const sb_body *body = sb_plates_body(reader->scene, use);
    if (!(use->law.kind->needs & SB_WM_TRAIN)) return SB_OK;
    const sb_status status = check_direction(reader, map, use, body);
    return status == SB_OK && use->law.motion == SB_PADDLE_PISTON ? check_height(reader, map, use, body) : status;
}
