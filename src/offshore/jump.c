#include "offshore/jump.h"

#include "offshore/dispersion.h"
#include "offshore/stencil.h"

void sb_offshore_set_jumps(sb_offshore *offshore, const sb_offshore_jump *jumps, size_t count)
{
    offshore->jumps = jumps;
    offshore->jump_count = count;
}

/* Distance in memory from the cell outside to the one within. */
static ptrdiff_t inwards_of(const sb_offshore *o, const sb_offshore_jump *j)
{
    return j->sign * (j->axis == 0 ? 1 : (ptrdiff_t)o->stride);
}

static size_t outside_of(const sb_offshore *o, const sb_offshore_jump *j)
{
    return o->origin + j->row * o->stride + j->column;
}

static face_side side_of(const sb_offshore *o, const sb_offshore_jump *j, size_t at)
{
    const double h = o->now.h[at], scale = h > o->options.dry_depth ? 1 / h : 0;
    const double u = scale * o->now.hu[at], v = scale * o->now.hv[at];
    return (face_side){h, h + o->bed[at], j->axis == 0 ? u : v, j->axis == 0 ? v : u};
}

/* The same water with the wave, or without it. */
static face_side with_wave(face_side water, const sb_offshore_wave *wave, double add, int sign)
{
    const double h = most(water.h + add * wave->surface, 0);
    return (face_side){h, water.surface + h - water.h, water.across + add * sign * wave->inwards, water.along};
}

/* Adds a flux through the face, less the one that the scheme has found, to the cell before it or after it. */
static void add_flux(sb_offshore *o, const sb_offshore_jump *j, size_t column, size_t row, bool after, face_flux wanted,
                     face_flux found, double rate)
{
    const double sign = after ? rate : -rate, volume = sign * (wanted.volume - found.volume);
    const double across = sign * (after ? wanted.right - found.right : wanted.left - found.left);
    const double along = sign * (wanted.along - found.along);
    sb_offshore_add(o, column, row, volume, j->axis == 0 ? across : along, j->axis == 0 ? along : across);
}

/* The scheme has found the flux between the water outside and that within, whose difference is not a wave. Each cell
   gets the one that it would have found if its part of the grid had continued. */
void sb_offshore_jump_fluxes(sb_offshore *offshore, double dt)
{
    const double g = offshore->options.gravity, rate = dt / offshore->options.cell;
    for (size_t k = 0; k < offshore->jump_count; k++) {
        const sb_offshore_jump *j = &offshore->jumps[k];
        const size_t at = outside_of(offshore, j);
        const face_side outside = side_of(offshore, j, at);
        const face_side within = side_of(offshore, j, (size_t)((ptrdiff_t)at + inwards_of(offshore, j)));
        const face_side beyond = with_wave(within, &j->within, 1, j->sign),
                        source = with_wave(outside, &j->outside, -1, j->sign);
        const bool up = j->sign > 0;
        if (j->outside.surface == 0 && j->within.surface == 0) continue;
        const face_flux found = up ? flux_between(outside, within, g) : flux_between(within, outside, g);
        const face_flux all = up ? flux_between(outside, beyond, g) : flux_between(beyond, outside, g);
        const face_flux part = up ? flux_between(source, within, g) : flux_between(within, source, g);
        const size_t column = (size_t)((ptrdiff_t)j->column + (j->axis == 0 ? j->sign : 0));
        const size_t row = (size_t)((ptrdiff_t)j->row + (j->axis == 1 ? j->sign : 0));
        add_flux(offshore, j, j->column, j->row, !up, all, found, rate);
        add_flux(offshore, j, column, row, up, part, found, rate);
    }
}

void sb_offshore_jump_breaking(const sb_offshore *offshore)
{
    for (size_t k = 0; k < offshore->jump_count; k++) {
        const sb_offshore_jump *j = &offshore->jumps[k];
        const size_t outside = outside_of(offshore, j);
        offshore->dispersion->breaking[outside] = 0;
        offshore->dispersion->breaking[(ptrdiff_t)outside + inwards_of(offshore, j)] = 0;
    }
}

/* The values around one cell. */
enum { BED, H, SURFACE, U, V, ACTIVE, EAST, NORTH, SCALE, UNKNOWN, RESIDUAL, PRESSURE, EARLIER, ARRAYS };

static void copy_around(const double *from, ptrdiff_t up, double to[9])
{
    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++) to[4 + 3 * j + i] = from[j * up + i];
}

/* Assembles the cell `at` anew, with the wave added to its neighbours beyond the face, which lies at `towards` (1 or
   -1) along the axis. add: 1 for the cell outside, -1 for the one within. */
static void assemble_beside(const sb_offshore *o, const sb_offshore_level *level, const sb_offshore_jump *j, size_t at,
                            int towards, double add, double ahead)
{
    const struct sb_offshore_dispersion *d = o->dispersion;
    const sb_offshore_system *s = &d->system;
    const double *const from[ARRAYS] = {o->bed,   level->h, o->surface, o->u,        o->v,        d->active, s->east,
                                        s->north, s->scale, s->unknown, s->residual, d->pressure, d->earlier};
    const bool flat = sb_offshore_flat(o);
    const sb_offshore_wave *wave = add > 0 ? &j->within : &j->outside;
    double v[ARRAYS][9];
    for (int k = 0; k < ARRAYS; k++) copy_around(from[k] + at, flat ? 0 : (ptrdiff_t)o->stride, v[k]);
    for (int side = -1; side <= 1; side++) {
        const int beyond = j->axis == 0 ? 4 + 3 * side + towards : 4 + 3 * towards + side;
        v[H][beyond] = most(v[H][beyond] + add * wave->surface, 0);
        v[SURFACE][beyond] += add * wave->surface;
        v[j->axis == 0 ? U : V][beyond] += add * j->sign * wave->inwards;
    }
    const line l = {.bed = v[BED] + 4,
                    .h = v[H] + 4,
                    .surface = v[SURFACE] + 4,
                    .u = v[U] + 4,
                    .v = v[V] + 4,
                    .active = v[ACTIVE] + 4,
                    .east = v[EAST] + 4,
                    .north = v[NORTH] + 4,
                    .scale = v[SCALE] + 4,
                    .unknown = v[UNKNOWN] + 4,
                    .residual = v[RESIDUAL] + 4,
                    .pressure = v[PRESSURE] + 4,
                    .earlier = v[EARLIER] + 4,
                    .gravity = o->options.gravity,
                    .cell = o->options.cell,
                    .up = flat ? 0 : 3};
    assemble_cell(l, 0, ahead, 0.5 / l.cell, 1 / (l.cell * l.cell));
    const int before = towards < 0;
    const double coupling = j->axis == 0 ? s->east[at - (size_t)before] : s->north[at - (before ? o->stride : 0)];
    s->residual[at] = *l.residual + *l.scale * coupling * add * wave->pressure;
}

void sb_offshore_jump_system(const sb_offshore *offshore, const sb_offshore_level *level, double ahead)
{
    for (size_t k = 0; k < offshore->jump_count; k++) {
        const sb_offshore_jump *j = &offshore->jumps[k];
        const size_t outside = outside_of(offshore, j);
        assemble_beside(offshore, level, j, outside, j->sign, 1, ahead);
        assemble_beside(offshore, level, j, (size_t)((ptrdiff_t)outside + inwards_of(offshore, j)), -j->sign, -1,
                        ahead);
    }
}

/* Differences of the pressure reach across the face from both sides. */
void sb_offshore_jump_forces(const sb_offshore *offshore)
{
    for (size_t k = 0; k < offshore->jump_count; k++) {
        const sb_offshore_jump *j = &offshore->jumps[k];
        const size_t at[] = {outside_of(offshore, j),
                             (size_t)((ptrdiff_t)outside_of(offshore, j) + inwards_of(offshore, j))};
        double *force = j->axis == 0 ? offshore->force_x : offshore->force_y;
        for (int n = 0; n < 2; n++)
            if (offshore->dispersion->active[at[n]] >= 0)
                force[at[n]] -= j->sign * (n == 0 ? j->within : j->outside).pressure * (0.5 / offshore->options.cell);
    }
}
