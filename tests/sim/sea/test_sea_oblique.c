/* A wave that comes in through two sides of kind sea at once, oblique to them, and leaves through the two others and
   their corners, where the given water is still. Reference: the theory, which is the exact solution everywhere. */
#include "sim/sea/shore.h"
#include "sim/sea/strip.h"

#include "check.h"

#include <math.h>
#include <stdio.h>

enum { PLACES = 3 };

/* What the surface at a place is off, over the height of the wave. */
typedef struct place {
    double x, y, still, sum, most;
} place;

/* Mean depth around a place by smooth weights, m. */
static double depth_at(const sb_sim *sim, const place *p, double reach)
{
    double sum = 0;
    for (size_t i = 0; i < sim->state.n; i++) {
        const sb_vec3 at = sb_space_position(&sim->space, sim->state.position[i]);
        const double dx = fabs(at.x - p->x), dy = fabs(at.y - p->y);
        if (dx < reach && dy < reach) sum += 0.25 * (1 + cos(M_PI * dx / reach)) * (1 + cos(M_PI * dy / reach));
    }
    return sum * (double)sim->constant.mass / (double)sim->constant.rest_density / (reach * reach);
}

static double theory_at(const sb_sim *sim, const place *p)
{
    sb_sea_point point;
    sb_sea_at(sim->strip->sea, sim->state.time, p->x, p->y, 1, 0, &point);
    return point.surface;
}

/* With still water in the corners of a given and a still side, the largest error at 45 degrees is 0.2 of the height in
   the mean over time and 0.4 at single times, there. Five layers. */
static void oblique_wave_leaves(void **state)
{
    (void)state;
    const double height = 0.3, side = 6, end = 22;
    const shore_form form = {3, 0.2, 1, {side, side, 1.8}, "{x_min: sea, x_max: sea, y_min: sea, y_max: sea}", NULL};
    shore s;
    shore_make(
        &s, &form,
        "{source: theory, wave: solitary, depth: 1, height: 0.3, direction: 45, sides: {x_max: still, y_max: still}}");
    sb_sim *sim = shore_sim(&s);
    place at[PLACES * PLACES];
    for (int k = 0; k < PLACES * PLACES; k++) {
        at[k] = (place){.x = 1.2 + 1.8 * (k % PLACES), .y = 1.2 + 1.8 * (k / PLACES)};
        at[k].still = depth_at(sim, &at[k], 1);
    }
    size_t samples = 0;
    for (; sim->state.time * sqrt(9.81) < end; samples++) {
        shore_run(sim, sim->state.time + 0.05);
        for (int k = 0; k < PLACES * PLACES; k++) {
            const double off = (depth_at(sim, &at[k], 1) - at[k].still - (theory_at(sim, &at[k]) - 1)) / height;
            at[k].sum += off * off;
            at[k].most = fmax(at[k].most, fabs(off));
        }
    }
    for (int k = 0; k < PLACES * PLACES; k++) {
        const double mean = sqrt(at[k].sum / (double)samples);
        printf("(%.1f, %.1f): RMS %.3f, most %.3f\n", at[k].x, at[k].y, mean, at[k].most);
        assert_true(mean < 0.06);
        assert_true(at[k].most < 0.2);
    }
    sb_sim_destroy(sim);
    shore_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(oblique_wave_leaves)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
