/* Fluxes beside the faces between two parts of the grid, in each stage of a step. The scheme has found the fluxes of
   water whose jump at the face is no wave. Here each part gets the fluxes that it would have if it continued beyond the
   face: the water there is that of the other part with the wave added, seen from outside, or taken away, seen from
   within. Slopes beside the face are those of the continued part, so that the scheme keeps its order. */
#include "offshore/flux.h"
#include "offshore/jump.h"

/* Cells across a face, by their index along the axis; the face is between the third and the fourth. */
enum { LOW = 2, HIGH = 3, ACROSS = 6 };

typedef struct stencil {
    size_t at[ACROSS];
    face_side cell[ACROSS];
    sb_offshore_wave wave[ACROSS]; /* not of the first and the last cell */
    double velocity[ACROSS];       /* m/s along the axis, of the wave */
    bool low_outside;
} stencil;

/* Values of a cell, and half of their change across it. */
typedef struct sloped {
    face_side here, slope;
} sloped;

/* What a part of the grid sees: the face beside the line, the line itself, and the slope of its cell at the line. */
typedef struct view {
    face_flux beside, line;
    double slope;
} view;

static stencil stencil_of(const sb_offshore *o, const sb_offshore_level *in, const sb_offshore_jump *j)
{
    const bool up = j->sign > 0;
    const size_t step = j->axis == 0 ? 1 : o->stride;
    const size_t outside = o->origin + j->row * o->stride + j->column, low = up ? outside : outside - step;
    const sb_offshore_wave wave[ACROSS] = {[1] = up ? j->outer : j->inner,
                                           [2] = up ? j->outside : j->within,
                                           [3] = up ? j->within : j->outside,
                                           [4] = up ? j->inner : j->outer};
    stencil s = {.low_outside = up};
    for (int k = 0; k < ACROSS; k++) {
        const size_t at = low + (size_t)k * step - LOW * step;
        s.at[k] = at;
        s.cell[k] = (face_side){in->h[at], o->surface[at], j->axis == 0 ? o->u[at] : o->v[at],
                                j->axis == 0 ? o->v[at] : o->u[at]};
        s.wave[k] = wave[k];
        s.velocity[k] = j->sign * wave[k].inwards;
    }
    return s;
}

/* Adds the wave to the cells from..from + 1, or takes it away. */
static void add_wave(stencil *s, int from, double add)
{
    for (int k = from; k < from + 2; k++) {
        const double h = most(s->cell[k].h + add * s->wave[k].surface, 0);
        s->cell[k].surface += h - s->cell[k].h;
        s->cell[k].h = h;
        s->cell[k].across += add * s->velocity[k];
    }
}

static sloped slope_at(const stencil *s, int k)
{
    const face_side a = s->cell[k - 1], b = s->cell[k], c = s->cell[k + 1];
    return (sloped){b,
                    {half_slope(a.h, b.h, c.h), half_slope(a.surface, b.surface, c.surface),
                     half_slope(a.across, b.across, c.across), half_slope(a.along, b.along, c.along)}};
}

static face_side face_of(sloped c, double sign)
{
    return (face_side){c.here.h + sign * c.slope.h, c.here.surface + sign * c.slope.surface,
                       c.here.across + sign * c.slope.across, c.here.along + sign * c.slope.along};
}

static face_flux flux_after(const stencil *s, int k, double gravity)
{
    return flux_between(face_of(slope_at(s, k), 1), face_of(slope_at(s, k + 1), -1), gravity);
}

/* What the part below the face sees, or the part above it. */
static view look(const stencil *s, bool from_low, double gravity)
{
    return (view){.beside = flux_after(s, from_low ? LOW - 1 : HIGH, gravity),
                  .line = flux_after(s, LOW, gravity),
                  .slope = slope_at(s, from_low ? LOW : HIGH).slope.surface};
}

/* Whether a cell of the stencil is one of the grid, and not beyond its sides. */
static bool in_grid(const sb_offshore *o, const sb_offshore_jump *j, int steps_outwards)
{
    const long steps = (long)j->sign * steps_outwards;
    const long at = (long)(j->axis == 0 ? j->column : j->row) - steps;
    return at >= 0 && at < (long)(j->axis == 0 ? o->options.columns : o->options.rows);
}

/* The changes of a cell. */
typedef struct change {
    double volume, across, along;
} change;

static void apply(sb_offshore *o, const sb_offshore_level *out, const sb_offshore_jump *j, size_t at, change c,
                  double share)
{
    const double before = out->h[at], after = most(before + share * c.volume, 0);
    const double area = sb_offshore_flat(o) ? o->options.cell : o->options.cell * o->options.cell;
    out->h[at] = after;
    out->hu[at] += share * (j->axis == 0 ? c.across : c.along);
    if (!sb_offshore_flat(o)) out->hv[at] += share * (j->axis == 0 ? c.along : c.across);
    o->pending_added += area * (after - before);
}

/* Sets what one part sees instead of what the scheme has found. */
static void correct(sb_offshore *o, const sb_offshore_update *u, const sb_offshore_jump *j, const stencil *s, bool low)
{
    const double g = o->options.gravity, rate = u->dt / o->options.cell, share = 1 - u->keep;
    const int line = low ? LOW : HIGH, next = low ? LOW - 1 : HIGH + 1;
    const double away = low ? 1 : -1; /* sign of what a flux along the axis through the line takes from the part */
    stencil with = *s;
    add_wave(&with, low ? HIGH : LOW - 1, low == s->low_outside ? 1 : -1);
    const view found = look(s, low, g), wanted = look(&with, low, g);
    const double volume = wanted.line.volume - found.line.volume, along = wanted.line.along - found.line.along;
    const double across = low ? wanted.line.left - found.line.left : wanted.line.right - found.line.right;
    const double weight = 2 * g * s->cell[line].h * (wanted.slope - found.slope);
    apply(o, u->out, j, s->at[line],
          (change){-away * rate * volume, -rate * (away * across + weight), -away * rate * along}, share);
    if (!in_grid(o, j, low == s->low_outside ? 1 : -2)) return;
    const double far_volume = away * rate * (wanted.beside.volume - found.beside.volume);
    const double far_along = away * rate * (wanted.beside.along - found.beside.along);
    const double left = rate * (wanted.beside.left - found.beside.left),
                 right = rate * (wanted.beside.right - found.beside.right);
    apply(o, u->out, j, s->at[line], (change){far_volume, low ? right : -left, far_along}, share);
    apply(o, u->out, j, s->at[next], (change){-far_volume, low ? -left : right, -far_along}, share);
}

static bool is_still(const sb_offshore_wave *w)
{
    return w->surface == 0 && w->inwards == 0;
}

void sb_offshore_jump_fluxes(sb_offshore *offshore, const sb_offshore_update *update)
{
    offshore->pending_added *= update->keep > 0 ? 1 - update->keep : 0;
    for (size_t k = 0; k < offshore->jump_count; k++) {
        const sb_offshore_jump *j = &offshore->jumps[k];
        if (is_still(&j->outer) && is_still(&j->outside) && is_still(&j->within) && is_still(&j->inner)) continue;
        const stencil s = stencil_of(offshore, update->in, j);
        correct(offshore, update, j, &s, true);
        correct(offshore, update, j, &s, false);
    }
}
