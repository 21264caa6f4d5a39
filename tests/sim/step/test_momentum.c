/* Balance of linear and angular momentum between water, bodies and gravity, step by step. */
#include "base/memory.h"
#include "check.h"
#include "sim/tank.h"

#include <stdio.h>

/* Momenta of the water about the scene's origin, from double sums over the particles that the simulation reports. */
typedef struct account {
    sb_vec3 momentum, spin, weight_moment; /* kg m/s, kg m^2/s; sum of m x of the last step's weights, kg m */
    double mass;
} account;

typedef struct record {
    sb_vec3 *position, *velocity; /* by id */
} record;

/* The weight of a particle acts at its position at the step's start. An isolated particle moves with the mean of the
   velocities before and after the step, so that its weight acts at the mean of the positions. */
static account take(const sb_sim *sim, record *r, double *pushed)
{
    account a = {0};
    double m = (double)sim->constant.mass;
    *pushed = 0;
    for (size_t i = 0; i < sim->state.n; i++) {
        sb_fluid_sample s = sb_sim_particle(sim, i);
        a.momentum = sb_madd(a.momentum, m, s.velocity);
        a.spin = sb_madd(a.spin, m, sb_cross(s.position, s.velocity));
        const sb_vec3 from = r->position[s.id];
        const bool isolated = sim->work.diagonal[i] == 0;
        a.weight_moment = sb_madd(a.weight_moment, m, isolated ? sb_scale(sb_add(from, s.position), 0.5) : from);
        a.mass += m;
        *pushed += m * sb_norm(sb_sub(s.velocity, r->velocity[s.id]));
        r->position[s.id] = s.position;
        r->velocity[s.id] = s.velocity;
    }
    return a;
}

typedef struct impulses {
    sb_vec3 push, moment, friction;
} impulses;

/* Sums over the bodies since the start. Moments are converted from each body's moment point to the origin. */
static impulses sum_impulses(const sb_sim *sim)
{
    impulses sum = {0};
    for (size_t b = 0; b < sim->model->body_count; b++) {
        const sb_body_impulse *i = sb_sim_impulse(sim, b);
        sb_vec3 push = sb_add(i->pressure, i->friction);
        sum.push = sb_add(sum.push, push);
        sum.friction = sb_add(sum.friction, i->friction);
        sum.moment = sb_add(sum.moment, sb_add(i->moment, sb_cross(sim->model->bodies[b].moment_point, push)));
    }
    return sum;
}

typedef struct balance {
    double force, moment; /* worst over the steps, relative to sum |m a| dt, and to that times the arm */
    double friction;      /* N s on bodies: must not be 0, or the test would not test friction */
} balance;

static balance follow(const tank *t, int steps, double arm)
{
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    record r = {sb_alloc(sim->state.n, sizeof(sb_vec3)), sb_alloc(sim->state.n, sizeof(sb_vec3))};
    assert_true(r.position && r.velocity);
    balance worst = {0};
    double pushed;
    account before = take(sim, &r, &pushed);
    impulses given = sum_impulses(sim);
    for (int s = 0; s < steps; s++) {
        assert_int_equal(tank_steps(sim, 1), 0);
        double dt = sim->state.time_step, g = t->scene.fluid.gravity;
        account after = take(sim, &r, &pushed);
        impulses now = sum_impulses(sim);
        sb_vec3 weight = sb_vec(0, 0, -g * dt * after.mass);
        sb_vec3 turn = sb_cross(after.weight_moment, sb_vec(0, 0, -g * dt));
        sb_vec3 force = sb_sub(sb_add(sb_sub(after.momentum, before.momentum), sb_sub(now.push, given.push)), weight);
        sb_vec3 moment = sb_sub(sb_add(sb_sub(after.spin, before.spin), sb_sub(now.moment, given.moment)), turn);
        assert_true(pushed > 0);
        worst.force = fmax(worst.force, sb_norm(force) / pushed);
        worst.moment = fmax(worst.moment, sb_norm(moment) / (pushed * arm));
        before = after;
        given = now;
    }
    worst.friction = sb_norm(given.friction);
    assert_int_equal(sim->state.n, t->model.fluid_count);
    assert_int_equal(sb_sim_report(sim)->lost + sb_sim_report(sim)->left_domain, 0);
    assert_true(sb_sim_report(sim)->max_speed > 0.5);
    sb_free(r.position);
    sb_free(r.velocity);
    sb_sim_destroy(sim);
    return worst;
}

/* Makes a tank with a preset. Stress correction and hyperviscosity are off, because they conserve momentum but not its
   moment: the_stress_correction_balances tests both, a_dam_break_before_facets_balances the latter. */
static void make(tank *t, sb_preset preset, int dimensions, double spacing, sb_vec3 size)
{
    tank_of_particles(t, dimensions, spacing, size, 1, 1, 0.1);
    tank_use(t, preset);
    t->scene.numerics.stress_correction = 0;
    t->scene.numerics.hyperviscosity = 0;
}

static void add_terms(tank *t, sb_solver solver)
{
    t->scene.numerics.solver = solver;
    t->scene.numerics.artificial_viscosity = 0.05;
    t->scene.numerics.wall_friction = 0.1;
    t->scene.numerics.wall_shear = SB_SHEAR_SMOOTH;
    t->scene.fluid.viscosity = 1e-3;
}

static void check(const tank *t, double arm, const char *name)
{
    balance b = follow(t, 50, arm);
    printf("%dD, %s: force %.2g, moment %.2g of sum |m a| dt; friction %.3g N s\n", t->scene.dimensions, name, b.force,
           b.moment, b.friction);
    assert_true(b.force < 1e-6 && b.moment < 1e-6 && b.friction > 0);
}

static void a_flat_dam_break_balances(void **state)
{
    (void)state;
    for (sb_preset preset = SB_PRESET_DEFAULT; preset <= SB_PRESET_PAPER; preset++)
        for (sb_solver solver = SB_SOLVER_JACOBI; solver <= SB_SOLVER_CG; solver++) {
            tank t;
            make(&t, preset, 2, 0.05, sb_vec(2, 0, 2));
            add_terms(&t, solver);
            t.model.bodies[0].moment_point = sb_vec(1, 0, 0.3);
            check(&t, 1, tank_preset_names[preset]);
            tank_free(&t);
        }
}

/* Walls that reflect the water take the same momentum. Its moment is kept less exactly. */
static void a_dam_break_before_facets_balances(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        tank t;
        tank_make(&t, dimensions, 0.1, sb_vec(2, 0.7, 2), 1, 1, 0.1);
        t.scene.numerics.stress_correction = 0;
        add_terms(&t, SB_SOLVER_CHEBYSHEV);
        t.model.bodies[0].moment_point = sb_vec(1, 0, 0.3);
        const balance b = follow(&t, 50, 1);
        printf("%dD, facets: force %.2g, moment %.2g of sum |m a| dt; friction %.3g N s\n", dimensions, b.force,
               b.moment, b.friction);
        assert_true(b.force < 1e-6 && b.moment < 1e-3 && b.friction > 0);
        tank_free(&t);
    }
}

/* With a static sill in front of the water and a paddle behind it, each with its own moment point. */
static void a_dam_break_with_bodies_balances(void **state)
{
    (void)state;
    const sb_wavemaker_parameters law = {
        .kind = sb_wavemaker_find("stroke"), .stroke = 0.3, .speed = 1, .gravity = 9.81};
    for (sb_preset preset = SB_PRESET_DEFAULT; preset <= SB_PRESET_PAPER; preset++) {
        tank t;
        make(&t, preset, 3, 0.1, sb_vec(2, 0.7, 1.5));
        add_terms(&t, SB_SOLVER_CG);
        size_t sill = tank_add_plate(&t, "sill", 1.45, 0, 0.4, sb_vec(0, 0, 0), NULL);
        size_t paddle = tank_add_plate(&t, "paddle", -0.05, 0, 1.2, sb_vec(1, 0, 0), &law);
        t.model.bodies[sill].moment_point = sb_vec(1.45, 0.35, 0);
        t.model.bodies[paddle].moment_point = sb_vec(0, 0.35, -3);
        check(&t, 1, tank_preset_names[preset]);
        tank_free(&t);
    }
}

/* The stress correction conserves momentum exactly, and angular momentum except for differences of <E> among
   neighbours. */
static void the_stress_correction_balances(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        tank t;
        tank_make(&t, dimensions, 0.1, sb_vec(3, 1, 2), 1.5, 1.5, 0.1);
        add_terms(&t, SB_SOLVER_CHEBYSHEV);
        assert_true(t.scene.numerics.stress_correction == 1);
        const balance b = follow(&t, 50, 1);
        printf("%dD, stress correction: force %.2g, moment %.2g of sum |m a| dt\n", dimensions, b.force, b.moment);
        assert_true(b.force < 1e-6 && b.moment > 0 && b.moment < 1e-3);
        tank_free(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_flat_dam_break_balances),
        cmocka_unit_test(a_dam_break_before_facets_balances),
        cmocka_unit_test(a_dam_break_with_bodies_balances),
        cmocka_unit_test(the_stress_correction_balances),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
