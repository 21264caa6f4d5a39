/* Cameras that find their place: on a circle, close to a body, beside the crest. */
#include "../check.h"
#include "render/camera/camera.h"
#include "render/camera/cameras.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void near_vec(sb_vec3 a, sb_vec3 b, double tolerance)
{
    assert_true(sb_norm(sb_sub(a, b)) <= tolerance);
}

/* A scene with one camera, a model with one box that is 4 m x 2 m x 6 m large, and a frame. */
typedef struct stage {
    sb_camera camera;
    sb_camera_key key;
    sb_scene scene;
    sb_vec3 vertices[2];
    sb_model_body body;
    sb_model model;
    sb_frame *frame;
} stage;

static stage *make_stage(size_t particles)
{
    static stage s;
    s = (stage){.vertices = {{10, 20, 0}, {14, 22, 6}}};
    snprintf(s.camera.name, sizeof s.camera.name, "film");
    snprintf(s.body.name, sizeof s.body.name, "tank");
    s.camera.fov = 40;
    s.camera.keys = &s.key;
    s.scene.dimensions = 3;
    s.scene.render.cameras = &s.camera;
    s.scene.render.camera_count = 1;
    s.body.mesh.vertices = s.vertices;
    s.body.mesh.vertex_count = 2;
    s.model.bodies = &s.body;
    s.model.body_count = 1;
    s.frame = sb_frame_create(particles, 1);
    assert_non_null(s.frame);
    s.frame->spacing = 0.5;
    return &s;
}

static void an_orbit_is_a_circle(void **state)
{
    (void)state;
    stage *s = make_stage(0);
    sb_camera_motion motion = {0};
    s->camera.kind = SB_CAMERA_ORBIT;
    s->camera.orbit = (sb_orbit){.target = {5, 6, 7}, .radius = 10, .height = 3, .period = -8, .from = 90};
    for (double t = 0; t < 20; t += 0.7) {
        s->frame->status.time = t;
        const sb_camera_key at = sb_cameras_at(&s->scene, &s->model, 0, s->frame, 1.5, &motion);
        /* A negative period is clockwise. */
        const double angle = 2 * 3.14159265358979323846 * (0.25 - t / 8);
        near_vec(at.eye, sb_vec(5 + 10 * cos(angle), 6 + 10 * sin(angle), 10), 1e-9);
        near_vec(at.target, sb_vec(5, 6, 7), 0);
        assert_true(at.fov == 40);
    }
    sb_frame_release(s->frame);
}

/* The largest coordinate of the box's corners in the picture, whose edges are at 1. */
static double reach(const sb_view *view, sb_vec3 low, sb_vec3 high)
{
    double most = 0;
    for (int c = 0; c < 8; c++) {
        const sb_vec3 at =
            sb_sub(sb_vec(c & 1 ? high.x : low.x, c & 2 ? high.y : low.y, c & 4 ? high.z : low.z), view->eye);
        const double depth = -sb_dot(at, view->back);
        assert_true(depth > 0);
        most = fmax(most, fabs(sb_dot(at, view->right)) / (depth * view->tangent * view->aspect));
        most = fmax(most, fabs(sb_dot(at, view->up)) / (depth * view->tangent));
    }
    return most;
}

/* From any direction and at any shape of picture, the box of the moved body touches the picture's edge and does not
   pass it. */
static void a_closeup_fits_the_body(void **state)
{
    (void)state;
    static const sb_vec3 directions[] = {{1, 0, 0}, {-3, -2, 1}, {0.1, -0.2, 5}, {0, 0, 1}, {1, 1, -0.5}};
    static const double aspects[] = {0.4, 1, 16.0 / 9, 3};
    stage *s = make_stage(0);
    sb_camera_motion motion = {0};
    const sb_vec3 moved = sb_vec(1, -2, 0.5);
    s->camera.kind = SB_CAMERA_CLOSEUP;
    s->camera.margin = 1;
    s->frame->bodies[0].displacement = moved;
    snprintf(s->camera.body, sizeof s->camera.body, "tank");
    assert_int_equal(sb_cameras_check(&s->scene, &s->model, NULL), SB_OK);
    for (size_t d = 0; d < sizeof directions / sizeof *directions; d++)
        for (size_t a = 0; a < sizeof aspects / sizeof *aspects; a++) {
            const sb_vec3 low = sb_add(s->vertices[0], moved), high = sb_add(s->vertices[1], moved);
            s->camera.direction = directions[d];
            const sb_camera_key key = sb_cameras_at(&s->scene, &s->model, 0, s->frame, aspects[a], &motion);
            const sb_view view = sb_view_create(&key, aspects[a], low, high);
            near_vec(key.target, sb_scale(sb_add(low, high), 0.5), 1e-12);
            near_vec(view.back, sb_normalize(directions[d]), 1e-9);
            const double most = reach(&view, low, high);
            if (fabs(most - 1) > 1e-9) fail_msg("direction %zu, aspect %g: the box reaches %.12g", d, aspects[a], most);
        }
    sb_frame_release(s->frame);
}

static void an_unknown_body_is_refused(void **state)
{
    (void)state;
    stage *s = make_stage(0);
    sb_error error = {0};
    s->camera.kind = SB_CAMERA_CLOSEUP;
    snprintf(s->camera.body, sizeof s->camera.body, "tnak");
    assert_int_equal(sb_cameras_check(&s->scene, &s->model, &error), SB_BAD_INPUT);
    assert_string_equal(error.text, "render.cameras.film.closeup: no body is named tnak, did you mean tank?");
    sb_frame_release(s->frame);
}

/* Water of 40 m x 4 m x 2 m with a crest of 3 m height and 4 m length at `at`, and spray above. Lines along x and along
   y. Returns the number of particles. */
static size_t fill(float *position, double at, bool along_y, bool crest)
{
    const double dx = 0.5;
    size_t n = 0;
    for (double x = 0.25; x < 40; x += dx)
        for (double y = 0.25; y < 4; y += dx)
            for (double z = 0.25; z < (crest && fabs(x - at) < 2 ? 5 : 2); z += dx) {
                if (position) position[3 * n] = (float)(along_y ? y : x);
                if (position) position[3 * n + 1] = (float)(along_y ? x : y);
                if (position) position[3 * n + 2] = (float)z;
                n++;
            }
    for (int i = 0; i < 3; i++) { /* three drops far above */
        if (position) position[3 * n] = position[3 * n + 1] = 1;
        if (position) position[3 * n + 2] = 20.0f + (float)i;
        n++;
    }
    return n;
}

static const sb_follow along_x = {.bx = 40, .ay = 2, .by = 2}, along_y = {.by = 40, .ax = 2, .bx = 2};

static void the_crest_is_found(void **state)
{
    (void)state;
    for (int y = 0; y < 2; y++)
        for (double at = 5.5; at < 36; at += 6) {
            stage *s = make_stage(fill(NULL, at, y, true));
            fill(s->frame->position, at, y, true);
            double place = -1;
            assert_true(sb_cameras_crest(y ? &along_y : &along_x, s->frame, 3, &place));
            if (fabs(place - at) > 0.5) fail_msg("the crest at %g m is found at %g m", at, place);
            sb_frame_release(s->frame);
        }
    /* Still water has no crest, and the drops above it are none. */
    stage *s = make_stage(fill(NULL, 10, false, false));
    fill(s->frame->position, 10, false, false);
    double place = -1;
    assert_false(sb_cameras_crest(&along_x, s->frame, 3, &place));
    assert_true(place == -1);
    sb_frame_release(s->frame);
    s = make_stage(0);
    assert_false(sb_cameras_crest(&along_x, s->frame, 3, &place));
    sb_frame_release(s->frame);
}

/* Follows a crest that runs with 4 m/s, with `frames` pictures in 5 s. */
static sb_camera_key follow(int frames, double smoothing, bool travel, double *most_jump)
{
    sb_camera_motion motion = {0};
    sb_camera_key key = {0}, before = {0};
    *most_jump = 0;
    for (int i = 0; i <= frames; i++) {
        const double t = 5.0 * i / frames, at = 8 + 4 * t;
        stage *s = make_stage(fill(NULL, at, false, true));
        fill(s->frame->position, at, false, true);
        s->camera.kind = SB_CAMERA_FOLLOW;
        s->camera.key_count = 1;
        s->key = (sb_camera_key){.eye = {8, -20, 5}, .target = {8, 2, 2}, .fov = 40};
        s->camera.follow = along_x;
        s->camera.follow.smoothing = smoothing;
        s->camera.follow.travel = travel;
        s->frame->status.time = t;
        key = sb_cameras_at(&s->scene, &s->model, 0, s->frame, 1.5, &motion);
        if (i > 0) *most_jump = fmax(*most_jump, sb_norm(sb_sub(key.target, before.target)));
        before = key;
        sb_frame_release(s->frame);
    }
    return key;
}

static void a_camera_follows_the_crest_smoothly(void **state)
{
    (void)state;
    double jump, rough;
    /* A critically damped spring with time constant T lags behind a constant speed U by U T. */
    const sb_camera_key smooth = follow(100, 0.5, false, &jump);
    assert_true(fabs(smooth.target.x - (28 - 4 * 0.5)) < 0.5);
    near_vec(smooth.eye, sb_vec(8, -20, 5), 0);
    const sb_camera_key at_once = follow(100, 0, true, &rough);
    assert_true(fabs(at_once.target.x - 28) <= 0.5);
    near_vec(sb_sub(at_once.eye, at_once.target), sb_vec(0, -22, 3), 1e-9);
    /* The crest moves 0.2 m per picture, and its middle is found in steps of half a column of 1 m. */
    assert_true(jump < 0.25 && rough > 0.45);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_orbit_is_a_circle),
        cmocka_unit_test(a_closeup_fits_the_body),
        cmocka_unit_test(an_unknown_body_is_refused),
        cmocka_unit_test(the_crest_is_found),
        cmocka_unit_test(a_camera_follows_the_crest_smoothly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
