/* A snapshot that is carried back through its step has the places at the step's start: particles move along straight
   lines with their velocity at the step's end. */
#include "base/memory.h"
#include "check.h"
#include "sim/tank.h"

#include <math.h>
#include <stdlib.h>

/* Places by id, m in the scene. */
static sb_vec3 *places(const sb_frame *frame, size_t most)
{
    sb_vec3 *at = sb_alloc(most, sizeof *at);
    assert_non_null(at);
    for (size_t i = 0; i < frame->count; i++) {
        assert_true(frame->id[i] < most);
        const float *p = frame->position + 3 * i;
        at[frame->id[i]] = sb_add(frame->origin, sb_vec((double)p[0], (double)p[1], (double)p[2]));
    }
    return at;
}

static sb_frame *snapshot(const sb_sim *sim)
{
    sb_frame *frame = sb_sim_snapshot(sim);
    assert_non_null(frame);
    return frame;
}

static void a_carried_snapshot_is_that_of_the_step_before(void **state)
{
    (void)state;
    tank t;
    const sb_wavemaker_parameters law = {
        .kind = sb_wavemaker_find("stroke"), .stroke = 1, .speed = 0.5, .gravity = 9.81};
    tank_of_particles(&t, 2, 0.05, sb_vec(2, 0, 1), 0.8, 0.6, 0);
    const size_t plate = tank_add_plate(&t, "plate", 1.9, 0, 0.5, sb_vec(-1, 0, 0), &law);
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    assert_int_equal(tank_steps(sim, 30), 0);
    sb_frame *before = snapshot(sim);
    assert_int_equal(tank_steps(sim, 1), 0);
    sb_frame *start = snapshot(sim), *middle = snapshot(sim), *end = snapshot(sim);
    const double dt = end->status.time - before->status.time, gravity = 9.81;
    assert_true(dt > 0 && end->count == before->count);
    sb_frame_carry(start, before->status.time);
    sb_frame_carry(middle, before->status.time + 0.5 * dt);
    const size_t count = end->count;
    sb_vec3 *a = places(before, count), *b = places(end, count), *at_a = places(start, count),
            *at_m = places(middle, count);
    double moved = 0;
    size_t exact = 0;
    for (size_t i = 0; i < count; i++) {
        const double off = sb_norm(sb_sub(at_a[i], a[i]));
        moved = fmax(moved, sb_norm(sb_sub(b[i], a[i])));
        /* Positions are rounded to single precision. A particle without neighbours moves along a parabola, and contact
           moves a particle by more or less than its velocity. */
        exact += off < 1e-6;
        if (off > gravity * dt * dt + 0.01 * 0.05) fail_msg("particle %zu is off by %g m", i, off);
        const sb_vec3 half = sb_scale(sb_add(at_a[i], b[i]), 0.5);
        assert_true(sb_norm(sb_sub(at_m[i], half)) < 1e-6);
    }
    /* The places would differ by hundreds of times more without the carry. */
    assert_true(moved > 2e-3);
    if (exact < count * 95 / 100) fail_msg("%zu of %zu particles are where they were", exact, count);
    const sb_vec3 body = start->bodies[plate].displacement, was = before->bodies[plate].displacement;
    if (!(sb_norm(sb_sub(body, was)) < 1e-12 && sb_norm(sb_sub(end->bodies[plate].displacement, was)) > 1e-4))
        fail_msg("the plate is %g m from where it was", sb_norm(sb_sub(body, was)));
    sb_free(a);
    sb_free(b);
    sb_free(at_a);
    sb_free(at_m);
    sb_frame_release(before);
    sb_frame_release(start);
    sb_frame_release(middle);
    sb_frame_release(end);
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* Frames have the density error of each particle if a camera shows it, and no memory for it otherwise. */
static void the_density_error_is_there_if_it_is_shown(void **state)
{
    (void)state;
    tank t;
    sb_camera camera = {.name = "c"};
    tank_of_particles(&t, 2, 0.05, sb_vec(2, 0, 1), 0.8, 0.6, 0);
    t.scene.render.cameras = &camera;
    t.scene.render.camera_count = 1;
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    assert_int_equal(tank_steps(sim, 20), 0);
    sb_frame *without = snapshot(sim);
    assert_null(without->density_error);
    camera.slice = (sb_slice){.normal = {0, 1, 0}, .field = SB_COLOR_DENSITY_ERROR};
    sb_frame *with = snapshot(sim);
    assert_non_null(with->density_error);
    const double rest = t.scene.fluid.density;
    double most = 0;
    for (size_t i = 0; i < with->count; i++) {
        const double error = sb_sim_particle(sim, i).density / rest - 1;
        assert_true(fabs((double)with->density_error[i] - error) < 1e-6);
        most = fmax(most, error);
    }
    assert_true(most > 1e-6); /* water under pressure is denser than at rest */
    camera = (sb_camera){.name = "c"};
    t.scene.render.cameras = NULL;
    t.scene.render.camera_count = 0;
    sb_frame_release(without);
    sb_frame_release(with);
    sb_sim_destroy(sim);
    tank_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_carried_snapshot_is_that_of_the_step_before),
                                       cmocka_unit_test(the_density_error_is_there_if_it_is_shown)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
