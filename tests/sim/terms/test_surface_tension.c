/* The term of surface tension: compared with its definition by brute force, momentum, the tension of a plane, the time
   step, the same bits for any number of threads and after a restart, and no cost when off. */
#include "base/memory.h"
#include "check.h"
#include "sim/drop.h"
#include "sim/terms/surface_tension.h"
#include "sim/twin.h"

#include <omp.h>
#include <stdio.h>

/* Quadratic B-spline, and its binomial means: the weight of a particle t nodes away after `means` means. */
static double weight(double t, int means)
{
    if (means > 0) return 0.25 * (weight(t - 1, means - 1) + 2 * weight(t, means - 1) + weight(t + 1, means - 1));
    t = fabs(t);
    return t < 0.5 ? 0.75 - t * t : t < 1.5 ? 0.5 * (1.5 - t) * (1.5 - t) : 0;
}

/* The definition on a box of nodes around all particles, with positions in node widths. */
typedef struct plain {
    int low[3], size[3], dimension;
    size_t n;
    double (*at)[3];           /* of particles */
    double *phi, *share, *own; /* nodes, nodes, particles */
    double (*force)[3], (*pull)[3];
    double width;
} plain;

static size_t node_of(const plain *p, int x, int y, int z)
{
    return (size_t)(((z - p->low[2]) * p->size[1] + y - p->low[1]) * p->size[0] + x - p->low[0]);
}

static double weight_between(const plain *p, size_t i, int x, int y, int z, int means)
{
    const double flat = p->dimension == 2 ? 1 : weight(p->at[i][1] - y, means);
    return weight(p->at[i][0] - x, means) * flat * weight(p->at[i][2] - z, means);
}

/* Calls for every node. */
#define EACH_NODE(p)                                                                                                   \
    for (int z = (p)->low[2]; z < (p)->low[2] + (p)->size[2]; z++)                                                     \
        for (int y = (p)->low[1]; y < (p)->low[1] + (p)->size[1]; y++)                                                 \
            for (int x = (p)->low[0]; x < (p)->low[0] + (p)->size[0]; x++)

static void place(plain *p, const sb_sim *sim)
{
    enum { BEYOND = 6 };
    p->dimension = sim->constant.dimension;
    p->n = sim->state.n;
    p->width = 0.5 * (double)sim->constant.support;
    p->at = sb_alloc(p->n, sizeof *p->at);
    assert_non_null(p->at);
    for (int axis = 0; axis < 3; axis++) {
        double low = (double)INFINITY, high = -(double)INFINITY;
        for (size_t i = 0; i < p->n; i++) {
            const double at = (double)sim->state.position[i][axis] / ldexp(1, sim->space.shift - 1) - 0.5;
            p->at[i][axis] = at;
            low = fmin(low, at), high = fmax(high, at);
        }
        const bool one = p->dimension == 2 && axis == 1;
        p->low[axis] = one ? 0 : (int)floor(low) - BEYOND;
        p->size[axis] = one ? 1 : (int)ceil(high) + BEYOND + 1 - p->low[axis];
    }
    const size_t nodes = (size_t)p->size[0] * (size_t)p->size[1] * (size_t)p->size[2];
    p->phi = sb_alloc(nodes, sizeof *p->phi);
    p->share = sb_alloc(nodes, sizeof *p->share);
    p->force = sb_alloc(nodes, sizeof *p->force);
    p->own = sb_alloc(p->n, sizeof *p->own);
    p->pull = sb_alloc(p->n, sizeof *p->pull);
    assert_true(p->phi && p->share && p->force && p->own && p->pull);
}

/* |grad phi| 1 - grad phi grad phi/|grad phi| times the width, in the middle of the cell that begins at (x, y, z). */
static void stress(const plain *p, int x, int y, int z, double t[3][3])
{
    const int across = p->dimension == 2 ? 1 : 2;
    double g[3] = {0};
    for (int k = 0; k < 4 * across; k++) {
        const int d[3] = {k & 1, k >> 2, k >> 1 & 1};
        const int at[3] = {x + d[0], y + d[1], z + d[2]};
        bool there = true;
        for (int axis = 0; axis < 3; axis++)
            there = there && at[axis] >= p->low[axis] && at[axis] < p->low[axis] + p->size[axis];
        if (!there) continue;
        for (int axis = 0; axis < 3; axis++)
            if (across == 2 || axis != 1)
                g[axis] += (d[axis] ? 1 : -1) * p->phi[node_of(p, at[0], at[1], at[2])] / (2 * across);
    }
    const double square = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) t[a][b] = ((a == b) * square - g[a] * g[b]) / sqrt(square + 0.005 * 0.005);
}

static void find(plain *p, const sb_sim *sim)
{
    const double volume = pow((double)sim->constant.spacing / p->width, p->dimension);
    const int across = p->dimension == 2 ? 1 : 2;
    EACH_NODE(p)
    for (size_t i = 0; i < p->n; i++) p->phi[node_of(p, x, y, z)] += volume * weight_between(p, i, x, y, z, 1);
    for (size_t i = 0; i < p->n; i++) {
        double phi = 0;
        EACH_NODE(p) phi += weight_between(p, i, x, y, z, 0) * p->phi[node_of(p, x, y, z)];
        p->own[i] = pow(fmax(1 - phi, 0) + 0.001, 2);
    }
    EACH_NODE(p)
    for (size_t i = 0; i < p->n; i++)
        p->share[node_of(p, x, y, z)] += volume * p->own[i] * weight_between(p, i, x, y, z, 2);
    EACH_NODE(p)
    {
        const size_t node = node_of(p, x, y, z);
        for (int k = 0; k < 4 * across && p->share[node] > 0; k++) {
            const int d[3] = {k & 1, k >> 2, k >> 1 & 1};
            double t[3][3];
            stress(p, x - 1 + d[0], across == 1 ? y : y - 1 + d[1], z - 1 + d[2], t);
            for (int a = 0; a < 3; a++)
                for (int b = 0; b < 3; b++)
                    if (across == 2 || b != 1) p->force[node][a] += (d[b] ? 1 : -1) * t[a][b] / (2 * across);
        }
    }
    const double unit = (double)sim->constant.surface_tension /
                        ((double)sim->constant.rest_density * p->width * p->width * sb_tension_of_plane());
    EACH_NODE(p)
    for (size_t i = 0; i < p->n; i++) {
        const size_t node = node_of(p, x, y, z);
        const double part = unit * p->own[i] * weight_between(p, i, x, y, z, 2);
        for (int a = 0; a < 3 && part > 0; a++) p->pull[i][a] += part * p->force[node][a] / p->share[node];
    }
}

static void forget(plain *p)
{
    sb_free(p->at);
    sb_free(p->phi);
    sb_free(p->share);
    sb_free(p->own);
    sb_free(p->force);
    sb_free(p->pull);
}

/* The stage is its definition; its forces sum to 0, in the definition to the rounding of double precision. */
static void a_drop_is_the_reference(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        drop d;
        sb_error error = {0};
        drop_make(&d, &(drop_form){dimensions, dimensions == 2 ? 0.12 : 0.25, 1.3, true, 0});
        assert_non_null(d.sim);
        assert_int_equal(tank_prepare_source(d.sim, 0.5), 0);
        assert_int_equal(sb_stage_surface_tension(d.sim, &error), SB_OK);
        plain p = {.n = 0};
        place(&p, d.sim);
        find(&p, d.sim);
        twin_gap gap = {0};
        double fast[3] = {0}, plain_sum[3] = {0}, all = 0;
        for (size_t i = 0; i < p.n; i++)
            for (int a = 0; a < 3; a++) {
                if (dimensions == 2 && a == 1) continue;
                twin_compare(&gap, i, (double)d.sim->work.pull[i][a], p.pull[i][a]);
                fast[a] += (double)d.sim->work.pull[i][a];
                plain_sum[a] += p.pull[i][a];
                all += fabs(p.pull[i][a]);
            }
        printf("%dD, %zu particles: %.2g of %.3g m/s^2; momentum %.2g and %.2g of sum |a|\n", dimensions, p.n,
               twin_relative(&gap), gap.scale, sb_norm(sb_vec(plain_sum[0], plain_sum[1], plain_sum[2])) / all,
               sb_norm(sb_vec(fast[0], fast[1], fast[2])) / all);
        assert_true(gap.scale > 1 && twin_relative(&gap) < 1e-6);
        assert_true(sb_norm(sb_vec(plain_sum[0], plain_sum[1], plain_sum[2])) < 1e-13 * all);
        assert_true(sb_norm(sb_vec(fast[0], fast[1], fast[2])) < 1e-8 * all);
        forget(&p);
        drop_free(&d);
    }
}

/* A plane stretched by sigma: what is left out as noise is below 2 %, and made up for. */
static void a_plane_has_the_tension(void **state)
{
    (void)state;
    const double plane = sb_tension_of_plane();
    printf("tension of a plane %.5f\n", plane);
    assert_true(plane > 0.98 && plane < 1);
}

/* sqrt(rho dr^3/(4 pi sigma)), by hand for the drop's sizes. */
static void the_step_is_short_enough(void **state)
{
    (void)state;
    drop d;
    drop_make(&d, &(drop_form){2, 0.1, 1, false, 0});
    assert_int_equal(tank_steps(d.sim, 1), 0);
    assert_near(d.sim->state.time_step, 0.0126157, 1e-6);
    drop_free(&d);
}

static uint64_t hash_after(const drop_form *form, int threads, int steps)
{
    drop d;
    omp_set_num_threads(threads);
    drop_make(&d, form);
    assert_int_equal(tank_steps(d.sim, steps), 0);
    const uint64_t hash = sb_sim_hash(d.sim);
    drop_free(&d);
    return hash;
}

static void the_same_bits(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        const drop_form form = {dimensions, dimensions == 2 ? 0.1 : 0.2, 1.2, false, 0};
        const uint64_t one = hash_after(&form, 1, 6);
        assert_true(hash_after(&form, 3, 6) == one);
        drop d, again;
        sb_archive_out out = {0};
        sb_error error = {0};
        drop_make(&d, &form);
        drop_make(&again, &form);
        assert_int_equal(tank_steps(d.sim, 3), 0);
        tank_shuffle(d.sim, 5);
        tank_save(d.sim, &out);
        assert_int_equal(tank_load(again.sim, &out, &error), SB_OK);
        assert_int_equal(tank_steps(again.sim, 3), 0);
        assert_true(sb_sim_hash(again.sim) == one);
        assert_true(sb_sim_ledger(again.sim)->tension > 0);
        sb_free(out.bytes);
        drop_free(&d);
        drop_free(&again);
    }
}

/* The ledger's entries sum to the change of energy. */
static void the_ledger_adds_up(void **state)
{
    (void)state;
    drop d;
    drop_make(&d, &(drop_form){2, 0.1, 1.3, false, 0.05});
    assert_int_equal(tank_steps(d.sim, 40), 0);
    const sb_ledger *l = sb_sim_ledger(d.sim);
    const double sum = l->viscosity + l->pressure + l->contact + l->integration + l->stress + l->tension;
    const double kinetic = sb_sim_energy(d.sim).kinetic;
    printf("kinetic energy %.6g J/m, entries %.6g, of surface tension %.6g\n", kinetic, sum, l->tension);
    assert_true(kinetic > 1 && l->tension > kinetic);
    assert_near(sum, kinetic, 1e-5 * kinetic);
    drop_free(&d);
}

static void it_costs_nothing_when_off(void **state)
{
    (void)state;
    for (int on = 0; on < 2; on++) {
        tank t;
        tank_make(&t, 2, 0.1, sb_vec(1, 0, 1), 0.5, 0.5, 0.1);
        t.scene.fluid.surface_tension = on;
        sb_sim *sim = tank_sim(&t);
        assert_non_null(sim);
        assert_int_equal(tank_steps(sim, 2), 0);
        assert_true(tank_has_stage(sim, "surface_tension") == on && tank_skips(sim, "surface tension") == !on);
        assert_true((sim->work.pull != NULL) == on && (sim->work.node != NULL) == on);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_drop_is_the_reference),  cmocka_unit_test(a_plane_has_the_tension),
        cmocka_unit_test(the_step_is_short_enough), cmocka_unit_test(the_same_bits),
        cmocka_unit_test(the_ledger_adds_up),       cmocka_unit_test(it_costs_nothing_when_off),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
