/* Slopes within cells and the flux through a face, without branches, so that loops over rows become vector code. */
#ifndef SB_OFFSHORE_FLUX_H
#define SB_OFFSHORE_FLUX_H

#include "base/multiversion.h"

#include <math.h>

SB_INLINE double least(double a, double b)
{
    return a < b ? a : b;
}

SB_INLINE double most(double a, double b)
{
    return a > b ? a : b;
}

/* Half the difference across a cell: monotonised central [van Leer 1977]. |result| is at most the distance to the
   nearer neighbour's value, so a depth at a face is never negative. */
SB_INLINE double half_slope(double before, double here, double after)
{
    const double a = here - before, b = after - here, centre = 0.25 * (a + b);
    return most(0, least(centre, least(a, b))) + least(0, most(centre, most(a, b)));
}

/* The state on one side of a face: depth, surface, velocity across and along the face. */
typedef struct face_side {
    double h, surface, across, along;
} face_side;

/* Volume per width and time; momentum across the face less the hydrostatic pressure of the water on each side; momentum
   along the face. */
typedef struct face_flux {
    double volume, left, right, along;
} face_flux;

/* Slowest and fastest wave [Fraccarollo & Toro 1995]: from the two-rarefaction state, and exact beside a dry side. */
SB_INLINE void wave_speeds(double hl, double ul, double hr, double ur, double gravity, double *slow, double *fast)
{
    const double cl = sqrt(gravity * hl), cr = sqrt(gravity * hr);
    const double u = 0.5 * (ul + ur) + cl - cr, c = 0.5 * (cl + cr) + 0.25 * (ul - ur);
    const double s = least(ul - cl, u - c), f = most(ur + cr, u + c);
    *slow = hl > 0 ? s : ur - 2 * cr;
    *fast = hr > 0 ? f : ul + 2 * cl;
    *slow = hr > 0 ? *slow : ul - cl;
    *fast = hl > 0 ? *fast : ur + cr;
}

/* HLLC [Toro 2001] between depths above the higher of the two beds [Audusse et al. 2004]. Written as the left flux and
   a jump, so that it is exact, without rounding, where surfaces are equal and velocities 0. */
SB_INLINE face_flux flux_between(face_side left, face_side right, double gravity)
{
    const double bed = most(left.surface - left.h, right.surface - right.h);
    const double hl = most(0, left.surface - bed), hr = most(0, right.surface - bed);
    double slow, fast;
    wave_speeds(hl, left.across, hr, right.across, gravity, &slow, &fast);
    slow = least(slow, 0);
    fast = most(fast, 0);
    const double ql = hl * left.across, qr = hr * right.across;
    const double jump_h = hr - hl, jump_q = qr - ql, pressure = 0.5 * gravity * (hl + hr) * jump_h;
    const double jump_f = qr * right.across - ql * left.across + pressure;
    const double scale = slow / (fast - slow + 1e-300);
    face_flux flux;
    flux.volume = ql + scale * (fast * jump_h - jump_q);
    flux.left = ql * left.across + scale * (fast * jump_q - jump_f);
    flux.right = flux.left - pressure;
    flux.along = flux.volume * (flux.volume > 0 ? left.along : right.along);
    return flux;
}

#endif
