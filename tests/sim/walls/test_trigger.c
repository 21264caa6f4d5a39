/* A wave maker that a command starts moves with the bits of one whose scene gives the time. */
#include "check.h"
#include "sim/tank.h"

#include <math.h>
#include <string.h>

enum { BEFORE = 12, MIDDLE = 8, AFTER = 20 };

static const double DR = 1.0 / 20;

static void make(tank *t, double start)
{
    const sb_wavemaker_parameters law = {.kind = sb_wavemaker_find("stroke"),
                                         .start = start,
                                         .stroke = 0.3,
                                         .speed = 0.8,
                                         .gravity = 9.81,
                                         .after = SB_AFTER_STAY};
    tank_of_particles(t, 2, DR, sb_vec(2, 0, 1), 2, 0.75, 0.1);
    tank_add_plate(t, "paddle", -DR / 2, 0, 0.8, sb_vec(1, 0, 0), &law);
}

/* The hash of a run whose paddle a command starts after BEFORE steps; *time: of the command. */
static uint64_t commanded(double *time, sb_archive_out *saved)
{
    tank t;
    sb_error error = {0};
    make(&t, HUGE_VAL);
    sb_sim *sim = tank_settled(&t);
    assert_int_equal(tank_steps(sim, BEFORE), 0);
    assert_true(sb_sim_body_displacement(sim, 1).x == 0);
    *time = sb_sim_report(sim)->time;
    if (sb_sim_trigger(sim, 0, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(sb_sim_trigger(sim, 0, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "its motion began or begins at t ="));
    assert_int_equal(tank_steps(sim, MIDDLE), 0);
    tank_save(sim, saved);
    assert_int_equal(tank_steps(sim, AFTER), 0);
    assert_true(sb_sim_body_displacement(sim, 1).x > 0.01 * DR);
    const uint64_t hash = sb_sim_hash(sim);
    sb_sim_destroy(sim);
    tank_free(&t);
    return hash;
}

static void a_commanded_start_has_the_bits_of_a_given_one(void **state)
{
    (void)state;
    double time;
    sb_archive_out saved = {0};
    sb_error error = {0};
    tank t;
    const uint64_t hash = commanded(&time, &saved);
    assert_true(time > 0);

    make(&t, time);
    sb_sim *sim = tank_settled(&t);
    assert_int_equal(tank_steps(sim, BEFORE + MIDDLE + AFTER), 0);
    assert_true(sb_sim_hash(sim) == hash);
    assert_int_equal(sb_sim_trigger(sim, 0, &error), SB_BAD_INPUT); /* it does not wait */
    sb_sim_destroy(sim);
    tank_free(&t);

    make(&t, HUGE_VAL);
    sim = tank_sim(&t);
    if (tank_load(sim, &saved, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(sb_sim_trigger(sim, 0, &error), SB_BAD_INPUT); /* the checkpoint has the command */
    assert_int_equal(tank_steps(sim, AFTER), 0);
    assert_true(sb_sim_hash(sim) == hash);
    sb_sim_destroy(sim);

    sim = tank_settled(&t);
    assert_int_equal(tank_steps(sim, BEFORE + MIDDLE + AFTER), 0);
    assert_true(sb_sim_hash(sim) != hash);
    assert_true(sb_sim_body_displacement(sim, 1).x == 0);
    sb_sim_destroy(sim);
    tank_free(&t);
    sb_archive_out_free(&saved);
}

/* A state from before the command waits again. */
static void a_waiting_state_is_saved_as_waiting(void **state)
{
    (void)state;
    tank t;
    sb_archive_out saved = {0};
    sb_error error = {0};
    make(&t, HUGE_VAL);
    sb_sim *sim = tank_settled(&t);
    assert_int_equal(tank_steps(sim, BEFORE), 0);
    tank_save(sim, &saved);
    assert_int_equal(sb_sim_trigger(sim, 0, &error), SB_OK);
    assert_int_equal(tank_steps(sim, AFTER), 0);
    const uint64_t hash = sb_sim_hash(sim);
    sb_sim_destroy(sim);
    sim = tank_sim(&t);
    if (tank_load(sim, &saved, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(sb_sim_trigger(sim, 0, &error), SB_OK);
    assert_int_equal(tank_steps(sim, AFTER), 0);
    assert_true(sb_sim_hash(sim) == hash);
    sb_sim_destroy(sim);
    sb_archive_out_free(&saved);
    tank_free(&t);
}

static void trigger(void *context, int done, int most, double speed)
{
    sb_error error = {0};
    (void)done;
    (void)most;
    (void)speed;
    assert_int_equal(sb_sim_trigger(context, 0, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "the water settles"));
}

static void settling_takes_no_trigger(void **state)
{
    (void)state;
    tank t;
    make(&t, HUGE_VAL);
    t.scene.sea = (sb_sea){.present = true, .level = 0.75};
    t.scene.numerics.settle_steps = 20;
    sb_sim *sim = tank_sim(&t);
    assert_int_equal(sb_sim_settle_watched(sim, trigger, sim, NULL), SB_OK);
    assert_int_equal(sb_sim_trigger(sim, 0, NULL), SB_OK);
    sb_sim_destroy(sim);
    tank_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_commanded_start_has_the_bits_of_a_given_one),
                                       cmocka_unit_test(a_waiting_state_is_saved_as_waiting),
                                       cmocka_unit_test(settling_takes_no_trigger)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
