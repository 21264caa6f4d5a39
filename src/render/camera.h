/* Where the picture is taken from: keys in time made smooth, and the matrices for one frame. */
#ifndef SB_RENDER_CAMERA_H
#define SB_RENDER_CAMERA_H

#include "base/vec.h"
#include "scene/scene.h"

/* The camera at `time`: before the first and after the last key it stands still, between them it
   moves with continuous velocity (cubic Hermite, Catmull-Rom slopes, at rest at both ends). Keys
   are ordered in time; key_count >= 1. */
sb_camera_key sb_camera_at(const sb_camera *camera, double time);

/* A view of the box [min, max] (m, scene) by a camera whose fov (degrees) is the vertical angle. */
typedef struct sb_view {
    sb_vec3 eye;             /* m, scene */
    sb_vec3 right, up, back; /* unit, the camera's axes */
    double tangent, aspect;  /* of half the vertical angle; width over height */
    double near, far;        /* m, clip planes that hold the box */
    float projection[16];    /* column-major */
} sb_view;
sb_view sb_view_create(const sb_camera_key *key, double aspect, sb_vec3 min, sb_vec3 max);

/* Column-major matrix from single-precision coordinates relative to `origin` (m, scene) to camera
   axes; the large numbers cancel in double precision. */
void sb_view_matrix(const sb_view *view, sb_vec3 origin, float matrix[16]);

#endif
