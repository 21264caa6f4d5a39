/* A frame that is carried to another time. */
#include "../check.h"
#include "frame/frame.h"

static void particles_and_bodies_move_along_their_velocities(void **state)
{
    (void)state;
    sb_frame *frame = sb_frame_create(2, 2);
    assert_non_null(frame);
    for (int k = 0; k < 6; k++) {
        frame->position[k] = (float)k;
        frame->velocity[k] = (float)(10 - k);
    }
    frame->pressure[1] = 7;
    frame->status.time = 2;
    frame->status.step = 9;
    frame->bodies[0].displacement = sb_vec(1, 2, 3);
    frame->bodies[0].velocity = sb_vec(4, 0, -8);
    sb_frame_carry(frame, 1.75);
    for (int k = 0; k < 6; k++) {
        assert_true(frame->position[k] == (float)k - 0.25f * (float)(10 - k));
        assert_true(frame->velocity[k] == (float)(10 - k));
    }
    assert_true(frame->status.time == 1.75 && frame->status.step == 9 && frame->pressure[1] == 7);
    const sb_vec3 moved = frame->bodies[0].displacement, rests = frame->bodies[1].displacement;
    assert_true(moved.x == 0 && moved.y == 2 && moved.z == 5 && sb_norm(rests) == 0);
    /* The time of the step changes no bit. */
    float before[6];
    for (int k = 0; k < 6; k++) before[k] = frame->position[k];
    sb_frame_carry(frame, 1.75);
    for (int k = 0; k < 6; k++) assert_true(frame->position[k] == before[k]);
    sb_frame_release(frame);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(particles_and_bodies_move_along_their_velocities)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
