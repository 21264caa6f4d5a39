#include "offshore/save.h"
#include "base/hash.h"
#include "offshore/dispersion.h"
#include "offshore/state.h"

#include <math.h>

enum { REALS = 10, ARRAYS = 10 };

/* The numbers that outlive a step. */
static void find_reals(sb_offshore *o, double *reals[REALS])
{
    double *const all[REALS] = {&o->time,       &o->before_time, &o->longest,    &o->added,      &o->repaired,
                                &o->entered[0], &o->entered[1],  &o->entered[2], &o->entered[3], &o->first};
    for (size_t k = 0; k < REALS; k++) reals[k] = all[k];
}

/* The arrays that outlive a step; those of the cells beyond the sides are found anew. Returns their number. */
static size_t find_arrays(const sb_offshore *o, double *arrays[ARRAYS])
{
    struct sb_offshore_dispersion *d = o->dispersion;
    double *const all[ARRAYS] = {o->now.h,
                                 o->now.hu,
                                 o->now.hv,
                                 o->before.h,
                                 o->before.hu,
                                 o->before.hv,
                                 d ? d->pressure : NULL,
                                 d ? d->earlier : NULL,
                                 d ? d->breaking : NULL,
                                 d ? d->active : NULL};
    for (size_t k = 0; k < ARRAYS; k++) arrays[k] = all[k];
    return d ? ARRAYS : 6;
}

void sb_offshore_save(const sb_offshore *offshore, sb_archive_out *out)
{
    sb_offshore copy = *offshore;
    double *reals[REALS], *arrays[ARRAYS];
    const size_t count = find_arrays(offshore, arrays);
    find_reals(&copy, reals);
    sb_put_count(out, offshore->steps);
    for (size_t k = 0; k < REALS; k++) sb_put_real(out, *reals[k]);
    if (offshore->dispersion) sb_put_real(out, offshore->dispersion->last_dt);
    for (size_t k = 0; k < count; k++) sb_put_list(out, arrays[k], offshore->cells, sizeof(double));
}

static void check(const sb_offshore *o, sb_archive_in *in)
{
    double *arrays[ARRAYS];
    const size_t count = find_arrays(o, arrays);
    for (size_t k = 0; k < count; k++)
        for (size_t j = 0; j < o->options.rows; j++)
            for (size_t i = 0; i < o->options.columns; i++) {
                const double value = arrays[k][o->origin + j * o->stride + i];
                if (isfinite(value) && (value >= 0 || k % 3 != 0 || k > 3)) continue;
                sb_archive_refuse(in, "the depth-averaged water has the value %g, expected finite ones and depths >= 0",
                                  value);
                return;
            }
    if (!(o->before_time <= o->time) || !isfinite(o->time) || !(o->longest >= 0))
        sb_archive_refuse(in, "the depth-averaged water is at %g s after %g s, expected finite times", o->time,
                          o->before_time);
}

void sb_offshore_load(sb_offshore *offshore, sb_archive_in *in)
{
    double *reals[REALS], *arrays[ARRAYS];
    const size_t count = find_arrays(offshore, arrays);
    find_reals(offshore, reals);
    offshore->steps = sb_take_count(in, UINT64_MAX);
    for (size_t k = 0; k < REALS; k++) *reals[k] = sb_take_real(in);
    if (offshore->dispersion) offshore->dispersion->last_dt = sb_take_real(in);
    for (size_t k = 0; k < count; k++) sb_take_list(in, arrays[k], offshore->cells, sizeof(double));
    check(offshore, in);
}

uint64_t sb_offshore_hash(const sb_offshore *offshore, uint64_t hash)
{
    const double *const fields[] = {offshore->now.h, offshore->now.hu, offshore->now.hv};
    hash = sb_hash(hash, &offshore->time, sizeof offshore->time);
    for (size_t f = 0; f < 3; f++)
        for (size_t j = 0; j < offshore->options.rows; j++)
            hash = sb_hash(hash, fields[f] + offshore->origin + j * offshore->stride,
                           offshore->options.columns * sizeof(double));
    return hash;
}
