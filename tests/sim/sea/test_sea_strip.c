/* Sides of kind sea: water comes in and goes out, rests, and is accounted for; the same bits for any number of threads
   and after a resumed run; bad input. */
#include "base/memory.h"
#include "physics/records/reflection.h"
#include "physics/waves/dispersion.h"
#include "sim/passes/passes.h"
#include "sim/sea/shore.h"
#include "sim/sea/strip.h"
#include "sim/tank.h"

#include "check.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define SOLITARY "source: theory, wave: solitary, depth: 1"

static const char *const still = NULL;

/* Largest change of the mean depth around x, over `times` sqrt(d/g). */
static double follow(sb_sim *sim, double x, double reach, double times)
{
    const double start = shore_depth(sim, x, reach), until = sim->state.time + times / sqrt(9.81);
    double most = 0;
    while (sim->state.time < until) {
        shore_run(sim, sim->state.time + 1e-9);
        most = fmax(most, fabs(shore_depth(sim, x, reach) - start));
    }
    return most;
}

/* Still water between two seas: no particle comes or goes, the level stays within 0.2 % of the depth, and no particle
   is faster than 0.025 sqrt(g D): with walls instead of the seas the same water has 0.019. */
static void still_water_rests(void **state)
{
    (void)state;
    const shore_form form = {2, 0.1, 1, {6, 0, 1.5}, "{x_min: sea, x_max: sea}", NULL};
    shore s;
    shore_make(&s, &form, still);
    sb_sim *sim = shore_sim(&s);
    const size_t count = sim->state.n;
    double top = 0, imbalance = 0;
    const double start = shore_depth(sim, 3, 1);
    while (sim->state.time * sqrt(9.81) < 40) {
        shore_run(sim, sim->state.time + 1e-9);
        top = fmax(top, sim->state.max_speed / sqrt(9.81));
        imbalance = fmax(imbalance, sim->report.momentum_imbalance);
    }
    printf("still water: top speed %.4f, level %+.5f, momentum %.1e\n", top, shore_depth(sim, 3, 1) - start, imbalance);
    assert_true(top < 0.025);
    assert_true(fabs(shore_depth(sim, 3, 1) - start) < 0.002);
    assert_int_equal(sim->state.n, count);
    assert_true(imbalance < 2e-5);
    sb_sim_destroy(sim);
    shore_free(&s);
}

/* Uneven ground, which rises out of the water along the side. */
static void water_rests_over_a_slope_with_a_dry_part(void **state)
{
    (void)state;
    const shore_form form = {3,
                             0.125,
                             1,
                             {2.5, 3, 1.5},
                             "{x_min: sea}",
                             "[{name: slope, shape: box, min: [-1, -3, -2], max: [4, 5, 0], rotate: [25, 0, 0], "
                             "translate: [0, 1.5, 0.5]}]"};
    shore s;
    shore_make(&s, &form, still);
    const sb_model_sea *ground = &s.model.sea[SB_X_MIN];
    double low = 10, high = -10;
    for (size_t c = 0; c < ground->along * ground->across; c++) {
        low = fmin(low, ground->bed[c]);
        high = fmax(high, ground->bed[c]);
    }
    printf("slope: ground from %.3f to %.3f m\n", low, high);
    assert_true(low < 0.5 && high > 1);
    sb_sim *sim = shore_sim(&s);
    const size_t count = sim->state.n;
    const double moved = follow(sim, 1.5, 0.5, 8);
    printf("slope: level moves by %.5f m, particles %+ld\n", moved, (long)sim->state.n - (long)count);
    assert_true(moved < 0.005);
    assert_true(labs((long)sim->state.n - (long)count) <= (long)(count / 100));
    assert_int_equal(sim->state.lost, 0);
    sb_sim_destroy(sim);
    shore_free(&s);
}

static double energy_of(const sb_sim *sim)
{
    const sb_energy e = sb_sim_energy(sim);
    return e.kinetic + e.potential;
}

static double sum_of(const sb_ledger *l)
{
    return l->bodies + l->viscosity + l->friction + l->pressure + l->contact + l->integration + l->left + l->stress +
           l->sea;
}

static int by_value(const void *a, const void *b)
{
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return x < y ? -1 : x > y;
}

static void assert_ids_differ(const sb_sim *sim)
{
    uint32_t *id = sb_alloc(sim->state.n, sizeof *id);
    memcpy(id, sim->state.id, sim->state.n * sizeof *id);
    qsort(id, sim->state.n, sizeof *id, by_value);
    for (size_t i = 1; i < sim->state.n; i++) assert_true(id[i] != id[i - 1]);
    assert_true(id[sim->state.n - 1] < sim->state.next_id);
    sb_free(id);
}

/* A solitary wave comes in at one side and leaves at the other. Ten spacings of depth are coarse: the bars of 1 % are
   those of 20 spacings (docs/open-sea.md). Three depths from the side: at this spacing it loses height on the way. */
static void a_solitary_wave_passes(void **state)
{
    (void)state;
    const shore_form form = {2, 0.1, 1, {12, 0, 1.8}, "{x_min: sea, x_max: sea}", NULL};
    shore s;
    shore_make(&s, &form, "{" SOLITARY ", height: 0.3}"); /* its crest passes x = 0 at 10.8 sqrt(d/g) */
    sb_sim *sim = shore_sim(&s);
    const size_t count = sim->state.n;
    const double before = energy_of(sim), still_depth = shore_depth(sim, 3, 0.4), c = sqrt(9.81);
    double top = 0, after = 0;
    while (sim->state.time * c < 32) {
        shore_run(sim, sim->state.time + 1e-9);
        const double eta = shore_depth(sim, 3, 0.4) - still_depth;
        top = fmax(top, eta);
        if (sim->state.time * c > 24) after = fmax(after, fabs(eta)); /* the wave has left; what it reflects passes */
    }
    const sb_crossing *crossing = sb_sim_crossing(sim);
    const double mass = 0.01 * (double)crossing->in;
    printf("solitary: height %.4f, after %.4f, volume in %.3f out %.3f\n", top, after, mass,
           0.01 * (double)crossing->out);
    assert_near(top, 0.3, 0.05 * 0.3);
    assert_true(after < 0.03 * 0.3);
    assert_near(mass, 1.362, 0.1); /* one column of particles */
    assert_int_equal(sim->state.n, count + crossing->in - crossing->out);
    assert_ids_differ(sim);
    assert_near(energy_of(sim) - before, sum_of(&sim->state.ledger), 1e-6 * before);
    assert_near(sim->state.ledger.sea, crossing->energy + crossing->held, 1e-9 * before);
    sb_sim_destroy(sim);
    shore_free(&s);
}

/* Water that has come in, m^2: particles, and the parts of particles that the rows of the first side owe. */
static double came_in(const sb_sim *sim, size_t at_first)
{
    const sb_strip_side *s = &sim->strip->side[0];
    double owed = 0;
    for (size_t k = 0; k < s->columns * s->rows; k++) owed += s->owed[k];
    return 0.01 * ((double)sim->state.n - (double)at_first + owed);
}

/* The wave of the full equations carries its volume, 1.7915 h^2, through the side: within 1 %, and half of its height
   is there when half of the volume is. The volume is that of Starr's identity (docs/decisions/0075). */
static void the_volume_that_comes_in_is_the_given_one(void **state)
{
    (void)state;
    const shore_form form = {2, 0.1, 1, {14, 0, 1.9}, "{x_min: sea}", NULL};
    const double volume = 1.7915, crest = 2.81, passed = 1.4; /* s */
    shore s;
    shore_make(&s, &form, "{" SOLITARY ", height: 0.5}");
    sb_sim *sim = shore_sim(&s);
    const size_t count = sim->state.n;
    shore_run(sim, crest);
    const double half = came_in(sim, count) / volume;
    shore_run(sim, crest + passed);
    const double all = came_in(sim, count) / volume;
    printf("volume that comes in: %.4f at the crest, %.4f in all\n", half, all);
    assert_near(half, 0.5, 0.02);
    assert_near(all, 1, 0.01);
    sb_sim_destroy(sim);
    shore_free(&s);
}

/* Water that flows in with a Froude number, one metre per second faster than the given flow, measured again and again
   while no particle moves: the part of this that has become the outgoing wave after a number of steps. */
static double share_measured(double froude, int steps)
{
    const shore_form form = {2, 0.1, 1, {6, 0, 1.5}, "{x_min: sea}", NULL};
    const double speed = froude * sqrt(9.81), more = 1;
    char folder[512], sea[640], path[600];
    sb_error error = {0};
    shore s;
    assert_non_null(getcwd(folder, sizeof folder));
    snprintf(path, sizeof path, "%s/current-%d.csv", folder, (int)getpid());
    snprintf(sea, sizeof sea, "{source: table, file: %s}", path);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fprintf(file, "t,eta,u\n0,0,%.17g\n100,0,%.17g\n", speed - more, speed - more);
    fclose(file);
    shore_make(&s, &form, sea);
    sb_sim *sim = shore_sim(&s);
    remove(path);
    shore_run(sim, 1e-9);
    sb_outgoing *station = &sim->strip->side[0].station[0];
    *station = (sb_outgoing){.share = station->share}; /* nothing has come out until now */
    for (size_t i = 0; i < sim->state.n; i++) sim->state.velocity[i] = (sb_f4){(float)speed, 0, 0, 0};
    for (int step = 0; step < steps; step++) assert_int_equal(sb_strip_measure(sim, &error), SB_OK);
    const double share = station->filtered / more;
    sb_sim_destroy(sim);
    shore_free(&s);
    return share;
}

/* A wave that goes out travels against the flow, with c - u: at a Froude number F of 0.5 its measurement takes
   twice the time as in still water, and the share 1 - F^2 of it counts. At -0.5 it takes two thirds of the time, and
   where the flow is faster than waves nothing comes out. */
static void a_wave_goes_out_against_the_flow(void **state)
{
    (void)state;
    const double calm = share_measured(0, 9), half = share_measured(0.5, 18), late = share_measured(0.5, 9);
    const double ebb = share_measured(-0.5, 6), fast = share_measured(1.1, 36);
    printf("outgoing wave: %.3f in still water, %.3f at a Froude number of 0.5 in twice the time, %.3f in the same; "
           "%.3f at -0.5 in two thirds; %.4f at 1.1\n",
           calm, half, late, ebb, fast);
    assert_true(calm > 0.4);
    assert_near(half, 0.75 * calm, 0.02);
    assert_true(late < 0.6 * 0.75 * calm);
    assert_near(ebb, calm, 0.02);
    assert_true(fabs(fast) < 1e-3);
}

/* Waters of two seas meet in corners. */
static void a_wave_passes_corners(void **state)
{
    (void)state;
    const shore_form form = {3, 0.2, 1, {5, 5, 1.8}, "{x_min: sea, x_max: sea, y_min: sea, y_max: sea}", NULL};
    shore s;
    shore_make(&s, &form, "{" SOLITARY ", height: 0.2, origin: [6, 0]}");
    sb_sim *sim = shore_sim(&s);
    const double start = shore_depth(sim, 2.5, 0.8);
    double top = 0;
    while (sim->state.time * sqrt(9.81) < 16) {
        shore_run(sim, sim->state.time + 1e-9);
        top = fmax(top, shore_depth(sim, 2.5, 0.8) - start);
    }
    const double after = shore_depth(sim, 2.5, 0.8) - start;
    printf("corners: height %.4f, level after %+.4f, in %lu out %lu\n", top, after,
           (unsigned long)sb_sim_crossing(sim)->in, (unsigned long)sb_sim_crossing(sim)->out);
    assert_near(top, 0.2, 0.1 * 0.2);
    assert_true(fabs(after) < 0.02); /* five layers */
    sb_sim_destroy(sim);
    shore_free(&s);
}

/* Steps while the wave comes in, saved half way. */
static void the_same_bits(const shore_form *form, const char *sea)
{
    enum { BEFORE = 60, AFTER = 40 };
    static const int threads[] = {1, 3};
    const int initial = omp_get_max_threads();
    sb_archive_out out = {0};
    sb_error error = {0};
    shore s;
    shore_make(&s, form, sea);
    omp_set_num_threads(1);
    sb_sim *sim = shore_sim(&s);
    const sb_passes *wide = sb_passes_cpu_wide();
    sim->passes = &sb_passes_cpu;
    assert_int_equal(tank_steps(sim, BEFORE), 0);
    tank_save(sim, &out);
    assert_int_equal(tank_steps(sim, AFTER), 0);
    const uint64_t end = sb_sim_hash(sim);
    assert_true(sb_sim_crossing(sim)->in > 0);
    sb_sim_destroy(sim);
    for (size_t k = 0; k < 2 + (wide != NULL); k++) {
        omp_set_num_threads(threads[k % 2]);
        sim = NULL;
        assert_int_equal(sb_sim_create(&s.scene, &s.model, NULL, &sim, &error), SB_OK);
        sim->passes = k == 2 ? wide : &sb_passes_cpu;
        if (tank_load(sim, &out, &error) != SB_OK) fail_msg("%s", error.text);
        assert_int_equal(tank_steps(sim, AFTER), 0);
        if (sb_sim_hash(sim) != end) fail_msg("run %zu ends with another state", k);
        sb_sim_destroy(sim);
    }
    omp_set_num_threads(initial);
    sb_archive_out_free(&out);
    shore_free(&s);
}

static void threads_and_resuming_do_not_matter(void **state)
{
    (void)state;
    static const char *const flat_wave = "{" SOLITARY ", height: 0.3, origin: [8]}";
    static const char *const wave = "{" SOLITARY ", height: 0.3, origin: [8, 0]}";
    const shore_form flat = {2, 0.1, 1, {4, 0, 1.8}, "{x_min: sea, x_max: sea}", NULL};
    const shore_form corner = {3, 0.2, 1, {3.2, 3.2, 1.8}, "{x_min: sea, y_max: sea}", NULL};
    const shore_form slab = {3, 0.2, 1, {4, 1, 1.8}, "{x_min: sea, y_min: periodic, y_max: periodic}", NULL};
    the_same_bits(&flat, flat_wave);
    the_same_bits(&corner, wave);
    the_same_bits(&slab, wave);
}

/* Waves of kd = 1.5 leave: amplitudes of the waves in both directions, by least squares from the depth at six places.
   Ten spacings of depth are coarse: the bar of 4 % is for 20 (assets/validation/sea). */
static void short_waves_leave(void **state)
{
    (void)state;
    enum { PLACES = 6 };
    const double period = 1.7216, first = 14, omega = 2 * M_PI / period, k = sb_wave_number(period, 1, 9.81);
    const shore_form form = {2, 0.1, 1, {8, 0, 1.5}, "{x_min: sea, x_max: sea}", NULL};
    double place[PLACES], cosines[PLACES] = {0}, sines[PLACES] = {0};
    shore s;
    shore_make(&s, &form,
               "{source: theory, wave: regular, height: 0.1, period: 1.7216, depth: 1, sides: {x_max: still}}");
    sb_sim *sim = shore_sim(&s);
    for (size_t p = 0; p < PLACES; p++) place[p] = 2.5 + 0.6 * (double)p;
    shore_run(sim, first);
    while (sim->state.time < first + 5 * period) {
        const double t = sim->state.time, dt = sim->state.time_step;
        for (size_t p = 0; p < PLACES; p++) {
            const double depth = shore_depth(sim, place[p], 0.3);
            cosines[p] += 2 * dt / (5 * period) * depth * cos(omega * t);
            sines[p] += 2 * dt / (5 * period) * depth * sin(omega * t);
        }
        shore_run(sim, t + 1e-9);
    }
    const sb_split split = sb_split_of(place, cosines, sines, PLACES, k);
    printf("short waves: in %.4f m, back %.2f %%\n", split.incident, 100 * split.reflected / split.incident);
    assert_near(split.incident, 0.05, 0.1 * 0.05);
    assert_true(split.reflected < 0.06 * split.incident);
    sb_sim_destroy(sim);
    shore_free(&s);
}

static void assert_refused(const shore_form *form, const char *sea, const char *expected)
{
    shore s;
    sb_error error = {0};
    assert_int_equal(shore_try(&s, form, sea, &error), SB_BAD_INPUT);
    if (!strstr(error.text, expected) || strchr(error.text, '\n')) fail_msg("%s", error.text);
    shore_free(&s);
}

static void bad_input_is_refused(void **state)
{
    (void)state;
    static const char *const high = "{" SOLITARY ", theory: third-order, height: 0.8}";
    shore_form f = {2, 0.1, 1, {6, 0, 1.5}, "{x_min: sea, x_max: periodic}", NULL};
    assert_refused(&f, still, "periodic, but x_min is sea");
    f.sides = "{z_min: sea}";
    assert_refused(&f, still, "vertical sides only");
    f.sides = "{x_min: sea}";
    assert_refused(&f, high, "above the domain");
    f.size.x = 1;
    assert_refused(&f, still, "the domain is 1 m long there");
    f.size.x = 6;
    f.bodies = "[{name: land, shape: box, min: [-1, -1, -1], max: [0.5, 1, 1.3]}]";
    assert_refused(&f, still, "the lowest ground there");
}

/* Ground is what stands below the still level, or reaches above it; not what hangs over the water. */
static void walls_are_ground_and_decks_are_not(void **state)
{
    (void)state;
    static const char *const low = "{" SOLITARY ", height: 0.1}", *const tall = "{" SOLITARY ", height: 0.4}";
    shore_form f = {2, 0.1, 1, {6, 0, 1.5}, "{x_min: sea}", NULL};
    f.bodies = "[{name: land, shape: box, min: [-1, -1, -1], max: [0.5, 1, 4]}]";
    assert_refused(&f, low, "the lowest ground there is at 1.5 m"); /* the domain's top */
    f.bodies = "[{name: floor, shape: box, min: [-1, -1, -1], max: [7, 1, 0.2]}, "
               "{name: deck, shape: box, min: [-1, -1, 1.2], max: [1, 1, 1.4]}]";
    assert_refused(&f, tall, "body \"deck\" hangs over the given water there, at 1.2 m");
    shore s;
    shore_make(&s, &f, low);
    for (size_t c = 0; c < s.model.sea[SB_X_MIN].across; c++) assert_near(s.model.sea[SB_X_MIN].bed[c], 0.2, 1e-9);
    shore_free(&s);
    f.bodies = "[{name: lower, shape: box, min: [-1, -1, -1], max: [7, 1, 0.3]}, "
               "{name: upper, shape: box, min: [3, -1, 0.3], max: [7, 1, 1.1]}, "
               "{name: top, shape: box, min: [3, -1, 1.1], max: [7, 1, 1.25]}]";
    f.sides = "{x_max: sea}";
    assert_refused(&f, still, "the lowest ground there is at 1.25 m"); /* bodies on each other */
}

/* A shore that recedes along a side: the deeper part of it keeps its water. */
static void a_side_may_fall_dry_in_part(void **state)
{
    (void)state;
    const shore_form form = {3,
                             0.1,
                             1,
                             {2, 2, 1.5},
                             "{x_min: sea}",
                             "[{name: slope, shape: box, min: [-1, -3, -2], max: [4, 6, 0], rotate: [20, 0, 0], "
                             "translate: [0, 0, 0.1]}]"};
    shore s;
    shore_make(&s, &form,
               "{source: theory, wave: components, depth: 0.9, ramp: 0.5, components: [{amplitude: 0.34, period: 6}]}");
    sb_sim *sim = shore_sim(&s);
    shore_run(sim, 3.2); /* the trough is at 3 s */
    sb_sim_destroy(sim);
    shore_free(&s);
}

/* A wave whose trough is deeper than the water: on the depth of its theory it would not break. */
static void a_source_that_dries_the_strip_ends_the_run(void **state)
{
    (void)state;
    const shore_form form = {2, 0.1, 1, {6, 0, 2.2}, "{x_min: sea}", NULL};
    shore s;
    shore_make(&s, &form,
               "{source: theory, wave: components, depth: 5, ramp: 0.5, components: [{amplitude: 0.98, period: 4}]}");
    sb_sim *sim = shore_sim(&s);
    sb_error error = {0};
    sb_status status = SB_OK;
    for (int step = 0; step < 2000 && status == SB_OK; step++) status = sb_sim_step(sim, &error);
    assert_int_equal(status, SB_FAILED);
    if (!strstr(error.text, "the strip would be dry")) fail_msg("%s", error.text);
    sb_sim_destroy(sim);
    shore_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(still_water_rests),
        cmocka_unit_test(water_rests_over_a_slope_with_a_dry_part),
        cmocka_unit_test(a_solitary_wave_passes),
        cmocka_unit_test(the_volume_that_comes_in_is_the_given_one),
        cmocka_unit_test(a_wave_goes_out_against_the_flow),
        cmocka_unit_test(a_wave_passes_corners),
        cmocka_unit_test(short_waves_leave),
        cmocka_unit_test(threads_and_resuming_do_not_matter),
        cmocka_unit_test(bad_input_is_refused),
        cmocka_unit_test(walls_are_ground_and_decks_are_not),
        cmocka_unit_test(a_side_may_fall_dry_in_part),
        cmocka_unit_test(a_source_that_dries_the_strip_ends_the_run),
    };
    omp_set_num_threads(1); /* small scenes */
    return cmocka_run_group_tests(tests, NULL, NULL);
}
