/* Periodic sides compared with the reference, which sums over all images, and with the same scene, shifted. */
#include "base/memory.h"
#include "base/random.h"
#include "sim/presets.h"
#include "sim/pressure/pressure.h"
#include "sim/step/stages.h"
#include "sim/twin.h"

#include <stdio.h>
#include <string.h>

typedef struct setup {
    tank tank;
    sb_sim *sim;
    twin twin;
    size_t n;
    double *rho, *x, *product, *source; /* n each */
    sb_vec3 *acceleration;
} setup;

static void allocate(setup *s)
{
    s->n = s->sim->state.n;
    double **fields[] = {&s->rho, &s->x, &s->product, &s->source};
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++) {
        *fields[f] = sb_alloc(s->n, sizeof(double));
        assert_non_null(*fields[f]);
    }
    s->acceleration = sb_alloc(s->n, sizeof *s->acceleration);
    assert_non_null(s->acceleration);
}

/* Water scattered through a tank with a static plate beside the side in x, and a moving paddle if only y is periodic.
   Lengths are no multiples of the spacing. */
static void begin(setup *s, sb_preset preset, int dimensions, bool x, bool y, sb_vec3 size)
{
    const sb_wavemaker_parameters law = {
        .kind = sb_wavemaker_find("stroke"), .stroke = 0.5, .speed = 0.8, .gravity = 9.81};
    *s = (setup){0};
    tank_of_particles(&s->tank, dimensions, 0.1, size, size.x, 0.8 * size.z, 0);
    tank_use(&s->tank, preset);
    if (x) tank_repeat(&s->tank, 0);
    if (y) tank_repeat(&s->tank, 1);
    tank_scatter(&s->tank, 5, 1);
    tank_add_plate(&s->tank, "sill", 0.04, 0, 0.5, sb_vec(0, 0, 0), NULL);
    if (!x) tank_add_plate(&s->tank, "paddle", 0.3, 0, 0.7, sb_vec(1, 0, 0), &law);
    s->tank.scene.numerics.artificial_viscosity = 0.5;
    s->tank.scene.numerics.wall_friction = 1;
    s->tank.scene.fluid.viscosity = 0;
    s->sim = tank_sim(&s->tank);
    assert_non_null(s->sim);
    s->sim->state.time = 0.4;
    assert_int_equal(tank_prepare(s->sim, 1), 0);
    assert_int_equal(s->sim->state.n, s->tank.model.fluid_count);
    assert_int_equal(twin_make(s->sim, &s->twin), 0);
    assert_int_equal(s->twin.reference.cloud.wall_count, s->tank.model.wall_count);
    allocate(s);
}

static void end(setup *s)
{
    sb_free(s->rho);
    sb_free(s->x);
    sb_free(s->product);
    sb_free(s->source);
    sb_free(s->acceleration);
    twin_free(&s->twin);
    sb_sim_destroy(s->sim);
    tank_free(&s->tank);
}

static size_t pairs_listed(const sb_sim *sim, bool walls)
{
    size_t count = 0;
    for (size_t i = 0; i < sim->state.n; i++)
        for (size_t k = 0; k < twin_listed(sim, i, walls); k++) count += !twin_list(sim, i, walls, k).padding;
    return count;
}

static void check_sums(setup *s)
{
    const sb_reference *r = &s->twin.reference;
    const sb_sim *sim = s->sim;
    size_t pairs = pairs_listed(sim, false), walls = pairs_listed(sim, true);
    twin_gap density = {0}, vector = {0}, flux = {0};
    double diagonal = 0;
    sb_reference_density(r, s->rho);
    sb_reference_diagonal(r, s->product);
    for (size_t i = 0; i < s->n; i++) {
        sb_vec3 b = {0, 0, 0};
        double flow = 0;
        for (size_t k = r->wall_start[i]; k < r->wall_start[i + 1]; k++) {
            const sb_reference_pair *pair = &r->wall[k];
            b = sb_madd(b, s->twin.psi[pair->other], pair->gradient);
            flow += s->twin.psi[pair->other] * sb_dot(s->twin.wall_velocity[pair->other], pair->gradient);
        }
        twin_compare(&density, i, (double)sim->work.density[i], s->rho[i]);
        twin_compare(&vector, i, (double)sim->work.wall[i][0], b.x);
        twin_compare(&vector, i, (double)sim->work.wall[i][1], b.y);
        twin_compare(&vector, i, (double)sim->work.wall[i][2], b.z);
        twin_compare(&flux, i, (double)sim->work.wall[i][3], flow);
        if (sim->work.diagonal[i] > 0)
            diagonal = fmax(diagonal, fabs((double)sim->work.diagonal[i] / -s->product[i] - 1));
    }
    printf("%zu particles, %zu ghosts, %zu pairs, %zu with walls; density %.2g, B %.2g, flux %.2g, "
           "diagonal %.2g\n",
           s->n, sim->ghosts.count, pairs, walls, twin_relative(&density), twin_relative(&vector), twin_relative(&flux),
           diagonal);
    /* Except for pairs at the support radius. */
    assert_near((double)pairs, (double)r->fluid_start[s->n], 4);
    assert_near((double)walls, (double)r->wall_start[s->n], 4);
    assert_true(sim->ghosts.count > 0 && pairs > 5 * s->n && walls > 0);
    assert_true(flux.scale > 0 || sim->walls.moving_count == 0);
    assert_true(twin_relative(&density) < 1e-6 && twin_relative(&vector) < 1e-6);
    assert_true(twin_relative(&flux) < 1e-6 && diagonal < 1e-5);
}

/* psi_b includes images beyond the periodic sides. */
static void check_volumes(const setup *s)
{
    const twin *t = &s->twin;
    sb_reference_cloud set = t->reference.cloud;
    size_t all = set.wall_count;
    double gamma = twin_gamma(s->sim), worst = 0;
    const bool curved = s->sim->needs.images;
    double *psi = sb_alloc(all, sizeof *psi);
    assert_non_null(psi);
    set.wall_count = t->static_count;
    sb_reference_psi(&set, gamma, curved, psi);
    set.wall_count = all - t->static_count;
    set.wall_position += t->static_count;
    set.wall_normal += t->static_count;
    sb_reference_psi(&set, gamma, curved, psi + t->static_count);
    for (size_t b = 0; b < all; b++) worst = fmax(worst, fabs(t->psi[b] / psi[b] - 1));
    assert_true(worst < 1e-6);
    sb_free(psi);
}

/* Viscosity and wall friction, and the source that results from the velocities. */
static void check_forces(setup *s)
{
    sb_error error = {0};
    sb_sim *sim = s->sim;
    memset(s->acceleration, 0, s->n * sizeof *s->acceleration);
    sb_reference_viscosity(&s->twin.reference, s->rho, s->acceleration);
    sb_reference_friction(&s->twin.reference, s->rho, s->acceleration, NULL, NULL, NULL);
    assert_int_equal(sb_stage_forces(sim, &error), SB_OK);
    twin_gap push = {0}, source = {0};
    for (size_t i = 0; i < s->n; i++) {
        sb_vec3 v = s->twin.velocity[i], a = s->acceleration[i];
        sb_vec3 expected = sb_add(v, sb_add(a, sb_vec(0, 0, -9.81)));
        twin_compare(&push, i, (double)sim->work.predicted[i][0] - v.x, a.x);
        twin_compare(&push, i, (double)sim->work.predicted[i][1] - v.y, a.y);
        twin_compare(&push, i, (double)sim->work.predicted[i][2] - v.z, a.z - 9.81);
        s->twin.velocity[i] = expected;
    }
    assert_int_equal(sb_stage_source(sim, &error), SB_OK);
    sb_reference_source(&s->twin.reference, s->rho, s->twin.velocity, sim->scene->numerics.source_relaxation,
                        s->source);
    for (size_t i = 0; i < s->n; i++) twin_compare(&source, i, (double)sim->work.source[i], s->source[i]);
    printf("  forces %.2g, source %.2g\n", twin_relative(&push), twin_relative(&source));
    double above = 0, worst = 0;
    const double rest = (double)sim->constant.rest_density;
    for (size_t i = 0; i < s->n; i++) {
        above += fmax(s->rho[i] - rest, 0) / ((double)s->n * rest);
        worst = fmax(worst, (s->rho[i] - rest) / rest);
    }
    assert_near(sim->report.compression, above, 1e-6);
    assert_near(sim->report.compression_max, worst, 1e-6);
    assert_true(twin_relative(&push) < 1e-6 && twin_relative(&source) < 2e-6);
}

static void check_operator(setup *s)
{
    float *argument = sb_alloc(s->n, sizeof *argument), *fast = sb_alloc(s->n, sizeof *fast);
    assert_true(argument && fast);
    for (size_t i = 0; i < s->n; i++) {
        argument[i] = (float)sb_random(1, i);
        s->x[i] = (double)argument[i];
    }
    sb_reference_apply(&s->twin.reference, s->x, s->acceleration, s->product);
    sb_pressure_load(s->sim, argument);
    sb_pressure_product(s->sim, fast);
    twin_gap push = {0}, product = {0};
    for (size_t i = 0; i < s->n; i++) {
        sb_f4 a = s->sim->work.acceleration[i];
        twin_compare(&push, i, (double)a[0], s->acceleration[i].x);
        twin_compare(&push, i, (double)a[1], s->acceleration[i].y);
        twin_compare(&push, i, (double)a[2], s->acceleration[i].z);
        twin_compare(&product, i, (double)fast[i], s->product[i]);
    }
    printf("  G q %.2g, A q %.2g\n", twin_relative(&push), twin_relative(&product));
    assert_true(twin_relative(&push) < 1e-6 && twin_relative(&product) < 1e-6);
    sb_free(argument);
    sb_free(fast);
}

static void check(sb_preset preset, int dimensions, bool x, bool y, sb_vec3 size)
{
    setup s;
    begin(&s, preset, dimensions, x, y, size);
    printf("%dD, periodic in%s%s, %g x %g m: ", dimensions, x ? " x" : "", y ? " y" : "", size.x, size.y);
    check_sums(&s);
    check_volumes(&s);
    check_forces(&s);
    check_operator(&s);
    end(&s);
}

/* Down to a domain of one support radius, in which two particles interact through both sides. */
static void a_cloud_meets_its_images(void **state)
{
    const sb_preset preset = preset_of(state);
    check(preset, 2, true, false, sb_vec(2.037, 0, 1.5));
    check(preset, 2, true, false, sb_vec(0.326, 0, 1.5));
    check(preset, 3, true, false, sb_vec(1.237, 0.8, 0.8));
    check(preset, 3, false, true, sb_vec(1.2, 0.671, 0.8));
    check(preset, 3, false, true, sb_vec(1.2, 0.4, 0.8));
    check(preset, 3, false, true, sb_vec(1.2, 0.365, 0.8));
    check(preset, 3, true, true, sb_vec(1.013, 0.671, 0.8));
    check(preset, 3, true, true, sb_vec(0.345, 0.275, 0.8));
}

/* Fields by particle id after one solve with a fixed number of iterations. */
typedef struct outcome {
    size_t n;
    double *density, *pressure, *speed[3];
    sb_body_impulse impulse;
} outcome;

static outcome solve_once(const tank *t)
{
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    outcome o = {.n = sim->state.n};
    double **fields[] = {&o.density, &o.pressure, &o.speed[0], &o.speed[1], &o.speed[2]};
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++) {
        *fields[f] = sb_alloc(o.n, sizeof(double));
        assert_non_null(*fields[f]);
    }
    assert_int_equal(tank_steps(sim, 1), 0);
    assert_int_equal(sb_sim_report(sim)->iterations, t->scene.numerics.max_iterations);
    for (size_t i = 0; i < o.n; i++) {
        uint32_t id = sim->state.id[i];
        o.density[id] = (double)sim->work.density[i];
        o.pressure[id] = (double)sim->state.velocity[i][3];
        for (int axis = 0; axis < 3; axis++) o.speed[axis][id] = (double)sim->state.velocity[i][axis];
    }
    o.impulse = *sb_sim_impulse(sim, 0);
    sb_sim_destroy(sim);
    return o;
}

static void outcome_free(outcome *o)
{
    sb_free(o->density);
    sb_free(o->pressure);
    for (int axis = 0; axis < 3; axis++) sb_free(o->speed[axis]);
}

static double gap_between(const double *a, const double *b, size_t n)
{
    twin_gap gap = {0};
    for (size_t i = 0; i < n; i++) twin_compare(&gap, i, a[i], b[i]);
    assert_true(gap.scale > 0);
    return twin_relative(&gap);
}

static void make_rolled(tank *t, sb_preset preset, int dimensions, bool x, bool y, sb_vec3 size)
{
    tank_make(t, dimensions, 0.1, size, size.x, 0.7, 0.2);
    tank_use(t, preset);
    if (x) tank_repeat(t, 0);
    if (y) tank_repeat(t, 1);
    t->scene.numerics.stress_correction = 0; /* its means depend on the place of the cells */
}

/* The position of periodic sides is arbitrary: the shifted scene has the same densities, pressures, velocities and
   forces on static bodies. Periods and shifts are whole quanta, so that all offsets keep their bits. A difference of
   one quantum could round a stored slope differently. */
static void check_rolled(sb_preset preset, int dimensions, bool x, bool y, sb_vec3 size)
{
    tank t;
    make_rolled(&t, preset, dimensions, x, y, size);
    size = tank_whole_quanta(&t, size);
    tank_free(&t);
    make_rolled(&t, preset, dimensions, x, y, size);
    t.scene.numerics.tolerance_rule = SB_TOLERANCE_DENSITY;
    t.scene.numerics.tolerance = 1e-30;
    t.scene.numerics.max_iterations = 25;
    t.scene.numerics.wall_friction = 0.1;
    sb_model *m = &t.model;
    for (size_t i = 0; i < m->fluid_count; i++)
        m->fluid_velocity[i] = sb_vec(2 * sb_random(3, 3 * i) - 1,
                                      dimensions == 2 ? 0 : 2 * sb_random(3, 3 * i + 1) - 1, -sb_random(3, 3 * i + 2));
    outcome still = solve_once(&t);
    for (uint64_t k = 0; k < 5; k++) {
        tank_roll(&t, tank_whole_quanta(&t, sb_vec(size.x * sb_random(k, 0), size.y * sb_random(k, 1), 0)));
        outcome moved = solve_once(&t);
        assert_int_equal(moved.n, still.n);
        double density = gap_between(moved.density, still.density, still.n);
        double pressure = gap_between(moved.pressure, still.pressure, still.n), speed = 0;
        for (int axis = 0; axis < 3; axis += 3 - dimensions + 1)
            speed = fmax(speed, gap_between(moved.speed[axis], still.speed[axis], still.n));
        double push = sb_norm(sb_sub(moved.impulse.pressure, still.impulse.pressure)) / sb_norm(still.impulse.pressure);
        double drag = sb_norm(sb_sub(moved.impulse.friction, still.impulse.friction)) / sb_norm(still.impulse.friction);
        printf("%dD rolled: density %.2g, pressure %.2g, velocity %.2g, push %.2g, drag %.2g\n", dimensions, density,
               pressure, speed, push, drag);
        assert_true(density < 1e-6 && pressure < 2e-5 && speed < 2e-5);
        assert_true(push < 1e-5 && drag < 1e-5);
        outcome_free(&moved);
    }
    outcome_free(&still);
    tank_free(&t);
}

static void sides_may_be_anywhere(void **state)
{
    const sb_preset preset = preset_of(state);
    check_rolled(preset, 2, true, false, sb_vec(2, 0, 1.2));
    check_rolled(preset, 3, false, true, sb_vec(1.2, 0.4, 1.2));
    check_rolled(preset, 3, true, true, sb_vec(0.8, 0.4, 1.2));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        in_both_presets(a_cloud_meets_its_images),
        in_both_presets(sides_may_be_anywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
