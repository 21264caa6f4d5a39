/* Each pass over pairs in each form gives what the reference form gives, for the same input. The reference computes in
   double precision, one pair at a time. */
#include "base/memory.h"
#include "base/random.h"
#include "check.h"
#include "sim/exchange/exchange.h"
#include "sim/passes/passes.h"
#include "sim/pressure/pressure.h"
#include "sim/step/stages.h"
#include "sim/tank.h"
#include "sim/twin.h"
#include "sim/walls/basin.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Walls of boundary particles or walls that reflect water, with a moving body or with periodic sides. */
enum { MOVING, PERIODIC, IMAGES, IMAGES_PERIODIC, KINDS };
static const char *const kinds[KINDS] = {"", ", periodic", ", images", ", images and periodic"};

typedef struct water {
    tank tank;
    basin basin;
    sb_sim *sim;
} water;

static sb_sim *make_images(basin *b, bool flat, bool repeats)
{
    const char *const moving =
        flat ? "[{name: paddle, shape: box, min: [0.2, 0], max: [0.5, 0.7]}, {name: block, shape: box, min: [0.9, 0], "
               "max: [1.1, 0.4]}]"
             : "[{name: paddle, shape: box, min: [0.2, 0.2, 0], max: [0.5, 0.5, 0.7]}, {name: block, shape: box, min: "
               "[0.9, 0.3, 0], max: [1.1, 0.7, 0.4]}]";
    const char *const beside_a_side = flat ? "[{name: block, shape: box, min: [0.1, 0], max: [0.4, 0.4]}]"
                                           : "[{name: block, shape: box, min: [0.1, 0.3, 0], max: [0.4, 0.7, 0.4]}]";
    const sb_override set[] = {
        {"dimensions", flat ? "2" : "3"},
        {"domain.max", flat ? "[1.3, 1.2]" : "[1.3, 0.7, 1.2]"},
        {"domain.min", flat ? "[0, 0]" : "[0, 0, 0]"},
        {"domain.sides", repeats ? "{x_min: periodic, x_max: periodic}" : "{x_min: wall}"},
        {"water",
         flat ? "{boxes: [{min: [0, 0], max: [1.3, 0.9]}]}" : "{boxes: [{min: [0, 0, 0], max: [1.3, 0.7, 0.5]}]}"},
        {"bodies", repeats ? beside_a_side : moving},
        {"wavemakers", flat ? "[{name: push, body: paddle, kind: stroke, stroke: 0.5, speed: 0.8, direction: [1, 0]}]"
                            : "[{name: push, body: paddle, kind: stroke, stroke: 0.5, speed: 0.8, direction: [1, 0, "
                              "0]}]"},
    };
    basin_build(b, set, sizeof set / sizeof *set - (repeats ? 1 : 0));
    basin_scatter(b, 3, b->model.min, b->model.max, 1);
    for (size_t i = 0; i < b->model.fluid_count; i++) { /* none in the bodies */
        sb_vec3 *at = &b->model.fluid_position[i];
        if (at->x < 0.7 || (at->x > 0.9 && at->x < 1.1)) at->z = 0.7 + at->z * 0.4;
    }
    b->scene.numerics.wall_friction = 0.05;
    b->scene.numerics.turbulence = SB_TURBULENCE_SPS;
    b->scene.fluid.viscosity = 1e-4;
    b->scene.numerics.artificial_viscosity = 0.1;
    basin_start(b);
    return b->sim;
}

/* Water in motion beside walls, with all terms. */
static sb_sim *make_tank(tank *t, int dimensions, bool repeats)
{
    const sb_wavemaker_parameters law = {
        .kind = sb_wavemaker_find("stroke"), .stroke = 0.5, .speed = 0.8, .gravity = 9.81};
    tank_of_particles(t, dimensions, 0.1, sb_vec(1.3, 0.7, 1.2), 1.3, 0.9, 0.2);
    if (repeats) tank_repeat(t, 0);
    tank_scatter(t, 3, 1);
    if (!repeats) tank_add_plate(t, "paddle", 0.3, 0, 0.7, sb_vec(1, 0, 0), &law);
    tank_add_terms(t);
    t->scene.numerics.artificial_viscosity = 0.1;
    t->scene.numerics.wall_shear = SB_SHEAR_SMOOTH;
    t->scene.numerics.density = SB_DENSITY_COMPLETED;
    return tank_sim(t);
}

static void make(water *w, int dimensions, int kind)
{
    *w = (water){0};
    w->sim = kind < IMAGES ? make_tank(&w->tank, dimensions, kind == PERIODIC)
                           : make_images(&w->basin, dimensions == 2, kind == IMAGES_PERIODIC);
    sb_sim *sim = w->sim;
    assert_non_null(sim);
    sim->state.time = 0.4;
    assert_int_equal(tank_prepare(sim, 0.01), 0);
    for (size_t i = 0; i < sim->state.n; i++) sim->state.velocity[i][3] = (float)(2000 * sb_random(5, i));
    if (kind >= IMAGES) assert_true(sim->groups.images_used > 0 && sim->work.edge_pairs.used > 0);
}

static void drain(water *w)
{
    sb_sim_destroy(w->sim);
    w->basin.sim = NULL;
    if (w->tank.model.body_count > 0) tank_free(&w->tank);
    if (w->basin.model.body_count > 0) basin_free(&w->basin);
}

/* A view that a pass writes, and how far forms may differ, over its largest value. */
typedef struct result {
    const char *view;
    double tolerance;
} result;

typedef struct row {
    const char *name;
    result result[4];
} row;

enum {
    NEIGHBOURS,
    STRAIN,
    STRAINED,
    DEVIATOR,
    MEAN_DEVIATOR,
    CORRECT,
    STRAIN_RATE,
    FORCES,
    DIFFERENCES,
    ACCELERATE,
    DIVERGE,
    VIRIAL,
    BODIES,
    PASSES
};

/* Sums of 80 floats. The roots of slopes are rounded to 15 bits, and one that is half way may round to the other side.
 */
static const double SUM = 3e-6, ROOTS = 1e-4;

static const row rows[PASSES] = {
    [NEIGHBOURS] = {"neighbours", {{"density", SUM}, {"wall", SUM}, {"diagonal", ROOTS}}},
    [STRAIN] = {"strain", {{"deviator_xx", SUM}, {"deviator", SUM}}},
    [STRAINED] = {"strained", {{"strained", SUM}}},
    [DEVIATOR] = {"deviator", {{"deviator_xx", SUM}, {"deviator", SUM}}},
    [MEAN_DEVIATOR] = {"mean_deviator", {{"stress_xx", SUM}, {"stress", SUM}}},
    [CORRECT] = {"correct", {{"corrected", SUM}}},
    [STRAIN_RATE] = {"strain_rate", {{"eddy", SUM}}},
    [FORCES] = {"forces", {{"predicted", SUM}, {"wall_drag", SUM}}},
    [DIFFERENCES] = {"differences", {{"predicted", SUM}}},
    [ACCELERATE] = {"accelerate", {{"acceleration", SUM}}},
    [DIVERGE] = {"diverge", {{"source", SUM}}},
    [VIRIAL] = {"virial", {{"virial", SUM}}},
    [BODIES] = {"bodies", {{"end_velocity", SUM}}},
};

static sb_viscous viscous_of(const sb_sim *sim)
{
    const double h = (double)sim->constant.support / sim->space.quantum;
    return (sb_viscous){.on = true,
                        .artificial = 40,
                        .physical = 0.1f,
                        .eddy = 2.0f * (float)(sim->constant.dimension + 2),
                        .epsilon = (float)(0.01 * h * h),
                        .inverse_quantum = (float)(1 / sim->space.quantum)};
}

static void run(const sb_passes *form, int pass, sb_sim *sim, double *force)
{
    const sb_viscous viscous = viscous_of(sim);
    const sb_wall_drag law = sb_wall_drag_make(sim);
    sb_body_sums sums = {.force = force};
    sb_error error = {0};
    switch (pass) {
    case NEIGHBOURS:
        assert_int_equal(form->neighbours(sim, &error), SB_OK);
        break;
    case STRAIN:
        form->strain(sim);
        break;
    case STRAINED:
        form->strained(sim);
        break;
    case DEVIATOR:
        form->deviator(sim);
        break;
    case MEAN_DEVIATOR:
        form->mean_deviator(sim);
        break;
    case CORRECT:
        assert_int_equal(form->correct(sim), 0);
        memcpy(force, sim->work.stress_force, sim->model->body_count * SB_FORCE_VALUES * sizeof *force);
        break;
    case STRAIN_RATE:
        assert_int_equal(form->strain_rate(sim, &error), SB_OK);
        break;
    case FORCES:
        assert_int_equal(form->forces(sim, &viscous, &law, &error), SB_OK);
        break;
    case DIFFERENCES:
        form->differences(sim, sim->state.velocity, 0.5f, sim->work.predicted);
        break;
    case ACCELERATE:
        form->accelerate(sim);
        break;
    case DIVERGE:
        form->diverge(sim, sim->state.velocity, 0.5f, sim->work.source);
        break;
    case VIRIAL:
        form->virial(sim);
        break;
    default:
        assert_int_equal(form->bodies(sim, &law, &sums), 0);
        break;
    }
}

/* Sets what the pass reads; the same for each form. */
static void set_input(int pass, sb_sim *sim)
{
    const size_t n = sim->state.n;
    if (pass == BODIES) { /* the drag of walls on the water, whose reaction acts on bodies */
        set_input(FORCES, sim);
        run(&sb_passes_reference, FORCES, sim, NULL);
    }
    sb_work *w = &sim->work;
    for (size_t i = 0; i < n; i++) {
        const float a = (float)sb_random(11, i), b = (float)sb_random(12, i) - 0.5f, c = (float)sb_random(13, i) - 0.5f;
        if (pass == DEVIATOR) w->last_unknown[i] = 1e-3f * a;
        if (pass == MEAN_DEVIATOR) w->deviator_xx[i] = b, w->deviator[i] = (sb_f4){c, a, b, c};
        if (pass == CORRECT || pass == STRAINED) w->stress_xx[i] = b, w->stress[i] = (sb_f4){c, a, b, c};
        if (pass == FORCES) w->eddy[i] = 0.01f * a, w->wall_drag[i] = (sb_f4){0};    /* set beside walls only */
        if (pass == FORCES && w->image_push) w->image_push[i] = (sb_f4){a, c, b, 0}; /* its memory becomes wall_drag */
        if (pass == DIFFERENCES) w->predicted[i] = (sb_f4){0};
        if (pass == ACCELERATE || pass == VIRIAL || pass == BODIES) w->unknown[i] = 1e-3f * a;
        if (pass == BODIES) w->end_velocity[i] = sim->state.velocity[i] + (sb_f4){b, 0, c, 0};
    }
    if (pass == DEVIATOR) sb_pressure_load(sim, w->last_unknown);
    if (pass == MEAN_DEVIATOR) sb_refresh(sim, w->deviator), sb_pressure_load(sim, w->deviator_xx);
    if (pass == CORRECT || pass == STRAINED) sb_refresh(sim, w->stress), sb_pressure_load(sim, w->stress_xx);
    if (pass == FORCES) sb_refresh_values(sim, w->eddy), sb_pressure_load(sim, w->density);
    if (pass == ACCELERATE) sb_pressure_load(sim, w->unknown);
}

/* A copy of a view as doubles, without the pressures in the last lanes of velocities. Returns the number of values. */
static size_t copy_view(const sb_sim *sim, const char *name, double *out)
{
    const sb_work_view *view = sb_work_views;
    while (view->name && strcmp(view->name, name) != 0) view++;
    assert_non_null(view->name);
    const float *entries;
    memcpy(&entries, (const char *)&sim->work + view->pointer, sizeof entries);
    assert_non_null(entries);
    const size_t count = sim->state.n * view->size / sizeof(float);
    const bool pressures = view->size == 16 && strcmp(view->unit, "m/s") == 0;
    for (size_t k = 0; k < count; k++) out[k] = pressures && k % 4 == 3 ? 0 : (double)entries[k];
    return count;
}

static void compare_pass(const sb_passes *form, int pass, sb_sim *sim, double *forces[2])
{
    double *values[2];
    for (int k = 0; k < 2; k++) values[k] = sb_alloc(4 * sim->state.n, sizeof(double));
    assert_true(values[0] && values[1]);
    for (const result *r = rows[pass].result; r < rows[pass].result + 4 && r->view; r++) {
        twin_gap gap = {0};
        size_t count = 0;
        for (int k = 0; k < 2; k++) {
            set_input(pass, sim);
            run(k ? form : &sb_passes_reference, pass, sim, forces[k]);
            count = copy_view(sim, r->view, values[k]);
        }
        for (size_t i = 0; i < count; i++) twin_compare(&gap, i, values[1][i], values[0][i]);
        printf("  %s: %.2g of %.3g\n", r->view, twin_relative(&gap), gap.scale);
        assert_true(gap.scale > 0 && twin_relative(&gap) < r->tolerance);
    }
    for (int k = 0; k < 2; k++) sb_free(values[k]);
}

/* Compares the first parts of forces on bodies: pressure, drag, moment. */
static void compare_bodies(const sb_sim *sim, double *forces[2], int parts)
{
    for (int part = 0; part < parts; part++) {
        twin_gap gap = {0};
        for (size_t b = 0; b < sim->model->body_count; b++)
            for (size_t axis = 0; axis < 3; axis++) {
                const size_t v = b * SB_FORCE_VALUES + 3 * (size_t)part + axis;
                twin_compare(&gap, v, forces[1][v], forces[0][v]);
            }
        printf("  forces, part %d: %.2g of %.3g\n", part, twin_relative(&gap), gap.scale);
        assert_true(gap.scale > 0 && twin_relative(&gap) < 3e-6);
    }
}

static void compare_form(const sb_passes *form)
{
    for (int dimensions = 2; dimensions <= 3; dimensions++)
        for (int kind = 0; kind < KINDS; kind++) {
            water w;
            make(&w, dimensions, kind);
            double *forces[2];
            for (int k = 0; k < 2; k++) {
                forces[k] = sb_alloc(w.sim->model->body_count * SB_FORCE_VALUES, sizeof(double));
                assert_non_null(forces[k]);
            }
            /* The reference does not search images. */
            for (int pass = kind < IMAGES ? NEIGHBOURS : STRAIN; pass < PASSES; pass++) {
                printf("%s, %dD%s, %s\n", form->name, dimensions, kinds[kind], rows[pass].name);
                assert_int_equal(tank_prepare(w.sim, 0.01), 0); /* fields share memory */
                compare_pass(form, pass, w.sim, forces);
                if (pass == BODIES) compare_bodies(w.sim, forces, 3);
                if (pass == CORRECT && kind >= IMAGES) compare_bodies(w.sim, forces, 1);
            }
            for (int k = 0; k < 2; k++) sb_free(forces[k]);
            drain(&w);
        }
}

static void vectors_of_32_bytes(void **state)
{
    (void)state;
    compare_form(&sb_passes_cpu);
}

static void vectors_of_64_bytes(void **state)
{
    (void)state;
    if (!sb_passes_cpu_wide()) skip();
    compare_form(sb_passes_cpu_wide());
}

/* A form is a whole column. */
static void all_rows_are_there(void **state)
{
    (void)state;
    const sb_passes *forms[] = {&sb_passes_cpu, &sb_passes_reference, sb_passes_cpu_wide(), sb_passes_choose()};
    for (size_t f = 0; f < sizeof forms / sizeof *forms; f++) {
        const sb_passes *p = forms[f];
        if (!p) continue;
        assert_true(p->name && p->neighbours && p->deviator && p->mean_deviator && p->correct && p->strain_rate &&
                    p->differences && p->forces && p->strain && p->strained);
        assert_true(p->accelerate && p->diverge && p->virial && p->bodies);
    }
    assert_ptr_not_equal(sb_passes_choose(), &sb_passes_reference);
}

/* A run by the reference form alone stays close to one by the usual form. */
static void a_run_by_the_reference(void **state)
{
    (void)state;
    enum { STEPS = 20 };
    double energy[2], time[2];
    for (int k = 0; k < 2; k++) {
        tank t;
        tank_of_particles(&t, 2, 0.1, sb_vec(2, 0, 1.5), 1, 1, 0.05);
        tank_add_terms(&t);
        sb_sim *sim = tank_sim(&t);
        assert_non_null(sim);
        if (k) sim->passes = &sb_passes_reference;
        assert_int_equal(tank_steps(sim, STEPS), 0);
        energy[k] = sb_sim_energy(sim).kinetic;
        time[k] = sb_sim_report(sim)->time;
        sb_sim_destroy(sim);
        tank_free(&t);
    }
    printf("kinetic energy after %d steps: %.9g and %.9g J\n", STEPS, energy[0], energy[1]);
    assert_near(energy[1], energy[0], 1e-4 * energy[0]);
    assert_near(time[1], time[0], 1e-4 * time[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vectors_of_32_bytes),
        cmocka_unit_test(vectors_of_64_bytes),
        cmocka_unit_test(all_rows_are_there),
        cmocka_unit_test(a_run_by_the_reference),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
