/* Contact resolution stops particles that come too close to a wall, along the wall's normal, and adds no energy. */
#include "../check.h"
#include "base/random.h"
#include "sim/tank.h"
#include "sim/walls/contact.h"

#include <stdio.h>

/* A tank of still water with a plate half a spacing from the nearest water, which is closer than contact resolution
   permits. */
static sb_sim *crowded(tank *t, int dimensions)
{
    tank_make(t, dimensions, 0.1, sb_vec(0.8, 0.8, 1.2), 0.8, 0.8, 0);
    tank_cubic(t);
    tank_add_plate(t, "plate", 0.4, 0, 1, sb_vec(0, 0, 0), NULL);
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    assert_int_equal(tank_prepare(sim, 0.01), 0);
    return sim;
}

/* Number of particles at rest that contact resolution moves, and their highest speed, m/s. */
static size_t moved_from_rest(const sb_sim *sim, double *most)
{
    size_t count = 0;
    *most = 0;
    for (size_t i = 0; i < sim->state.n; i++) {
        sb_f4 v = {0};
        sb_contact_push pushes[SB_CONTACT_PUSHES_MAX];
        if (sb_contact_resolve(sim, i, &v, pushes) == 0) continue;
        count++;
        *most = fmax(*most, sqrt((double)sb_sum3(v * v)));
    }
    return count;
}

static void only_settling_moves_out_water_at_rest(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        tank t;
        sb_sim *sim = crowded(&t, dimensions);
        double most;
        const size_t beside = 2 * 8 * (dimensions == 3 ? 8 : 1);
        assert_ptr_equal(sim->policy, &sb_policy_run);
        const size_t running = moved_from_rest(sim, &most);
        assert_true(most < 1e-9);
        sim->policy = &sb_policy_creep;
        const size_t settling = moved_from_rest(sim, &most);
        printf("%dD: %zu stopped in a run, %zu moved out in settling, %.3g m/s at most\n", dimensions, running,
               settling, most);
        assert_int_equal(settling, beside);
        assert_true(most > 0 && most < 0.1); /* a hundredth of a spacing a step at most */
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

static void approaching_particles_are_stopped_without_energy_gain(void **state)
{
    (void)state;
    tank t;
    sb_sim *sim = crowded(&t, 3);
    size_t stopped = 0;
    double all_before = 0, all_after = 0;
    for (size_t i = 0; i < sim->state.n; i++) {
        const sb_f4 start = {(float)(6 * sb_random(5, 3 * i) - 3), (float)(6 * sb_random(5, 3 * i + 1) - 3),
                             (float)(6 * sb_random(5, 3 * i + 2) - 3), 0};
        sb_f4 v = start, sum = start;
        sb_contact_push pushes[SB_CONTACT_PUSHES_MAX];
        const size_t count = sb_contact_resolve(sim, i, &v, pushes);
        if (count == 0) continue;
        stopped++;
        for (size_t k = 0; k < count; k++) sum += pushes[k].change;
        sum -= v;
        assert_true((double)sb_sum3(sum * sum) < 1e-10); /* (m/s)^2: bodies receive what the water loses */
        const double before = (double)sb_sum3(start * start), after = (double)sb_sum3(v * v);
        assert_true(after < 1.01 * before); /* the unevenness of the boundary surface may lift particles */
        all_before += before;
        all_after += after;
    }
    printf("%zu stopped, %.3g of their energy left\n", stopped, all_after / all_before);
    assert_true(stopped > 50 && all_after < 0.8 * all_before);
    sb_sim_destroy(sim);
    tank_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_settling_moves_out_water_at_rest),
        cmocka_unit_test(approaching_particles_are_stopped_without_energy_gain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
