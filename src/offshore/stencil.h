/* The system for the pressure, one cell at a time. Private to src/offshore. */
#ifndef SB_OFFSHORE_STENCIL_H
#define SB_OFFSHORE_STENCIL_H

#include "offshore/flux.h"
#include "offshore/state.h"

#include <stddef.h>

/* Slopes of the bed are at most this where there is a pressure; bends count as such a slope over a cell or over the
   depth at most. */
static const double STEEPEST = SB_OFFSHORE_STEEPEST;

/* One row of cells, of which all pointers are at column 0. */
typedef struct line {
    const double *bed, *h, *surface, *u, *v, *active;
    double *east, *north, *scale, *unknown, *residual, *pressure, *earlier, *force_x, *force_y;
    double gravity, cell;
    ptrdiff_t up; /* to the next row; 0 with one row, so that differences along y are 0 */
} line;

SB_INLINE double clamp(double value, double limit)
{
    return least(most(value, -limit), limit);
}

/* Slope of the bed between the cells `step` before and after. */
SB_INLINE double bed_slope(line l, ptrdiff_t i, ptrdiff_t step)
{
    return clamp((l.bed[i + step] - l.bed[i - step]) * (0.5 / l.cell), STEEPEST);
}

/* Second derivative of the bed along one axis. */
SB_INLINE double bed_bend(line l, ptrdiff_t i, ptrdiff_t step)
{
    return clamp((l.bed[i + step] - 2 * l.bed[i] + l.bed[i - step]) / (l.cell * l.cell),
                 STEEPEST / most(l.cell, l.h[i]));
}

/* G. */
SB_INLINE double bed_rate(line l, ptrdiff_t i)
{
    const double u = l.u[i], v = l.v[i], *b = l.bed + i, *s = l.surface + i;
    const double twist = clamp((b[l.up + 1] - b[l.up - 1] - b[1 - l.up] + b[-l.up - 1]) / (4 * l.cell * l.cell),
                               STEEPEST / most(l.cell, l.h[i]));
    const double fall = (s[1] - s[-1]) * bed_slope(l, i, 1) + (s[l.up] - s[-l.up]) * bed_slope(l, i, l.up);
    return -l.gravity * fall * (0.5 / l.cell) + u * u * bed_bend(l, i, 1) + 2 * u * v * twist +
           v * v * bed_bend(l, i, l.up);
}

/* Scale, right-hand side and first unknown of a cell. `ahead` extrapolates the pressure in time. half: 1 / (2 cell),
   square: 1 / cell^2. */
SB_INLINE void assemble_cell(line l, ptrdiff_t i, double ahead, double half, double square)
{
    const double h = most(l.h[i], 1e-100), in = 1 / h;
    const double bx = bed_slope(l, i, 1), by = bed_slope(l, i, l.up);
    const double bend = bed_bend(l, i, 1) + bed_bend(l, i, l.up);
    const double ux = (l.u[i + 1] - l.u[i - 1]) * half, vx = (l.v[i + 1] - l.v[i - 1]) * half;
    const double uy = (l.u[i + l.up] - l.u[i - l.up]) * half, vy = (l.v[i + l.up] - l.v[i - l.up]) * half;
    const double hx = (l.h[i + 1] - l.h[i - 1]) * half, hy = (l.h[i + l.up] - l.h[i - l.up]) * half;
    const double *s = l.surface + i;
    const double laplacian = (s[1] - 2 * s[0] + s[-1] + s[l.up] - 2 * s[0] + s[-l.up]) * square;
    const double q = ux * ux + vy * vy + ux * vy + uy * vx;
    const double right = l.gravity * laplacian + 2 * q + 1.5 * in * bed_rate(l, i);
    const double e = clamp(0.5 * h * bend - bx * hx - by * hy - 0.75 * (bx * bx + by * by), 0.5);
    const double diagonal = 3 * (1 - e) * in * in * in + l.east[i] + l.east[i - 1] + l.north[i] + l.north[i - l.up];
    const double root = sqrt(diagonal), scale = l.active[i] > 0 ? 1 / root : 0;
    const double pressure = l.pressure[i] + ahead * (l.pressure[i] - l.earlier[i]);
    l.scale[i] = scale;
    l.residual[i] = scale > 0 ? right * scale : 0;
    l.unknown[i] = scale > 0 ? pressure * root : 0;
}

#endif
