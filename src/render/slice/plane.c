/* Axes, maps and the visible part of a slice's plane. */
#include "render/slice/plane.h"

#include <math.h>

sb_plane sb_plane_of(const sb_slice *slice, sb_vec3 eye)
{
    sb_plane plane = {.point = slice->point, .normal = sb_normalize(slice->normal)};
    if (sb_dot(plane.normal, sb_sub(eye, plane.point)) < 0) plane.normal = sb_scale(plane.normal, -1);
    /* In a horizontal plane, the axes are x and y, or x and -y seen from below. */
    const bool flat = fabs(plane.normal.z) > 0.9999;
    plane.across = flat ? sb_vec(1, 0, 0) : sb_cross(sb_vec(0, 0, 1), plane.normal);
    plane.across = sb_normalize(sb_madd(plane.across, -sb_dot(plane.across, plane.normal), plane.normal));
    plane.over = sb_cross(plane.normal, plane.across);
    return plane;
}

sb_plane_map sb_plane_to_pixels(const sb_plane *plane, const sb_view *view, int width, int height)
{
    const sb_vec3 from = sb_sub(plane->point, view->eye), ahead = sb_scale(view->back, -1);
    const sb_vec3 along[3] = {plane->across, plane->over, from};
    const double wide = 0.5 * width / (view->tangent * view->aspect), tall = 0.5 * height / view->tangent;
    sb_plane_map map;
    for (int k = 0; k < 3; k++) {
        const double depth = sb_dot(along[k], ahead);
        map.m[0][k] = 0.5 * width * depth + wide * sb_dot(along[k], view->right);
        map.m[1][k] = 0.5 * height * depth - tall * sb_dot(along[k], view->up);
        map.m[2][k] = depth;
    }
    return map;
}

sb_plane_map sb_plane_inverse(const sb_plane_map *map)
{
    const double(*m)[3] = map->m;
    sb_plane_map inverse;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            const int r = (k + 1) % 3, s = (k + 2) % 3, p = (i + 1) % 3, q = (i + 2) % 3;
            inverse.m[i][k] = m[r][p] * m[s][q] - m[r][q] * m[s][p];
        }
    const double determinant = m[0][0] * inverse.m[0][0] + m[0][1] * inverse.m[1][0] + m[0][2] * inverse.m[2][0];
    const double scale = determinant != 0 ? 1 / determinant : 0; /* the eye in the plane: there is no image */
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) inverse.m[i][k] *= scale;
    return inverse;
}

/* Cuts off the part where c[0] a + c[1] b + c[2] < 0. */
static void clip(sb_plane_area *area, const double c[3])
{
    sb_plane_area in = *area;
    area->count = 0;
    for (size_t i = 0; i < in.count; i++) {
        const double *p = in.corner[i], *q = in.corner[(i + 1) % in.count];
        const double at_p = c[0] * p[0] + c[1] * p[1] + c[2], at_q = c[0] * q[0] + c[1] * q[1] + c[2];
        if (at_p >= 0 && area->count < SB_PLANE_CORNERS) {
            area->corner[area->count][0] = p[0];
            area->corner[area->count++][1] = p[1];
        }
        if ((at_p >= 0) == (at_q >= 0) || area->count == SB_PLANE_CORNERS) continue;
        const double s = at_p / (at_p - at_q);
        area->corner[area->count][0] = p[0] + s * (q[0] - p[0]);
        area->corner[area->count++][1] = p[1] + s * (q[1] - p[1]);
    }
}

/* Cuts off the part of the plane on the far side of another plane, normal . (x - at) < 0. */
static void clip_space(sb_plane_area *area, const sb_plane *plane, sb_vec3 normal, sb_vec3 at)
{
    const double c[3] = {sb_dot(normal, plane->across), sb_dot(normal, plane->over),
                         sb_dot(normal, sb_sub(plane->point, at))};
    clip(area, c);
}

sb_plane_area sb_plane_visible(const sb_plane *plane, const sb_view *view, sb_vec3 min, sb_vec3 max)
{
    const sb_vec3 middle = sb_scale(sb_add(min, max), 0.5), from = sb_sub(middle, plane->point);
    const double a = sb_dot(from, plane->across), b = sb_dot(from, plane->over), half = sb_norm(sb_sub(max, min));
    sb_plane_area area = {
        .count = 4, .corner = {{a - half, b - half}, {a + half, b - half}, {a + half, b + half}, {a - half, b + half}}};
    const sb_vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int k = 0; k < 3; k++) {
        clip_space(&area, plane, axes[k], min);
        clip_space(&area, plane, sb_scale(axes[k], -1), max);
    }
    const sb_vec3 ahead = sb_scale(view->back, -1);
    const double wide = view->tangent * view->aspect;
    clip_space(&area, plane, ahead, sb_madd(view->eye, view->near, ahead));
    clip_space(&area, plane, sb_madd(view->right, wide, ahead), view->eye);
    clip_space(&area, plane, sb_madd(sb_scale(view->right, -1), wide, ahead), view->eye);
    clip_space(&area, plane, sb_madd(view->up, view->tangent, ahead), view->eye);
    clip_space(&area, plane, sb_madd(sb_scale(view->up, -1), view->tangent, ahead), view->eye);
    if (area.count < 3) area.count = 0;
    for (int k = 0; k < 2; k++) {
        area.low[k] = HUGE_VAL;
        area.high[k] = -HUGE_VAL;
        for (size_t i = 0; i < area.count; i++) {
            area.low[k] = fmin(area.low[k], area.corner[i][k]);
            area.high[k] = fmax(area.high[k], area.corner[i][k]);
        }
    }
    return area;
}
