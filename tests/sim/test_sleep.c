/* Still water asleep: it keeps its place until the front comes near, wakes calm, and is missed by nothing that looks at
   the water; a wave that runs into it is the wave that runs without it. */
#include "../check.h"
#include "base/memory.h"
#include "sim/sleep.h"
#include "sim/tank.h"

#include <omp.h>
#include <stdio.h>
#include <string.h>

static const double DEPTH = 1;

/* A paddle at x = 0 that pushes for 0.9 s at up to 0.5 m/s: waves of a sixth of the depth. */
static void make_flume(tank *t, int dimensions, double dr, sb_vec3 size, bool sleep)
{
    static const sb_wavemaker_parameters law = {
        .stroke = 0.4, .speed = 0.5, .gravity = 9.81, .after = SB_AFTER_STAY};
    sb_wavemaker_parameters stroke = law;
    stroke.kind = sb_wavemaker_find("stroke");
    tank_make(t, dimensions, dr, size, size.x, DEPTH, 0.02);
    tank_add_sheet(t, "paddle", -dr / 2, 0, size.z, sb_vec(1, 0, 0), &stroke);
    t->scene.sea = (sb_sea){.present = true, .level = DEPTH};
    t->scene.numerics.settle_steps = 200;
    t->scene.numerics.sleep = sleep;
}

static sb_sim *settled(const tank *t)
{
    sb_error error = {0};
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    if (sb_sim_settle(sim, &error) != SB_OK) fail_msg("%s", error.text);
    return sim;
}

static double wave_speed(void)
{
    return sqrt(9.81 * DEPTH);
}

/* By id: where each particle is, and whether it sleeps. */
typedef struct census {
    sb_fluid_sample *sample;
    bool *asleep;
    size_t count;
} census;

static void census_take(census *c, const sb_sim *sim, size_t ids)
{
    if (!c->sample) {
        c->sample = sb_alloc(ids, sizeof *c->sample);
        c->asleep = sb_alloc(ids, sizeof *c->asleep);
        assert_true(c->sample && c->asleep);
    }
    c->count = sb_sim_report(sim)->fluid_count;
    for (size_t i = 0; i < c->count; i++) {
        const sb_fluid_sample s = sb_sim_particle(sim, i);
        assert_true(s.id < ids);
        c->sample[s.id] = s;
        c->asleep[s.id] = i >= sim->n;
    }
}

static void census_free(census *c)
{
    sb_free(c->sample);
    sb_free(c->asleep);
}

/* Where no place is out of a wave maker's reach nothing sleeps, and no bit differs from a run without. */
static void a_short_tank_is_as_without(void **state)
{
    (void)state;
    uint64_t hash[2];
    for (int sleep = 0; sleep < 2; sleep++) {
        tank t;
        make_flume(&t, 2, 0.1, sb_vec(4, 0, 1.5), sleep);
        sb_sim *sim = settled(&t);
        assert_true(sim->sleep == NULL && sb_sim_sleep(sim).asleep == 0);
        assert_int_equal(tank_steps(sim, 20), 0);
        hash[sleep] = sb_sim_hash(sim);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
    assert_true(hash[0] == hash[1]);
}

static bool same_place(sb_vec3 a, sb_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Mean velocity along x of the water awake, by bins of half a metre. */
enum { BINS = 40 };
static void mean_speeds(const census *c, size_t n, double mean[BINS])
{
    double sum[BINS] = {0}, count[BINS] = {0};
    for (size_t id = 0; id < n; id++) {
        const int bin = (int)fmin(fmax(2 * c->sample[id].position.x, 0), BINS - 1);
        sum[bin] += c->sample[id].velocity.x;
        count[bin]++;
    }
    for (int bin = 0; bin < BINS; bin++) mean[bin] = count[bin] > 0 ? sum[bin] / count[bin] : 0;
}

/* Follows every particle until the last has woken. */
static void sleepers_rest_and_wake_calm(void **state)
{
    (void)state;
    tank t;
    make_flume(&t, 2, 0.1, sb_vec(20, 0, 1.5), true);
    sb_sim *sim = settled(&t);
    const size_t n = t.model.fluid_count;
    assert_true(sb_sim_sleep(sim).asleep > n / 2);
    census first = {0}, now = {0};
    census_take(&first, sim, n);
    const double mass = sb_sim_energy(sim).mass, reach = 4 * DEPTH;
    double nearest = 1e9, fastest = 0;
    size_t woken = 0;
    while (sb_sim_sleep(sim).asleep > 0) {
        double front = 0, edge_x = 1e9, mean[BINS];
        assert_int_equal(tank_steps(sim, 1), 0);
        census_take(&now, sim, n);
        assert_int_equal(now.count, n);
        assert_near(sb_sim_energy(sim).mass, mass, 1e-9 * mass);
        for (size_t id = 0; id < n; id++) {
            const sb_fluid_sample *s = &now.sample[id];
            if (now.asleep[id]) {
                assert_true(first.asleep[id]);
                assert_true(same_place(s->position, first.sample[id].position));
                assert_true(sb_norm(s->velocity) == 0 && s->pressure == first.sample[id].pressure &&
                            s->density == first.sample[id].density);
                edge_x = fmin(edge_x, s->position.x);
            } else {
                woken += first.asleep[id];
                first.asleep[id] = false;
            }
        }
        /* Next to sleepers the water moves hardly. */
        mean_speeds(&now, n, mean);
        for (int bin = 0; bin < BINS && 0.5 * (bin + 1) < edge_x; bin++) {
            if (mean[bin] > 0.03 * wave_speed()) front = 0.5 * (bin + 1);
            if (0.5 * (bin + 1) > edge_x - DEPTH) fastest = fmax(fastest, fabs(mean[bin]));
        }
        if (edge_x < 1e9) nearest = fmin(nearest, edge_x - front);
    }
    printf("mean speed within a depth of sleepers %.3g sqrt(g D), nearest that waves came %.3g D, the last woke at %.3g s\n",
           fastest / wave_speed(), nearest, sb_sim_sleep(sim).woken);
    assert_true(woken > n / 2);
    assert_true(nearest > reach - 1.5 * DEPTH); /* a look comes every few steps, waves outrun the front a little */
    assert_true(fastest < 0.01 * wave_speed());
    /* Never after the front, and not long before it: the wave's own head may be ahead of it. */
    assert_near(sb_sim_sleep(sim).woken, (20 - reach - DEPTH) / (1.1 * wave_speed()) - 0.5, 0.8);
    assert_true(sb_sim_sleep(sim).asleep_steps > 0 &&
                sb_sim_sleep(sim).particle_steps == n * sb_sim_report(sim)->step);
    census_free(&first);
    census_free(&now);
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* What a paddle feels, what waves carry and what the floor bears, over 5 s with and without. */
typedef struct record {
    double paddle, floor, potential, crest; /* N s, N s, J, m */
} record;

static record run_flume(double jitter, bool sleep)
{
    enum { MOST = 4096 };
    static sb_fluid_sample found[MOST];
    tank t;
    record r = {0};
    make_flume(&t, 2, 0.1, sb_vec(20, 0, 1.5), sleep);
    for (size_t i = 0; i < t.model.fluid_count; i++) t.model.fluid_position[i].x += jitter * sin(7.0 * (double)i);
    sb_sim *sim = settled(&t);
    const double potential = sb_sim_energy(sim).potential;
    while (sb_sim_report(sim)->time < 4.5) {
        assert_int_equal(tank_steps(sim, 1), 0);
        const size_t count = sb_sim_query(sim, sb_vec(8, -1, 0), sb_vec(8.3, 1, 1.5), found, MOST);
        for (size_t k = 0; k < count; k++) r.crest = fmax(r.crest, found[k].position.z);
    }
    r.floor = sb_sim_impulse(sim, 0)->pressure.z;
    r.paddle = sb_sim_impulse(sim, 1)->pressure.x;
    r.potential = sb_sim_energy(sim).potential - potential;
    if (sleep) assert_true(sb_sim_sleep(sim).asleep_steps > sb_sim_sleep(sim).particle_steps / 4);
    sb_sim_destroy(sim);
    tank_free(&t);
    return r;
}

static void the_wave_is_the_same(void **state)
{
    (void)state;
    const record off = run_flume(0, false), other = run_flume(0.001, false), on = run_flume(0, true);
    const record runs[] = {off, other, on};
    for (int k = 0; k < 3; k++)
        printf("%s: paddle %.5g N s/m, floor %.6g N s/m, potential %.4g J/m, crest at x = 8 m %.4g m\n",
               k == 0 ? "awake" : k == 1 ? "awake, another start" : "asleep", runs[k].paddle, runs[k].floor,
               runs[k].potential, runs[k].crest);
    assert_near(on.paddle, off.paddle, 0.01 * fabs(off.paddle));
    assert_near(on.floor, off.floor, 0.002 * fabs(off.floor));
    assert_near(on.potential, off.potential, 0.02 * off.potential);
    assert_near(on.crest, off.crest, 0.05);
}

/* The balance is of the water awake: what sleepers do to it is among the forces, by pressure and by viscosity. */
static void check_momentum(tank *t, sb_solver solver)
{
    t->scene.numerics.solver = solver;
    t->scene.numerics.artificial_viscosity = 0.05;
    t->scene.fluid.viscosity = 1e-3;
    t->scene.numerics.turbulence = SB_TURBULENCE_SPS;
    t->scene.numerics.smagorinsky = 0.1;
    sb_sim *sim = settled(t);
    double worst = 0, share = 0;
    for (int s = 0; s < 150; s++) {
        assert_int_equal(tank_steps(sim, 1), 0);
        worst = s < 20 ? 0 : fmax(worst, sb_sim_report(sim)->momentum_imbalance);
        share = fmax(share, sb_norm(sim->sleep->support));
    }
    printf("imbalance %.2g, sleepers' push %.3g N, rub %.3g N\n", worst, share, sb_norm(sim->sleep->rub));
    assert_true(sb_sim_sleep(sim).asleep > 0);
    assert_true(worst < 1e-6);
    assert_true(share > 100 && sb_norm(sim->sleep->rub) > 0);
    sb_sim_destroy(sim);
}

static void momentum_balances(void **state)
{
    (void)state;
    for (sb_solver solver = SB_SOLVER_JACOBI; solver <= SB_SOLVER_CG; solver++) {
        tank t;
        make_flume(&t, 2, 0.1, sb_vec(14, 0, 1.5), true);
        check_momentum(&t, solver);
        tank_free(&t);
    }
}

/* Sides that repeat across the flume, where sleepers have images, and along it, where the front comes from both. */
static void periodic_sides(void **state)
{
    (void)state;
    for (int axis = 1; axis >= 0; axis--) {
        tank t;
        make_flume(&t, 3, 0.2, sb_vec(axis ? 16 : 32, 0.8, 1.6), true);
        tank_repeat(&t, axis);
        if (axis == 0) { /* without a paddle: it stands at a side that is none */
            t.model.body_count = 1;
            t.scene.wavemaker_count = 0;
            t.model.wall_count = t.model.bodies[0].count;
            for (size_t i = 0; i < t.model.fluid_count; i++)
                t.model.fluid_velocity[i].x = t.model.fluid_position[i].x < 1 ? 0.3 : 0;
        }
        sb_sim *sim = settled(&t);
        if (axis == 0) {
            bool low = false, high = false;
            for (size_t i = 0; i < sim->n; i++) {
                const double x = sb_sim_particle(sim, i).position.x;
                low |= x < 4;
                high |= x > 28;
                assert_true(x < 8 || x > 24);
            }
            assert_true(low && high);
        }
        double worst = 0;
        for (int s = 0; s < 60; s++) {
            assert_int_equal(tank_steps(sim, 1), 0);
            worst = s < 20 ? 0 : fmax(worst, sb_sim_report(sim)->momentum_imbalance);
        }
        printf("periodic along %c: %zu of %zu asleep, imbalance %.2g\n", axis ? 'y' : 'x', sb_sim_sleep(sim).asleep,
               t.model.fluid_count, worst);
        assert_true(sb_sim_sleep(sim).asleep > t.model.fluid_count / 5);
        assert_int_equal(sb_sim_report(sim)->fluid_count, t.model.fluid_count);
        assert_true(worst < 1e-6);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

/* The same bits for any number of threads, and from a state saved while some sleep. */
static void bits_repeat(void **state)
{
    (void)state;
    static const int threads[] = {1, 2, 3};
    const int before = omp_get_max_threads();
    uint64_t hash[3];
    sb_archive_out out = {0};
    tank t;
    make_flume(&t, 3, 0.2, sb_vec(16, 0.8, 1.6), true);
    t.scene.numerics.wall_friction = 0.05;
    for (int k = 0; k < 3; k++) {
        omp_set_num_threads(threads[k]);
        sb_sim *sim = settled(&t);
        const size_t asleep = sb_sim_sleep(sim).asleep;
        assert_int_equal(tank_steps(sim, 61), 0);
        if (k == 0) {
            sb_archive_begin(&out, "TEST", 1);
            sb_sim_save(sim, &out);
            assert_int_equal(sb_archive_close(&out, NULL), SB_OK);
        }
        assert_int_equal(tank_steps(sim, 60), 0);
        assert_true(sb_sim_sleep(sim).asleep > 0 && sb_sim_sleep(sim).asleep < asleep);
        hash[k] = sb_sim_hash(sim);
        sb_sim_destroy(sim);
    }
    assert_true(hash[1] == hash[0] && hash[2] == hash[0]);
    sb_sim *sim = tank_sim(&t);
    sb_archive_in in;
    sb_error error = {0};
    assert_int_equal(sb_archive_parse(&in, "saved", out.bytes, out.used, "TEST", 1, &error), SB_OK);
    if (sb_sim_load(sim, &in, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(tank_steps(sim, 60), 0);
    assert_true(sb_sim_hash(sim) == hash[0]);
    sb_sim_destroy(sim);
    omp_set_num_threads(before);
    sb_archive_out_free(&out);
    tank_free(&t);
}

/* Bodies feel the water asleep as they did: the whole tank the weight of all of it, where pressure bears it and where
   boundary particles are so light that contact has to. */
static void check_load(double wall_gamma, int steps, double within)
{
    tank t;
    make_flume(&t, 2, 0.1, sb_vec(20, 0, 1.5), true);
    t.scene.wavemakers[0].law.start = 100;
    t.scene.numerics.wall_gamma = wall_gamma;
    t.scene.numerics.settle_steps = steps;
    sb_sim *sim = settled(&t);
    const double weight = 9.81 * sb_sim_energy(sim).mass;
    const uint64_t woken = sb_sim_sleep(sim).asleep;
    assert_int_equal(tank_steps(sim, 40), 0);
    const double load = -sb_sim_impulse(sim, 0)->pressure.z / sb_sim_report(sim)->time;
    printf("gamma %g: floor bears %.4f of the weight\n", wall_gamma, load / weight);
    assert_int_equal(sb_sim_sleep(sim).asleep, woken); /* nothing has moved */
    assert_near(load, weight, within * weight);
    sb_sim_destroy(sim);
    tank_free(&t);
}

static void bodies_feel_sleepers(void **state)
{
    (void)state;
    check_load(0.7, 200, 0.005);
    check_load(0.1, 400, 0.05); /* pressure alone bears a third; what lies on contacts never comes quite to rest */
}

/* Snapshots show everyone once. */
static void frames_show_sleepers(void **state)
{
    (void)state;
    tank t;
    make_flume(&t, 2, 0.1, sb_vec(14, 0, 1.5), true);
    sb_sim *sim = settled(&t);
    const size_t n = t.model.fluid_count;
    assert_int_equal(tank_steps(sim, 3), 0);
    sb_frame *frame = sb_sim_snapshot(sim);
    bool *seen = sb_alloc(n, 1);
    assert_true(frame && seen);
    assert_int_equal(frame->count, n);
    double far = 0;
    for (size_t i = 0; i < n; i++) {
        assert_true(frame->id[i] < n && !seen[frame->id[i]]);
        seen[frame->id[i]] = true;
        far = fmax(far, (double)frame->position[3 * i]);
    }
    assert_true(far > 13.8);
    static sb_fluid_sample found[1024];
    assert_true(sb_sim_query(sim, sb_vec(13, -1, 0), sb_vec(14, 1, 2), found, 1024) >= 95);
    assert_true(found[0].pressure >= 0 && found[0].density > 800);
    sb_frame_release(frame);
    sb_free(seen);
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* Every allocation of laying down and waking may fail, and is said to have. */
static void no_memory(void **state)
{
    (void)state;
    long failures = 0;
    for (long n = 1;; n++) {
        tank t;
        sb_error error = {0};
        make_flume(&t, 2, 0.2, sb_vec(14, 0, 1.6), true);
        t.scene.numerics.settle_steps = 1;
        sb_sim *sim = tank_sim(&t);
        assert_non_null(sim);
        assert_int_equal(tank_steps(sim, 1), 0);
        sim->report.step = 0;
        sb_memory_fail_at(n);
        sb_status status = sb_sleep_expect(sim, &error);
        if (status == SB_OK) {
            sb_sleep_listen(sim, 0);
            status = sb_sleep_begin(sim, &error);
        }
        sb_memory_fail_at(0);
        if (status != SB_OK) assert_non_null(strstr(error.text, "memory"));
        failures += status != SB_OK;
        sb_sim_destroy(sim);
        tank_free(&t);
        if (status == SB_OK) break;
    }
    printf("%ld allocations\n", failures);
    assert_true(failures > 15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_short_tank_is_as_without),
        cmocka_unit_test(sleepers_rest_and_wake_calm),
        cmocka_unit_test(the_wave_is_the_same),
        cmocka_unit_test(momentum_balances),
        cmocka_unit_test(periodic_sides),
        cmocka_unit_test(bits_repeat),
        cmocka_unit_test(bodies_feel_sleepers),
        cmocka_unit_test(frames_show_sleepers),
        cmocka_unit_test(no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
