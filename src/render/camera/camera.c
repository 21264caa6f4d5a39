/* Interpolates the camera's keys and computes the view matrices. */
#include "render/camera/camera.h"

#include <stdbool.h>
#include <string.h>

#define CGLM_ALL_UNALIGNED
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <cglm/cglm.h>
#pragma GCC diagnostic pop

/* A key as an array of seven numbers, all of which are interpolated by one formula. */
enum { NUMBERS = 7 };

static void to_numbers(const sb_camera_key *key, double out[NUMBERS])
{
    const double numbers[NUMBERS] = {key->eye.x,    key->eye.y,    key->eye.z, key->target.x,
                                     key->target.y, key->target.z, key->fov};
    memcpy(out, numbers, sizeof numbers);
}

static sb_camera_key from_numbers(double time, const double n[NUMBERS])
{
    return (sb_camera_key){
        .time = time, .eye = sb_vec(n[0], n[1], n[2]), .target = sb_vec(n[3], n[4], n[5]), .fov = n[6]};
}

/* Adds `weight` times the mean velocity from key k to the next one. */
static void add_velocity(const sb_camera *camera, size_t k, double weight, double out[NUMBERS])
{
    double a[NUMBERS], b[NUMBERS];
    to_numbers(&camera->keys[k], a);
    to_numbers(&camera->keys[k + 1], b);
    const double span = camera->keys[k + 1].time - camera->keys[k].time;
    for (int i = 0; i < NUMBERS; i++) out[i] += weight * (b[i] - a[i]) / span;
}

/* The velocity at the end of a motion that is not smooth, over its mean. */
static double end_velocity(sb_ease ease, bool at_start)
{
    if (ease == SB_EASE_LINEAR) return 1;
    return (ease == SB_EASE_IN) == at_start ? 0 : 2;
}

/* Velocity at key k of the smooth motions beside it: that of the motion on its other side if that one is not smooth,
   the difference of the neighbouring keys over their time difference between two smooth ones, zero at both ends. */
static void slopes(const sb_camera *camera, size_t k, double out[NUMBERS])
{
    const sb_camera_key *keys = camera->keys;
    memset(out, 0, NUMBERS * sizeof *out);
    if (k == 0 || k + 1 == camera->key_count) return;
    const double before = keys[k].time - keys[k - 1].time, after = keys[k + 1].time - keys[k].time;
    if (keys[k - 1].ease != SB_EASE_SMOOTH) {
        add_velocity(camera, k - 1, end_velocity(keys[k - 1].ease, false), out);
    } else if (keys[k].ease != SB_EASE_SMOOTH) {
        add_velocity(camera, k, end_velocity(keys[k].ease, true), out);
    } else {
        add_velocity(camera, k - 1, before / (before + after), out);
        add_velocity(camera, k, after / (before + after), out);
    }
}

/* The smooth motion from key k to the next one, at the fraction s of its time: a cubic Hermite polynomial. */
static void move_smoothly(const sb_camera *camera, size_t k, double s, double mixed[NUMBERS])
{
    double a[NUMBERS], b[NUMBERS], slope_a[NUMBERS], slope_b[NUMBERS];
    const double span = camera->keys[k + 1].time - camera->keys[k].time;
    to_numbers(&camera->keys[k], a);
    to_numbers(&camera->keys[k + 1], b);
    slopes(camera, k, slope_a);
    slopes(camera, k + 1, slope_b);
    const double rise = s * s * (3 - 2 * s), out = s * (1 - s) * (1 - s), in = s * s * (s - 1);
    for (int i = 0; i < NUMBERS; i++)
        mixed[i] = a[i] + (b[i] - a[i]) * rise + span * (slope_a[i] * out + slope_b[i] * in);
}

static double eased(sb_ease ease, double s)
{
    if (ease == SB_EASE_IN) return s * s;
    return ease == SB_EASE_OUT ? s * (2 - s) : s;
}

sb_camera_key sb_camera_at(const sb_camera *camera, double time)
{
    const sb_camera_key *keys = camera->keys;
    size_t last = camera->key_count - 1, k = 0;
    if (time <= keys[0].time || last == 0) return keys[0];
    if (time >= keys[last].time) return keys[last];
    while (keys[k + 1].time <= time) k++;
    const double s = (time - keys[k].time) / (keys[k + 1].time - keys[k].time), part = eased(keys[k].ease, s);
    double a[NUMBERS], b[NUMBERS], mixed[NUMBERS];
    to_numbers(&keys[k], a);
    to_numbers(&keys[k + 1], b);
    for (int i = 0; i < NUMBERS; i++) mixed[i] = a[i] + (b[i] - a[i]) * part;
    if (keys[k].ease == SB_EASE_SMOOTH) move_smoothly(camera, k, s, mixed);
    sb_camera_key key = from_numbers(time, mixed);
    /* The spline may overshoot its keys; the angle must stay within 0 and 180 degrees. */
    key.fov = key.fov < 1 ? 1 : key.fov > 170 ? 170 : key.fov;
    return key;
}

static void clip_planes(sb_view *view, sb_vec3 min, sb_vec3 max)
{
    double near = HUGE_VAL, far = 0;
    for (int corner = 0; corner < 8; corner++) {
        sb_vec3 at = sb_vec(corner & 1 ? max.x : min.x, corner & 2 ? max.y : min.y, corner & 4 ? max.z : min.z);
        double depth = -sb_dot(sb_sub(at, view->eye), view->back);
        near = depth < near ? depth : near;
        far = depth > far ? depth : far;
    }
    double size = sb_norm(sb_sub(max, min));
    if (!(far > 0)) far = size > 0 ? size : 1;
    far *= 1.01;
    /* A depth buffer of 24 bits has enough resolution if near is at least far / 2000. */
    near *= 0.95;
    view->near = near > far / 2000 ? near : far / 2000;
    view->far = far;
}

sb_view sb_view_create(const sb_camera_key *key, double aspect, sb_vec3 min, sb_vec3 max)
{
    sb_view view = {.eye = key->eye, .aspect = aspect};
    view.tangent = tan(key->fov * 0.5 * 3.14159265358979323846 / 180);
    view.back = sb_normalize(sb_sub(key->eye, key->target));
    if (sb_norm(view.back) < 0.5) view.back = sb_vec(0, -1, 0);
    /* For a view straight down, +y points up in the picture. */
    sb_vec3 upward = fabs(view.back.z) > 0.9999 ? sb_vec(0, 1, 0) : sb_vec(0, 0, 1);
    view.right = sb_normalize(sb_cross(upward, view.back));
    view.up = sb_cross(view.back, view.right);
    clip_planes(&view, min, max);
    mat4 projection;
    glm_perspective((float)(2 * atan(view.tangent)), (float)aspect, (float)view.near, (float)view.far, projection);
    memcpy(view.projection, projection, sizeof view.projection);
    return view;
}

void sb_view_matrix(const sb_view *view, sb_vec3 origin, float matrix[16])
{
    sb_vec3 eye = sb_sub(view->eye, origin);
    const sb_vec3 axes[3] = {view->right, view->up, view->back};
    for (int row = 0; row < 3; row++) {
        matrix[row] = (float)axes[row].x;
        matrix[4 + row] = (float)axes[row].y;
        matrix[8 + row] = (float)axes[row].z;
        matrix[12 + row] = (float)-sb_dot(axes[row], eye);
    }
    matrix[3] = matrix[7] = matrix[11] = 0;
    matrix[15] = 1;
}
