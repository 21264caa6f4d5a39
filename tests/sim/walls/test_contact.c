/* Contact resolution stops particles that come too close to a wall, along the wall's normal, and adds no energy. */
#include "base/random.h"
#include "check.h"
#include "sim/tank.h"
#include "sim/walls/contact.h"

#include <stdio.h>

static const double DR = 0.1, PLATE = 0.4, SIZE = 0.8;

/* A tank of still water with a plate. The nearest water is 0.05 spacings away from the plate's facets, which is 0.05
   spacings closer than contact resolution permits. */
static sb_sim *crowded(tank *t, int dimensions, sb_preset preset)
{
    tank_of_particles(t, dimensions, DR, sb_vec(SIZE, SIZE, 1.2), SIZE, SIZE, 0);
    tank_use(t, preset);
    t->scene.numerics.jitter = 0;
    const double shift = (t->scene.numerics.wall_offset - 0.45) * DR;
    for (size_t i = 0; i < t->model.fluid_count; i++)
        t->model.fluid_position[i].x += t->model.fluid_position[i].x < PLATE ? -shift : shift;
    tank_add_plate(t, "plate", PLATE, 0, 1, sb_vec(0, 0, 0), NULL);
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    assert_int_equal(tank_prepare(sim, 0.01), 0);
    return sim;
}

/* Moves of particles at rest. */
typedef struct moves {
    size_t beside, away; /* of particles next to the plate, and of others */
    double speed;        /* highest of all, m/s */
} moves;

/* The velocity after contact of particle i of a group, and the number of pushes, whose sum is added to *given. */
static sb_f4 resolved(const sb_sim *sim, const sb_group *group, size_t i, sb_f4 velocity, size_t *count, sb_f4 *given)
{
    sb_facet_contact c;
    *count = 0;
    for (; *count < SB_CONTACT_PUSHES_MAX && sb_contact_find(sim, group, i, velocity, &c); ++*count) {
        const sb_f4 change = c.normal * sb_splat(c.push * (float)(sim->space.quantum / sim->state.time_step));
        *given += change;
        velocity += change;
    }
    return velocity;
}

static moves moves_from_rest(const sb_sim *sim)
{
    moves all = {0};
    for (size_t g = 0; g < sim->groups.count; g++)
        for (size_t i = sim->groups.group[g].first; i < sim->groups.group[g].end; i++) {
            size_t count;
            sb_f4 given = {0};
            const sb_f4 v = resolved(sim, &sim->groups.group[g], i, (sb_f4){0}, &count, &given);
            if (count == 0) continue;
            const bool beside = fabs(sb_sim_particle(sim, i).position.x - PLATE) < DR;
            all.beside += beside;
            all.away += !beside;
            all.speed = fmax(all.speed, sqrt((double)sb_sum3(v * v)));
        }
    return all;
}

static void only_settling_moves_out_water_at_rest(void **state)
{
    (void)state;
    for (sb_preset preset = SB_PRESET_DEFAULT; preset <= SB_PRESET_PAPER; preset++)
        for (int dimensions = 2; dimensions <= 3; dimensions++) {
            tank t;
            sb_sim *sim = crowded(&t, dimensions, preset);
            const size_t beside = 2 * 8 * (dimensions == 3 ? 8 : 1);
            assert_ptr_equal(sim->policy, &sb_policy_run);
            const moves running = moves_from_rest(sim);
            assert_true(running.speed < 1e-9);
            sim->policy = &sb_policy_creep;
            const moves settling = moves_from_rest(sim);
            printf("%dD, %s: %zu moved out in settling beside the plate, %zu away from it, %.3g m/s at most\n",
                   dimensions, tank_preset_names[preset], settling.beside, settling.away, settling.speed);
            assert_int_equal(settling.beside, beside);
            assert_int_equal(settling.away, 0);
            assert_true(settling.speed > 0 && settling.speed < 0.1); /* a hundredth of a spacing a step at most */
            sb_sim_destroy(sim);
            tank_free(&t);
        }
}

static void check_approach(sb_preset preset)
{
    tank t;
    sb_sim *sim = crowded(&t, 3, preset);
    size_t stopped = 0;
    double all_before = 0, all_after = 0;
    for (size_t g = 0; g < sim->groups.count; g++)
        for (size_t i = sim->groups.group[g].first; i < sim->groups.group[g].end; i++) {
            const sb_f4 start = {(float)(6 * sb_random(5, 3 * i) - 3), (float)(6 * sb_random(5, 3 * i + 1) - 3),
                                 (float)(6 * sb_random(5, 3 * i + 2) - 3), 0};
            sb_f4 sum = start;
            size_t count;
            const sb_f4 v = resolved(sim, &sim->groups.group[g], i, start, &count, &sum);
            if (count == 0) continue;
            stopped++;
            sum -= v;
            assert_true((double)sb_sum3(sum * sum) < 1e-10); /* (m/s)^2: bodies receive what the water loses */
            const double before = (double)sb_sum3(start * start), after = (double)sb_sum3(v * v);
            assert_true(after <= before * (1 + 1e-6));
            all_before += before;
            all_after += after;
        }
    printf("%s: %zu stopped, %.3g of their energy left\n", tank_preset_names[preset], stopped, all_after / all_before);
    assert_true(stopped > 50 && all_after < 0.8 * all_before);
    sb_sim_destroy(sim);
    tank_free(&t);
}

static void approaching_particles_are_stopped_without_energy_gain(void **state)
{
    (void)state;
    for (sb_preset preset = SB_PRESET_DEFAULT; preset <= SB_PRESET_PAPER; preset++) check_approach(preset);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_settling_moves_out_water_at_rest),
        cmocka_unit_test(approaching_particles_are_stopped_without_energy_gain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
