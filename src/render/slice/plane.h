/* The plane of a slice as a camera sees it: its axes, the part of it in the picture, and the maps between both. */
#ifndef SB_RENDER_PLANE_H
#define SB_RENDER_PLANE_H

#include "render/camera/camera.h"

#include <stdbool.h>

/* Places in the plane are `point` plus a and b metres along its axes. */
typedef struct sb_plane {
    sb_vec3 point;        /* m, scene */
    sb_vec3 normal;       /* unit, towards the eye */
    sb_vec3 across, over; /* unit: the axes of a and b; across x over = normal; `over` is upwards where it can be */
} sb_plane;

sb_plane sb_plane_of(const sb_slice *slice, sb_vec3 eye);

static inline sb_vec3 sb_plane_at(const sb_plane *plane, double a, double b)
{
    return sb_madd(sb_madd(plane->point, a, plane->across), b, plane->over);
}

/* A projective map: (x, y) = (m[0] . (a, b, 1), m[1] . (a, b, 1)) / (m[2] . (a, b, 1)), defined where the divisor is
   above 0. */
typedef struct sb_plane_map {
    double m[3][3];
} sb_plane_map;

/* Returns the map from a and b to px from the picture's top left corner; the divisor is the depth in m. */
sb_plane_map sb_plane_to_pixels(const sb_plane *plane, const sb_view *view, int width, int height);

/* Returns the inverse map, whose divisor is above 0 where that of `map` is. */
sb_plane_map sb_plane_inverse(const sb_plane_map *map);

/* Applies a map. False: the point has no image. */
static inline bool sb_plane_apply(const sb_plane_map *map, double a, double b, double out[2])
{
    const double w = map->m[2][0] * a + map->m[2][1] * b + map->m[2][2];
    if (!(w > 0)) return false;
    for (int k = 0; k < 2; k++) out[k] = (map->m[k][0] * a + map->m[k][1] * b + map->m[k][2]) / w;
    return true;
}

enum { SB_PLANE_CORNERS = 20 };

/* A convex part of the plane, counter-clockwise seen from the eye. */
typedef struct sb_plane_area {
    size_t count; /* corners; 0: empty */
    double corner[SB_PLANE_CORNERS][2], low[2], high[2];
} sb_plane_area;

/* Returns the part within the box [min, max] (m, scene) and within the view. */
sb_plane_area sb_plane_visible(const sb_plane *plane, const sb_view *view, sb_vec3 min, sb_vec3 max);

#endif
