#include "sim/passes/cpu/cpu.h"
#include "sim/passes/cpu/drag.h"
#include "sim/passes/cpu/eights.h"
#include "sim/passes/cpu/wall_finder.h"
#include "sim/passes/groups.h"
#include "sim/step/settle.h"

/* Arguments of the pass. */
typedef struct all_terms {
    const sb_viscous *viscous;
    const sb_wall_drag *law;
    const sb_wall_search *search;
    unsigned *full; /* limits that a finder of walls exceeded */
} all_terms;

/* The values of a particle itself in its pairs, repeated in all lanes. */
typedef struct own_part {
    sb_f8 x, y, z, density;
    sb_f8 u, v, w, eddy;
} own_part;

/* Eight pairs: the offsets, and their factors. */
typedef struct eight_pairs {
    sb_f8 x, y, z, pi;
} eight_pairs;

SB_INLINE eight_pairs find_pairs(const own_part *own, const sb_f4 *around, const sb_four_pairs *one,
                                 const sb_four_pairs *other, const sb_viscous *f, bool eddies)
{
    const sb_eight at = sb_eight_with(around, one, other, 0), of = sb_eight_with(around, one, other, 1);
    const sb_f8 x = own->x - at.x, y = own->y - at.y, z = own->z - at.z;
    const sb_f8 u = own->u - of.x, v = own->v - of.y, w = own->w - of.z;
    const sb_f8 weight = sb_eight_slopes(one, other);
    const sb_f8 approach = u * x + v * y + w * z;
    const sb_f8 r2 = x * x + y * y + z * z;
    sb_f8 physical = sb_splat8(f->physical);
    if (eddies) physical += (own->eddy + of.w) * sb_splat8(f->eddy);
    const sb_f8 factor = sb_select8(approach < (sb_f8){0}, physical + sb_splat8(f->artificial), physical);
    const sb_f8 both = own->density + at.w;
    return (eight_pairs){x, y, z, factor * approach * weight / ((r2 + sb_splat8(f->epsilon)) * both)};
}

/* -sum_j m Pi_ij grad W_ij, eight neighbours at a time, added up four after four. around: output of sb_around_with for
   the velocities, with densities in the last lane of the records. x . v and r^2 are in quanta; their quotient is
   converted by 1/quantum. eddies: the last lane of the velocities contains sim->work.eddy. */
SB_INLINE sb_f4 fluid_part(const sb_sim *sim, const sb_group *group, const sb_f4 *around, size_t i, const sb_viscous *f,
                           bool eddies)
{
    const sb_f4 at = sb_in_group(sim, group, i), of = sim->state.velocity[i];
    const own_part own = {
        sb_spread(at, 0), sb_spread(at, 1), sb_spread(at, 2), sb_spread(at, 3),
        sb_spread(of, 0), sb_spread(of, 1), sb_spread(of, 2), sb_splat8(eddies ? sim->work.eddy[i] : 0)};
    const sb_four_pairs *four = sim->work.pairs.four + sim->work.pairs.first[i],
                        *end = four + sb_direct(&sim->work.pairs, i);
    sb_f4 x = {0}, y = {0}, z = {0};
    for (; four < end; four += 2) {
        const bool two = four + 1 < end;
        const eight_pairs e = find_pairs(&own, around, four, two ? four + 1 : four, f, eddies);
        x += sb_first4(e.x) * sb_first4(e.pi);
        y += sb_first4(e.y) * sb_first4(e.pi);
        z += sb_first4(e.z) * sb_first4(e.pi);
        if (!two) break;
        x += sb_second4(e.x) * sb_second4(e.pi);
        y += sb_second4(e.y) * sb_second4(e.pi);
        z += sb_second4(e.z) * sb_second4(e.pi);
    }
    const sb_four sum = sb_transpose(x, y, z, (sb_f4){0});
    return (sum.x + sum.y + sum.z + sum.w) * sb_splat(sim->work.pairs.unit * f->inverse_quantum);
}

SB_INLINE sb_f4 wall_part(const sb_sim *sim, size_t i, sb_wall_list walls, const sb_wall_drag *law)
{
    sb_f4 sum = {0}, part[4];
    for (size_t k = 0; k < walls.count; k += 4) {
        sb_wall_drag_four(sim, i, sim->state.velocity[i], walls.index + k, walls.slope + k, law, part);
        for (int pair = 0; pair < 4; pair++) sum += part[pair];
    }
    return sum;
}

/* The drag of walls on particle i, which is kept for the forces on bodies. */
SB_INLINE sb_f4 drag_part(const sb_sim *sim, size_t i, sb_wall_finder *finder, const sb_wall_drag *law)
{
    const sb_wall_list walls = sb_wall_list_of(sim, finder, i);
    if (sim->work.wall_body) sim->work.wall_body[i] = sb_wall_list_body(sim, walls);
    if (walls.count == 0) return (sb_f4){0};
    return sim->work.wall_drag[i] = wall_part(sim, i, walls, law);
}

SB_MULTIVERSION
static void do_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    const all_terms *terms = arguments;
    const sb_viscous *f = terms->viscous;
    const sb_wall_drag *law = terms->law;
    const bool viscous = f->on;
    _Alignas(64) sb_f4 around[2 * SB_AROUND_MAX];
    const float dt = (float)sim->state.time_step;
    sb_f4 *next = sim->work.predicted;
    sb_wall_finder finder;
    sb_wall_finder_begin(&finder, terms->search);
    if (viscous) sb_around_with(sim, group, sim->state.velocity, around);
    if (sim->work.eddy) sb_around_last(sim, group, sim->work.eddy, around);
    for (size_t i = group->first; i < group->end; i++) {
        sb_f4 a = {sim->policy->holds_wave ? sb_settle_wave_acceleration(sim, sim->state.position[i]) : 0, 0,
                   -sim->constant.gravity, 0};
        if (sim->work.eddy)
            a += fluid_part(sim, group, around, i, f, true);
        else if (viscous)
            a += fluid_part(sim, group, around, i, f, false);
        const sb_f4 push =
            sim->work.image_push ? sim->work.image_push[i] : (sb_f4){0}; /* its memory becomes wall_drag */
        if (law->on) a += drag_part(sim, i, &finder, law);
        if (sim->work.image_push) a += push;
        a[3] = 0;
        next[i] = sim->state.velocity[i] + a * sb_splat(dt);
    }
    if (finder.full) __atomic_fetch_or(terms->full, finder.full, __ATOMIC_RELAXED);
}

sb_status sb_cpu_forces(sb_sim *sim, const sb_viscous *viscous, const sb_wall_drag *law, sb_error *error)
{
    unsigned full = 0;
    const sb_wall_search search = sb_wall_search_of(sim);
    const all_terms terms = {viscous, law, &search, &full};
    sb_each_group(sim, do_group, &terms);
    return sb_wall_finder_refuse(sim, full, error);
}
