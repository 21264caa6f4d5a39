/* Queries, energies and frames compared with a loop over all particles. */
#include "base/memory.h"
#include "base/random.h"
#include "check.h"
#include "sim/tank.h"

#include <stdio.h>
#include <string.h>

static sb_fluid_sample found[4096];

static bool in_box(sb_vec3 x, sb_vec3 min, sb_vec3 max)
{
    return x.x >= min.x && x.y >= min.y && x.z >= min.z && x.x <= max.x && x.y <= max.y && x.z <= max.z;
}

static void check_box(const sb_sim *sim, sb_vec3 min, sb_vec3 max, bool *listed)
{
    size_t n = sb_sim_report(sim)->fluid_count, expected = 0;
    size_t count = sb_sim_query(sim, min, max, found, 4096);
    assert_true(count <= 4096);
    memset(listed, 0, n);
    for (size_t k = 0; k < count; k++) {
        assert_true(in_box(found[k].position, min, max));
        assert_false(listed[found[k].id]);
        listed[found[k].id] = true;
    }
    for (size_t i = 0; i < n; i++) {
        sb_fluid_sample s = sb_sim_particle(sim, i);
        bool in = in_box(s.position, min, max);
        expected += in;
        if (listed[s.id] != in)
            fail_msg("particle %u at (%g, %g, %g): found %d, expected %d", s.id, s.position.x, s.position.y,
                     s.position.z, listed[s.id], in);
    }
    assert_int_equal(count, expected);
}

/* Samples have the values of the particles, and a buffer that is too small gets the first of them. */
static void check_samples(const sb_sim *sim)
{
    sb_vec3 min = {0.4, -1, 0}, max = {1.4, 2, 0.6};
    size_t count = sb_sim_query(sim, min, max, found, 4096), n = sim->state.n;
    assert_true(count > 20);
    for (size_t k = 0; k < count; k++) {
        size_t i = 0;
        while (i < n && sim->state.id[i] != found[k].id) i++;
        sb_fluid_sample s = sb_sim_particle(sim, i);
        assert_memory_equal(&s.position, &found[k].position, sizeof s.position);
        assert_memory_equal(&s.velocity, &found[k].velocity, sizeof s.velocity);
        assert_true(s.pressure == found[k].pressure && s.density == found[k].density);
        assert_true(s.density > 200 && s.density < 1500);
    }
    sb_fluid_sample few[8] = {0};
    assert_int_equal(sb_sim_query(sim, min, max, few, 7), count);
    for (size_t k = 0; k < 7; k++) assert_int_equal(few[k].id, found[k].id);
    assert_int_equal(few[7].id, 0);
    assert_true(few[7].density == 0);
    assert_int_equal(sb_sim_query(sim, min, max, NULL, 0), count);
}

static void check_boxes(const sb_sim *sim)
{
    bool *listed = sb_alloc(sim->state.n, sizeof *listed);
    assert_non_null(listed);
    sb_vec3 size = sb_sub(sim->model->max, sim->model->min);
    for (uint64_t b = 0; b < 200; b++) {
        sb_vec3 a, c;
        double u[6];
        for (uint64_t k = 0; k < 6; k++) u[k] = 1.4 * sb_random(b, k) - 0.2;
        a = sb_add(sim->model->min, sb_vec(u[0] * size.x, u[1] * size.y, u[2] * size.z));
        c = sb_add(sim->model->min, sb_vec(u[3] * size.x, u[4] * size.y, u[5] * size.z));
        check_box(sim, sb_min(a, c), sb_max(a, c), listed);
        /* A thin box around one particle, which may have left its cell since the sort. */
        sb_vec3 x = sb_sim_particle(sim, (size_t)(sb_random(b, 9) * (double)sim->state.n)).position;
        sb_vec3 thin = sb_vec(1e-6, 1e-6, 1e-6);
        check_box(sim, sb_sub(x, thin), sb_add(x, thin), listed);
    }
    check_box(sim, sb_vec(-1e9, -1e9, -1e9), sb_vec(1e9, 1e9, 1e9), listed);
    check_box(sim, sb_vec(1, 1, 1), sb_vec(0, 0, 0), listed);
    sb_free(listed);
}

static void check_energy(const sb_sim *sim)
{
    sb_energy e = sb_sim_energy(sim), sum = {0};
    double m = (double)sim->constant.mass;
    for (size_t i = 0; i < sim->state.n; i++) {
        sb_fluid_sample s = sb_sim_particle(sim, i);
        sum.kinetic += 0.5 * m * sb_dot(s.velocity, s.velocity);
        sum.potential += m * 9.81 * (s.position.z - sim->model->min.z);
        sum.momentum = sb_madd(sum.momentum, m, s.velocity);
        sum.mass += m;
    }
    assert_true(e.kinetic > 0 && e.potential > 0);
    assert_near(e.kinetic, sum.kinetic, 1e-6 * sum.kinetic);
    assert_near(e.potential, sum.potential, 1e-6 * sum.potential);
    assert_near(e.mass, sum.mass, 1e-9 * sum.mass);
    double scale = sqrt(2 * sum.kinetic * sum.mass);
    assert_near(sb_norm(sb_sub(e.momentum, sum.momentum)), 0, 1e-9 * scale);
}

static void check_frame(const sb_sim *sim, size_t paddle)
{
    sb_frame *f = sb_sim_snapshot(sim);
    assert_non_null(f);
    assert_int_equal(f->count, sim->state.n);
    assert_int_equal(f->body_count, sim->model->body_count);
    assert_true(f->spacing == sim->scene->resolution && f->status.time == sim->state.time);
    assert_true(f->status.step == sim->state.step && f->status.max_speed == sim->state.max_speed);
    double worst = 0;
    for (size_t i = 0; i < f->count; i++) {
        sb_fluid_sample s = sb_sim_particle(sim, i);
        const float *x = &f->position[3 * i], *v = &f->velocity[3 * i];
        sb_vec3 at = sb_add(f->origin, sb_vec((double)x[0], (double)x[1], (double)x[2]));
        worst = fmax(worst, sb_norm(sb_sub(at, s.position)));
        assert_true((double)v[0] == s.velocity.x && (double)v[1] == s.velocity.y && (double)v[2] == s.velocity.z);
        assert_true((double)f->pressure[i] == s.pressure && f->id[i] == s.id);
    }
    double moved = sb_sim_body_displacement(sim, paddle).x;
    printf("frame: positions within %.2g m; paddle at %.4f m\n", worst, moved);
    assert_true(worst < 2e-7);
    assert_true(moved > 0.01 && f->bodies[paddle].displacement.x == moved);
    assert_string_equal(f->bodies[paddle].name, "paddle");
    assert_true(f->bodies[0].displacement.x == 0);
    sb_frame_release(f);
    sb_memory_fail_at(1);
    assert_null(sb_sim_snapshot(sim));
    sb_memory_fail_at(0);
}

static void check_run(int dimensions, sb_vec3 away)
{
    const sb_wavemaker_parameters law = {
        .kind = sb_wavemaker_find("stroke"), .stroke = 0.3, .speed = 1, .gravity = 9.81};
    tank t;
    tank_of_particles(&t, dimensions, 0.1, sb_vec(2, dimensions == 2 ? 0 : 0.7, 1.5), 1, 1, 0.1);
    size_t paddle = tank_add_plate(&t, "paddle", -0.05, 0, 1.2, sb_vec(1, 0, 0), &law);
    tank_shift(&t, away);
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    check_boxes(sim);
    for (int part = 0; part < 4; part++) {
        assert_int_equal(tank_steps(sim, 10), 0);
        check_boxes(sim);
        check_energy(sim);
    }
    if (sb_norm(away) == 0) check_samples(sim);
    check_frame(sim, paddle);
    sb_sim_destroy(sim);
    tank_free(&t);
}

static void in_a_flat_tank(void **state)
{
    (void)state;
    check_run(2, sb_vec(0, 0, 0));
}

static void in_a_tank(void **state)
{
    (void)state;
    check_run(3, sb_vec(0, 0, 0));
}

/* Frames keep their precision where single-precision coordinates would have steps of 6 cm. */
static void in_a_tank_far_away(void **state)
{
    (void)state;
    check_run(3, sb_vec(1e6, -5e5, 300));
}

/* A paddle accelerates a drop from rest. The reported maximum speed and the queries must include contact resolution. */
static void a_drop_swept_away_is_found(void **state)
{
    (void)state;
    const sb_wavemaker_parameters law = {.kind = sb_wavemaker_find("gate"), .stroke = 3, .speed = 6, .gravity = 9.81};
    tank t;
    tank_of_particles(&t, 3, 0.1, sb_vec(4, 0.8, 0.8), 0.1, 0.1, 0);
    t.scene.fluid.gravity = 0;
    t.model.fluid_count = 1;
    t.model.fluid_position[0] = sb_vec(0.6, 0.4, 0.4);
    tank_add_plate(&t, "paddle", 0.25, 0, 0.8, sb_vec(1, 0, 0), &law);
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    bool listed[1];
    while (sb_sim_report(sim)->time < 0.4) {
        sb_vec3 x = sb_sim_particle(sim, 0).position, thin = sb_vec(1e-6, 1e-6, 1e-6);
        check_box(sim, sb_sub(x, thin), sb_add(x, thin), listed);
        assert_int_equal(tank_steps(sim, 1), 0);
        double speed = sb_norm(sb_sim_particle(sim, 0).velocity);
        assert_near(sb_sim_report(sim)->max_speed, speed, 1e-5 * speed);
    }
    sb_vec3 x = sb_sim_particle(sim, 0).position;
    printf("the drop is at x = %.2f, the paddle at %.2f\n", x.x, 0.25 + sb_sim_body_displacement(sim, 1).x);
    assert_true(x.x > 0.25 + sb_sim_body_displacement(sim, 1).x);
    sb_sim_destroy(sim);
    tank_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(in_a_flat_tank),
        cmocka_unit_test(in_a_tank),
        cmocka_unit_test(in_a_tank_far_away),
        cmocka_unit_test(a_drop_swept_away_is_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
