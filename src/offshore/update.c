/* One stage of the time step: slopes, fluxes and new values, row by row. */
#include "offshore/flux.h"
#include "offshore/state.h"

#include <omp.h>
#include <string.h>

/* Half slopes of a row's cells. */
typedef struct slopes {
    double *h, *surface, *across, *along;
} slopes;

/* Fluxes through a row of faces. */
typedef struct fluxes {
    double *volume, *left, *right, *along;
} fluxes;

/* Values of a row of cells, where `across` is the velocity across the faces in question. */
typedef struct cells {
    const double *h, *surface, *across, *along;
} cells;

/* One thread's rows: slopes and fluxes along x; along y those of the row and of the next, and of the faces below and
   above the row. 24 rows of the scratch memory. */
typedef struct rows {
    slopes x, y, next_y;
    fluxes flux_x, below, above;
} rows;

static rows rows_of(const sb_offshore *offshore, int thread)
{
    double *at = offshore->scratch + (size_t)thread * SB_OFFSHORE_ROWS * offshore->stride;
    double *part[SB_OFFSHORE_ROWS];
    for (size_t k = 0; k < SB_OFFSHORE_ROWS; k++) part[k] = at + k * offshore->stride;
    return (rows){.x = {part[0], part[1], part[2], part[3]},
                  .y = {part[4], part[5], part[6], part[7]},
                  .next_y = {part[8], part[9], part[10], part[11]},
                  .flux_x = {part[12], part[13], part[14], part[15]},
                  .below = {part[16], part[17], part[18], part[19]},
                  .above = {part[20], part[21], part[22], part[23]}};
}

/* Half slopes of `count` cells; the neighbours of cell i are i - step and i + step. */
SB_MULTIVERSION static void find_slopes(cells c, ptrdiff_t step, slopes out, size_t count)
{
    double *restrict h = out.h, *restrict surface = out.surface, *restrict across = out.across,
                     *restrict along = out.along;
#pragma omp simd
    for (ptrdiff_t i = 0; i < (ptrdiff_t)count; i++) {
        h[i] = half_slope(c.h[i - step], c.h[i], c.h[i + step]);
        surface[i] = half_slope(c.surface[i - step], c.surface[i], c.surface[i + step]);
        across[i] = half_slope(c.across[i - step], c.across[i], c.across[i + step]);
        along[i] = half_slope(c.along[i - step], c.along[i], c.along[i + step]);
    }
}

/* Fluxes through `count` faces; face i is between cell i, with slope i of `low`, and cell i + step, with slope i of
   `high`. */
SB_MULTIVERSION static void find_fluxes(cells c, ptrdiff_t step, slopes low, slopes high, double gravity, fluxes out,
                                        size_t count)
{
    double *restrict volume = out.volume, *restrict left = out.left, *restrict right = out.right,
                     *restrict along = out.along;
#pragma omp simd
    for (ptrdiff_t i = 0; i < (ptrdiff_t)count; i++) {
        const face_side l = {c.h[i] + low.h[i], c.surface[i] + low.surface[i], c.across[i] + low.across[i],
                             c.along[i] + low.along[i]};
        const face_side r = {c.h[i + step] - high.h[i], c.surface[i + step] - high.surface[i],
                             c.across[i + step] - high.across[i], c.along[i + step] - high.along[i]};
        const face_flux f = flux_between(l, r, gravity);
        volume[i] = f.volume;
        left[i] = f.left;
        right[i] = f.right;
        along[i] = f.along;
    }
}

/* The new values of one row, and what they are made of. */
typedef struct target {
    const double *first_h, *first_hu, *first_hv, *in_h, *in_hu, *in_hv, *force_x, *force_y;
    double *h, *hu, *hv;
    double keep, rate, dt, gravity, dry; /* rate: dt over the cell's edge */
} target;

/* The flux of momentum into a cell is the difference of (flux - pressure of the cell's own water at the face); the
   pressures and the weight of the water on its sloping bed together are g h times the slope of the surface, which is 0,
   without rounding, in water at rest. Returns the depth that was added to make depths positive, m. */
SB_MULTIVERSION static double finish_row(target t, rows r, bool flat, size_t count)
{
    const double *restrict slope_x = r.x.surface + 1, *restrict slope_y = r.y.surface;
    const fluxes e = r.flux_x, b = r.below, a = r.above;
    const double other = 1 - t.keep, both = flat ? 0 : 1;
    double repaired = 0;
#pragma omp simd reduction(+ : repaired)
    for (size_t i = 0; i < count; i++) {
        const double weight = 2 * t.gravity * t.in_h[i];
        double h = t.in_h[i] - t.rate * (e.volume[i + 1] - e.volume[i]);
        double hu = t.in_hu[i] - t.rate * (e.left[i + 1] - e.right[i] + weight * slope_x[i]);
        double hv = t.in_hv[i] - t.rate * (e.along[i + 1] - e.along[i]);
        if (!flat) {
            h -= t.rate * (a.volume[i] - b.volume[i]);
            hu -= t.rate * (a.along[i] - b.along[i]);
            hv -= t.rate * (a.left[i] - b.right[i] + weight * slope_y[i]);
        }
        if (t.force_x) {
            hu += t.dt * t.force_x[i];
            hv += t.dt * both * t.force_y[i];
        }
        h = t.keep * t.first_h[i] + other * h;
        const double held = most(h, 0), factor = held > t.dry ? 1 : 2 * held * held / (held * held + t.dry * t.dry);
        t.h[i] = held;
        t.hu[i] = factor * (t.keep * t.first_hu[i] + other * hu);
        t.hv[i] = factor * (t.keep * t.first_hv[i] + other * hv);
        repaired += held - h;
    }
    return repaired;
}

typedef struct stage {
    sb_offshore *offshore;
    const sb_offshore_update *update;
} stage;

static cells cells_at(const stage *s, size_t at, bool along_y)
{
    const sb_offshore *o = s->offshore;
    return (cells){s->update->in->h + at, o->surface + at, (along_y ? o->v : o->u) + at, (along_y ? o->u : o->v) + at};
}

static void finish(const stage *s, size_t j, const rows *r)
{
    sb_offshore *o = s->offshore;
    const sb_offshore_update *u = s->update;
    const size_t at = o->origin + j * o->stride, count = o->options.columns;
    const target t = {.first_h = u->first->h + at,
                      .first_hu = u->first->hu + at,
                      .first_hv = u->first->hv + at,
                      .in_h = u->in->h + at,
                      .in_hu = u->in->hu + at,
                      .in_hv = u->in->hv + at,
                      .force_x = o->force_x ? o->force_x + at : NULL,
                      .force_y = o->force_y ? o->force_y + at : NULL,
                      .h = u->out->h + at,
                      .hu = u->out->hu + at,
                      .hv = u->out->hv + at,
                      .keep = u->keep,
                      .rate = u->dt / o->options.cell,
                      .dt = u->dt,
                      .gravity = o->options.gravity,
                      .dry = o->options.dry_depth};
    o->line_repaired[j] = finish_row(t, *r, sb_offshore_flat(o), count);
    o->edge[2 * j] = r->flux_x.volume[0];
    o->edge[2 * j + 1] = -r->flux_x.volume[count];
}

static double *edges_along_y(const sb_offshore *offshore)
{
    return offshore->edge + 2 * offshore->lines;
}

/* Rows [from, to). A face between two threads' rows is computed by both, with the same bits. */
static void advance_rows(const stage *s, size_t from, size_t to, rows r)
{
    sb_offshore *o = s->offshore;
    const size_t columns = o->options.columns;
    const ptrdiff_t up = (ptrdiff_t)o->stride;
    const bool flat = sb_offshore_flat(o);
    const double g = o->options.gravity;
    if (!flat) {
        const cells under = cells_at(s, o->origin + from * o->stride - o->stride, true);
        const cells first = cells_at(s, o->origin + from * o->stride, true);
        find_slopes(under, up, r.next_y, columns);
        find_slopes(first, up, r.y, columns);
        find_fluxes(under, up, r.next_y, r.y, g, r.below, columns);
        if (from == 0) memcpy(edges_along_y(o), r.below.volume, columns * sizeof(double));
    }
    for (size_t j = from; j < to; j++) {
        const size_t at = o->origin + j * o->stride;
        const cells x = cells_at(s, at - 1, false);
        find_slopes(x, 1, r.x, columns + 2);
        const slopes high = {r.x.h + 1, r.x.surface + 1, r.x.across + 1, r.x.along + 1};
        find_fluxes(x, 1, r.x, high, g, r.flux_x, columns + 1);
        if (!flat) {
            find_slopes(cells_at(s, at + o->stride, true), up, r.next_y, columns);
            find_fluxes(cells_at(s, at, true), up, r.y, r.next_y, g, r.above, columns);
        }
        finish(s, j, &r);
        const slopes slope = r.y;
        r.y = r.next_y;
        r.next_y = slope;
        const fluxes flux = r.below;
        r.below = r.above;
        r.above = flux;
    }
    if (!flat && to == o->options.rows) memcpy(edges_along_y(o) + o->stride, r.below.volume, columns * sizeof(double));
}

/* Books the volume through the sides, in a fixed order. */
static void book(sb_offshore *o, const sb_offshore_update *update)
{
    const double share = (1 - update->keep) * update->dt * (sb_offshore_flat(o) ? 1 : o->options.cell);
    const double area = sb_offshore_flat(o) ? o->options.cell : o->options.cell * o->options.cell;
    double sum[SB_OFFSHORE_SIDES] = {0}, repaired = 0;
    for (size_t j = 0; j < o->options.rows; j++) {
        sum[SB_OFFSHORE_X_MIN] += o->edge[2 * j];
        sum[SB_OFFSHORE_X_MAX] += o->edge[2 * j + 1];
        repaired += o->line_repaired[j];
    }
    if (!sb_offshore_flat(o))
        for (size_t i = 0; i < o->options.columns; i++) {
            sum[SB_OFFSHORE_Y_MIN] += edges_along_y(o)[i];
            sum[SB_OFFSHORE_Y_MAX] -= edges_along_y(o)[o->stride + i];
        }
    /* Of what the first stage did, the second one keeps a part. */
    const double kept = update->keep > 0 ? 1 - update->keep : 0;
    for (int s = 0; s < SB_OFFSHORE_SIDES; s++) o->pending[s] *= kept;
    o->pending_repaired *= kept;
    for (int s = 0; s < SB_OFFSHORE_SIDES; s++) o->pending[s] += share * sum[s];
    o->pending_repaired += repaired * area;
}

void sb_offshore_advance(sb_offshore *offshore, const sb_offshore_update *update)
{
    const stage s = {offshore, update};
    const size_t rows_count = offshore->options.rows;
#pragma omp parallel num_threads(offshore->scratch_threads) if (offshore->cells > 20000)
    {
        const size_t threads = (size_t)omp_get_num_threads(), thread = (size_t)omp_get_thread_num();
        const size_t from = rows_count * thread / threads, to = rows_count * (thread + 1) / threads;
        if (from < to) advance_rows(&s, from, to, rows_of(offshore, (int)thread));
    }
    book(offshore, update);
}
