/* The Serre-Green-Naghdi equations over a bed, as one equation for the depth-integrated non-hydrostatic pressure P over
   density. With the velocity constant over depth, the vertical acceleration at the height s h above the bed is
   b'' + s h'' (' is the rate that moves with the water), so that

       P = h^2 (b''/2 + h''/3),    pressure at the bed p = 3 P / (2 h) + h b''/4,
       d(hu)/dt = ... - grad P - p grad b,    h'' = -h div a + 2 h Q,    b'' = a . grad b + u . (grad grad b) . u,

   where a is the acceleration of the water and Q = (div u)^2 - det(grad u). Without terms of second order in the slope
   of the bed in the coupling between cells, this is the symmetric system

       3 (1 - e) P / h^3 - div(grad P / h) = g div grad(h + b) + 2 Q + 3 G / (2 h),
       G = -g grad(h + b) . grad b + u . (grad grad b) . u,
       e = h div grad b / 2 - grad b . grad h - 3 |grad b|^2 / 4.

   docs/offshore.md derives it. */
#include "offshore/dispersion.h"
#include "base/memory.h"
#include "offshore/jump.h"
#include "offshore/paddle.h"
#include "offshore/stencil.h"

#include <string.h>

/* Relative residual at which a solve ends. */
static const double TOLERANCE = 1e-3;

/* In last steps: the farthest that the pressure is extrapolated in time. */
static const double FARTHEST = 2;

size_t sb_offshore_dispersion_bytes(size_t cells)
{
    return 11 * cells * sizeof(double);
}

sb_status sb_offshore_dispersion_create(const sb_offshore *offshore, struct sb_offshore_dispersion **dispersion,
                                        sb_error *error)
{
    struct sb_offshore_dispersion *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "the dispersive model");
    sb_offshore_system *s = &made->system;
    double **arrays[] = {&s->east,    &s->north,       &s->scale,      &s->unknown,   &s->residual,   &s->direction,
                         &s->product, &made->pressure, &made->earlier, &made->active, &made->breaking};
    sb_status status = SB_OK;
    for (size_t k = 0; status == SB_OK && k < sizeof arrays / sizeof *arrays; k++) {
        *arrays[k] = sb_alloc(offshore->cells, sizeof(double));
        if (!*arrays[k]) status = sb_fail_memory(error, "the dispersive model");
    }
    s->line_sum = sb_alloc(offshore->lines, sizeof(double));
    if (status == SB_OK && !s->line_sum) status = sb_fail_memory(error, "the dispersive model");
    if (status != SB_OK) {
        sb_offshore_dispersion_destroy(made);
        return status;
    }
    *dispersion = made;
    return SB_OK;
}

void sb_offshore_dispersion_destroy(struct sb_offshore_dispersion *dispersion)
{
    if (!dispersion) return;
    const sb_offshore_system *s = &dispersion->system;
    double *const arrays[] = {s->east,
                              s->north,
                              s->scale,
                              s->unknown,
                              s->residual,
                              s->direction,
                              s->product,
                              s->line_sum,
                              dispersion->pressure,
                              dispersion->earlier,
                              dispersion->active,
                              dispersion->breaking};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) sb_free(arrays[k]);
    sb_free(dispersion);
}

static line line_at(const sb_offshore *o, const sb_offshore_level *level, size_t j)
{
    const struct sb_offshore_dispersion *d = o->dispersion;
    const size_t at = o->origin + j * o->stride;
    return (line){.bed = o->bed + at,
                  .h = level->h + at,
                  .surface = o->surface + at,
                  .u = o->u + at,
                  .v = o->v + at,
                  .active = d->active + at,
                  .east = d->system.east + at,
                  .north = d->system.north + at,
                  .scale = d->system.scale + at,
                  .unknown = d->system.unknown + at,
                  .residual = d->system.residual + at,
                  .pressure = d->pressure + at,
                  .earlier = d->earlier + at,
                  .force_x = o->force_x + at,
                  .force_y = o->force_y + at,
                  .gravity = o->options.gravity,
                  .cell = o->options.cell,
                  .up = sb_offshore_flat(o) ? 0 : (ptrdiff_t)o->stride};
}

/* 1 / (h cell^2) at the faces to the next cell along x and y. */
SB_MULTIVERSION static void find_faces(line l, size_t count)
{
    const double square = 2 / (l.cell * l.cell), both = l.up ? 1 : 0;
#pragma omp simd
    for (ptrdiff_t i = -1; i < (ptrdiff_t)count; i++) {
        l.east[i] = square / most(l.h[i] + l.h[i + 1], 1e-100);
        l.north[i] = both * square / most(l.h[i] + l.h[i + l.up], 1e-100);
    }
}

/* Scale, right-hand side and first unknown of a row. `ahead` extrapolates the pressure in time. */
SB_MULTIVERSION static void assemble(line l, double ahead, size_t count)
{
    const double half = 0.5 / l.cell, square = 1 / (l.cell * l.cell);
#pragma omp simd
    for (ptrdiff_t i = 0; i < (ptrdiff_t)count; i++) assemble_cell(l, i, ahead, half, square);
}

SB_MULTIVERSION static void scale_faces(line l, size_t count)
{
#pragma omp simd
    for (ptrdiff_t i = -1; i < (ptrdiff_t)count; i++) {
        l.east[i] *= l.scale[i] * l.scale[i + 1];
        l.north[i] *= l.scale[i] * l.scale[i + l.up];
    }
}

SB_MULTIVERSION static void find_pressure(line l, size_t count)
{
#pragma omp simd
    for (size_t i = 0; i < count; i++) l.pressure[i] = l.unknown[i] * l.scale[i];
}

SB_MULTIVERSION static void find_forces(line l, size_t count)
{
    const double half = 0.5 / l.cell;
#pragma omp simd
    for (ptrdiff_t i = 0; i < (ptrdiff_t)count; i++) {
        const double h = most(l.h[i], 1e-100);
        const double bx = bed_slope(l, i, 1), by = bed_slope(l, i, l.up);
        const double px = (l.pressure[i + 1] - l.pressure[i - 1]) * half;
        const double py = (l.pressure[i + l.up] - l.pressure[i - l.up]) * half;
        const double loaded = l.active[i] >= 0 ? 1 : 0, active = l.active[i] > 0 ? 1 : 0;
        const double bottom = active * (1.5 * l.pressure[i] / h + 0.25 * (h * bed_rate(l, i) - px * bx - py * by));
        l.force_x[i] = -loaded * (px + bottom * bx);
        l.force_y[i] = -loaded * (py + bottom * by);
    }
}

/* No pressure gradient across a side, except through periodic ones. */
static void close_sides(const sb_offshore *o)
{
    const sb_offshore_system *s = &o->dispersion->system;
    const size_t stride = o->stride;
    if (o->options.side[SB_OFFSHORE_X_MIN] != SB_OFFSHORE_PERIODIC)
        for (size_t j = 0; j < o->options.rows; j++) {
            s->east[o->origin + j * stride - 1] = 0;
            s->east[o->origin + j * stride + o->options.columns - 1] = 0;
        }
    if (sb_offshore_flat(o) || o->options.side[SB_OFFSHORE_Y_MIN] == SB_OFFSHORE_PERIODIC) return;
    memset(s->north + o->origin - stride, 0, o->options.columns * sizeof(double));
    memset(s->north + o->origin + (o->options.rows - 1) * stride, 0, o->options.columns * sizeof(double));
}

typedef enum act { FACES, ASSEMBLE, SCALE, PRESSURE, FORCES } act;

static void on_rows(const sb_offshore *o, const sb_offshore_level *level, act what, double ahead)
{
    const size_t count = o->options.columns;
    const long first = !sb_offshore_flat(o) && (what == FACES || what == SCALE) ? -1 : 0; /* faces below row 0 */
#pragma omp parallel for schedule(static) if (o->cells > 20000)
    for (long j = first; j < (long)o->options.rows; j++) {
        const line l = line_at(o, level, (size_t)j);
        if (what == FACES) find_faces(l, count);
        if (what == ASSEMBLE) assemble(l, ahead, count);
        if (what == SCALE) scale_faces(l, count);
        if (what == PRESSURE) find_pressure(l, count);
        if (what == FORCES) find_forces(l, count);
    }
}

sb_status sb_offshore_find_dispersion(sb_offshore *offshore, const sb_offshore_level *level, int stage, double dt,
                                      sb_error *error)
{
    struct sb_offshore_dispersion *d = offshore->dispersion;
    sb_offshore_mark_active(offshore, level, stage == 0);
    on_rows(offshore, level, FACES, 0);
    close_sides(offshore);
    /* The second stage of the last step was at the time of this one's first stage. A last step much shorter than this
       one, as that to the end of a run is, says little of the change ahead: it is the difference of two solves. */
    const double ahead = stage == 1 && d->last_dt > 0 ? fmin(dt / d->last_dt, FARTHEST) : 0;
    on_rows(offshore, level, ASSEMBLE, ahead);
    sb_offshore_jump_system(offshore, level, ahead);
    if (offshore->options.paddle) sb_offshore_paddle_system(offshore, level, d->system.scale, d->system.residual);
    if (stage == 1) memcpy(d->earlier, d->pressure, offshore->cells * sizeof *d->earlier);
    sb_offshore_wrap(offshore, d->system.scale, 0);
    on_rows(offshore, level, SCALE, 0);
    const int iterations = sb_offshore_solve(offshore, &d->system, TOLERANCE);
    if (iterations < 0)
        return sb_fail(error, SB_FAILED, "offshore: t = %g s: the solve for the dispersive pressure did not converge",
                       offshore->time);
    on_rows(offshore, level, PRESSURE, 0);
    sb_offshore_wrap(offshore, d->pressure, 1);
    if (offshore->options.paddle) sb_offshore_paddle_beyond(offshore, level, d->system.scale, d->pressure);
    on_rows(offshore, level, FORCES, 0);
    sb_offshore_jump_forces(offshore);
    d->iterations = (stage == 0 ? 0 : d->iterations) + (uint64_t)iterations;
    if (stage == 1) d->last_dt = dt;
    return SB_OK;
}

void sb_offshore_dispersion_effort(const sb_offshore *offshore, uint64_t *iterations, size_t *breaking)
{
    const struct sb_offshore_dispersion *d = offshore->dispersion;
    *iterations = d->iterations;
    *breaking = 0;
    for (size_t j = 0; j < offshore->options.rows; j++)
        for (size_t i = 0; i < offshore->options.columns; i++)
            *breaking += d->breaking[offshore->origin + j * offshore->stride + i] > 0;
}
