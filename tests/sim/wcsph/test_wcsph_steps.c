/* Steps of wcsph: exact motions, the balance of momentum, the same bits for any number of threads and after a restart.
 */
#include "check.h"
#include "sim/step/stages.h"
#include "sim/tank.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <string.h>

/* Makes the tank again with the preset, with the walls of the tank's form. */
static void use_wen(tank *t, sb_wall_form walls, sb_kernel_correction correction)
{
    t->form.particles = false;
    tank_use(t, SB_PRESET_WEN);
    t->scene.numerics.walls = walls;
    t->scene.numerics.kernel_correction = correction;
}

/* A particle without neighbours follows its parabola, whatever the steps. */
static void a_drop_is_ballistic(void **state)
{
    (void)state;
    tank t;
    tank_make(&t, 2, 0.05, sb_vec(2, 0, 3), 0.1, 0.1, 0);
    use_wen(&t, SB_WALLS_DYNAMIC, SB_CORRECTION_CSPM);
    t.model.fluid_count = 1;
    t.model.fluid_position[0] = sb_vec(0.5, 0, 1);
    t.model.fluid_velocity[0] = sb_vec(1, 0, 4);
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    while (sim->state.time < 0.3) assert_int_equal(tank_steps(sim, 1), 0);
    const sb_fluid_sample s = sb_sim_particle(sim, 0);
    const double time = sim->state.time;
    printf("after %.3g s off by %.2g, %.2g m\n", time, s.position.x - 0.5 - time,
           s.position.z - 1 - 4 * time + 0.5 * 9.81 * time * time);
    assert_true(fabs(s.position.x - 0.5 - time) < 1e-5);
    assert_true(fabs(s.position.z - 1 - 4 * time + 0.5 * 9.81 * time * time) < 1e-5);
    assert_true(fabs(s.velocity.z - 4 + 9.81 * time) < 1e-5);
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* Amplitude of the standing sound wave cos kx. */
static double amplitude(const sb_sim *sim, double k)
{
    double sum = 0;
    for (size_t i = 0; i < sim->state.n; i++)
        sum += (double)sim->state.excess[i] * cos(k * sb_space_position(&sim->space, sim->state.position[i]).x);
    return 2 * sum / (double)sim->state.n;
}

/* Sound without gravity in water that is periodic in x: the density swings as cos(kx) cos(c_0 k t). The kernel slows
   waves of 40 spacings by less than 1 % (1 - (k h)^2/30), and the surfaces above and below, which the pressure does not
   leave at rest, are compared with the middle only through their mean. */
static void sound_has_its_speed(void **state)
{
    (void)state;
    const double length = 1, k = 2 * acos(-1) / length, c = 10;
    tank t;
    tank_make(&t, 2, 0.025, sb_vec(length, 0, 0.5), length, 0.5, 0);
    tank_repeat(&t, 0);
    use_wen(&t, SB_WALLS_DYNAMIC, SB_CORRECTION_NONE);
    t.scene.fluid.gravity = 0;
    t.scene.numerics.sound_speed = c;
    t.scene.numerics.artificial_viscosity = t.scene.numerics.density_diffusion = 0;
    for (size_t i = 0; i < t.model.fluid_count; i++)
        t.model.fluid_pressure[i] = 0.1 * c * c * cos(k * t.model.fluid_position[i].x);
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    const double start = amplitude(sim, k);
    double before = start, time = 0;
    while (before > 0 && sim->state.time < 1) { /* to the first zero, a quarter of the period */
        time = sim->state.time;
        assert_int_equal(tank_steps(sim, 1), 0);
        const double now = amplitude(sim, k);
        if (now <= 0) time += (sim->state.time - time) * before / (before - now);
        before = now;
    }
    const double quarter = length / (4 * c);
    printf("amplitude %.4g kg/m^3; a quarter of the period is %.4g s, expected %.4g s\n", start, time, quarter);
    assert_true(fabs(start - 0.1) < 1e-3);
    assert_true(fabs(time / quarter - 1) < 0.02);
    sb_sim_destroy(sim);
    tank_free(&t);
}

static sb_vec3 impulse_of(const sb_sim *sim)
{
    sb_vec3 sum = {0};
    for (size_t b = 0; b < sim->model->body_count; b++)
        sum = sb_add(sum, sb_add(sb_sim_impulse(sim, b)->pressure, sb_sim_impulse(sim, b)->friction));
    return sum;
}

/* Worst error of momentum in a step, over m |change of velocity| of all particles. */
static double imbalance(const tank *t, int steps, double *reported)
{
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    double worst = 0;
    *reported = 0;
    for (int s = 0; s < steps; s++) {
        const sb_energy before = sb_sim_energy(sim);
        const sb_vec3 given = impulse_of(sim);
        assert_int_equal(tank_steps(sim, 1), 0);
        const sb_energy after = sb_sim_energy(sim);
        const double dt = (double)(float)sim->state.time_step;
        sb_vec3 off = sb_add(sb_sub(after.momentum, before.momentum), sb_sub(impulse_of(sim), given));
        off.z += after.mass * (double)sim->constant.gravity * dt;
        /* The fall alone: the other changes only add to it. */
        worst = fmax(worst, sb_norm(off) / (after.mass * (double)sim->constant.gravity * dt));
        *reported = fmax(*reported, sb_sim_report(sim)->momentum_imbalance);
        assert_true(after.mass == before.mass);
    }
    assert_true(sb_sim_report(sim)->max_speed > 0.5);
    sb_sim_destroy(sim);
    return worst;
}

/* Without corrected gradients. The report compares with the sum of the changes of the velocities, some of which are as
   small as 1e5 times the rounding of velocities in so short steps. */
static void momentum_balances(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++)
        for (int walls = SB_WALLS_PARTICLES; walls <= SB_WALLS_DYNAMIC; walls++) {
            tank t;
            tank_make(&t, dimensions, 0.1, sb_vec(2, 0.7, 2), 1, 1, 0.1);
            use_wen(&t, SB_WALLS_DYNAMIC, SB_CORRECTION_NONE);
            if (walls != SB_WALLS_DYNAMIC) { /* facets belong to the model */
                tank_free(&t);
                (walls == SB_WALLS_IMAGES ? tank_make : tank_of_particles)(&t, dimensions, 0.1, sb_vec(2, 0.7, 2), 1, 1,
                                                                           0.1);
                t.scene.numerics.solver = SB_SOLVER_WCSPH;
                t.scene.numerics.cfl = 0.3;
                t.scene.numerics.density_diffusion = 0.1;
                t.scene.numerics.settle_steps = 0;
            }
            double reported;
            const double worst = imbalance(&t, 70, &reported);
            printf("%dD, walls %d: %.2g, reported %.2g\n", dimensions, walls, worst, reported);
            assert_true(worst < 1e-6 && reported < 3e-6);
            tank_free(&t);
        }
}

/* A dam break, or a paddle before a periodic slab. */
static void make(tank *t, bool paddle)
{
    const sb_wavemaker_parameters law = {
        .kind = sb_wavemaker_find("stroke"), .stroke = 0.1, .speed = 0.8, .gravity = 9.81};
    if (paddle)
        tank_make(t, 3, 0.125, sb_vec(2, 1.25, 1.5), 2, 1, 0.1);
    else
        tank_make(t, 2, 1.0 / 36, sb_vec(2, 0, 1.5), 1, 1.1, 0.1);
    if (paddle) tank_repeat(t, 1);
    use_wen(t, SB_WALLS_DYNAMIC, SB_CORRECTION_CSPM);
    if (!paddle) return;
    tank_add_plate(t, "paddle", -0.0625, 0, 1.25, sb_vec(1, 0, 0), &law);
}

enum { BEFORE = 12, AFTER = 12 };

static void threads_and_restarts_give_the_same_bits(void **state)
{
    (void)state;
    static const int threads[] = {1, 2, 3, 8};
    const int usual = omp_get_max_threads();
    for (int paddle = 0; paddle < 2; paddle++) {
        tank t;
        sb_archive_out out = {0};
        sb_error error = {0};
        uint64_t half = 0, end = 0;
        make(&t, paddle);
        for (size_t k = 0; k < 2 * sizeof threads / sizeof *threads; k++) { /* from the start, then from the half */
            omp_set_num_threads(threads[k % 4]);
            sb_sim *sim = tank_sim(&t);
            assert_non_null(sim);
            if (k < 4) {
                assert_int_equal(tank_steps(sim, BEFORE), 0);
            } else if (tank_load(sim, &out, &error) != SB_OK)
                fail_msg("%s", error.text);
            if (k == 0) half = sb_sim_hash(sim);
            if (k == 0) tank_save(sim, &out);
            if (sb_sim_hash(sim) != half) fail_msg("%d threads: another state half way", threads[k % 4]);
            assert_int_equal(tank_steps(sim, AFTER), 0);
            if (k == 0) end = sb_sim_hash(sim);
            if (sb_sim_hash(sim) != end) fail_msg("%d threads: another state at the end", threads[k % 4]);
            assert_true(sim->state.n > SB_BLOCK);
            sb_sim_destroy(sim);
        }
        sb_archive_out_free(&out);
        tank_free(&t);
    }
    omp_set_num_threads(usual);
}

/* The densities of water and boundary particles belong to the state and its hash. Impossible ones are refused. */
static void densities_are_saved(void **state)
{
    (void)state;
    tank t;
    sb_archive_out out = {0};
    sb_error error = {0};
    tank_make(&t, 2, 0.1, sb_vec(1, 0, 1), 0.5, 0.5, 0.1);
    use_wen(&t, SB_WALLS_DYNAMIC, SB_CORRECTION_NONE);
    sb_sim *sim = tank_sim(&t);
    assert_true(sim && tank_steps(sim, 3) == 0);
    const uint64_t hash = sb_sim_hash(sim);
    size_t wet = 0;
    while (isnan(sim->walls.boundary.excess[wet])) wet++;
    float *const densities[] = {&sim->state.excess[4], &sim->walls.boundary.excess[wet]};
    for (int k = 0; k < 2; k++) {
        const float kept = *densities[k];
        *densities[k] += 1;
        assert_true(sb_sim_hash(sim) != hash);
        *densities[k] = -2000;
        tank_save(sim, &out);
        assert_int_equal(tank_load(sim, &out, &error), SB_BAD_INPUT);
        if (!strstr(error.text, "is -1000 kg/m^3, expected a finite value above 0")) fail_msg("%s", error.text);
        *densities[k] = kept;
        assert_true(sb_sim_hash(sim) == hash);
    }
    sb_sim_destroy(sim);
    sb_archive_out_free(&out);
    tank_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_drop_is_ballistic), cmocka_unit_test(sound_has_its_speed),
        cmocka_unit_test(momentum_balances),   cmocka_unit_test(threads_and_restarts_give_the_same_bits),
        cmocka_unit_test(densities_are_saved),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
