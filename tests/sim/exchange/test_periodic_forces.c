/* Forces across a periodic side conserve momentum and act on the right body at the right place. */
#include "base/memory.h"
#include "base/random.h"
#include "sim/presets.h"

#include <stdio.h>

/* Largest change of (momentum of the water + impulse on bodies - impulse of the weight) over a step, relative to the
   sum of |m a| dt, or to a tenth of that of |m v| if this is larger, because velocities are floats. */
static double follow_momentum(sb_sim *sim, int steps)
{
    double m = (double)sim->constant.mass, worst = 0;
    sb_vec3 *before = sb_alloc(sim->state.n, sizeof *before);
    assert_non_null(before);
    sb_vec3 last = {0};
    for (int s = 0; s <= steps; s++) {
        if (s > 0) assert_int_equal(tank_steps(sim, 1), 0);
        sb_vec3 sum = {0};
        double pushed = 0, moving = 0;
        for (size_t i = 0; i < sim->state.n; i++) {
            sb_fluid_sample p = sb_sim_particle(sim, i);
            sum = sb_madd(sum, m, p.velocity);
            pushed += m * sb_norm(sb_sub(p.velocity, before[p.id]));
            moving += m * sb_norm(p.velocity);
            before[p.id] = p.velocity;
        }
        for (size_t b = 0; b < sim->model->body_count; b++) {
            const sb_body_impulse *given = sb_sim_impulse(sim, b);
            sum = sb_add(sum, sb_add(given->pressure, given->friction));
        }
        sum.z += m * (double)sim->state.n * sim->scene->fluid.gravity * sim->state.time;
        if (s > 0) worst = fmax(worst, sb_norm(sb_sub(sum, last)) / fmax(pushed, 0.1 * moving));
        last = sum;
    }
    sb_free(before);
    return worst;
}

static void momentum_is_kept_across_sides(void **state)
{
    for (int dimensions = 2; dimensions <= 3; dimensions++)
        for (int bodies = 0; bodies <= 1; bodies++) {
            bool flat = dimensions == 2;
            tank t;
            tank_of_particles(&t, dimensions, 0.1, sb_vec(1.2, flat ? 0 : 0.4, bodies ? 2 : 4), 1.2, 1, 0.1);
            tank_use(&t, preset_of(state));
            tank_repeat(&t, 0);
            if (!flat) tank_repeat(&t, 1);
            t.scene.numerics.artificial_viscosity = 0.05;
            t.scene.numerics.wall_friction = 0.1;
            if (bodies) {
                tank_add_plate(&t, "sill", 0.03, 0, 0.3, sb_vec(0, 0, 0), NULL);
            } else {
                t.model.wall_count = t.model.bodies[0].count = 0;
                tank_stop_contact(&t);
                t.scene.fluid.gravity = 0;
            }
            for (size_t i = 0; i < t.model.fluid_count; i++)
                t.model.fluid_velocity[i] = sb_vec(1 + 0.2 * sb_random(4, 2 * i), 0, 0.2 * sb_random(4, 2 * i + 1));
            /* Two layers fly at each other. */
            for (size_t i = 0; i < t.model.fluid_count && !bodies; i++) {
                t.model.fluid_velocity[i].z = t.model.fluid_position[i].z < 0.5 ? 0.25 : -0.25;
                t.model.fluid_position[i].z += 1.5;
            }
            sb_sim *sim = tank_sim(&t);
            assert_non_null(sim);
            double worst = follow_momentum(sim, 60);
            printf("%dD, %s: momentum within %.2g of sum |m a| dt\n", dimensions,
                   bodies ? "floor and sill" : "water alone", worst);
            assert_int_equal(sim->state.n, t.model.fluid_count);
            assert_true(worst < 1e-6);
            sb_sim_destroy(sim);
            tank_free(&t);
        }
}

/* A drop leaves at one side, returns at the other and meets a wall there. Pressure, contact and friction stop it, and
   the wall receives the impulse. */
static void a_drop_meets_a_wall_beyond_the_side(void **state)
{
    for (int way = -1; way <= 1; way += 2)
        for (int dimensions = 2; dimensions <= 3; dimensions++) {
            tank t;
            tank_of_particles(&t, dimensions, 0.1, sb_vec(2, 0.8, 2), 0.1, 0.1, 0);
            tank_use(&t, preset_of(state));
            tank_repeat(&t, 0);
            t.scene.fluid.gravity = 0;
            double plane = way > 0 ? 0.03 : 1.97;
            size_t wall = tank_add_plate(&t, "plane", plane, 0, 2, sb_vec(0, 0, 0), NULL);
            t.model.bodies[wall].moment_point = sb_vec(plane, 0, 0);
            t.model.fluid_count = 1;
            t.model.fluid_position[0] = sb_vec(way > 0 ? 1.42 : 0.58, dimensions == 2 ? 0 : 0.4, 1.01);
            t.model.fluid_velocity[0] = sb_vec(9 * way, 0, 0);
            sb_sim *sim = tank_sim(&t);
            assert_non_null(sim);
            double mass = sb_sim_energy(sim).mass;
            while (sb_sim_report(sim)->time < 0.3) assert_int_equal(tank_steps(sim, 1), 0);
            double x = sb_sim_particle(sim, 0).position.x;
            const sb_body_impulse *push = sb_sim_impulse(sim, wall);
            assert_int_equal(sim->state.n, 1);
            const double gap = fmod(2 + way * (plane - x), 2); /* before the plane, as the drop moves */
            assert_true(gap > 0 && gap < t.scene.numerics.support * t.scene.resolution);
            double lost = 9 * way - sb_sim_particle(sim, 0).velocity.x;
            const double given = push->pressure.x + push->friction.x; /* by the wall friction of `paper` */
            assert_near(given, mass * lost, 1e-4 * mass * 9);
            assert_true(fabs(lost) > 4);
            /* The force acts on the wall itself, not on its image: the moment is that of a force at z = 1. */
            assert_near(push->moment.y, 1.01 * given, 0.05 * fabs(given));
            sb_sim_destroy(sim);
            tank_free(&t);
        }
}

static void make_slab(tank *t, sb_preset preset, sb_vec3 size)
{
    tank_of_particles(t, 3, 0.1, size, size.x, 0.6, 0.1);
    tank_use(t, preset);
    tank_repeat(t, 0);
    tank_repeat(t, 1);
    t->scene.numerics.stress_correction = 0; /* its means depend on the place of the cells */
}

/* The moment of a force on a body beside a periodic side, from water beyond that side. */
static void a_push_across_acts_at_the_body(void **state)
{
    sb_body_impulse given[2];
    for (int beside = 0; beside <= 1; beside++) {
        tank t;
        make_slab(&t, preset_of(state), sb_vec(2, 0.4, 1));
        const sb_vec3 size = tank_whole_quanta(&t, sb_vec(2, 0.4, 1));
        tank_free(&t);
        make_slab(&t, preset_of(state), size);
        size_t wall = tank_add_plate(&t, "plane", 1, 0, 1, sb_vec(0, 0, 0), NULL);
        t.model.bodies[wall].moment_point = sb_vec(1, 0, 0);
        t.scene.numerics.tolerance = 1e-30; /* a fixed number of sweeps for both */
        t.scene.numerics.max_iterations = 25;
        tank_stop_contact(&t); /* rounding decides which facet of two at the same distance pushes a particle */
        if (beside) {
            tank_roll(&t, tank_whole_quanta(&t, sb_vec(1.01, 0, 0)));
            t.model.bodies[wall].moment_point = sb_vec(0.01, 0, 0);
        }
        sb_sim *sim = tank_sim(&t);
        assert_non_null(sim);
        assert_int_equal(tank_steps(sim, 1), 0);
        given[beside] = *sb_sim_impulse(sim, wall);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
    double push = sb_norm(sb_sub(given[1].pressure, given[0].pressure));
    double moment = sb_norm(sb_sub(given[1].moment, given[0].moment));
    printf("push differs by %.2g, moment by %.2g of each\n", push / sb_norm(given[0].pressure),
           moment / sb_norm(given[0].moment));
    assert_true(push < 1e-5 * sb_norm(given[0].pressure));
    assert_true(moment < 1e-5 * sb_norm(given[0].moment));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        in_both_presets(momentum_is_kept_across_sides),
        in_both_presets(a_drop_meets_a_wall_beyond_the_side),
        in_both_presets(a_push_across_acts_at_the_body),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
