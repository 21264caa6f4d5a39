/* An oscillating drop held against theory. */
#ifndef SB_TESTS_OSCILLATE_H
#define SB_TESTS_OSCILLATE_H

#include "check.h"
#include "sim/drop.h"

#include <stdio.h>

typedef struct case_of_drop {
    drop_form form;
    double until;                    /* periods */
    int stride;                      /* steps between looks */
    double pressure_off, period_off; /* tolerated, relative; 0: not judged */
} case_of_drop;

/* Times at which the stretch changes its sign. */
typedef struct crossings {
    double first, last;
    int count;
} crossings;

static void pass_through_zero(crossings *c, double before, double after, double time, double step)
{
    if (before * after >= 0) return;
    const double at = time - step * fabs(after) / (fabs(before) + fabs(after));
    if (c->count++ == 0) c->first = at;
    c->last = at;
}

/* Mean pressure and period from the second half-period on. */
static void oscillate(const case_of_drop *of)
{
    drop d;
    drop_make(&d, &of->form);
    assert_non_null(d.sim);
    crossings c = {0};
    drop_shape shape = drop_look(&d);
    double pressure = 0, time = 0;
    while (d.sim->state.time < of->until * d.period) {
        const double before = shape.stretch, since = d.sim->state.time;
        assert_int_equal(tank_steps(d.sim, of->stride), 0);
        shape = drop_look(&d);
        const double step = d.sim->state.time - since;
        pass_through_zero(&c, before, shape.stretch, d.sim->state.time, step);
        if (c.count > 0) pressure += shape.inside * step, time += step;
    }
    const double inside = pressure / time / d.pressure - 1;
    const double period = c.count > 1 ? 2 * (c.last - c.first) / (c.count - 1) / d.period - 1 : (double)NAN;
    printf("%dD, R = %.1f spacings, stretch %g: pressure %+.2f %%, period %+.2f %%, momentum %.2g m/s\n",
           of->form.dimensions, d.radius / of->form.spacing, of->form.stretch, 100 * inside, 100 * period,
           sb_norm(shape.momentum));
    assert_true(fabs(inside) < of->pressure_off);
    if (of->period_off > 0) assert_true(c.count > 1 && fabs(period) < of->period_off);
    drop_free(&d);
}

#endif
