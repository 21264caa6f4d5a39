/* Forces of the water on bodies over one step: the reaction to every wall term that accelerated the water
   [A12, eq. 10]. The momenta of water and bodies therefore balance to round-off. */
#include "sim/contact.h"
#include "sim/ledger.h"
#include "sim/stages.h"
#include "sim/wall_drag.h"
#include "sim/wall_entry.h"

#include <string.h>

enum { VALUES = 9 }; /* per body: pressure and friction, N, and moment, N m: three components each */

/* Vector from an image of a boundary particle to the original. A force across a periodic side acts on the original. */
static sb_vec3 to_original(const sb_space *space, sb_record image)
{
    return sb_sub(sb_space_position(space, sb_space_wrap(space, image)), sb_space_position(space, image));
}

/* Force of one fluid particle on one body: sums over consecutive boundary particles of the body in the particle's list,
   of slope times offset and of the drag. The force acts at the fluid particle, shifted to the original where it meets
   an image. A force along the line to a boundary particle has the same moment there. Shear is not along that line;
   acting at the fluid particle it keeps the moments of water and bodies balanced. */
typedef struct tally {
    const sb_sim *sim;
    double *sum, press, mass; /* sum[body][VALUES]; press: m q */
    sb_vec3 at, shift;        /* m: of the fluid particle, and to the original */
    uint32_t body;
    sb_f4 pushed, drag;
} tally;

static sb_vec3 vector(sb_f4 v, double scale)
{
    return sb_vec(scale * (double)v[0], scale * (double)v[1], scale * (double)v[2]);
}

static void add_to(double value[3], sb_vec3 v)
{
    value[0] += v.x;
    value[1] += v.y;
    value[2] += v.z;
}

/* Adds a force on a body. pressure, drag: N; at: m, the point of application. */
SB_APART void add(const sb_sim *sim, double *sum, uint32_t body, sb_vec3 at, sb_vec3 pressure, sb_vec3 drag)
{
    double *value = sum + (size_t)VALUES * body;
    add_to(value, pressure);
    add_to(value + 3, drag);
    add_to(value + 6, sb_cross(sb_sub(at, sim->model->bodies[body].moment_point), sb_add(pressure, drag)));
}

static void flush(tally *t)
{
    add(t->sim, t->sum, t->body, sb_add(t->at, t->shift), vector(t->pushed, t->press), vector(t->drag, -t->mass));
    t->pushed = t->drag = (sb_f4){0};
}

static void turn_to(tally *t, const sb_wall_set *set, uint32_t wall)
{
    const uint32_t body = set->body[wall];
    const sb_vec3 shift = t->sim->space.repeats ? to_original(&t->sim->space, set->record[wall]) : (sb_vec3){0};
    if (body == t->body && shift.x == t->shift.x && shift.y == t->shift.y && shift.z == t->shift.z) return;
    flush(t);
    t->body = body;
    t->shift = shift;
}

static void add_push(const sb_sim *sim, size_t i, uint32_t wall, sb_vec3 push, double *sum)
{
    const sb_record record = sb_wall_set_of(sim, wall)->record[sb_wall_particle(wall)];
    sb_vec3 at = sb_space_position(&sim->space, sim->position[i]);
    if (sim->space.repeats) at = sb_add(at, to_original(&sim->space, record));
    add(sim, sum, sb_wall_body(sim, wall), at, push, (sb_vec3){0});
}

/* Resolves contact of particle i; the bodies receive the reactions. */
SB_APART void contact(sb_sim *sim, size_t i, double *sum, sb_ledger_sums *ledger)
{
    const sb_f4 start = ((const sb_f4 *)sim->scratch)[i];
    sb_f4 velocity = sim->acceleration[i];
    sb_contact_push pushes[SB_CONTACT_PUSHES_MAX];
    const size_t count = sb_contact_resolve(sim, i, &velocity, pushes);
    const double scale = -(double)sim->constant.mass / sim->report.time_step;
    if (count == 0) return;
    for (size_t k = 0; k < count; k++) {
        const uint32_t wall = pushes[k].wall;
        /* The push is along the wall's normal through the particle, so that it may act at the particle. */
        const sb_vec3 push = vector(pushes[k].change, scale);
        const sb_f4 body = sb_wall_velocity(sim, wall);
        add_push(sim, i, wall, push, sum);
        ledger->contact_bodies += sb_ledger_work((sb_f4){0}, pushes[k].change, body, body);
    }
    ledger->contact += sb_ledger_work(sim->acceleration[i], velocity, start, velocity);
    velocity[3] = sim->acceleration[i][3];
    sim->acceleration[i] = velocity;
}

/* Whether all boundary particles of a list belong to one body. Always false with periodic sides, where forces on images
   act elsewhere. */
static bool one_body(const sb_sim *sim, const uint32_t *index, size_t count)
{
    bool same = !sim->space.repeats;
    const uint32_t first = count > 0 ? sb_wall_body(sim, index[0]) : 0;
    for (size_t k = 1; k < count && same; k++) same = sb_wall_body(sim, index[k]) == first;
    return same;
}

/* Adds the forces of particle i's pressure and drag on bodies to sum[body][VALUES]. Returns the sum of
   sb_wall_drag_four; law: NULL without drag. */
SB_INLINE sb_f4 react(const sb_sim *sim, size_t i, const sb_wall_drag *law, double *sum)
{
    const uint32_t *index = sim->wall_pairs.index + sim->wall_pairs.first[i];
    const float *slope = sim->wall_pairs.slope + sim->wall_pairs.first[i];
    const size_t count = sim->wall_pairs.count[i];
    const double mass = (double)sim->constant.mass;
    const sb_f4 *velocity = sim->scratch; /* at the step's start */
    tally t = {.sim = sim, .sum = sum, .press = mass * (double)sim->unknown[i], .mass = mass};
    sb_f4 drag = {0}, part[4];
    t.at = sb_space_position(&sim->space, sim->position[i]);
    if (count > 0) t.body = sb_wall_body(sim, index[0]);
    if (one_body(sim, index, count)) { /* the usual case: the sums exist already */
        t.pushed = sim->wall[i];
        drag = t.drag = law ? sim->wall_drag[i] : (sb_f4){0};
        flush(&t);
        return drag;
    }
    for (size_t k = 0; k < count; k++) {
        if (law && k % 4 == 0) sb_wall_drag_four(sim, i, velocity[i], index + k, slope + k, law, part);
        if (slope[k] == 0) continue;
        const sb_wall_set *set = sb_wall_set_of(sim, index[k]);
        const uint32_t wall = sb_wall_particle(index[k]);
        turn_to(&t, set, wall);
        t.pushed += sb_offset(sim->position[i], set->record[wall]) * sb_splat(slope[k]);
        if (law) {
            drag += part[k % 4];
            t.drag += part[k % 4];
        }
    }
    flush(&t);
    return drag;
}

/* Adds forces (N) and moments (N m) of one block of particles on bodies to sum[body][VALUES], and the work of friction
   and contact to the block's ledger. */
SB_MULTIVERSION
static void do_block(sb_sim *sim, size_t block, double *sum, const sb_wall_drag *law)
{
    sb_ledger_sums *ledger = &sim->block_ledger[block];
    const sb_f4 *velocity = sim->scratch; /* at the step's start */
    for (size_t i = block * SB_BLOCK; i < sb_block_end(sim, block); i++) {
        if (sim->wall_pairs.count[i] == 0) continue;
        const sb_f4 drag = react(sim, i, law->on ? law : NULL, sum);
        contact(sim, i, sum, ledger);
        if (law->on) ledger->friction += sb_ledger_work((sb_f4){0}, drag, velocity[i], sim->acceleration[i]);
    }
}

static bool touches_walls(const sb_sim *sim, size_t block)
{
    for (size_t i = block * SB_BLOCK; i < sb_block_end(sim, block); i++)
        if (sim->wall_pairs.count[i] > 0) return true;
    return false;
}

/* Adds a force's values over dt (s) to a body's impulse. */
static void add_impulse(sb_body_impulse *total, double dt, const double *s)
{
    total->pressure = sb_madd(total->pressure, dt, sb_vec(s[0], s[1], s[2]));
    total->friction = sb_madd(total->friction, dt, sb_vec(s[3], s[4], s[5]));
    total->moment = sb_madd(total->moment, dt, sb_vec(s[6], s[7], s[8]));
}

sb_status sb_stage_impulse(sb_sim *sim, sb_error *error)
{
    (void)error;
    const size_t bodies = sim->model->body_count, blocks = sb_blocks(sim);
    const sb_wall_drag law = sb_wall_drag_make(sim);
#pragma omp parallel for schedule(dynamic, 4)
    for (size_t b = 0; b < blocks; b++) {
        sim->block_ledger[b] = (sb_ledger_sums){0};
        sim->block_touched[b] = touches_walls(sim, b);
        if (!sim->block_touched[b]) continue;
        double *sum = sim->block_impulse + b * bodies * VALUES;
        memset(sum, 0, bodies * VALUES * sizeof *sum);
        do_block(sim, b, sum, &law);
    }
    if (sim->settling) return SB_OK;
    const double dt = sim->report.time_step;
    for (size_t b = 0; b < blocks; b++) {
        if (!sim->block_touched[b]) continue;
        for (size_t body = 0; body < bodies; body++)
            add_impulse(&sim->impulse[body], dt, sim->block_impulse + (b * bodies + body) * VALUES);
    }
    return SB_OK;
}
