/* Contact resolution stops particles that come too close to a wall, along the wall's normal, and adds no energy. */
#include "base/random.h"
#include "check.h"
#include "sim/tank.h"
#include "sim/walls/contact.h"

#include <stdio.h>

static const double DR = 0.1, PLATE = 0.4, SIZE = 0.8;

/* A tank of still water with a plate. The nearest water is wall_offset away from the plate, which is 0.05 spacings
   closer than contact resolution permits. */
static sb_sim *crowded(tank *t, int dimensions, sb_preset preset)
{
    tank_of_particles(t, dimensions, DR, sb_vec(SIZE, SIZE, 1.2), SIZE, SIZE, 0);
    tank_use(t, preset);
    t->scene.numerics.jitter = 0;
    const double shift = (t->scene.numerics.wall_offset - 0.5) * DR;
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
    size_t beside, away; /* of particles next to the plate, and of others that have no wall within a spacing */
    double speed;        /* highest of all, m/s */
} moves;

static moves moves_from_rest(const sb_sim *sim)
{
    moves all = {0};
    const bool flat = sim->constant.dimension == 2;
    for (size_t i = 0; i < sim->state.n; i++) {
        sb_f4 v = {0};
        sb_contact_push pushes[SB_CONTACT_PUSHES_MAX];
        if (sb_contact_resolve(sim, i, &v, pushes) == 0) continue;
        const sb_vec3 x = sb_sim_particle(sim, i).position;
        const bool inside = x.x > DR && x.x < SIZE - DR && x.z > DR && (flat || (x.y > DR && x.y < SIZE - DR));
        const bool beside = fabs(x.x - PLATE) < DR;
        all.beside += beside;
        all.away += inside && !beside;
        all.speed = fmax(all.speed, sqrt((double)sb_sum3(v * v)));
    }
    return all;
}

/* Particles in the corners of the tank may move too: there the mean plane of the walls is closer than each wall. */
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

/* Largest gain of a particle's energy by one push, relative to it, for a particle that moves along the wall over a
   boundary particle. The push moves the end of its way from the distance r to the permitted distance L from that
   particle, and its start was not closer than L. With s the length of its way, the square of s then grows by
   (L - r) (s^2 - L (L - r)) / r, which is at most s^4 / (4 L r) <= s^4 / (4 r^2). r is at least wall_offset here. */
static double most_gain(const sb_sim *sim, double speed)
{
    const double r = sim->scene->numerics.wall_offset * DR, way = speed * sim->state.time_step;
    return way * way / (4 * r * r);
}

static void check_approach(sb_preset preset)
{
    tank t;
    sb_sim *sim = crowded(&t, 3, preset);
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
        assert_true(after <= before * pow(1 + most_gain(sim, sqrt(before)), (double)count));
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
