/* Walls that reflect water: loads of still water on blocks, and a sea over a slope. */
#include "check.h"
#include "sim/walls/basin.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A block that stands on the floor bears no vertical force, and no horizontal one; two blocks one spacing apart
   neither, on the mean: the water between them oscillates. */
static void check_blocks(const char *bodies, const char *max, double most)
{
    basin b;
    basin_fill(&b, 3, "0.075", max, "{level: 0.45, seed: [0.1, 0.1, 0.1]}", bodies, "completed");
    basin_settle(&b);
    const double face = 0.5 * 9810 * 0.45 * 0.45 * 0.3, weight = 9810 * 0.3 * 0.3 * 0.45;
    assert_int_equal(tank_steps(b.sim, 100), 0);
    for (size_t body = 0; body + 1 < b.model.body_count; body++) {
        const sb_vec3 f = sb_scale(sb_sim_impulse(b.sim, body)->pressure, 1 / sb_sim_report(b.sim)->time);
        printf("%s: force %.2g, %.2g of a face's load, %.2g of the displaced weight\n", b.model.bodies[body].name,
               f.x / face, f.y / face, f.z / weight);
        assert_true(fabs(f.x) < most * face && fabs(f.y) < most * face);
        assert_true(fabs(f.z) < 1e-4 * weight);
    }
    basin_free(&b);
}

static void blocks_in_still_water_bear_no_force(void **state)
{
    (void)state;
    check_blocks("[{name: a, shape: box, min: [0.4, 0.3, 0], max: [0.7, 0.6, 0.8]}]", "[1.05, 0.9, 0.8]", 0.02);
    check_blocks("[{name: a, shape: box, min: [0.225, 0.3, -0.2], max: [0.525, 0.6, 0.8]},"
                 " {name: b, shape: box, min: [0.6, 0.3, -0.2], max: [0.9, 0.6, 0.8]}]",
                 "[1.125, 0.9, 0.8]", 0.05);
}

/* A sea over a slope with a shallow shelf stays at rest, without damping (docs/decisions/0033): the speed of no
   particle exceeds 4 % of sqrt(gD), the mean speed 0.4 %. */
static void a_sea_over_a_slope_rests(void **state)
{
    (void)state;
    char path[] = "/tmp/sb-shelf-XXXXXX.obj", bodies[128];
    const int file = mkstemps(path, 4);
    assert_true(file >= 0);
    static const char *const mesh =
        "v -20 -9 -7.6\nv -20 9 -7.6\nv 30 -9 -7.6\nv 30 9 -7.6\nv 84 -9 -2.5\nv 84 9 -2.5\nv 124 -9 -1.6\n"
        "v 124 9 -1.6\nv 190 -9 -1.6\nv 190 9 -1.6\nf 1 3 4 2\nf 3 5 6 4\nf 5 7 8 6\nf 7 9 10 8\n";
    assert_int_equal(write(file, mesh, strlen(mesh)), (ssize_t)strlen(mesh));
    close(file);
    snprintf(bodies, sizeof bodies, "[{name: bed, shape: mesh, role: terrain, file: %s}]", path);
    basin b;
    const sb_override set[] = {
        {"dimensions", "2"},
        {"resolution", "1.2"},
        {"domain.min", "[0, -12]"},
        {"domain.max", "[160, 8]"},
        {"water", "{level: 0, seed: [20, -2]}"},
        {"bodies", bodies},
        {"numerics.walls", "images"},
    };
    basin_fill_from(&b, set, sizeof set / sizeof *set);
    basin_settle(&b);
    const double wave = (double)b.sim->constant.wave_speed;
    double fastest = 0, mean = 0;
    const int steps = 400;
    for (int k = 0; k < steps; k++) {
        assert_int_equal(tank_steps(b.sim, 1), 0);
        const sb_energy e = sb_sim_energy(b.sim);
        fastest = fmax(fastest, b.sim->state.max_speed);
        mean += sqrt(2 * e.kinetic / e.mass) / steps;
    }
    printf("%zu particles, %.0f s: speeds up to %.2g, mean %.2g of sqrt(gD)\n", b.sim->state.n,
           sb_sim_report(b.sim)->time, fastest / wave, mean / wave);
    assert_true(fastest < 0.04 * wave);
    assert_true(mean < 0.004 * wave);
    basin_free(&b);
    unlink(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_in_still_water_bear_no_force),
        cmocka_unit_test(a_sea_over_a_slope_rests),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
