/* The camera: a smooth path through keys in time, and the view matrices for one frame. */
#ifndef SB_RENDER_CAMERA_H
#define SB_RENDER_CAMERA_H

#include "base/vec.h"
#include "scene/scene.h"

#include <stdbool.h>

/* Returns a camera with keys at `time`. Before the first key and after the last key the camera is at rest. From key to
   key it moves by the `ease` of the first: smoothly (cubic Hermite interpolation with Catmull-Rom slopes, at rest at
   both ends, and with the velocity of a neighbour that is not smooth), with constant velocity, or with constant
   acceleration from rest or to rest. The keys must be ordered in time; key_count >= 1. */
sb_camera_key sb_camera_at(const sb_camera *camera, double time);

/* A view of the box [min, max] (m, scene) by a camera whose fov (degrees) is the vertical angle. */
typedef struct sb_view {
    sb_vec3 eye;             /* m, scene */
    sb_vec3 right, up, back; /* unit, the camera's axes */
    double tangent, aspect;  /* tangent of half the vertical angle; width over height */
    double near, far;        /* m, clip planes that enclose the box */
    float projection[16];    /* column-major */
    bool cuts;               /* places with cut_normal . place > cut_at (m, scene) are not drawn */
    sb_vec3 cut_normal;      /* unit */
    double cut_at;
} sb_view;
sb_view sb_view_create(const sb_camera_key *key, double aspect, sb_vec3 min, sb_vec3 max);

/* Writes the column-major matrix that transforms single-precision coordinates relative to `origin` (m, scene) to camera
   axes. The differences of large coordinates are computed in double precision. */
void sb_view_matrix(const sb_view *view, sb_vec3 origin, float matrix[16]);

#endif
