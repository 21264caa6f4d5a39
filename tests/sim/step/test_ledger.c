/* The energy ledger: its sum is the change of energy, each entry is the work of its term according to the reference,
   and known flows have known entries. */
#include "base/memory.h"
#include "sim/presets.h"
#include "sim/pressure/pressure.h"
#include "sim/step/stages.h"
#include "sim/terms/density_correction.h"
#include "sim/terms/stress_correction.h"
#include "sim/terms/turbulence.h"
#include "sim/twin.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

static double sum(const sb_ledger *l)
{
    return l->bodies + l->viscosity + l->friction + l->pressure + l->contact + l->integration + l->left + l->stress;
}

static double mechanical(const sb_sim *sim)
{
    sb_energy e = sb_sim_energy(sim);
    return e.kinetic + e.potential;
}

static sb_vec3 wide(sb_f4 v)
{
    return sb_vec((double)v[0], (double)v[1], (double)v[2]);
}

static void add_terms(tank *t)
{
    t->scene.numerics.stress_correction = 1;
    t->scene.numerics.artificial_viscosity = 0.05;
    t->scene.numerics.wall_friction = 0.1;
    t->scene.numerics.turbulence = SB_TURBULENCE_SPS;
    t->scene.numerics.smagorinsky = 0.1;
    t->scene.fluid.viscosity = 1e-3;
}

/* Advances the tank. Checks after each step that the sum is the change since the start, and that momentum balances. */
static sb_ledger follow(const tank *t, double until, const char *name)
{
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    const double start = mechanical(sim);
    double gap = 0, imbalance = 0;
    assert_near(sum(sb_sim_ledger(sim)), 0, 0);
    while (sb_sim_report(sim)->time < until) {
        assert_int_equal(tank_steps(sim, 1), 0);
        gap = fmax(gap, fabs(mechanical(sim) - start - sum(sb_sim_ledger(sim))));
        imbalance = fmax(imbalance, sb_sim_report(sim)->momentum_imbalance);
        assert_true(sb_sim_report(sim)->momentum_imbalance > 0);
    }
    sb_ledger l = *sb_sim_ledger(sim);
    printf("%s, %.3g s: %.6g J and %.6g: sum off by %.2g of it; bodies %.4g, viscosity %.4g, friction %.4g, "
           "pressure %.4g, stress %.4g, contact %.4g, integration %.4g, left %.4g; momentum %.2g\n",
           name, sb_sim_report(sim)->time, start, mechanical(sim) - start, gap / start, l.bodies, l.viscosity,
           l.friction, l.pressure, l.stress, l.contact, l.integration, l.left, imbalance);
    /* Over the short steps of `paper` the velocities of a thin layer change so little that their rounding shows. */
    assert_true(gap < 1e-12 * start && imbalance < (t->form.preset == SB_PRESET_PAPER ? 1e-5 : 1e-6));
    sb_sim_destroy(sim);
    return l;
}

static void a_bore_on_a_column_is_accounted_for(void **state)
{
    tank t;
    tank_of_particles(&t, 3, 0.1, sb_vec(2, 0.7, 1.5), 0.8, 1, 0);
    tank_use(&t, preset_of(state));
    add_terms(&t);
    tank_add_plate(&t, "column", 1.45, 0, 0.8, sb_vec(0, 0, 0), NULL);
    sb_ledger l = follow(&t, 1.2, "column");
    assert_near(l.bodies, 0, 0);
    assert_near(l.left, 0, 0);
    assert_true(l.viscosity < -1 && l.friction < -1 && l.pressure < 0 && l.contact < 0 && l.stress != 0);
    tank_free(&t);
}

static sb_wavemaker_parameters stroke_law(void)
{
    return (sb_wavemaker_parameters){.kind = sb_wavemaker_find("stroke"), .stroke = 0.3, .speed = 1, .gravity = 9.81};
}

/* With the default preset alone: the paddle stands on the boundary particles of the side, and their summed densities
   would accelerate the water of `paper`. */
static void a_paddle_flume_is_accounted_for(void **state)
{
    (void)state;
    const sb_wavemaker_parameters law = stroke_law();
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        tank t;
        tank_of_particles(&t, dimensions, 0.1, sb_vec(4, 0.5, 1.5), 4, 1, 0.1);
        add_terms(&t);
        tank_add_plate(&t, "paddle", -0.05, 0, 1.4, sb_vec(1, 0, 0), &law);
        sb_ledger l = follow(&t, 0.8, dimensions == 2 ? "flume 2D" : "flume 3D");
        /* Pushing a metre of water by 0.3 m raises a bore of some 0.3 m times still pressure. */
        double width = dimensions == 2 ? 1 : 0.5;
        assert_true(l.bodies > 1000 * width && l.bodies < 4000 * width);
        assert_true(l.viscosity < -1 && l.friction < -0.1);
        tank_free(&t);
    }
}

/* Water that leaves through the open side is entered with the energy that it has there. */
static void what_leaves_is_accounted_for(void **state)
{
    tank t;
    tank_make(&t, 2, 0.05, sb_vec(3, 0, 1.2), 1, 1, 0);
    tank_use(&t, preset_of(state));
    t.scene.domain.max.x = 1.6;
    t.scene.domain.side[SB_X_MAX] = SB_SIDE_OPEN;
    sb_ledger l = follow(&t, 1.5, "outflow");
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    double left = 0, mass = (double)sim->constant.mass;
    while (sb_sim_report(sim)->time < 1.5) {
        /* The next step removes the particles that are outside now. */
        for (size_t i = 0; i < sim->state.n; i++) {
            sb_fluid_sample p = sb_sim_particle(sim, i);
            if (p.position.x > 1.6) left += mass * (sb_dot(p.velocity, p.velocity) / 2 + 9.81 * p.position.z);
        }
        assert_int_equal(tank_steps(sim, 1), 0);
    }
    assert_true(sb_sim_report(sim)->left_domain > 20 && left > 1);
    assert_near(l.left, -left, 1e-6 * left);
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* Work of one step according to the reference: each acceleration times the mean of the velocities before and after. */
typedef struct works {
    double viscosity, friction, pressure, bodies;
    double pressure_by_error; /* the pressure's work by docs/method.md (M23b) */
} works;

static double work(const sb_sim *sim, const twin *before, const sb_vec3 *acceleration)
{
    double all = 0;
    for (size_t i = 0; i < sim->state.n; i++) {
        sb_vec3 end = wide(sim->state.velocity[i]);
        all += 0.5 * sb_dot(acceleration[i], sb_add(before->velocity[i], end));
    }
    return all * (double)sim->constant.mass * sim->state.time_step;
}

/* eddy: the step's eddy viscosities. */
static works by_reference(const sb_sim *sim, const twin *before, const double *eddy)
{
    const sb_reference *r = &before->reference;
    const size_t n = sim->state.n;
    double *rho = sb_alloc(n, sizeof *rho), *q = sb_alloc(n, sizeof *q);
    sb_vec3 *viscous = sb_alloc(n, sizeof *viscous), *friction = sb_alloc(n, sizeof *friction);
    sb_vec3 *push = sb_alloc(n, sizeof *push);
    assert_true(rho && q && viscous && friction && push);
    sb_reference_density(r, rho);
    const float *correction = sim->state.density_correction;
    for (size_t i = 0; i < n && correction; i++) rho[i] += (double)correction[i];
    for (size_t i = 0; i < n; i++) q[i] = (double)sim->work.unknown[i];
    sb_reference_viscosity(r, rho, viscous);
    sb_reference_unswitched(r, rho, sim->scene->fluid.viscosity, eddy, viscous);
    sb_vec3 center[2] = {{0}}, drag[2] = {{0}}, force[2] = {{0}}, torque[2] = {{0}};
    sb_reference_friction(r, rho, friction, center, drag, torque);
    sb_reference_pressure_acceleration(r, q, push);
    sb_reference_pressure_forces(r, q, center, force, torque);
    const double dt = sim->state.time_step;
    const sb_vec3 paddle = sim->walls.moving[0].velocity;
    const double given = dt * sb_dot(drag[1], paddle), pushed = dt * sb_dot(force[1], paddle);
    double pressure_by_error = 0;
    for (size_t i = 0; i < n; i++) {
        double change = sb_dot(push[i], sb_sub(wide(sim->state.velocity[i]), before->velocity[i]));
        /* The density of which the solve was asked: rounded, it is off from rho by more than the rest is. */
        const double density = (double)sim->work.density[i];
        double excess = sim->scene->numerics.source_relaxation * (1000 - density) + (double)sim->work.residual[i];
        pressure_by_error -= (double)sim->constant.mass * (q[i] * excess + 0.5 * dt * change);
    }
    works w = {.pressure_by_error = pressure_by_error,
               .viscosity = work(sim, before, viscous),
               .friction = work(sim, before, friction) + given,
               .pressure = work(sim, before, push) + pushed,
               .bodies = -given - pushed};
    sb_free(rho);
    sb_free(q);
    sb_free(viscous);
    sb_free(friction);
    sb_free(push);
    return w;
}

static void entries_are_the_works_of_their_terms(void **state)
{
    const sb_wavemaker_parameters law = stroke_law();
    sb_status (*const stages[])(sb_sim *, sb_error *) = {sb_stage_forces,     sb_stage_source,  sb_stage_pressure,
                                                         sb_stage_accelerate, sb_stage_impulse, sb_stage_move};
    tank t;
    twin before;
    tank_of_particles(&t, 3, 0.1, sb_vec(1.5, 0.6, 1.2), 1, 0.9, 0.1);
    tank_use(&t, preset_of(state));
    add_terms(&t);
    tank_add_plate(&t, "paddle", -0.05, 0, 1.1, sb_vec(1, 0, 0), &law);
    tank_stop_contact(&t); /* the reference has none; without normals there is no wall shear either */
    sb_free(t.model.wall_normal);
    t.model.wall_normal = NULL;
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    assert_int_equal(tank_steps(sim, 25), 0);
    assert_int_equal(tank_prepare(sim, sim->state.time_step), 0);
    assert_true(sim->walls.moving[0].velocity.x > 0.3);
    sb_error error = {0};
    if (sim->needs.density_correction) assert_int_equal(sb_stage_density_correction(sim, &error), SB_OK);
    assert_int_equal(sb_stage_stress_correction(sim, &error), SB_OK);
    assert_int_equal(twin_make(sim, &before), 0);
    sb_ledger l = *sb_sim_ledger(sim);
    double *eddy = sb_alloc(sim->state.n, sizeof *eddy);
    assert_non_null(eddy);
    assert_int_equal(sb_stage_turbulence(sim, &error), SB_OK);
    for (size_t i = 0; i < sim->state.n; i++) eddy[i] = (double)sim->work.eddy[i];
    for (size_t s = 0; s < sizeof stages / sizeof *stages; s++) assert_int_equal(stages[s](sim, &error), SB_OK);
    const sb_ledger *now = sb_sim_ledger(sim);
    works w = by_reference(sim, &before, eddy);
    sb_free(eddy);
    const double entered[] = {now->viscosity - l.viscosity, now->friction - l.friction, now->pressure - l.pressure,
                              now->bodies - l.bodies};
    const double expected[] = {w.viscosity, w.friction, w.pressure, w.bodies};
    double largest = 0; /* round-off is in proportion to it */
    for (size_t k = 0; k < 4; k++) largest = fmax(largest, fabs(expected[k]));
    for (size_t k = 0; k < 4; k++) {
        printf("ledger %.9g J, reference %.9g J\n", entered[k], expected[k]);
        assert_true(fabs(expected[k]) > 1e-3);
        /* The pressure's entry is a difference of its works on water and bodies. */
        assert_near(entered[k], expected[k], k == 2 ? 1e-6 * largest : 1e-5 * fabs(expected[k]));
    }
    /* The residual is a difference of float sums as large as the forces on bodies. */
    printf("pressure by (M23b) %.9g J\n", w.pressure_by_error);
    assert_near(entered[2], w.pressure_by_error, 1e-6 * largest);
    assert_near(now->contact, l.contact, 0);
    twin_free(&before);
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* Time (s) in which the drop below falls to a fraction of the support radius from the floor's boundary surface. */
static double fall_to(const tank *t, double fraction)
{
    const sb_numerics *n = &t->scene.numerics;
    return sqrt(2 * (1.03 - (fraction * n->support - n->wall_offset) * t->scene.resolution) / 9.81);
}

/* A drop falls from rest and is stopped by the floor. In free fall it loses nothing. Once the floor is within the
   support radius, v' = v - g dt and x' = x + dt v' lose m g dt/2 of each |v' - v|. Contact and pressure remove the
   rest. */
static void a_falling_drop_has_its_known_entries(void **state)
{
    tank t;
    tank_of_particles(&t, 3, 0.1, sb_vec(1, 1, 2), 1, 0.1, 0);
    tank_use(&t, preset_of(state));
    sb_model *m = &t.model;
    m->fluid_count = 1;
    m->fluid_position[0] = sb_vec(0.53, 0.47, 1.03);
    m->fluid_pressure[0] = 0;
    t.scene.numerics.time_step_max = 0.002;
    t.scene.numerics.density = SB_DENSITY_SUMMED; /* with the density correction pressure alone stops a drop */
    t.scene.numerics.artificial_viscosity = 0;
    t.scene.numerics.hyperviscosity = 0;
    t.scene.numerics.wall_friction = 0;
    t.scene.fluid.viscosity = 0; /* no wall shear, which would be entered as friction */
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    const sb_ledger *l = sb_sim_ledger(sim);
    const double start = mechanical(sim);
    double speed = 0, expected = 0, rounding = 0;
    double free = 0; /* s */
    int falling = 0;
    while (l->contact == 0 && falling++ < 1000) {
        assert_int_equal(tank_steps(sim, 1), 0);
        if (l->contact != 0) break;
        double v = -sb_sim_particle(sim, 0).velocity.z, dt = sim->state.time_step;
        /* Each step rounds the displacement to a quantum and the velocity to a float. */
        rounding += 9.81 * sim->space.quantum / 2 + fmax(v * v, speed * speed) * (double)FLT_EPSILON / 2;
        if (sim->work.diagonal[0] > 0)
            expected -= 9.81 * dt * (v - speed) / 2;
        else
            free += dt;
        speed = v;
        assert_near(l->integration, expected, rounding);
        assert_near(fabs(l->viscosity) + fabs(l->friction) + fabs(l->bodies) + fabs(l->left), 0, 0);
    }
    assert_true(sim->work.diagonal[0] > 0 && falling < 1000);
    /* The floor's kernel ends at the support radius, and its slope, (1 - r/h)^3, is negligible beyond 0.85 of it. */
    const double dt = t.scene.numerics.time_step_max;
    assert_true(free > fall_to(&t, 1) - dt && free < fall_to(&t, 0.85) + dt);
    assert_int_equal(tank_steps(sim, 100), 0);
    printf("a drop of 1 kg fell for %d steps: %.4g J of %.4g removed by contact, %.4g by pressure\n", falling,
           -l->contact, start - mechanical(sim), -l->pressure);
    assert_near(sum(l), mechanical(sim) - start, 1e-9);
    assert_true(l->contact < 0 && l->contact + l->pressure < -0.9 * (start - mechanical(sim)));
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* A paddle accelerates a drop from rest by contact: its density sum is below that of water. The paddle does the work m
   dv.v_b; pressure and contact lose the part of it that does not move the drop. */
static void a_swept_drop_has_the_paddles_work(void **state)
{
    sb_status (*const stages[])(sb_sim *, sb_error *) = {sb_stage_time_step,  sb_stage_walls,     sb_stage_sort,
                                                         sb_stage_neighbours, sb_stage_forces,    sb_stage_source,
                                                         sb_stage_pressure,   sb_stage_accelerate};
    const sb_wavemaker_parameters law = stroke_law();
    tank t;
    tank_of_particles(&t, 3, 0.1, sb_vec(2, 1, 1), 1, 0.1, 0);
    tank_use(&t, preset_of(state));
    tank_add_plate(&t, "paddle", 0.3, 0, 1, sb_vec(1, 0, 0), &law);
    t.model.fluid_count = 1;
    t.model.fluid_position[0] = sb_vec(0.4, 0.47, 0.53);
    t.model.fluid_pressure[0] = 0;
    t.scene.fluid.gravity = 0;
    t.scene.fluid.viscosity = 0; /* no wall shear */
    t.scene.numerics.wall_friction = 0;
    t.scene.numerics.density = SB_DENSITY_SUMMED; /* with the density correction pressure alone moves a drop */
    t.scene.numerics.time_step_max = 0.005;
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    const sb_ledger *l = sb_sim_ledger(sim);
    double mass = (double)sim->constant.mass, given = 0, contact = 0, pressure = 0;
    sb_error error = {0};
    for (int step = 0; step < 30; step++) {
        sb_vec3 before = wide(sim->state.velocity[0]);
        for (size_t s = 0; s < sizeof stages / sizeof *stages; s++) assert_int_equal(stages[s](sim, &error), SB_OK);
        sb_vec3 pushed = wide(sim->work.end_velocity[0]), paddle = sim->walls.moving[0].velocity;
        assert_int_equal(sb_stage_impulse(sim, &error), SB_OK);
        assert_int_equal(sb_stage_move(sim, &error), SB_OK);
        sb_vec3 after = wide(sim->state.velocity[0]);
        sb_vec3 slip = sb_sub(sb_scale(sb_add(before, after), 0.5), paddle);
        given += mass * sb_dot(sb_sub(after, before), paddle);
        pressure += mass * sb_dot(sb_sub(pushed, before), slip);
        contact += mass * sb_dot(sb_sub(after, pushed), slip);
    }
    printf("a drop of 1 kg accelerated to %.3g m/s: paddle %.4g J, contact %.4g, pressure %.4g\n",
           (double)sim->state.velocity[0][0], l->bodies, l->contact, l->pressure);
    assert_true(sim->state.velocity[0][0] > 0.9f && contact < -0.01);
    assert_near(l->bodies, given, 1e-6 * given);
    assert_near(l->contact, contact, -1e-6 * contact);
    assert_near(l->pressure, pressure, -1e-6 * (pressure + contact));
    sb_sim_destroy(sim);
    tank_free(&t);
}

static void settling_is_not_entered(void **state)
{
    tank t;
    tank_make(&t, 2, 0.1, sb_vec(1, 0, 1.5), 1, 1, 0.1);
    tank_use(&t, preset_of(state));
    t.scene.numerics.settle_steps = 20;
    t.scene.numerics.stress_correction = 1;
    sb_sim *sim = tank_sim(&t);
    sb_error error = {0};
    assert_non_null(sim);
    double before = mechanical(sim);
    assert_int_equal(sb_sim_settle(sim, &error), SB_OK);
    assert_true(mechanical(sim) != before);
    const sb_ledger none = {0};
    assert_memory_equal(sb_sim_ledger(sim), &none, sizeof none);
    assert_near(sb_sim_report(sim)->momentum_imbalance, 0, 0);
    sb_sim_destroy(sim);
    tank_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        in_both_presets(a_bore_on_a_column_is_accounted_for),
        cmocka_unit_test(a_paddle_flume_is_accounted_for),
        in_both_presets(what_leaves_is_accounted_for),
        in_both_presets(entries_are_the_works_of_their_terms),
        in_both_presets(a_falling_drop_has_its_known_entries),
        in_both_presets(a_swept_drop_has_the_paddles_work),
        in_both_presets(settling_is_not_entered),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
