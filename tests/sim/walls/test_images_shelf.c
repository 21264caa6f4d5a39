/* A sea over a slope, a shelf and an end wall stays at rest at each probe, with walls that reflect water. */
#include "check.h"
#include "sim/walls/basin.h"

#include <stdio.h>
#include <unistd.h>

/* The bed: x and height, m. */
static const double BED[][2] = {{-100, -38}, {150, -38}, {420, -12.5}, {620, -8}, {900, -8}};
enum { POINTS = sizeof BED / sizeof *BED };

static double depth_at(double x)
{
    int k = 0;
    while (k + 2 < POINTS && x > BED[k + 1][0]) k++;
    const double share = (x - BED[k][0]) / (BED[k + 1][0] - BED[k][0]);
    return -(BED[k][1] + share * (BED[k + 1][1] - BED[k][1]));
}

static void write_bed(const char *path)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (int k = 0; k < POINTS; k++)
        fprintf(file, "v %g -50 %g\nv %g 50 %g\n", BED[k][0], BED[k][1], BED[k][0], BED[k][1]);
    for (int k = 1; k < POINTS; k++) fprintf(file, "f %d %d %d %d\n", 2 * k - 1, 2 * k + 1, 2 * k + 2, 2 * k);
    assert_int_equal(fclose(file), 0);
}

static void fill(basin *b, const char *spacing, const char *seed)
{
    char path[256], bodies[512];
    snprintf(path, sizeof path, "%s/images-shelf-%d.obj", SB_BINARY_DIR, (int)getpid());
    write_bed(path);
    snprintf(bodies, sizeof bodies, "[{name: bed, shape: mesh, role: terrain, file: %s}]", path);
    const sb_override set[] = {
        {"dimensions", "2"},         {"resolution", spacing},           {"domain.min", "[0, -60]"},
        {"domain.max", "[800, 40]"}, {"domain.sides", "{z_max: open}"}, {"water", "{level: 0, seed: [100, -10]}"},
        {"bodies", bodies},          {"numerics.seed", seed},
    };
    basin_build(b, set, sizeof set / sizeof *set);
    remove(path);
    basin_start(b);
}

/* Mean velocity and mean excess of the level near x, weighed by a bell of the support radius; depth: below the level.
 */
static double speed_at(const basin *b, double x, double z)
{
    const double h = (double)b->sim->constant.support;
    sb_fluid_sample near[256];
    const size_t n =
        sb_sim_query(b->sim, sb_vec(x - h, -1, z - h), sb_vec(x + h, 1, z + h), near, sizeof near / sizeof *near);
    assert_true(n > 3 && n <= sizeof near / sizeof *near);
    double weights = 0;
    sb_vec3 sum = {0};
    for (size_t k = 0; k < n; k++) {
        const double r = hypot(near[k].position.x - x, near[k].position.z - z) / h;
        const double weight = r < 1 ? (1 - r * r) * (1 - r * r) : 0;
        sum = sb_madd(sum, weight, near[k].velocity);
        weights += weight;
    }
    return sb_norm(sb_scale(sum, 1 / weights));
}

/* Speeds stay below 0.01 sqrt(g D) of the depth at each place. */
static void check(const char *spacing, const char *seed, double end)
{
    static const double probe[][2] = {{100, -10}, {400, -4}, {600, -3}, {720, -3}};
    basin b;
    fill(&b, spacing, seed);
    basin_settle(&b);
    double most[4] = {0};
    while (sb_sim_report(b.sim)->time < end) {
        assert_int_equal(tank_steps(b.sim, 1), 0);
        for (int k = 0; k < 4; k++) most[k] = fmax(most[k], speed_at(&b, probe[k][0], probe[k][1]));
    }
    printf("  %s m, seed %s:", spacing, seed);
    for (int k = 0; k < 4; k++) printf(" %.3f of %.3f", most[k], 0.01 * sqrt(9.81 * depth_at(probe[k][0])));
    printf(" m/s\n");
    for (int k = 0; k < 4; k++) assert_true(most[k] < 0.01 * sqrt(9.81 * depth_at(probe[k][0])));
    assert_int_equal(b.sim->state.n, b.model.fluid_count);
    basin_free(&b);
}

static void a_sea_over_a_slope_rests(void **state)
{
    (void)state;
    static const char *const seeds[] = {"1", "2", "3"};
    for (int k = 0; k < 3; k++) check("6", seeds[k], 60);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sea_over_a_slope_rests),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
