/* Walls that reflect water, with surfaces of facets finer than the spacing: still water rests round a thin cylinder,
   and over fine and rough grids as over coarse ones. */
#include "base/random.h"
#include "check.h"
#include "sim/walls/basin.h"

#include <math.h>
#include <stdio.h>
#include <unistd.h>

/* Water 3 or more spacings deep over `bodies`, settled for at most `settle` steps. */
static void fill(basin *b, const char *max, const char *water, const char *bodies, const char *settle)
{
    const sb_override set[] = {{"resolution", "0.1"},
                               {"domain.max", max},
                               {"water", water},
                               {"bodies", bodies},
                               {"numerics.settle_steps", settle}};
    basin_build(b, set, sizeof set / sizeof *set);
    basin_start(b);
    basin_settle(b);
}

/* ---- a cylinder ---- */

/* Radius 1.5 spacings, in water 4 spacings deep: neither a force nor a gap in the density. */
static void a_thin_cylinder_in_still_water(void **state)
{
    (void)state;
    basin b;
    fill(&b, "[1.1, 0.9, 0.9]", "{level: 0.4, seed: [0.1, 0.1, 0.1]}",
         "[{name: pillar, shape: cylinder, center: [0.55, 0.45, -0.1], radius: 0.15, height: 1}]", "500");
    assert_int_equal(tank_steps(b.sim, 100), 0);
    const double face = 0.5 * 9810 * 0.4 * 0.4 * 0.3;
    const sb_vec3 f = sb_scale(sb_sim_impulse(b.sim, 0)->pressure, 1 / sb_sim_report(b.sim)->time);
    double beside = 0, all = 0, highest = 0;
    size_t besides = 0, alls = 0;
    for (size_t i = 0; i < b.sim->state.n; i++) {
        const sb_vec3 at = sb_space_position(&b.sim->space, b.sim->state.position[i]);
        highest = fmax(highest, at.z);
        if (at.z > 0.2) continue; /* below the surface's influence */
        const bool near = hypot(at.x - 0.55, at.y - 0.45) < 0.15 + 0.1;
        beside += near ? (double)b.sim->work.density[i] : 0, besides += near;
        all += (double)b.sim->work.density[i], alls++;
    }
    const double ratio = beside / (double)besides * (double)alls / all;
    printf("force %.2g, %.2g of a face's load; density beside the pillar %.4g of all; top row at %.3g of 0.35 m\n",
           f.x / face, f.y / face, ratio, highest);
    assert_true(fabs(f.x) < 0.01 * face && fabs(f.y) < 0.01 * face);
    assert_true(besides > 10 && fabs(ratio - 1) < 0.02);
    assert_true(fabs(highest - 0.35) < 0.05);
    basin_free(&b);
}

/* ---- beds ---- */

/* A slope of 3 to 20 as a grid of cells of one spacing or a quarter, level or with heights at random. */
static void write_bed(const char *path, double cell, double high)
{
    const int columns = (int)lround(1.6 / cell) + 1, rows = (int)lround(0.8 / cell) + 1;
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "ncols %d\nnrows %d\nxllcorner -0.2\nyllcorner -0.2\ncellsize %g\n", columns, rows, cell);
    for (int j = 0; j < rows; j++)
        for (int i = 0; i < columns; i++)
            fprintf(file, "%g%c", 0.15 * (i * cell - 0.2) + high * (sb_random(7, (uint64_t)(1000 * j + i)) - 0.5),
                    i + 1 < columns ? ' ' : '\n');
    assert_int_equal(fclose(file), 0);
}

/* What rests over a bed: mean square of the speed over gD, and the mean height. */
typedef struct rest {
    double motion, height;
    size_t facets;
} rest;

static rest rest_over(double cell, double high)
{
    char path[256], bodies[512];
    basin b;
    snprintf(path, sizeof path, "%s/images-bed-%d.asc", SB_BINARY_DIR, (int)getpid());
    write_bed(path, cell, high);
    snprintf(bodies, sizeof bodies, "[{name: bed, shape: grid, role: terrain, file: %s}]", path);
    fill(&b, "[1.2, 0.4, 0.9]", "{level: 0.5, seed: [0.1, 0.2, 0.3]}", bodies, "100");
    remove(path);
    assert_int_equal(tank_steps(b.sim, 30), 0);
    rest r = {.facets = b.model.facets.count};
    for (size_t i = 0; i < b.sim->state.n; i++) {
        const sb_f4 v = b.sim->state.velocity[i];
        r.motion += (double)sb_sum3(v * v) / (double)b.sim->state.n / (9.81 * 0.5);
        r.height += sb_space_position(&b.sim->space, b.sim->state.position[i]).z / (double)b.sim->state.n;
    }
    printf("cells of %g m, %g m rough: %zu facets, speed %.2g of sqrt(gD), mean height %.4g m of %zu particles\n", cell,
           high, r.facets, sqrt(r.motion), r.height, b.sim->state.n);
    basin_free(&b);
    return r;
}

static void fine_beds_rest_as_coarse_ones(void **state)
{
    (void)state;
    const rest coarse = rest_over(0.1, 0), fine = rest_over(0.025, 0), rough = rest_over(0.025, 0.008);
    assert_true(fine.facets < 2 * coarse.facets + 20);
    /* What remains after settling is the basin's slowest oscillation. */
    assert_true(sqrt(fine.motion) < 0.05 && sqrt(rough.motion) < 0.05);
    assert_true(fabs(fine.height - coarse.height) < 0.005 && fabs(rough.height - coarse.height) < 0.01);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_thin_cylinder_in_still_water),
        cmocka_unit_test(fine_beds_rest_as_coarse_ones),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
