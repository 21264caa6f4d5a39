/* Heun's time step: two stages, then friction. */
#include "offshore/dispersion.h"
#include "offshore/jump.h"
#include "offshore/paddle.h"
#include "offshore/state.h"

#include <math.h>

/* Share of the largest time step at which a cell cannot become empty: waves may cross half a cell, along both axes
   together, because slopes put as little as half of the water at one face. */
static const double COURANT = 0.45;

/* Prepares the fluxes of a level. */
static void prepare(sb_offshore *offshore, const sb_offshore_level *level, double time)
{
    if (offshore->options.paddle) offshore->push = sb_offshore_paddle_at(offshore->options.paddle, time);
    sb_offshore_fill_sides(offshore, level, time);
    sb_offshore_find_primitives(offshore, level);
}

static double fastest(const sb_offshore *offshore)
{
    double rate = 0;
    for (size_t j = 0; j < offshore->lines; j++) {
        if (isnan(offshore->line_speed[j])) return (double)NAN;
        rate = fmax(rate, offshore->line_speed[j]);
    }
    return rate;
}

static double stable(const sb_offshore *offshore)
{
    const double rate = fastest(offshore);
    return rate > 0 ? COURANT / rate : isnan(rate) ? rate : HUGE_VAL;
}

static sb_status fail(const sb_offshore *offshore, sb_error *error)
{
    const sb_offshore_options *o = &offshore->options;
    for (size_t j = 0; j < o->rows; j++)
        for (size_t i = 0; i < o->columns; i++) {
            const size_t at = offshore->origin + j * offshore->stride + i;
            const double h = offshore->now.h[at], hu = offshore->now.hu[at], hv = offshore->now.hv[at];
            if (isfinite(h) && isfinite(hu) && isfinite(hv)) continue;
            return sb_fail(error, SB_FAILED,
                           "offshore: t = %g s: depth %g m and momentum (%g, %g) at (%g, %g) m, expected finite values",
                           offshore->time, h, hu, hv, o->x + ((double)i + 0.5) * o->cell,
                           o->y + ((double)j + 0.5) * o->cell);
        }
    return sb_fail(error, SB_FAILED, "offshore: t = %g s: water beyond a side is not finite, expected finite values",
                   offshore->time);
}

/* A time step so much shorter than the longest one means that the run diverges. */
static const double COLLAPSE = 1e-5;

static sb_status fail_collapse(const sb_offshore *offshore, double limit, sb_error *error)
{
    const sb_offshore_options *o = &offshore->options;
    double greatest = 0;
    size_t column = 0, row = 0;
    for (size_t j = 0; j < o->rows; j++)
        for (size_t i = 0; i < o->columns; i++) {
            const size_t at = offshore->origin + j * offshore->stride + i;
            const double speed = fabs(offshore->u[at]) + fabs(offshore->v[at]);
            if (!(speed > greatest)) continue;
            greatest = speed;
            column = i;
            row = j;
        }
    return sb_fail(
        error, SB_FAILED,
        "offshore: t = %g s: diverged: a time step of %.3g s, with a speed of %.3g m/s at (%g, %g) m, expected "
        "at least %.3g s",
        offshore->time, limit, greatest, o->x + ((double)column + 0.5) * o->cell, o->y + ((double)row + 0.5) * o->cell,
        COLLAPSE * offshore->longest);
}

double sb_offshore_time_step(sb_offshore *offshore)
{
    prepare(offshore, &offshore->now, offshore->time);
    return stable(offshore);
}

static void book(sb_offshore *offshore)
{
    for (int s = 0; s < SB_OFFSHORE_SIDES; s++) offshore->entered[s] += offshore->pending[s];
    offshore->repaired += offshore->pending_repaired;
    offshore->added += offshore->pending_added;
}

sb_status sb_offshore_step(sb_offshore *offshore, double most, double *taken, sb_error *error)
{
    prepare(offshore, &offshore->now, offshore->time);
    const double limit = stable(offshore);
    if (isnan(limit)) return fail(offshore, error);
    if (isfinite(limit)) offshore->longest = fmax(offshore->longest, limit);
    if (limit < COLLAPSE * offshore->longest) return fail_collapse(offshore, limit, error);
    const double dt = fmin(most, limit);
    if (!(dt > 0) || !isfinite(dt))
        return sb_fail(error, SB_FAILED, "offshore: a time step of %g s, expected > 0 and finite", dt);
    const sb_offshore_update first = {&offshore->now, &offshore->now, &offshore->stage, 0, dt};
    const sb_offshore_update second = {&offshore->now, &offshore->stage, &offshore->before, 0.5, dt};
    sb_status status = SB_OK;
    if (offshore->dispersion) status = sb_offshore_find_dispersion(offshore, &offshore->now, 0, dt, error);
    if (status != SB_OK) return status;
    sb_offshore_advance(offshore, &first);
    sb_offshore_jump_fluxes(offshore, &first);
    prepare(offshore, &offshore->stage, offshore->time + dt);
    if (offshore->dispersion) status = sb_offshore_find_dispersion(offshore, &offshore->stage, 1, dt, error);
    if (status != SB_OK) return status;
    sb_offshore_advance(offshore, &second);
    sb_offshore_jump_fluxes(offshore, &second);
    sb_offshore_apply_friction(offshore, &offshore->before, dt);
    book(offshore);
    const sb_offshore_level level = offshore->now;
    offshore->now = offshore->before;
    offshore->before = level;
    offshore->before_time = offshore->time;
    offshore->time += dt;
    offshore->steps++;
    if (taken) *taken = dt;
    return SB_OK;
}
