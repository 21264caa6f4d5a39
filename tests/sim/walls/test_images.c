/* Walls that reflect water: the operator, the rate of the density, and momentum. */
#include "base/memory.h"
#include "base/random.h"
#include "check.h"
#include "sim/passes/passes.h"
#include "sim/pressure/pressure.h"
#include "sim/step/stages.h"
#include "sim/walls/basin.h"

#include <omp.h>
#include <stdio.h>
#include <string.h>

/* A block on the floor, a plate of one spacing beside it, and water that stands higher at one end. */
static void fill_stirred(basin *b, int dimensions, const char *density)
{
    if (dimensions == 2)
        basin_fill(b, 2, "0.05", "[2, 1.2]",
                   "{boxes: [{min: [0, 0], max: [2, 0.5]}, {min: [0, 0.5], max: [0.6, 0.8]}]}",
                   "[{name: block, shape: box, min: [0.9, 0], max: [1.2, 0.3]},"
                   " {name: slab, shape: box, min: [1.5, 0.2], max: [1.8, 0.27]}]",
                   density);
    else
        basin_fill(b, 3, "0.1", "[1.6, 1, 1.2]",
                   "{boxes: [{min: [0, 0, 0], max: [1.6, 1, 0.5]}, {min: [0, 0, 0.5], max: [0.5, 1, 0.9]}]}",
                   "[{name: block, shape: box, min: [0.8, 0.3, 0], max: [1.1, 0.7, 0.4]},"
                   " {name: tower, shape: box, min: [1.3, 0.4, 0], max: [1.5, 0.6, 1]}]",
                   density);
    basin_settle(b);
    assert_int_equal(tank_steps(b->sim, 10), 0);
}

static double dot(const float *a, const float *b, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++) sum += (double)a[i] * (double)b[i];
    return sum;
}

static void product(sb_sim *sim, const float *argument, float *out)
{
    sb_pressure_load(sim, argument);
    sb_pressure_product(sim, out);
}

/* x.Ay = y.Ax, x.Ax < 0, and (A e_i)_i is the stored diagonal. */
static void the_operator_is_symmetric(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        basin b;
        fill_stirred(&b, dimensions, "completed");
        sb_sim *sim = b.sim;
        assert_int_equal(tank_prepare_source(sim, sim->state.time_step), 0);
        const size_t n = sim->state.n;
        float *x = sb_alloc(n, sizeof *x), *y = sb_alloc(n, sizeof *y), *ax = sb_alloc(n, sizeof *ax),
              *ay = sb_alloc(n, sizeof *ay);
        assert_true(x && y && ax && ay);
        for (size_t i = 0; i < n; i++) {
            x[i] = (float)sb_random(1, i);
            y[i] = (float)sb_random(2, i);
        }
        product(sim, x, ax);
        product(sim, y, ay);
        const double xay = dot(x, ay, n), yax = dot(y, ax, n), size = sqrt(dot(x, x, n) * dot(ay, ay, n));
        printf("%dD, %zu particles, %zu images, %zu pairs at edges: x.Ay and y.Ax differ by %.2g of |x||Ay|\n",
               dimensions, n, sim->groups.images_used, sim->work.edge_pairs.used, fabs(xay - yax) / size);
        assert_true(sim->work.edge_pairs.used > 100);
        assert_true(fabs(xay - yax) < 1e-6 * size);
        assert_true(dot(x, ax, n) < 0);
        const double dt2 = sim->state.time_step * sim->state.time_step;
        double worst = 0;
        memset(x, 0, n * sizeof *x);
        for (size_t i = 0; i < n; i += 7) {
            if (sim->work.diagonal[i] == 0) continue;
            x[i] = 1;
            product(sim, x, ax);
            x[i] = 0;
            worst = fmax(worst, fabs((double)ax[i] / (-(double)sim->work.diagonal[i] * dt2) - 1));
        }
        printf("diagonal: probed against stored %.2g of each\n", worst);
        assert_true(worst < 1e-3);
        sb_free(x);
        sb_free(y);
        sb_free(ax);
        sb_free(ay);
        basin_free(&b);
    }
}

/* Density sums after all particles have moved by `share` of their ways, by id. */
static void densities(basin *b, const sb_record *at, const sb_f4 *way, int share, double *out)
{
    sb_sim *sim = b->sim;
    for (size_t i = 0; i < sim->state.n; i++) {
        const uint32_t id = sim->state.id[i];
        for (int axis = 0; axis < 3; axis++)
            sim->state.position[i][axis] = at[id][axis] + (uint32_t)(share * (int32_t)way[id][axis]);
    }
    assert_int_equal(tank_prepare(sim, sim->state.time_step), 0);
    for (size_t i = 0; i < sim->state.n; i++) out[sim->state.id[i]] = (double)sim->work.density[i];
}

/* The divergence is the rate of the density sum, also round convex edges: compared with the sums at positions a step
   before and after. */
static void the_divergence_is_the_rate_of_the_density(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        basin b;
        fill_stirred(&b, dimensions, "summed");
        sb_sim *sim = b.sim;
        assert_int_equal(tank_prepare(sim, sim->state.time_step), 0);
        const size_t n = sim->state.n;
        float *divergence = sb_alloc(n, sizeof *divergence);
        double *rate = sb_alloc(n, sizeof *rate), *before = sb_alloc(n, sizeof *before),
               *after = sb_alloc(n, sizeof *after);
        sb_record *at = sb_alloc(n, sizeof *at);
        sb_f4 *way = sb_alloc(n, sizeof *way);
        assert_true(divergence && rate && before && after && at && way);
        const double size = floor(2e-3 * b.model.spacing / sim->space.quantum);
        for (size_t i = 0; i < n; i++) {
            const uint32_t id = sim->state.id[i];
            at[id] = sim->state.position[i];
            sim->work.predicted[i] = way[id] = basin_way(sim, sb_space_position(&sim->space, at[id]), id, size);
        }
        sim->passes->diverge(sim, sim->work.predicted, (float)sim->space.quantum, divergence);
        for (size_t i = 0; i < n; i++) rate[sim->state.id[i]] = (double)divergence[i];
        densities(&b, at, way, -1, before);
        densities(&b, at, way, 1, after);
        double worst = 0, largest = 0;
        for (size_t i = 0; i < n; i++) {
            worst = fmax(worst, fabs(0.5 * (after[i] - before[i]) - rate[i]));
            largest = fmax(largest, fabs(rate[i]));
        }
        printf("%dD: the change of the density differs by %.2g of the largest, %.2g kg/m^3\n", dimensions,
               worst / largest, largest);
        assert_true(largest > 1);
        assert_true(worst < 0.02 * largest);
        sb_free(divergence);
        sb_free(rate);
        sb_free(before);
        sb_free(after);
        sb_free(at);
        sb_free(way);
        basin_free(&b);
    }
}

/* Momenta of water and bodies balance; no particle leaves; the state is the same for any number of threads, and after
   it was saved and loaded. */
static void water_in_motion(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        uint64_t hash[2];
        const int threads = omp_get_max_threads();
        for (int run = 0; run < 2; run++) {
            basin b;
            omp_set_num_threads(run == 0 ? 1 : 3);
            fill_stirred(&b, dimensions, "completed");
            double worst = 0;
            for (int k = 0; k < 40; k++) {
                assert_int_equal(tank_steps(b.sim, 1), 0);
                worst = fmax(worst, sb_sim_report(b.sim)->momentum_imbalance);
            }
            hash[run] = sb_sim_hash(b.sim);
            printf("%dD: momentum within %.2g of sum |m a| dt\n", dimensions, worst);
            assert_true(worst < 5e-6);
            assert_int_equal(b.sim->state.n, b.model.fluid_count);
            sb_archive_out out = {0};
            tank_save(b.sim, &out);
            assert_int_equal(tank_steps(b.sim, 5), 0);
            const uint64_t later = sb_sim_hash(b.sim);
            sb_error error = {0};
            assert_int_equal(tank_load(b.sim, &out, &error), SB_OK);
            assert_int_equal(tank_steps(b.sim, 5), 0);
            assert_true(sb_sim_hash(b.sim) == later);
            sb_archive_out_free(&out);
            basin_free(&b);
        }
        omp_set_num_threads(threads);
        assert_true(hash[0] == hash[1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_operator_is_symmetric),
        cmocka_unit_test(the_divergence_is_the_rate_of_the_density),
        cmocka_unit_test(water_in_motion),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
