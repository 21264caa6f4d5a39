/* Runs with periodic sides: streams, slabs, samples across a side, and the same bits for any number of threads. */
#include "base/memory.h"
#include "base/random.h"
#include "sim/presets.h"
#include "sim/pressure/pressure.h"
#include "sim/step/stages.h"

#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Water flows at one speed over a smooth floor through the periodic sides: no particle is lost or leaves. */
static void a_stream_goes_round(void **state)
{
    tank t;
    tank_make(&t, 2, 0.05, sb_vec(1, 0, 1), 1, 0.6, 0.02);
    tank_use(&t, preset_of(state));
    tank_repeat(&t, 0);
    t.scene.numerics.wall_friction = 0;
    for (size_t i = 0; i < t.model.fluid_count; i++) t.model.fluid_velocity[i].x = 1.5;
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    double before = sb_sim_energy(sim).momentum.x / sb_sim_energy(sim).mass;
    while (sb_sim_report(sim)->time < 2) {
        assert_int_equal(tank_steps(sim, 1), 0);
        for (size_t i = 0; i < sim->state.n; i++) {
            double x = sb_sim_particle(sim, i).position.x;
            assert_true(x >= 0 && x < 1);
        }
    }
    double after = sb_sim_energy(sim).momentum.x / sb_sim_energy(sim).mass;
    printf("mean speed %.6f, after three rounds %.6f m/s\n", before, after);
    assert_int_equal(sim->state.n, t.model.fluid_count);
    assert_int_equal(sb_sim_report(sim)->lost + sb_sim_report(sim)->left_domain, 0);
    assert_near(after, before, 0.01 * before);
    sb_sim_destroy(sim);
    tank_free(&t);
}

typedef struct flow {
    double front, middle; /* m: of the particle farthest ahead, mean of all */
} flow;

static flow flow_at(sb_sim *sim, double time)
{
    while (sb_sim_report(sim)->time < time) assert_int_equal(tank_steps(sim, 1), 0);
    flow f = {0};
    for (size_t i = 0; i < sim->state.n; i++) {
        double x = sb_sim_particle(sim, i).position.x;
        f.front = fmax(f.front, x);
        f.middle += x / (double)sim->state.n;
    }
    return f;
}

/* A metre of water, in two dimensions (width 0) or in a slab without side walls. */
static sb_sim *make_flume(tank *t, sb_preset preset, double width, double length)
{
    tank_make(t, width > 0 ? 3 : 2, 0.05, sb_vec(length, width, 1.5), 1, 1, 0.02);
    tank_use(t, preset);
    if (width > 0) tank_repeat(t, 1);
    t->scene.numerics.settle_steps = 100;
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    return sim;
}

enum { TIMES = 2 };
static const double times[TIMES] = {0.3, 0.35};

static void break_dam(double width, flow flows[TIMES])
{
    tank t;
    sb_sim *sim = make_flume(&t, SB_PRESET_DEFAULT, width, 2.5);
    for (int k = 0; k < TIMES; k++) {
        flows[k] = flow_at(sim, times[k]);
        printf("width %g at %.2f s: front %.3f, mean %.4f m\n", width, times[k], flows[k].front, flows[k].middle);
    }
    assert_int_equal(sim->state.n, t.model.fluid_count);
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* A slab of four spacings behaves like a flume of any width. A dam break in it is the same as in two dimensions once
   the start is over; at the start the lattices are pushed off their walls by different forces. The front is a single
   particle and so is accurate to one or two spacings. */
static void a_slab_is_a_flume(void **state)
{
    (void)state;
    flow flat[TIMES], slab[TIMES], wide[TIMES];
    break_dam(0, flat);
    break_dam(0.2, slab);
    break_dam(0.4, wide);
    for (int k = 0; k < TIMES; k++) {
        assert_near(wide[k].middle, slab[k].middle, 0.01 * (slab[k].middle - 0.5));
        assert_near(wide[k].front, slab[k].front, 0.05);
        assert_near(slab[k].middle, flat[k].middle, 0.03 * (flat[k].middle - 0.5));
        assert_near(slab[k].front, flat[k].front, 2 * 0.05);
    }
}

/* The load on the floor per metre of width is the same. */
static void the_load_is_proportional_to_the_width(void **state)
{
    for (int slab = 0; slab <= 1; slab++) {
        tank t;
        sb_sim *sim = make_flume(&t, preset_of(state), slab ? 0.2 : 0, 1);
        sb_error error = {0};
        assert_int_equal(sb_sim_settle(sim, &error), SB_OK);
        flow_at(sim, 0.4);
        double push = -sb_sim_impulse(sim, 0)->pressure.z;
        double force = push / (sb_sim_report(sim)->time * (slab ? 0.2 : 1));
        printf("floor at rest, %s: %.1f N per m\n", slab ? "slab" : "2D", force);
        assert_near(force, 9810, 0.01 * 9810);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

static uint64_t run(const tank *t, int threads)
{
    omp_set_num_threads(threads);
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    assert_int_equal(tank_steps(sim, 40), 0);
    assert_true(sim->state.n > (size_t)SB_BLOCK && sim->ghosts.count > (size_t)SB_BLOCK);
    uint64_t hash = sb_sim_hash(sim);
    sb_sim_destroy(sim);
    return hash;
}

static void threads_make_no_difference(void **state)
{
    const int counts[] = {2, 3, 8};
    int before = omp_get_max_threads();
    tank t;
    tank_make(&t, 3, 1.0 / 16, sb_vec(1.5, 0.3, 1.2), 1.5, 0.8, 0.1);
    tank_use(&t, preset_of(state));
    tank_repeat(&t, 0);
    tank_repeat(&t, 1);
    t.scene.numerics.wall_friction = 0.05;
    t.scene.numerics.solver = SB_SOLVER_CG;
    for (size_t i = 0; i < t.model.fluid_count; i++) t.model.fluid_velocity[i] = sb_vec(1, 2 * sb_random(1, i), 0);
    uint64_t alone = run(&t, 1);
    printf("1 thread: %016llx\n", (unsigned long long)alone);
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) assert_true(run(&t, counts[c]) == alone);
    omp_set_num_threads(before);
    tank_free(&t);
}

static sb_fluid_sample found[16384];

static bool in_box(sb_vec3 x, sb_vec3 min, sb_vec3 max)
{
    return x.x >= min.x && x.y >= min.y && x.z >= min.z && x.x <= max.x && x.y <= max.y && x.z <= max.z;
}

/* Checks that a query finds every image in the box once. */
static void check_box(const sb_sim *sim, sb_vec3 min, sb_vec3 max)
{
    /* The domain's length, rounded to quanta. */
    double quantum = sim->space.quantum;
    sb_vec3 size = sb_vec(sim->space.period[0] * quantum, sim->space.period[1] * quantum, 0);
    size_t expected = 0, count = sb_sim_query(sim, min, max, found, 16384);
    double sum = 0, found_sum = 0;
    for (size_t i = 0; i < sim->state.n; i++)
        for (int x = -2; x <= 2; x++)
            for (int y = -5; y <= 5; y++) {
                sb_fluid_sample s = sb_sim_particle(sim, i);
                s.position = sb_add(s.position, sb_vec(x * size.x, y * size.y, 0));
                if (!in_box(s.position, min, max)) continue;
                expected++;
                sum += (1 + s.position.x + 3 * s.position.y) * (1 + s.id % 17);
            }
    assert_int_equal(count, expected);
    assert_true(count <= 16384);
    for (size_t k = 0; k < count; k++) {
        assert_true(in_box(found[k].position, min, max));
        found_sum += (1 + found[k].position.x + 3 * found[k].position.y) * (1 + found[k].id % 17);
    }
    assert_near(found_sum, sum, 1e-9 * fabs(sum));
}

/* Images up to one domain length away in x, and up to eight spacings in y, where the domain is three spacings wide. */
static void queries_find_images_across_sides(void **state)
{
    tank t;
    tank_make(&t, 3, 0.1, sb_vec(1.2, 0.3, 1), 1.2, 0.6, 0.1);
    tank_use(&t, preset_of(state));
    tank_repeat(&t, 0);
    tank_repeat(&t, 1);
    for (size_t i = 0; i < t.model.fluid_count; i++) t.model.fluid_velocity[i] = sb_vec(3, -2, 0);
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    for (int part = 0; part < 5; part++) {
        for (uint64_t b = 0; b < 100; b++) {
            double u[6];
            for (uint64_t k = 0; k < 6; k++) u[k] = sb_random(b, k);
            sb_vec3 a = sb_vec(-1 + 3 * u[0], -0.8 + 1.8 * u[1], u[2]);
            sb_vec3 c = sb_vec(-1 + 3 * u[3], -0.8 + 1.8 * u[4], u[5]);
            check_box(sim, sb_min(a, c), sb_max(a, c));
        }
        assert_int_equal(tank_steps(sim, 5), 0);
    }
    sb_sim_destroy(sim);
    tank_free(&t);
}

static bool skips_ghosts(const sb_sim *sim)
{
    bool skipped = false;
    for (const sb_skipped *line = sb_sim_skipped(sim); line->what; line++)
        skipped = skipped || strstr(line->what, "periodic sides");
    return skipped;
}

/* Without periodic sides there are no ghosts and no memory for ghosts, and the list of skipped parts says so. */
static void no_side_costs_nothing(void **state)
{
    for (int periodic = 0; periodic <= 1; periodic++) {
        tank t;
        tank_make(&t, 3, 0.1, sb_vec(1.2, 0.4, 1), 1.2, 0.6, 0.1);
        tank_use(&t, preset_of(state));
        if (periodic) tank_repeat(&t, 1);
        sb_sim *sim = tank_sim(&t);
        assert_non_null(sim);
        size_t before = sb_sim_bytes(sim);
        assert_int_equal(sim->state.capacity, sim->state.n);
        sb_error error = {0};
        sim->state.time_step = 0.01;
        assert_int_equal(sb_stage_ghosts(sim, &error), SB_OK);
        bool none = sim->ghosts.count == 0 && !sim->ghosts.of && sim->state.capacity == sim->state.n;
        assert_true(none == !periodic && skips_ghosts(sim) == !periodic);
        assert_true((sb_sim_bytes(sim) > before) == (periodic != 0));
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

static void missing_memory_is_reported(void **state)
{
    tank t;
    tank_make(&t, 3, 0.1, sb_vec(1.2, 0.4, 1), 1.2, 0.6, 0.1);
    tank_use(&t, preset_of(state));
    tank_repeat(&t, 1);
    bool done = false;
    int reported = 0;
    for (long n = 1; !done; n++) {
        sb_error error = {0};
        sb_sim *sim = NULL;
        sb_memory_fail_at(n);
        sb_status status = sb_sim_create(&t.scene, &t.model, NULL, &sim, &error);
        if (status == SB_OK) status = sb_sim_step(sim, &error);
        sb_memory_fail_at(0);
        done = status == SB_OK;
        if (!done) assert_non_null(strstr(error.text, "memory"));
        reported += !done && (strstr(error.text, "ghosts") || strstr(error.text, "images"));
        sb_sim_destroy(sim);
    }
    assert_true(reported >= 8);
    tank_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        in_both_presets(a_stream_goes_round),
        cmocka_unit_test(a_slab_is_a_flume),
        in_both_presets(the_load_is_proportional_to_the_width),
        in_both_presets(threads_make_no_difference),
        in_both_presets(queries_find_images_across_sides),
        in_both_presets(no_side_costs_nothing),
        in_both_presets(missing_memory_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
