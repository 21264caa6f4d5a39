/* Selects the visible particles. */
#include "render/visible.h"

#include "base/memory.h"

/* A particle is hidden if the density at a distance of cover_spacings towards the eye is above this. */
static const float dense = 0.68f, cover_spacings = 1.6f;
/* The density at and above which a particle is not drawn as a single drop. */
static const float crowd_density = 0.35f;

/* The eye and the side planes of the view, relative to the frame's origin. */
struct lens {
    float eye[3], right[3], up[3], back[3];
    float tangent, aspect, near, margin;
};

static struct lens lens_of(const sb_view *view, sb_vec3 origin, double margin)
{
    sb_vec3 eye = sb_sub(view->eye, origin);
    return (struct lens){
        .eye = {(float)eye.x, (float)eye.y, (float)eye.z},
        .right = {(float)view->right.x, (float)view->right.y, (float)view->right.z},
        .up = {(float)view->up.x, (float)view->up.y, (float)view->up.z},
        .back = {(float)view->back.x, (float)view->back.y, (float)view->back.z},
        .tangent = (float)view->tangent,
        .aspect = (float)view->aspect,
        .near = (float)view->near,
        .margin = (float)margin,
    };
}

static float dot3(const float *a, const float *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool outside(const struct lens *lens, const float *to_eye)
{
    float depth = dot3(to_eye, lens->back);
    float half = depth * lens->tangent;
    return depth < lens->near - lens->margin ||
           fabsf(dot3(to_eye, lens->up)) > half + lens->margin * (1 + lens->tangent) ||
           fabsf(dot3(to_eye, lens->right)) > half * lens->aspect + lens->margin * (1 + lens->tangent * lens->aspect);
}

/* The normal is opposite to the density gradient. The gradient is taken slightly above the particle, because it
   vanishes within a single layer of particles on land. */
static void surface_normal(const sb_density *density, const float *p, float spacing, const float *to_eye,
                           signed char normal[4])
{
    float d = density->cell, x = p[0], y = p[1], z = p[2] + 0.7f * spacing;
    float g[3] = {sb_density_at(density, x - d, y, z) - sb_density_at(density, x + d, y, z),
                  sb_density_at(density, x, y - d, z) - sb_density_at(density, x, y + d, z),
                  sb_density_at(density, x, y, z - d) - sb_density_at(density, x, y, z + d)};
    float length = sqrtf(dot3(g, g));
    if (length < 1e-4f) {
        for (int a = 0; a < 3; a++) g[a] = to_eye[a];
        length = sqrtf(dot3(g, g));
    }
    for (int a = 0; a < 3; a++) normal[a] = (signed char)lrintf(127 * g[a] / length);
    normal[3] = 0;
}

static void collect(sb_visible *visible, const sb_frame *frame, const sb_view *view, double speed_max)
{
    const sb_density *density = &visible->density;
    struct lens lens = lens_of(view, frame->origin, frame->spacing);
    float to_share = (float)(65535 / speed_max), spacing = (float)frame->spacing;
    for (size_t i = 0; i < frame->count; i++) {
        const float *p = frame->position + 3 * i, *v = frame->velocity + 3 * i;
        float to_eye[3] = {lens.eye[0] - p[0], lens.eye[1] - p[1], lens.eye[2] - p[2]};
        if (!sb_density_counts(p) || outside(&lens, to_eye)) continue;
        float step = cover_spacings * spacing / sqrtf(dot3(to_eye, to_eye));
        if (sb_density_at(density, p[0] + step * to_eye[0], p[1] + step * to_eye[1], p[2] + step * to_eye[2]) > dense)
            continue;
        float share = sqrtf(dot3(v, v)) * to_share;
        float crowd = sb_density_at(density, p[0], p[1], p[2]) / crowd_density;
        sb_visible_point *point = &visible->points[visible->count++];
        *point = (sb_visible_point){
            .position = {p[0], p[1], p[2]},
            .speed = (unsigned short)(share < 65535 ? share : 65535),
            .crowd = (unsigned short)(65535 * (crowd < 1 ? crowd : 1)),
        };
        surface_normal(density, p, spacing, to_eye, point->normal);
    }
}

sb_status sb_visible_collect(sb_visible *visible, const sb_frame *frame, const sb_view *view, double speed_max,
                             sb_error *error)
{
    visible->count = 0;
    if (!(frame->spacing > 0) || !(speed_max > 0))
        return sb_fail(error, SB_BAD_INPUT, "frame: spacing %g m and largest speed %g m/s, expected > 0",
                       frame->spacing, speed_max);
    if (sb_grow((void **)&visible->points, &visible->capacity, frame->count, sizeof *visible->points) != 0)
        return sb_fail_memory(error, "the visible particles");
    sb_status status = sb_density_build(&visible->density, frame, error);
    if (status == SB_OK) collect(visible, frame, view, speed_max);
    return status;
}

void sb_visible_free(sb_visible *visible)
{
    sb_free(visible->points);
    sb_density_free(&visible->density);
    *visible = (sb_visible){0};
}
