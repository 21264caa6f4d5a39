/* The density of a strained packing: the change of density sums in a linear motion. The height of long waves is judged
   by the cases sea-solitary of tools/validate. */
#include "base/memory.h"
#include "check.h"
#include "sim/passes/passes.h"
#include "sim/pressure/pressure.h"
#include "sim/tank.h"

#include <math.h>
#include <stdio.h>

/* Gives all particles a linear velocity without divergence. */
static void strain(sb_sim *sim)
{
    for (size_t i = 0; i < sim->state.n; i++) {
        const sb_vec3 x = sb_space_position(&sim->space, sim->state.position[i]);
        const bool flat = sim->constant.dimension == 2;
        const float side = flat ? 0 : (float)x.y;
        sim->state.velocity[i] = (sb_f4){(float)(-0.7 * x.x + 0.2 * x.z), flat ? 0 : 0.3f * side + 0.1f * (float)x.x,
                                         (float)((flat ? 0.7 : 0.4) * x.z - 0.5 * x.x), 0};
    }
}

/* A linear motion without change of volume is a strain alone: what it does to the density sum of particles away from
   walls, also at the surface and in a disordered packing, is what the stage takes back. */
static void a_linear_motion_keeps_the_density(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        tank t;
        tank_make(&t, dimensions, 0.1, sb_vec(2, 2, 1.5), 2, 1, 0.2);
        sb_sim *sim = tank_sim(&t);
        assert_non_null(sim);
        assert_true(sim->needs.packing_strain);
        assert_int_equal(tank_prepare(sim, 0.01), 0);
        strain(sim);
        const sb_passes *passes = sb_passes_choose();
        passes->strain(sim);
        for (size_t i = 0; i < sim->state.n; i++) {
            assert_near(sim->work.deviator_xx[i], -0.7, 1e-4);
            sim->work.stress_xx[i] = sim->work.deviator_xx[i];
            sim->work.stress[i] = sim->work.deviator[i];
        }
        sb_pressure_load(sim, sim->work.stress_xx);
        passes->strained(sim);
        float *rate = sb_alloc(sim->state.n, sizeof *rate);
        passes->diverge(sim, sim->state.velocity, 1, rate);
        const double away = (double)sim->constant.support;
        size_t compared = 0, surface = 0;
        double worst = 0, largest = 0;
        for (size_t i = 0; i < sim->state.n; i++) {
            const sb_vec3 x = sb_space_position(&sim->space, sim->state.position[i]);
            if (fabs(x.x - 1) > 1 - away || x.z < away || (dimensions == 3 && fabs(x.y - 1) > 1 - away)) continue;
            worst = fmax(worst, fabs((double)(sim->work.strained[i] - rate[i])));
            largest = fmax(largest, fabs((double)rate[i]));
            compared++;
            surface += x.z > 0.9;
        }
        printf("%dD: %zu particles, %zu at the surface: %.2g of %.3g kg/m3/s\n", dimensions, compared, surface, worst,
               largest);
        assert_true(compared > 50 && surface > 10 && largest > 10);
        assert_true(worst < 1e-4 * largest);
        sb_free(rate);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_linear_motion_keeps_the_density)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
