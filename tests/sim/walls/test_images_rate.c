/* The divergence is the rate of the density sum at the edges of a plate with water on both sides, round a moving body,
   and over a bed that bends: compared with the sums after a small way forth and back. */
#include "base/memory.h"
#include "base/random.h"
#include "check.h"
#include "sim/passes/passes.h"
#include "sim/walls/basin.h"

#include <stdio.h>
#include <unistd.h>

/* Water on a disturbed lattice over the whole basin, outside of the box [from, to]. */
static void spread(basin *b, double depth, sb_vec3 from, sb_vec3 to)
{
    sb_model *m = &b->model;
    const double s = m->spacing;
    const bool flat = m->dimensions == 2;
    const size_t nx = (size_t)lround((m->max.x - m->min.x) / s);
    const size_t ny = flat ? 1 : (size_t)lround((m->max.y - m->min.y) / s), nz = (size_t)lround(depth / s);
    size_t n = 0;
    for (size_t k = 0; k < nx * ny * nz && n < m->fluid_count; k++) {
        const sb_vec3 at = sb_vec(((double)(k % nx) + 0.3 + 0.4 * sb_random(1, k)) * s,
                                  flat ? 0 : ((double)(k / nx % ny) + 0.3 + 0.4 * sb_random(2, k)) * s,
                                  ((double)(k / nx / ny) + 0.3 + 0.4 * sb_random(3, k)) * s);
        if (!(at.x > from.x && at.y > from.y && at.z > from.z && at.x < to.x && at.y < to.y && at.z < to.z))
            m->fluid_position[n++] = at;
    }
    m->fluid_count = n;
}

typedef struct motion {
    double time, dt;
    sb_record *at; /* by id */
    sb_f4 *way;
} motion;

/* Density sums, by id, after `share` steps. */
static void densities(basin *b, const motion *m, int share, double *out)
{
    sb_sim *sim = b->sim;
    sim->state.time = m->time + share * m->dt;
    for (size_t i = 0; i < sim->state.n; i++) {
        const uint32_t id = sim->state.id[i];
        for (int axis = 0; axis < 3; axis++)
            sim->state.position[i][axis] = m->at[id][axis] + (uint32_t)(share * (int32_t)m->way[id][axis]);
    }
    assert_int_equal(tank_prepare(sim, m->dt), 0);
    for (size_t i = 0; i < sim->state.n; i++) out[sim->state.id[i]] = (double)sim->work.density[i];
}

/* most: largest difference, over the largest change. */
static void compare(basin *b, double time, double dt, double most)
{
    sb_sim *sim = b->sim;
    sim->state.time = time;
    assert_int_equal(tank_prepare(sim, dt), 0);
    const size_t n = sim->state.n;
    motion m = {time, dt, sb_alloc(n, sizeof *m.at), sb_alloc(n, sizeof *m.way)};
    float *divergence = sb_alloc(n, sizeof *divergence);
    double *rate = sb_alloc(n, sizeof *rate), *before = sb_alloc(n, sizeof *before),
           *after = sb_alloc(n, sizeof *after);
    assert_true(m.at && m.way && divergence && rate && before && after);
    const double size = floor(2e-3 * b->model.spacing / sim->space.quantum);
    double flux = 0, worst = 0, largest = 0;
    for (size_t i = 0; i < n; i++) {
        const uint32_t id = sim->state.id[i];
        m.at[id] = sim->state.position[i];
        sim->work.predicted[i] = m.way[id] = basin_way(sim, sb_space_position(&sim->space, m.at[id]), id, size);
    }
    sim->passes->diverge(sim, sim->work.predicted, (float)sim->space.quantum, divergence);
    for (size_t i = 0; i < n; i++) {
        rate[sim->state.id[i]] = (double)divergence[i] - dt * (double)sb_wall_flux(sim, i);
        flux = fmax(flux, fabs(dt * (double)sb_wall_flux(sim, i)));
    }
    printf("  %dD: %zu particles, %zu images, %zu pairs at edges, ", sim->constant.dimension, n,
           sim->groups.images_used, sim->work.edge_pairs.used);
    assert_true(sim->groups.images_used > 50 && sim->work.edge_pairs.used > 10);
    densities(b, &m, -1, before);
    densities(b, &m, 1, after);
    size_t at = 0;
    for (size_t i = 0; i < n; i++) {
        const double off = fabs(0.5 * (after[i] - before[i]) - rate[i]);
        if (off > worst) at = i;
        worst = fmax(worst, off);
        largest = fmax(largest, fabs(rate[i]));
    }
    const sb_vec3 p = sb_space_position(&sim->space, m.at[at]);
    printf("change of the density %.2g kg/m^3, %.2g by the wall's motion; it differs by %.2g of that at (%.3f %.3f "
           "%.3f)\n",
           largest, flux, worst / largest, p.x, p.y, p.z);
    assert_true(largest > 0.5);
    assert_true((flux > 0.1 * largest) == (sim->walls.moving_count > 0));
    assert_true(worst < most * largest);
    sb_free(m.at), sb_free(m.way), sb_free(divergence), sb_free(rate), sb_free(before), sb_free(after);
}

/* A body that moves through the water, which flows round it. */
static void a_moving_body(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        basin b;
        const bool flat = dimensions == 2;
        const sb_override set[] = {
            {"dimensions", flat ? "2" : "3"},
            {"resolution", flat ? "0.05" : "0.1"},
            {"domain.min", flat ? "[0, 0]" : "[0, 0, 0]"},
            {"domain.max", flat ? "[1.6, 1.2]" : "[1.6, 0.9, 1.2]"},
            {"numerics.density", "summed"},
            {"numerics.settle_steps", "0"},
            {"water",
             flat ? "{boxes: [{min: [0, 0], max: [1.6, 0.9]}]}" : "{boxes: [{min: [0, 0, 0], max: [1.6, 0.9, 0.9]}]}"},
            {"bodies", flat ? "[{name: paddle, shape: box, min: [0.3, 0], max: [0.6, 0.5]}]"
                            : "[{name: paddle, shape: box, min: [0.3, 0.2, 0], max: [0.6, 1.2, 0.5]}]"},
            {"wavemakers", flat
                               ? "[{name: push, body: paddle, kind: stroke, stroke: 0.5, speed: 0.4, direction: [1, "
                                 "0]}]"
                               : "[{name: push, body: paddle, kind: stroke, stroke: 0.5, speed: 0.4, direction: [1, 0, "
                                 "0]}]"},
        };
        basin_build(&b, set, sizeof set / sizeof *set);
        sb_paddle paddle;
        assert_int_equal(sb_paddle_create(&b.scene.wavemakers[0].law, &paddle, NULL), SB_OK);
        const double x = sb_paddle_displacement(&paddle, 0.6);
        sb_paddle_destroy(&paddle);
        spread(&b, 0.9, sb_vec(0.3 + x, flat ? -1 : 0.2, -1), sb_vec(0.6 + x, 2, 0.5));
        basin_start(&b);
        compare(&b, 0.6, flat ? 2.5e-4 : 5e-4, 2e-3);
        basin_free(&b);
    }
}

/* A plate in the middle of the water, with four edges (2D: two ends). */
static void a_plate(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        basin b;
        const bool flat = dimensions == 2;
        char path[64], bodies[256];
        snprintf(path, sizeof path, "%s/images-rate-%d.obj", SB_BINARY_DIR, (int)getpid());
        FILE *file = fopen(path, "w");
        assert_non_null(file);
        fprintf(file, "v 0.8 %g 0.2\nv 0.8 %g 0.2\nv 0.8 %g 0.6\nv 0.8 %g 0.6\nf 1 2 3\nf 1 3 4\n", flat ? -1 : 0.25,
                flat ? 1 : 0.65, flat ? 1 : 0.65, flat ? -1 : 0.25);
        assert_int_equal(fclose(file), 0);
        snprintf(bodies, sizeof bodies, "[{name: plate, shape: mesh, file: %s}]", path);
        const sb_override set[] = {
            {"dimensions", flat ? "2" : "3"},
            {"resolution", flat ? "0.05" : "0.1"},
            {"domain.min", flat ? "[0, 0]" : "[0, 0, 0]"},
            {"domain.max", flat ? "[1.6, 1.2]" : "[1.6, 0.9, 1.2]"},
            {"numerics.density", "summed"},
            {"water",
             flat ? "{boxes: [{min: [0, 0], max: [1.6, 0.9]}]}" : "{boxes: [{min: [0, 0, 0], max: [1.6, 0.9, 0.9]}]}"},
            {"bodies", bodies},
        };
        basin_build(&b, set, sizeof set / sizeof *set);
        remove(path);
        assert_true(b.model.facets.facets[0].both);
        spread(&b, 0.9, (sb_vec3){0}, (sb_vec3){0});
        basin_start(&b);
        compare(&b, 0, 1e-3, 2e-3);
        basin_free(&b);
    }
}

/* A bed of triangles whose slopes differ by some degrees. It is level within `rim` cells of its border. Heights: from
   -most to most. */
static void write_bed(const char *path, double most, int rim)
{
    enum { CELLS = 10, CORNERS = CELLS + 1 };
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (int k = 0; k < CORNERS * CORNERS; k++) {
        const int i = k % CORNERS, j = k / CORNERS;
        const bool level = i < rim || j < rim || i > CELLS - rim || j > CELLS - rim;
        fprintf(file, "v %g %g %g\n", 0.3 * i - 0.3, 0.3 * j - 0.3,
                0.2 + (level ? 0 : most * (2 * sb_random(9, (uint64_t)k) - 1)));
    }
    for (int k = 0; k < CELLS * CELLS; k++) {
        const int a = k / CELLS * CORNERS + k % CELLS + 1;
        fprintf(file, "f %d %d %d\nf %d %d %d\n", a, a + 1, a + CORNERS + 1, a, a + CORNERS + 1, a + CORNERS);
    }
    assert_int_equal(fclose(file), 0);
}

/* Bends of a fifth of the tolerance with which surfaces are simplified, about that, and well above it; with a level
   rim, and up to walls and a block. */
static void a_bed_that_bends(void **state)
{
    (void)state;
    static const double most[] = {0.002, 0.01, 0.04, 0.01, 0.04, 0.04};
    for (size_t k = 0; k < sizeof most / sizeof *most; k++) {
        basin b;
        char path[64], bodies[256];
        const bool block = k == 5;
        snprintf(path, sizeof path, "%s/images-rate-%d.obj", SB_BINARY_DIR, (int)getpid());
        write_bed(path, most[k], k < 3 ? 3 : 0);
        snprintf(bodies, sizeof bodies, "[{name: bed, shape: mesh, role: terrain, file: %s}%s]", path,
                 block ? ", {name: block, shape: box, min: [0.85, 1.35, -1], max: [1.45, 1.85, 0.8]}" : "");
        const sb_override set[] = {
            {"dimensions", "3"},
            {"resolution", "0.1"},
            {"domain.min", "[0, 0, 0]"},
            {"domain.max", "[2.4, 2.4, 1.2]"},
            {"numerics.density", "summed"},
            {"numerics.jitter", "0.2"},
            {"water", "{level: 0.6, seed: [0.8, 0.8, 0.5]}"},
            {"bodies", bodies},
        };
        basin_build(&b, set, sizeof set / sizeof *set);
        remove(path);
        basin_start(&b);
        compare(&b, 0, 1e-3, 5e-3); /* weights below 1e-4 are 0 */
        basin_free(&b);
    }
}

/* A tank whose bed is one slope, so that its walls stand on it at 90 degrees plus or minus the slope; 3D: it falls
   along x and y, and three walls meet in the corners. block: a body on the slope, with its faces beside the water. */
static void fill_slope(basin *b, bool flat, double degrees, bool block)
{
    char path[64], bodies[512];
    const double size = flat ? 1.2 : 1.6, s = tan(degrees * 3.14159265358979 / 180), sx = flat ? s : s / sqrt(2);
    const double sy = flat ? 0 : sx, level = 2 * s * size + 0.7;
    snprintf(path, sizeof path, "%s/images-rate-%d.obj", SB_BINARY_DIR, (int)getpid());
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (int k = 0; k < 4; k++) {
        const double x = k % 2 ? size + 0.5 : -0.5, y = k / 2 ? size + 0.5 : -0.5;
        fprintf(file, "v %.9g %.9g %.9g\n", x, y, 0.3 + s * size + sx * (x - size / 2) + sy * (y - size / 2));
    }
    fprintf(file, "f 1 2 4 3\n");
    assert_int_equal(fclose(file), 0);
    int at = snprintf(bodies, sizeof bodies, "[{name: bed, shape: mesh, role: terrain, file: %s}", path);
    if (block)
        at += snprintf(bodies + at, sizeof bodies - (size_t)at, ", {name: block, shape: box, %s %g%s}",
                       flat ? "min: [0.4, -1], max: [0.7," : "min: [0.5, 0.5, -1], max: [1, 1.1,", level + 0.25, "]");
    snprintf(bodies + at, sizeof bodies - (size_t)at, "]");
    char max[64], water[96];
    snprintf(max, sizeof max, flat ? "[%g, %g]" : "[%g, %g, %g]", size, flat ? level + 0.5 : size, level + 0.5);
    snprintf(water, sizeof water, flat ? "{level: %g, seed: [0.2, %g]}" : "{level: %g, seed: [0.2, 0.2, %g]}", level,
             level - 0.05);
    const sb_override set[] = {{"dimensions", flat ? "2" : "3"},
                               {"resolution", flat ? "0.05" : "0.1"},
                               {"domain.min", flat ? "[0, -2]" : "[0, 0, -2]"},
                               {"domain.max", max},
                               {"numerics.density", "summed"},
                               {"numerics.jitter", "0.2"},
                               {"water", water},
                               {"bodies", bodies}};
    basin_build(b, set, sizeof set / sizeof *set);
    remove(path);
}

static void walls_on_a_slope(void **state)
{
    (void)state;
    static const double degrees[] = {5, 0.5, 12, 20, 29}; /* 3D: the first and the last */
    for (int dimensions = 2; dimensions <= 3; dimensions++)
        for (int block = 0; block < 2; block++)
            for (size_t k = 0; k < sizeof degrees / sizeof *degrees; k += dimensions == 3 ? 4 : 1) {
                basin b;
                fill_slope(&b, dimensions == 2, degrees[k], block);
                basin_start(&b);
                printf("%g degrees%s", degrees[k], block ? ", block" : "");
                compare(&b, 0, 1e-3, 5e-3);
                basin_free(&b);
            }
}

/* The density of a particle that rises beside a wall from the bed has no jumps: of its second differences, which fall
   with the square of the step, the largest is small. */
static void a_way_beside_a_wall(void **state)
{
    (void)state;
    enum { STEPS = 400 };
    for (int end = 0; end < 2; end++) {
        basin b;
        const double tangent = tan(20 * 3.14159265358979 / 180), size = 1.2, s = 0.05;
        fill_slope(&b, true, 20, false);
        basin_start(&b);
        sb_sim *sim = b.sim;
        assert_int_equal(tank_prepare(sim, 1e-3), 0);
        const double x = end ? size - 0.4 * s : 0.4 * s, bed = 0.3 + tangent * (size / 2 + x);
        uint32_t id = 0;
        double nearest = INFINITY;
        for (size_t i = 0; i < sim->state.n; i++) {
            const double away =
                sb_norm(sb_sub(sb_space_position(&sim->space, sim->state.position[i]), sb_vec(x, 0, bed)));
            if (away < nearest) nearest = away, id = sim->state.id[i];
        }
        double density[STEPS], worst = 0, rho = (double)sim->constant.rest_density;
        for (int k = 0; k < STEPS; k++) {
            for (size_t i = 0; i < sim->state.n; i++)
                if (sim->state.id[i] == id)
                    sim->state.position[i] =
                        sb_space_record(&sim->space, sb_vec(x, 0, bed + (0.5 + 2.0 * k / STEPS) * s));
            assert_int_equal(tank_prepare(sim, 1e-3), 0);
            for (size_t i = 0; i < sim->state.n; i++)
                if (sim->state.id[i] == id) density[k] = (double)sim->work.density[i];
            if (k >= 2) worst = fmax(worst, fabs(density[k] - 2 * density[k - 1] + density[k - 2]));
        }
        printf("  second difference of the density at most %.2g of it\n", worst / rho);
        assert_true(worst < 2e-4 * rho);
        basin_free(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_moving_body),       cmocka_unit_test(a_plate),
        cmocka_unit_test(a_bed_that_bends),    cmocka_unit_test(walls_on_a_slope),
        cmocka_unit_test(a_way_beside_a_wall),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
