/* Films on a floor that reflects water. The load of water on an end wall is that of the hydrostatic pressure but for a
   constant, down to a single layer. A film is then level with deeper water beside it if it has as many particles as its
   volume holds. */
#include "check.h"
#include "sim/walls/basin.h"

#include <stdio.h>

/* Water over 12 m x 5 m before an end wall; the spacing is 1 m. */
enum { LENGTH = 12, WIDTH = 5, STEPS = 400 };

static void fill(basin *b, const char *sides, const char *max, const char *level, const char *bodies)
{
    char water[64];
    snprintf(water, sizeof water, "{level: %s, seed: [1, 1, 0.1]}", level);
    const sb_override set[] = {
        {"dimensions", "3"},         {"resolution", "1"},
        {"domain.min", "[0, 0, 0]"}, {"domain.max", max},
        {"domain.sides", sides},     {"water", water},
        {"bodies", bodies},          {"numerics.jitter", bodies[1] == ']' ? "0" : "0.05"},
    };
    basin_build(b, set, sizeof set / sizeof *set);
    basin_start(b);
}

/* Load on the end wall per width, in rho g dr^2, less n^2/2. *layers: n, the number of particles per area. */
static double excess_of(const char *level, double *layers)
{
    basin b;
    fill(&b, "{z_max: open}", "[13, 5, 8]", level, "[{name: end, shape: box, min: [12, -1, -1], max: [14, 6, 9]}]");
    basin_settle(&b);
    *layers = (double)b.sim->state.n / (LENGTH * WIDTH);
    assert_int_equal(tank_steps(b.sim, STEPS), 0);
    const double force = sb_sim_impulse(b.sim, 0)->pressure.x / sb_sim_report(b.sim)->time;
    const double unit = b.scene.fluid.gravity * b.scene.fluid.density * WIDTH;
    basin_free(&b);
    return force / unit - *layers * *layers / 2;
}

/* A film of n layers is in equilibrium with water of the depth h if the loads are equal: h^2/2 + the excess of deep
   water = n^2/2 + its own. */
static void films_are_level_with_deeper_water(void **state)
{
    (void)state;
    static const char *const levels[] = {"1", "1.2", "1.5", "2"};
    double n;
    const double deep = excess_of("3", &n);
    printf("%.2f layers: excess %.3f\n", n, deep);
    for (size_t k = 0; k < sizeof levels / sizeof *levels; k++) {
        const double excess = excess_of(levels[k], &n), depth = sqrt(n * n + 2 * (excess - deep));
        printf("%.2f layers: excess %.3f, level with water of %.3f\n", n, excess, depth);
        /* In spacings. Without the correction of films: 0.16, 0.1, 0.06, 0.00. */
        assert_true(fabs(n - depth) < (k == 0 ? 0.1 : 0.04));
    }
}

/* A floor between periodic sides is its own image beyond them and reflects once: a lattice has the density that it has
   between walls. */
static void a_floor_between_periodic_sides_reflects_once(void **state)
{
    (void)state;
    basin closed, periodic;
    fill(&closed, "{z_max: open}", "[6, 6, 8]", "2", "[]");
    fill(&periodic, "{x_min: periodic, x_max: periodic, y_min: periodic, y_max: periodic, z_max: open}", "[6, 6, 8]",
         "2", "[]");
    assert_int_equal(closed.sim->state.n, periodic.sim->state.n);
    assert_int_equal(tank_prepare(closed.sim, 0.01), 0);
    assert_int_equal(tank_prepare(periodic.sim, 0.01), 0);
    double most = 0;
    for (size_t i = 0; i < closed.sim->state.n; i++)
        for (size_t j = 0; j < periodic.sim->state.n; j++)
            if (closed.sim->state.id[i] == periodic.sim->state.id[j])
                most = fmax(most, fabs((double)(closed.sim->work.density[i] - periodic.sim->work.density[j])));
    printf("density differs by at most %.2g kg/m^3\n", most);
    assert_true(most < 0.1);
    basin_free(&closed);
    basin_free(&periodic);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(films_are_level_with_deeper_water),
        cmocka_unit_test(a_floor_between_periodic_sides_reflects_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
