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
