/* The simulation of unusual scenes: one particle, none, two at one position; and runs that fail. */
#include "base/memory.h"
#include "check.h"
#include "sim/pressure/pressure.h"
#include "sim/tank.h"

#include <omp.h>
#include <stdio.h>
#include <string.h>

static sb_sim *make(const tank *t)
{
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    return sim;
}

static sb_fluid_sample by_id(const sb_sim *sim, uint32_t id)
{
    for (size_t i = 0; i < sim->state.n; i++)
        if (sim->state.id[i] == id) return sb_sim_particle(sim, i);
    fail_msg("particle %u is gone", id);
    return (sb_fluid_sample){0};
}

/* An isolated particle is subject to gravity only: without neighbours it has no pressure. */
static void a_lone_particle_flies_a_parabola(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        bool flat = dimensions == 2;
        tank t;
        tank_make(&t, dimensions, 0.1, sb_vec(4, 4, 4), 0.5, 0.5, 0);
        t.model.fluid_count = 1;
        sb_vec3 start = sb_vec(1, flat ? 0 : 1, 2), v0 = sb_vec(1.5, flat ? 0 : 1, 2);
        t.model.fluid_position[0] = start;
        t.model.fluid_velocity[0] = v0;
        t.scene.numerics.wall_friction = 0.1;
        sb_sim *sim = make(&t);
        double worst = 0;
        while (sb_sim_report(sim)->time < 0.8) {
            assert_int_equal(tank_steps(sim, 1), 0);
            const sb_step_report *r = sb_sim_report(sim);
            const double z = start.z + v0.z * r->time - 0.5 * 9.81 * r->time * r->time;
            sb_fluid_sample p = sb_sim_particle(sim, 0);
            worst =
                fmax(worst, sb_norm(sb_sub(p.position, sb_vec(start.x + v0.x * r->time, start.y + v0.y * r->time, z))));
            assert_true(p.pressure == 0 && p.velocity.x == v0.x && p.velocity.y == v0.y);
        }
        printf("%dD: %llu steps, worst %.2g m from the parabola\n", dimensions,
               (unsigned long long)sb_sim_report(sim)->step, worst);
        assert_true(worst < 5e-6);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

static void check_finite(const sb_sim *sim)
{
    for (size_t i = 0; i < sim->state.n; i++) {
        sb_fluid_sample p = sb_sim_particle(sim, i);
        assert_true(sb_isfinite(p.position) && sb_isfinite(p.velocity));
        assert_true(isfinite(p.pressure) && isfinite(p.density));
    }
}

static void coincident_particles_do_no_harm(void **state)
{
    (void)state;
    for (sb_solver solver = SB_SOLVER_JACOBI; solver <= SB_SOLVER_CG; solver++) {
        tank t;
        tank_of_particles(&t, 3, 0.1, sb_vec(0.6, 0.6, 1), 0.6, 0.6, 0.05);
        t.scene.numerics.solver = solver;
        t.scene.numerics.wall_friction = 0.1;
        t.scene.fluid.viscosity = 1e-4;
        sb_vec3 *x = t.model.fluid_position;
        x[1] = x[0]; /* exactly */
        x[100] = sb_add(x[101], sb_vec(1e-7, 0, 0));
        x[50] = t.model.wall_position[40]; /* at the position of a boundary particle */
        x[7] = x[8] = x[9] = sb_vec(0.3, 0.3, 0.9);
        sb_sim *sim = make(&t);
        assert_int_equal(tank_steps(sim, 60), 0);
        check_finite(sim);
        const sb_step_report *r = sb_sim_report(sim);
        assert_int_equal(sim->state.n + r->left_domain + r->lost, t.model.fluid_count);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

static void what_leaves_is_counted(void **state)
{
    (void)state;
    tank t;
    tank_of_particles(&t, 2, 0.1, sb_vec(2, 0, 1), 1, 0.5, 0);
    t.scene.domain.side[SB_X_MAX] = SB_SIDE_OPEN;
    tank_split_patch(&t, sb_vec(-1, -1, 1), sb_vec(3, 1, 2));
    t.model.bodies[0].count = 0; /* no lid */
    size_t n = t.model.fluid_count;
    t.model.fluid_position[3] = sb_vec(1.5, 0, 0.8);
    t.model.fluid_velocity[3] = sb_vec(0, 0, 3);   /* through the open top */
    t.model.fluid_position[4] = sb_vec(3, 0, 0.5); /* beyond the open side from the start */
    const double support = t.scene.numerics.support * t.scene.resolution;
    t.model.fluid_position[5] = sb_vec(-support - 0.01, 0, 0.8); /* beyond a wall by more than the support */
    t.model.fluid_position[6] = sb_vec(1e12, 0, -1e12);          /* beyond the range of stored positions */
    sb_sim *sim = make(&t);
    const sb_step_report *r = sb_sim_report(sim);
    assert_int_equal(r->left_domain, 2);
    assert_int_equal(r->lost, 1);
    assert_int_equal(r->fluid_count, n - 3);
    assert_int_equal(tank_steps(sim, 1), 0);
    assert_true(by_id(sim, 3).velocity.z > 2);
    while (r->time < 0.15) assert_int_equal(tank_steps(sim, 1), 0);
    assert_int_equal(r->left_domain, 3);
    assert_int_equal(r->lost, 1);
    assert_int_equal(r->fluid_count, n - 4);
    assert_int_equal(sim->state.n, n - 4);
    for (uint32_t id = 0; id < n; id++)
        if (id < 3 || id > 6) assert_true(by_id(sim, id).position.z < 1);
    assert_near(sb_sim_energy(sim).mass, 10.0 * (double)(n - 4), 1e-3);
    sb_sim_destroy(sim);
    tank_free(&t);
}

static void check_empty(const sb_scene *scene, const sb_model *model)
{
    sb_error error = {0};
    sb_sim *sim = NULL;
    assert_int_equal(sb_sim_create(scene, model, NULL, &sim, &error), SB_OK);
    assert_int_equal(sb_sim_settle(sim, &error), SB_OK);
    assert_int_equal(tank_steps(sim, 3), 0);
    assert_true(sb_sim_report(sim)->time > 0);
    assert_int_equal(sb_sim_report(sim)->fluid_count, 0);
    sb_energy e = sb_sim_energy(sim);
    assert_true(e.kinetic == 0 && e.potential == 0 && e.mass == 0);
    assert_int_equal(sb_sim_query(sim, model->min, model->max, NULL, 0), 0);
    sb_frame *frame = sb_sim_snapshot(sim);
    assert_non_null(frame);
    assert_int_equal(frame->count, 0);
    assert_int_equal(frame->body_count, model->body_count);
    sb_frame_release(frame);
    assert_true(sb_sim_hash(sim) == sb_sim_hash(sim));
    sb_sim_destroy(sim);
}

/* Settling ends by setting the scene's velocities. If the model has none any more, all are zero. */
static void a_start_forgotten_is_one_at_rest(void **state)
{
    (void)state;
    uint64_t hash[2];
    for (int forgotten = 0; forgotten < 2; forgotten++) {
        tank t;
        tank_make(&t, 2, 0.1, sb_vec(1, 0, 1), 1, 0.6, 0.1);
        t.scene.numerics.settle_steps = 5;
        sb_sim *sim = make(&t);
        if (forgotten) {
            sb_free(t.model.fluid_velocity);
            t.model.fluid_velocity = NULL;
        }
        assert_int_equal(sb_sim_settle(sim, NULL), SB_OK);
        assert_int_equal(tank_steps(sim, 2), 0);
        hash[forgotten] = sb_sim_hash(sim);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
    assert_true(hash[0] == hash[1]);
}

/* A block of water released in mid-air falls at once and as a whole: its centre is on the parabola at every step. */
static void a_block_from_rest_starts_on_time(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        tank t;
        tank_make(&t, dimensions, 0.1, sb_vec(4, 4, 4), 0.5, 0.5, 0.02);
        t.model.fluid_count = dimensions == 2 ? 25 : 200;
        for (size_t i = 0; i < t.model.fluid_count; i++)
            t.model.fluid_position[i] = sb_add(t.model.fluid_position[i], sb_vec(1, 0, 3));
        t.scene.box_count = 1;
        t.scene.numerics.settle_steps = 20;
        t.scene.fluid.viscosity = 0; /* in 3D the block extends to two walls, whose shear would slow it */
        sb_sim *sim = make(&t);
        assert_int_equal(sb_sim_settle(sim, NULL), SB_OK);
        const sb_energy start = sb_sim_energy(sim);
        double worst = 0;
        while (sb_sim_report(sim)->time < 0.3) {
            assert_int_equal(tank_steps(sim, 1), 0);
            const double time = sb_sim_report(sim)->time;
            const double fallen = (start.potential - sb_sim_energy(sim).potential) / (9.81 * start.mass);
            worst = fmax(worst, fabs(fallen - 0.5 * 9.81 * time * time));
        }
        printf("%dD: %llu steps, worst %.2g m from the parabola\n", dimensions,
               (unsigned long long)sb_sim_report(sim)->step, worst);
        assert_true(worst < 1e-6); /* float's rounding; a start half a step early would give 0.01 m */
        sb_sim_destroy(sim);
        t.scene.box_count = 0;
        tank_free(&t);
    }
}

static void no_water_is_fine(void **state)
{
    (void)state;
    for (sb_solver solver = SB_SOLVER_JACOBI; solver <= SB_SOLVER_CG; solver++) {
        tank t;
        tank_make(&t, 3, 0.1, sb_vec(0.5, 0.5, 0.5), 0.5, 0.2, 0);
        t.scene.numerics.solver = solver;
        t.scene.numerics.settle_steps = 3;
        t.model.fluid_count = 0;
        check_empty(&t.scene, &t.model);
        sb_model bare = {.max = t.model.max}; /* no walls and no bodies either */
        check_empty(&t.scene, &bare);
        tank_free(&t);
    }
    sb_sim_destroy(NULL);
}

/* A step that fails leaves the readable state of the step before. */
static void check_divergence(double speed, double pressure, const char *why)
{
    tank t;
    tank_make(&t, 2, 0.1, sb_vec(2, 0, 1.5), 1, 1, 0.1);
    t.scene.numerics.stress_correction = pressure > 0;
    sb_sim *sim = make(&t);
    assert_int_equal(tank_steps(sim, 4), 0);
    size_t hit = 0;
    while (sim->state.id[hit] != 42) hit++;
    sim->state.velocity[hit][0] = (float)speed;
    for (size_t i = 0; i < sim->state.n && pressure > 0; i++)
        sim->state.velocity[i][3] = (float)(pressure * (double)(i + 1));
    sb_vec3 at = sb_sim_particle(sim, hit).position, where = {0};
    sb_vec3 sum_before = {0}, sum_after = {0};
    for (size_t i = 0; i < sim->state.n; i++)
        if (i != hit) sum_before = sb_add(sum_before, sb_sim_particle(sim, i).velocity);
    double time = sb_sim_report(sim)->time;
    sb_error error = {0};
    assert_int_equal(sb_sim_step(sim, &error), SB_FAILED);
    assert_int_equal(error.status, SB_FAILED);
    printf("%s: %s\n", why, error.text);
    assert_non_null(strstr(error.text, "step"));
    assert_non_null(strstr(error.text, "particle"));
    const char *place = strstr(error.text, "at (");
    if (place && speed != 0) {
        assert_int_equal(sscanf(place, "at (%lf, %lf, %lf)", &where.x, &where.y, &where.z), 3);
        /* by hyperviscosity what is not a number spreads to neighbours of neighbours */
        assert_true(sb_norm(sb_sub(where, at)) < 2 * t.scene.numerics.support * t.scene.resolution);
    }
    assert_true(sb_sim_report(sim)->time == time && sb_sim_report(sim)->step == 4);
    assert_int_equal(sim->state.n, t.model.fluid_count);
    for (size_t i = 0; i < sim->state.n; i++) {
        sb_fluid_sample p = sb_sim_particle(sim, i);
        assert_true(sb_isfinite(p.position));
        if (p.id != 42) sum_after = sb_add(sum_after, p.velocity);
    }
    assert_near(sb_norm(sb_sub(sum_after, sum_before)), 0, 1e-9);
    assert_near(sb_norm(sb_sub(by_id(sim, 42).position, at)), 0, 0);
    sb_frame *frame = sb_sim_snapshot(sim);
    assert_non_null(frame);
    assert_int_equal(frame->count, sim->state.n);
    sb_frame_release(frame);
    assert_int_equal(sb_sim_query(sim, t.model.min, t.model.max, NULL, 0), sim->state.n);
    sb_sim_destroy(sim);
    tank_free(&t);
}

static void divergence_is_reported_and_keeps_the_state(void **state)
{
    (void)state;
    check_divergence(1e5, 0, "too fast");
    check_divergence((double)NAN, 0, "not a number");
    check_divergence(1e5, 1, "too fast, with stress correction");
    check_divergence(0, 1e12, "too fast by the stress correction");
}

/* With a viscosity for which an explicit step of the usual length is unstable, the step is shorter and energy only
   decreases. Wall friction counts half as much as the same artificial viscosity. */
static void much_viscosity_shortens_the_step(void **state)
{
    (void)state;
    enum { NOT, ARTIFICIAL, FRICTION, PHYSICAL, KINDS };
    double step[KINDS];
    for (int strong = NOT; strong < KINDS; strong++) {
        tank t;
        tank_make(&t, 2, 0.1, sb_vec(2, 0, 1.5), 0.8, 1, 0.02);
        t.scene.numerics.artificial_viscosity = strong == ARTIFICIAL ? 10 : 0;
        t.scene.numerics.wall_friction = strong == FRICTION ? 20 : 0;
        t.scene.fluid.viscosity = strong == PHYSICAL ? 1 : 0;
        t.scene.numerics.settle_steps = 60; /* an unsettled lattice expands the faster, the shorter its first step */
        sb_sim *sim = make(&t);
        sb_error error = {0};
        assert_int_equal(sb_sim_settle(sim, &error), SB_OK);
        sb_energy first = sb_sim_energy(sim);
        for (int s = 0; s < 200; s++) {
            assert_int_equal(tank_steps(sim, 1), 0);
            sb_energy now = sb_sim_energy(sim);
            assert_true(now.kinetic + now.potential <= 1.005 * (first.kinetic + first.potential));
        }
        const sb_step_report *r = sb_sim_report(sim);
        assert_int_equal(r->lost + r->left_domain, 0);
        step[strong] = r->time_step;
        assert_true(strong ? r->time_step < 0.5 * step[NOT] : r->time_step > 0);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
    assert_near(step[FRICTION], step[ARTIFICIAL], 1e-12);
}

static void a_step_that_moves_nothing_is_refused(void **state)
{
    (void)state;
    for (int key = 0; key < 3; key++) {
        tank t;
        tank_make(&t, 2, 0.1, sb_vec(1, 0, 1), 0.5, 0.5, 0);
        sb_numerics *n = &t.scene.numerics;
        *(key == 0 ? &n->cfl : key == 1 ? &n->time_step_factor : &n->time_step_max) = 1e-300;
        sb_sim *sim = make(&t);
        sb_error error = {0};
        assert_int_equal(sb_sim_step(sim, &error), SB_FAILED);
        assert_non_null(strstr(error.text, "expected at least"));
        assert_int_equal(sb_sim_report(sim)->lost, 0);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

static void bad_parts_are_refused(void **state)
{
    (void)state;
    sb_wavemaker_parameters law = {.kind = sb_wavemaker_find("stroke"), .stroke = -1, .speed = 1};
    tank t;
    tank_of_particles(&t, 2, 0.1, sb_vec(1, 0, 1), 0.5, 0.5, 0);
    tank_add_plate(&t, "paddle", -0.05, 0, 1, sb_vec(1, 0, 0), &law);
    sb_error error = {0};
    sb_sim *sim = NULL;
    assert_int_equal(sb_sim_create(&t.scene, &t.model, NULL, &sim, &error), SB_BAD_INPUT);
    assert_null(sim);
    assert_non_null(strstr(error.text, "stroke"));
    t.scene.wavemakers[0].law.stroke = 1;
    t.model.max.x = 1e9;
    assert_int_equal(sb_sim_create(&t.scene, &t.model, NULL, &sim, &error), SB_BAD_INPUT);
    assert_null(sim);
    tank_free(&t);
}

/* Creation and two steps in which the n-th allocation fails. Returns whether there was such an allocation. */
static bool allocation_fails(const tank *t, long n)
{
    sb_error error = {0};
    sb_sim *sim = NULL;
    sb_memory_fail_at(n);
    sb_status status = sb_sim_create(&t->scene, &t->model, NULL, &sim, &error);
    assert_true((status == SB_OK) == (sim != NULL));
    for (int s = 0; s < 2 && status == SB_OK; s++) status = sb_sim_step(sim, &error);
    sb_memory_fail_at(0);
    if (status != SB_OK) {
        assert_int_equal(status, SB_FAILED);
        if (!strstr(error.text, "out of memory")) fail_msg("allocation %ld: %s", n, error.text);
    }
    if (sim) { /* still readable */
        check_finite(sim);
        assert_true(sb_sim_energy(sim).mass > 0);
        sb_sim_query(sim, t->model.min, t->model.max, NULL, 0);
        sb_sim_hash(sim);
        assert_true(sb_sim_bytes(sim) > 0);
    }
    sb_sim_destroy(sim);
    return status != SB_OK;
}

static void every_failed_allocation_is_survived(void **state)
{
    (void)state;
    const sb_wavemaker_parameters law = {.kind = sb_wavemaker_find("gate"), .stroke = 2, .speed = 3, .gravity = 9.81};
    tank t;
    tank_of_particles(&t, 2, 0.1, sb_vec(1, 0, 1), 0.5, 0.5, 0.1);
    tank_add_plate(&t, "gate", 0.55, 0, 1, sb_vec(0, 0, 1), &law);
    t.scene.numerics.solver = SB_SOLVER_CG;
    int before = omp_get_max_threads();
    for (int threads = 1; threads <= 2; threads++) {
        omp_set_num_threads(threads);
        long n = 1;
        while (allocation_fails(&t, n)) n++;
        printf("%d threads: %ld allocations failed one by one\n", threads, n - 1);
        assert_true(n > 80);
    }
    omp_set_num_threads(before);
    tank_free(&t);
}

/* A gate that is pulled up out of the domain holds the water until it moves, and then has no effect. */
static void a_gate_leaves_the_domain(void **state)
{
    (void)state;
    const sb_wavemaker_parameters law = {
        .kind = sb_wavemaker_find("gate"), .start = 0.1, .stroke = 1000, .speed = 8, .gravity = 9.81};
    tank t;
    tank_of_particles(&t, 2, 0.05, sb_vec(2, 0, 1), 0.5, 0.6, 0.01);
    size_t gate = tank_add_plate(&t, "gate", 0.525, 0, 1, sb_vec(0, 0, 1), &law);
    sb_sim *sim = make(&t);
    double front = 0;
    while (sb_sim_report(sim)->time < 0.1) assert_int_equal(tank_steps(sim, 1), 0);
    for (size_t i = 0; i < sim->state.n; i++) front = fmax(front, sb_sim_particle(sim, i).position.x);
    assert_true(front < 0.56);
    assert_true(sb_sim_impulse(sim, gate)->pressure.x > 0);
    size_t count = sim->walls.set[SB_MOVING].count;
    assert_int_equal(count, 25); /* 1 m of them, 0.8 spacings apart */
    while (sim->walls.set[SB_MOVING].count > 0) {
        assert_int_equal(tank_steps(sim, 1), 0);
        assert_true(sim->walls.set[SB_MOVING].count <= count);
        count = sim->walls.set[SB_MOVING].count;
        assert_true(sb_sim_report(sim)->time < 0.5);
    }
    assert_true(sb_sim_body_displacement(sim, gate).z > 1);
    sb_vec3 push = sb_sim_impulse(sim, gate)->pressure;
    while (sb_sim_report(sim)->time < 0.6) assert_int_equal(tank_steps(sim, 1), 0);
    assert_true(sb_sim_impulse(sim, gate)->pressure.x == push.x);
    assert_near(sb_sim_body_displacement(sim, gate).z, 8 * (sb_sim_report(sim)->time - 0.1), 1e-9);
    front = 0;
    for (size_t i = 0; i < sim->state.n; i++) front = fmax(front, sb_sim_particle(sim, i).position.x);
    printf("the front is at x = %.2f m at %.2f s\n", front, sb_sim_report(sim)->time);
    assert_true(front > 1.2);
    assert_int_equal(sb_sim_report(sim)->lost, 0);
    sb_sim_destroy(sim);
    tank_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_lone_particle_flies_a_parabola),
        cmocka_unit_test(coincident_particles_do_no_harm),
        cmocka_unit_test(what_leaves_is_counted),
        cmocka_unit_test(a_start_forgotten_is_one_at_rest),
        cmocka_unit_test(a_block_from_rest_starts_on_time),
        cmocka_unit_test(no_water_is_fine),
        cmocka_unit_test(divergence_is_reported_and_keeps_the_state),
        cmocka_unit_test(much_viscosity_shortens_the_step),
        cmocka_unit_test(a_step_that_moves_nothing_is_refused),
        cmocka_unit_test(bad_parts_are_refused),
        cmocka_unit_test(every_failed_allocation_is_survived),
        cmocka_unit_test(a_gate_leaves_the_domain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
