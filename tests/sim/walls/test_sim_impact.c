/* Spray that hits walls: it does not pass them, and it loses energy. */
#include "check.h"
#include "sim/pressure/pressure.h"
#include "sim/tank.h"

#include <stdio.h>

static sb_sim *make(const tank *t)
{
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    return sim;
}

/* A single drop is too light to build up pressure. Contact resolution alone stops it, at any speed, and the wall
   receives the momentum that it loses. */
static void check_drop(sb_solver solver, sb_vec3 velocity)
{
    tank t;
    tank_make(&t, 3, 0.1, sb_vec(1, 1, 2), 0.1, 0.1, 0);
    t.scene.numerics.solver = solver;
    t.model.fluid_count = 1;
    t.model.fluid_position[0] = sb_vec(0.5, 0.5, 0.5);
    t.model.fluid_velocity[0] = velocity;
    sb_sim *sim = make(&t);
    double mass = sb_sim_energy(sim).mass, speed = sb_norm(velocity);
    while (sb_sim_report(sim)->time < 0.4) assert_int_equal(tank_steps(sim, 1), 0);
    assert_int_equal(sim->state.n, 1);
    sb_fluid_sample p = sb_sim_particle(sim, 0);
    assert_true(p.position.x > -0.01 && p.position.y > -0.01 && p.position.z > -0.01);
    assert_true(p.position.x < 1.01 && p.position.y < 1.01);
    /* In the default preset the wall also receives friction, by the artificial viscosity. */
    const sb_body_impulse *impulse = sb_sim_impulse(sim, 0);
    sb_vec3 push = sb_add(impulse->pressure, impulse->friction);
    sb_vec3 gained = sb_scale(sb_sub(p.velocity, velocity), mass);
    gained.z += mass * 9.81 * sb_sim_report(sim)->time;
    assert_near(sb_norm(sb_add(gained, push)), 0, 1e-5 * mass * speed);
    assert_true(sb_norm(push) > 0.5 * mass * speed);
    sb_sim_destroy(sim);
    tank_free(&t);
}

static void a_drop_does_not_pass_walls(void **state)
{
    (void)state;
    const sb_vec3 ways[] = {{15, 0, 0}, {-11, 0, -11}, {9, 9, -9}, {0, -2, -2}, {3, 60, 0}};
    for (sb_solver solver = SB_SOLVER_JACOBI; solver <= SB_SOLVER_CG; solver++)
        for (size_t w = 0; w < sizeof ways / sizeof *ways; w++) check_drop(solver, ways[w]);
}

/* Energy of the particles from `first` on, J. */
static double energy_from(const sb_sim *sim, uint32_t first)
{
    double sum = 0, mass = (double)sim->constant.mass;
    for (size_t i = 0; i < sim->state.n; i++) {
        sb_fluid_sample p = sb_sim_particle(sim, i);
        if (p.id >= first) sum += mass * (0.5 * sb_dot(p.velocity, p.velocity) + 9.81 * p.position.z);
    }
    return sum;
}

/* side^3 particles fly at a wall, while a calm pool far from them makes the mean error of the water small. The pressure
   of each drop must be correct nevertheless. */
static void check_lump(sb_solver solver, size_t side)
{
    tank t;
    tank_make(&t, 3, 0.1, sb_vec(2.4, 0.8, 1.6), 2.4, 1.6, 0.05);
    t.scene.numerics.solver = solver;
    t.model.still_depth = 0.6;
    sb_model *m = &t.model;
    size_t pool = 0;
    for (size_t i = 0; i < m->fluid_count; i++)
        if (m->fluid_position[i].z < 0.6) {
            m->fluid_position[pool] = m->fluid_position[i];
            m->fluid_pressure[pool++] = 9810 * (0.6 - m->fluid_position[i].z);
        }
    m->fluid_count = pool;
    for (size_t k = 0; k < side * side * side; k++) {
        double x = (double)(k % side), y = (double)(k / side % side), z = (double)(k / side / side);
        size_t i = m->fluid_count++;
        m->fluid_position[i] = sb_vec(1.9 + 0.1 * x + 0.01 * y, 0.3 + 0.1 * y - 0.01 * z, 1 + 0.1 * z + 0.01 * x);
        m->fluid_velocity[i] = sb_vec(15, 1, 2);
        m->fluid_pressure[i] = 0;
    }
    sb_sim *sim = make(&t);
    double start = energy_from(sim, (uint32_t)pool), most = 0, last = start;
    while (sb_sim_report(sim)->time < 0.15) {
        assert_int_equal(tank_steps(sim, 1), 0);
        last = energy_from(sim, (uint32_t)pool);
        most = fmax(most, last);
    }
    printf("%s, %zu^3 drops with a pool of %zu: energy at most %.4f, then %.3f of the start's\n",
           sb_pressure_solvers[solver]->name, side, pool, most / start, last / start);
    assert_true(most < 1.001 * start && last < 0.7 * start);
    assert_int_equal(sim->state.n, m->fluid_count);
    sb_sim_destroy(sim);
    tank_free(&t);
}

static void lumps_lose_energy_at_walls(void **state)
{
    (void)state;
    for (sb_solver solver = SB_SOLVER_JACOBI; solver <= SB_SOLVER_CG; solver++)
        for (size_t side = 1; side <= 4; side++) check_lump(solver, side);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_drop_does_not_pass_walls),
        cmocka_unit_test(lumps_lose_energy_at_walls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
