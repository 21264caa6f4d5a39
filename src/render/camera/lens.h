/* The eye and the side planes of a view in single precision, relative to a frame's origin. */
#ifndef SB_RENDER_LENS_H
#define SB_RENDER_LENS_H

#include "render/camera/camera.h"

#include <stdbool.h>

typedef struct sb_lens {
    float eye[3], right[3], up[3], back[3];
    float tangent, aspect, near, margin;
    bool cuts;
    float cut_normal[3], cut_at; /* as in sb_view */
} sb_lens;

/* margin: m by which a point may be outside of the view. */
static inline sb_lens sb_lens_of(const sb_view *view, sb_vec3 origin, double margin)
{
    sb_vec3 eye = sb_sub(view->eye, origin);
    return (sb_lens){
        .eye = {(float)eye.x, (float)eye.y, (float)eye.z},
        .right = {(float)view->right.x, (float)view->right.y, (float)view->right.z},
        .up = {(float)view->up.x, (float)view->up.y, (float)view->up.z},
        .back = {(float)view->back.x, (float)view->back.y, (float)view->back.z},
        .tangent = (float)view->tangent,
        .aspect = (float)view->aspect,
        .near = (float)view->near,
        .margin = (float)margin,
        .cuts = view->cuts,
        .cut_normal = {(float)view->cut_normal.x, (float)view->cut_normal.y, (float)view->cut_normal.z},
        .cut_at = (float)(view->cut_at - sb_dot(view->cut_normal, origin)),
    };
}

static inline float sb_dot3(const float *a, const float *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* to_eye: from the point to the eye. */
static inline bool sb_lens_outside(const sb_lens *lens, const float *to_eye)
{
    float depth = sb_dot3(to_eye, lens->back);
    float half = depth * lens->tangent;
    return depth < lens->near - lens->margin ||
           fabsf(sb_dot3(to_eye, lens->up)) > half + lens->margin * (1 + lens->tangent) ||
           fabsf(sb_dot3(to_eye, lens->right)) >
               half * lens->aspect + lens->margin * (1 + lens->tangent * lens->aspect);
}

/* Whether the plane of a slice cuts a point off. */
static inline bool sb_lens_cut(const sb_lens *lens, const float *point)
{
    return lens->cuts && sb_dot3(point, lens->cut_normal) > lens->cut_at;
}

#endif
