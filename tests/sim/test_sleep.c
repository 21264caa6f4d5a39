/* Still water asleep: it keeps its place until the front comes near, wakes calm, and is missed by nothing that looks at
   the water; a wave that runs into it is the wave that runs without it. */
#include "../check.h"
#include "base/memory.h"
#include "sim/flume.h"
#include "sim/sleep.h"

#include <stdio.h>
#include <string.h>

static double wave_speed(void)
{
    return sqrt(9.81 * SB_FLUME_DEPTH);
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
    float *told[2];
    size_t n = 0;
    for (int sleep = 0; sleep < 2; sleep++) {
        tank t;
        flume_make(&t, 2, 0.1, sb_vec(4, 0, 1.5), sleep);
        sb_sim *sim = tank_settled(&t);
        assert_true(sim->sleep == NULL && sb_sim_sleep(sim).asleep == 0);
        sb_sim_find_pressures(sim);
        n = sim->n;
        told[sleep] = sb_alloc(n, sizeof(float));
        assert_non_null(told[sleep]);
        for (size_t i = 0; i < n; i++) told[sleep][sim->id[i]] = (float)sb_sim_particle(sim, i).pressure;
        assert_int_equal(tank_steps(sim, 20), 0);
        hash[sleep] = sb_sim_hash(sim);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
    assert_true(hash[0] == hash[1]);
    assert_memory_equal(told[0], told[1], n * sizeof(float));
    sb_free(told[0]);
    sb_free(told[1]);
}

/* At t = 0, once some sleep, lists are none of the order that is left, so the solve's pressures are told. */
static void pressures_at_the_start_are_the_water_s(void **state)
{
    (void)state;
    tank t;
    flume_make(&t, 2, 0.1, sb_vec(14, 0, 1.5), true);
    sb_sim *sim = tank_settled(&t);
    assert_true(sb_sim_sleep(sim).asleep > 0);
    sb_sim_find_pressures(sim);
    double mean = 0, scale = 1000 * 9.81 * SB_FLUME_DEPTH;
    for (size_t i = 0; i < sim->n; i++) {
        const sb_fluid_sample s = sb_sim_particle(sim, i);
        assert_true(s.pressure == (double)sim->velocity[i][3]);
        mean += fabs(s.pressure - 1000 * 9.81 * (SB_FLUME_DEPTH - s.position.z)) / (scale * (double)sim->n);
    }
    printf("off the still water's by %.3g of rho g D\n", mean);
    assert_true(mean < 0.2); /* of ten layers the first has nearly twice its own */
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* Settled, not yet laid down. */
static sb_sim *before_lying_down(tank *t, int steps)
{
    sb_error error = {0};
    flume_make(t, 2, 0.1, sb_vec(14, 0, 1.5), true);
    t->scene.numerics.wall_gamma = 0.1; /* so light that contact has to bear some of it */
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    assert_int_equal(sb_sleep_expect(sim, &error), SB_OK);
    for (int s = 0; s < steps; s++) {
        sim->settling = s < 20 ? SB_CREEPING : SB_DAMPED;
        assert_int_equal(tank_steps(sim, 1), 0);
        sb_sleep_listen(sim, s);
    }
    sim->settling = SB_RUNNING;
    return sim;
}

/* Settling's last step may throw one out where water is to sleep: it is neither awake nor asleep, and has left before
   the run began. */
static void what_leaves_does_not_sleep(void **state)
{
    (void)state;
    tank t;
    sb_error error = {0};
    sb_sim *sim = before_lying_down(&t, 3);
    const size_t n = t.model.fluid_count;
    size_t far = 0;
    for (size_t i = 0; i < n; i++)
        if (sim->position[i][0] > sim->position[far][0]) far = i;
    const uint32_t gone = sim->id[far];
    sim->position[far] = sb_space_record(&sim->space, sb_vec(13, 0, 1.7)); /* through the open top */
    assert_int_equal(sb_sleep_begin(sim, &error), SB_OK);
    assert_true(sb_asleep(sim) > 0 && sim->sleep->count == sim->sleep->capacity);
    assert_int_equal(sim->n + sb_asleep(sim), n - 1);
    assert_int_equal(sb_sim_report(sim)->fluid_count, n - 1);
    assert_int_equal(sb_sim_report(sim)->left_domain, 1);
    assert_true(sb_sim_ledger(sim)->left == 0);
    bool *seen = sb_alloc(n, 1);
    assert_non_null(seen);
    for (size_t i = 0; i < n - 1; i++) {
        const uint32_t id = sb_sim_particle(sim, i).id;
        assert_true(id < n && id != gone && !seen[id]);
        seen[id] = true;
    }
    sb_free(seen);
    assert_int_equal(tank_steps(sim, 3), 0);
    assert_int_equal(sb_sim_report(sim)->fluid_count, n - 1);
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* The step that poises what starts from rest adds nothing to the mean of settling's. */
static void a_poised_step_is_not_listened_to(void **state)
{
    (void)state;
    tank t;
    sb_sim *sim = before_lying_down(&t, 100);
    const size_t n = t.model.fluid_count, bytes = n * sizeof *sim->sleep->settled_push;
    sb_settled_push *before = sb_alloc(n, sizeof *before);
    assert_non_null(before);
    memcpy(before, sim->sleep->settled_push, bytes);
    sim->settling = SB_POISED;
    assert_int_equal(tank_steps(sim, 1), 0);
    sim->settling = SB_RUNNING;
    double borne = 0;
    for (size_t id = 0; id < n; id++) borne -= (double)before[id].push[2];
    printf("contacts bear %.3g of the weight\n", borne / (9.81 * sb_sim_energy(sim).mass));
    assert_true(borne > 0.1 * 9.81 * sb_sim_energy(sim).mass);
    assert_memory_equal(before, sim->sleep->settled_push, bytes);
    sb_free(before);
    sb_sim_destroy(sim);
    tank_free(&t);
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
    flume_make(&t, 2, 0.1, sb_vec(20, 0, 1.5), true);
    sb_sim *sim = tank_settled(&t);
    const size_t n = t.model.fluid_count;
    assert_true(sb_sim_sleep(sim).asleep > n / 2);
    census first = {0}, now = {0};
    census_take(&first, sim, n);
    const double mass = sb_sim_energy(sim).mass, reach = 4 * SB_FLUME_DEPTH;
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
            if (0.5 * (bin + 1) > edge_x - SB_FLUME_DEPTH) fastest = fmax(fastest, fabs(mean[bin]));
        }
        if (edge_x < 1e9) nearest = fmin(nearest, edge_x - front);
    }
    printf("mean speed within a depth of sleepers %.3g sqrt(g D), nearest that waves came %.3g D, the last woke at "
           "%.3g s\n",
           fastest / wave_speed(), nearest, sb_sim_sleep(sim).woken);
    assert_true(woken > n / 2);
    assert_true(nearest >
                reach - 1.5 * SB_FLUME_DEPTH); /* a look comes every few steps, waves outrun the front a little */
    assert_true(fastest < 0.01 * wave_speed());
    /* Never after the front, and not long before it: the wave's own head may be ahead of it. */
    assert_near(sb_sim_sleep(sim).woken, (20 - reach - SB_FLUME_DEPTH) / (1.1 * wave_speed()) - 0.5, 0.8);
    assert_true(sb_sim_sleep(sim).asleep_steps > 0 && sb_sim_sleep(sim).particle_steps == n * sb_sim_report(sim)->step);
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
    flume_make(&t, 2, 0.1, sb_vec(20, 0, 1.5), sleep);
    for (size_t i = 0; i < t.model.fluid_count; i++) t.model.fluid_position[i].x += jitter * sin(7.0 * (double)i);
    sb_sim *sim = tank_settled(&t);
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
               k == 0   ? "awake"
               : k == 1 ? "awake, another start"
                        : "asleep",
               runs[k].paddle, runs[k].floor, runs[k].potential, runs[k].crest);
    assert_near(on.paddle, off.paddle, 0.01 * fabs(off.paddle));
    assert_near(on.floor, off.floor, 0.002 * fabs(off.floor));
    assert_near(on.potential, off.potential, 0.02 * off.potential);
    assert_near(on.crest, off.crest, 0.05);
}

/* Snapshots show everyone once. */
static void frames_show_sleepers(void **state)
{
    (void)state;
    tank t;
    flume_make(&t, 2, 0.1, sb_vec(14, 0, 1.5), true);
    sb_sim *sim = tank_settled(&t);
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

/* What a box covers is in motion from the start, to its end at a periodic side and no farther. */
static void a_box_may_end_at_a_periodic_side(void **state)
{
    (void)state;
    tank t;
    flume_make(&t, 3, 0.2, sb_vec(16, 4, 1.6), true);
    tank_repeat(&t, 0);
    tank_repeat(&t, 1);
    t.model.body_count = 1; /* no paddle */
    t.scene.wavemaker_count = 0;
    sb_fluid_box box = {.min = sb_vec(12, 2, 0), .max = sb_vec(16, 4, 1)};
    t.scene.boxes = &box;
    t.scene.box_count = 1;
    sb_sim *sim = tank_sim(&t);
    sb_tiles tiles = {0};
    assert_non_null(sim);
    assert_int_equal(sb_tiles_create(sim, &tiles), 0);
    sb_tiles_look(sim, &tiles);
    const double edge = ldexp(sim->space.quantum, tiles.shift);
    for (size_t i = 0; i < sim->n; i++) {
        const sb_vec3 at = sb_sim_particle(sim, i).position;
        const bool reached = tiles.reached[sb_tile_of(sim, &tiles, sim->position[i])];
        if (at.x > box.min.x && at.y > box.min.y) assert_true(reached);
        if (at.x < box.min.x - edge || at.y < box.min.y - edge) assert_false(reached);
    }
    sb_tiles_free(&tiles);
    sb_sim_destroy(sim);
    t.scene.boxes = NULL;
    t.scene.box_count = 0;
    tank_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_short_tank_is_as_without),
        cmocka_unit_test(sleepers_rest_and_wake_calm),
        cmocka_unit_test(the_wave_is_the_same),
        cmocka_unit_test(frames_show_sleepers),
        cmocka_unit_test(pressures_at_the_start_are_the_water_s),
        cmocka_unit_test(what_leaves_does_not_sleep),
        cmocka_unit_test(a_poised_step_is_not_listened_to),
        cmocka_unit_test(a_box_may_end_at_a_periodic_side),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
