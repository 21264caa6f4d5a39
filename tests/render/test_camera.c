/* The camera's path through its keys, and the view matrices. */
#include "render/camera/camera.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static void near_vec(sb_vec3 a, sb_vec3 b, double tolerance)
{
    assert_true(sb_norm(sb_sub(a, b)) <= tolerance);
}

static void fixed_camera_stays(void **state)
{
    (void)state;
    sb_camera_key key = {5, {1, 2, 3}, {4, 5, 6}, 40, SB_EASE_SMOOTH};
    sb_camera camera = {.name = "fixed", .key_count = 1, .keys = &key};
    for (double t = -10; t < 100; t += 15) {
        sb_camera_key at = sb_camera_at(&camera, t);
        near_vec(at.eye, key.eye, 0);
        near_vec(at.target, key.target, 0);
        assert_true(at.fov == 40);
    }
}

static void path_passes_keys_with_continuous_velocity(void **state)
{
    (void)state;
    sb_camera_key keys[] = {{0, {0, 0, 10}, {1, 0, 0}, 40, SB_EASE_SMOOTH},
                            {2, {20, 5, 12}, {2, 1, 0}, 50, SB_EASE_SMOOTH},
                            {7, {60, -5, 30}, {3, 0, 5}, 60, SB_EASE_SMOOTH},
                            {10, {80, 0, 20}, {9, 9, 9}, 45, SB_EASE_SMOOTH}};
    sb_camera camera = {.name = "path", .key_count = 4, .keys = keys};
    const double d = 1e-5;
    for (int k = 0; k < 4; k++) {
        sb_camera_key at = sb_camera_at(&camera, keys[k].time);
        near_vec(at.eye, keys[k].eye, 1e-12);
        near_vec(at.target, keys[k].target, 1e-12);
        sb_vec3 before = sb_camera_at(&camera, keys[k].time - d).eye;
        sb_vec3 after = sb_camera_at(&camera, keys[k].time + d).eye;
        sb_vec3 in = sb_scale(sb_sub(at.eye, before), 1 / d);
        sb_vec3 out = sb_scale(sb_sub(after, at.eye), 1 / d);
        near_vec(in, out, 1e-2);
        if (k == 0 || k == 3) near_vec(out, sb_vec(0, 0, 0), 1e-2);
    }
    /* The slope at a key is the difference of its neighbours over their time difference. */
    sb_vec3 slope = sb_scale(sb_sub(sb_camera_at(&camera, 2 + d).eye, keys[1].eye), 1 / d);
    near_vec(slope, sb_vec(60.0 / 7, -5.0 / 7, 20.0 / 7), 1e-2);
    near_vec(sb_camera_at(&camera, -1).eye, keys[0].eye, 0);
    near_vec(sb_camera_at(&camera, 11).eye, keys[3].eye, 0);
}

static void two_keys_ease_in_and_out(void **state)
{
    (void)state;
    sb_camera_key keys[] = {{10, {0, 0, 0}, {0, 1, 0}, 30, SB_EASE_SMOOTH},
                            {20, {8, 0, 0}, {0, 1, 0}, 50, SB_EASE_SMOOTH}};
    sb_camera camera = {.name = "ease", .key_count = 2, .keys = keys};
    near_vec(sb_camera_at(&camera, 15).eye, sb_vec(4, 0, 0), 1e-12);
    near_vec(sb_camera_at(&camera, 12.5).eye, sb_vec(8 * 0.15625, 0, 0), 1e-12);
    assert_true(fabs(sb_camera_at(&camera, 15).fov - 40) < 1e-12);
}

/* The motions of each kind between two places, and their velocities where they meet a smooth one. */
static void each_ease_moves_as_it_says(void **state)
{
    (void)state;
    static const struct {
        sb_ease ease;
        double quarter, half, start, end; /* m at s = 1/4 and 1/2 of 8 m; velocities over the mean */
    } rows[] = {{SB_EASE_LINEAR, 2, 4, 1, 1}, {SB_EASE_IN, 0.5, 2, 0, 2}, {SB_EASE_OUT, 3.5, 6, 2, 0}};
    const double d = 1e-6, mean = 0.8;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        sb_camera_key keys[] = {{0, {-3, 0, 0}, {0, 1, 0}, 30, SB_EASE_SMOOTH},
                                {10, {0, 0, 0}, {0, 1, 0}, 30, rows[i].ease},
                                {20, {8, 0, 0}, {0, 1, 0}, 50, SB_EASE_SMOOTH},
                                {25, {9, 0, 0}, {0, 1, 0}, 50, SB_EASE_SMOOTH}};
        sb_camera camera = {.name = "ease", .key_count = 4, .keys = keys};
        near_vec(sb_camera_at(&camera, 12.5).eye, sb_vec(rows[i].quarter, 0, 0), 1e-12);
        near_vec(sb_camera_at(&camera, 15).eye, sb_vec(rows[i].half, 0, 0), 1e-12);
        const double before = sb_camera_at(&camera, 10 - d).eye.x, after = sb_camera_at(&camera, 10 + d).eye.x;
        assert_true(fabs(after / d - rows[i].start * mean) < 1e-4 && fabs(-before / d - rows[i].start * mean) < 1e-4);
        const double in = sb_camera_at(&camera, 20 - d).eye.x, out = sb_camera_at(&camera, 20 + d).eye.x;
        assert_true(fabs((8 - in) / d - rows[i].end * mean) < 1e-4 && fabs((out - 8) / d - rows[i].end * mean) < 1e-4);
    }
}

static sb_vec3 project(const sb_view *view, sb_vec3 origin, sb_vec3 point)
{
    float m[16];
    sb_view_matrix(view, origin, m);
    sb_vec3 p = sb_sub(point, origin);
    double e[3], clip[4];
    for (int row = 0; row < 3; row++)
        e[row] = (double)m[row] * p.x + (double)m[4 + row] * p.y + (double)m[8 + row] * p.z + (double)m[12 + row];
    for (int row = 0; row < 4; row++)
        clip[row] = (double)view->projection[row] * e[0] + (double)view->projection[4 + row] * e[1] +
                    (double)view->projection[8 + row] * e[2] + (double)view->projection[12 + row];
    return sb_scale(sb_vec(clip[0], clip[1], clip[2]), 1 / clip[3]);
}

static void view_projects_points_correctly(void **state)
{
    (void)state;
    sb_camera_key key = {.eye = {0, -100, 0}, .fov = 90};
    sb_view view = sb_view_create(&key, 2, sb_vec(-50, -50, -50), sb_vec(50, 50, 50));
    near_vec(sb_vec(project(&view, sb_vec(0, 0, 0), sb_vec(0, 0, 0)).x, 0, 0), sb_vec(0, 0, 0), 1e-6);
    /* The vertical angle is 90 degrees, so a height of 100 m at a distance of 100 m is at the picture's upper edge. */
    sb_vec3 corner = project(&view, sb_vec(0, 0, 0), sb_vec(200, 0, 100));
    assert_true(fabs(corner.x - 1) < 1e-5 && fabs(corner.y - 1) < 1e-5);
    /* The whole box lies between the clip planes. */
    assert_true(project(&view, sb_vec(0, 0, 0), sb_vec(0, -50, 0)).z > -1);
    assert_true(project(&view, sb_vec(0, 0, 0), sb_vec(0, 50, 0)).z < 1);
}

static void view_keeps_its_precision_far_away(void **state)
{
    (void)state;
    sb_vec3 far = sb_vec(1e6, -1e6, 300);
    sb_camera_key near_key = {.eye = {30, -80, 40}, .target = {1, 2, 3}, .fov = 50}, far_key = near_key;
    far_key.eye = sb_add(far_key.eye, far);
    far_key.target = sb_add(far_key.target, far);
    sb_vec3 min = sb_vec(-50, -50, -50), max = sb_vec(50, 50, 50);
    sb_view a = sb_view_create(&near_key, 1.5, min, max);
    sb_view b = sb_view_create(&far_key, 1.5, sb_add(min, far), sb_add(max, far));
    sb_vec3 p = sb_vec(7.25, -3.5, 1.125);
    near_vec(project(&a, sb_vec(0, 0, 0), p), project(&b, far, sb_add(p, far)), 1e-6);
}

static void looking_straight_down_works(void **state)
{
    (void)state;
    sb_camera_key key = {.eye = {5, 5, 100}, .target = {5, 5, 0}, .fov = 60};
    sb_view view = sb_view_create(&key, 1, sb_vec(0, 0, 0), sb_vec(10, 10, 10));
    near_vec(view.right, sb_vec(1, 0, 0), 1e-12);
    near_vec(view.up, sb_vec(0, 1, 0), 1e-12);
    assert_true(view.near > 0 && view.far > view.near);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fixed_camera_stays),
        cmocka_unit_test(path_passes_keys_with_continuous_velocity),
        cmocka_unit_test(two_keys_ease_in_and_out),
        cmocka_unit_test(each_ease_moves_as_it_says),
        cmocka_unit_test(view_projects_points_correctly),
        cmocka_unit_test(view_keeps_its_precision_far_away),
        cmocka_unit_test(looking_straight_down_works),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
