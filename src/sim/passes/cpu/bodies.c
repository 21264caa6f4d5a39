#include "sim/exchange/exchange.h"
#include "sim/exchange/sums.h"
#include "sim/passes/cpu/cpu.h"
#include "sim/passes/cpu/drag.h"
#include "sim/passes/cpu/reactions.h"
#include "sim/passes/cpu/wall_finder.h"
#include "sim/passes/groups.h"
#include "sim/search/around.h"
#include "sim/step/ledger.h"
#include "sim/walls/contact.h"
#include "sim/walls/mirrors.h"
#include "sim/walls/pushes.h"

enum { WORKS = 3 };

/* Forces on bodies, and works, summed by one thread. */
typedef struct forces {
    sb_body_forces on;
    sb_exact works[WORKS]; /* friction, contact, contact_bodies of sb_ledger_sums */
} forces;

/* Force of one fluid particle on one body: sums over consecutive boundary particles of the body in the particle's list,
   of slope times offset and of the drag. The force acts at the fluid particle, shifted to the original where it meets
   an image. A force along the line to a boundary particle has the same moment there. Shear is not along that line;
   acting at the fluid particle it keeps the moments of water and bodies balanced. */
typedef struct tally {
    const sb_sim *sim;
    forces *to;
    double press, mass; /* press: m q */
    sb_vec3 at, shift;  /* m: of the fluid particle, and to the original */
    uint32_t body;
    sb_f4 pushed, drag;
} tally;

static sb_vec3 vector(sb_f4 v, double scale)
{
    return sb_vec(scale * (double)v[0], scale * (double)v[1], scale * (double)v[2]);
}

SB_APART void add(const sb_sim *sim, forces *to, uint32_t body, sb_vec3 at, sb_vec3 pressure, sb_vec3 drag)
{
    sb_body_forces_add(sim, &to->on, body, at, pressure, drag);
}

static void flush(tally *t)
{
    add(t->sim, t->to, t->body, sb_add(t->at, t->shift), vector(t->pushed, t->press), vector(t->drag, -t->mass));
    t->pushed = t->drag = (sb_f4){0};
}

static void turn_to(tally *t, const sb_wall_set *set, uint32_t wall)
{
    const uint32_t body = set->body[wall];
    const sb_vec3 shift = t->sim->space.repeats ? sb_wall_to_original(&t->sim->space, set->record[wall]) : (sb_vec3){0};
    if (body == t->body && shift.x == t->shift.x && shift.y == t->shift.y && shift.z == t->shift.z) return;
    flush(t);
    t->body = body;
    t->shift = shift;
}

/* Records the forces of the pressure between particle i and all boundary particles of its list. */
static void record_pairs(const sb_sim *sim, size_t i)
{
    const size_t begin = sim->work.wall_pairs.first[i], end = begin + sim->work.wall_pairs.count[i];
    const double press = (double)sim->constant.mass * (double)sim->work.unknown[i];
    for (size_t k = begin; k < end; k++) {
        const uint32_t wall = sim->work.wall_pairs.index[k];
        const float slope = sim->work.wall_pairs.slope[k];
        if (slope == 0) continue;
        const sb_record of = sb_wall_set_of(sim, wall)->record[sb_wall_particle(wall)];
        sb_wall_push_record(sim, i, wall, vector(sb_offset(sim->state.position[i], of) * sb_splat(slope), press));
    }
}

/* Resolves contact of particle i; the bodies receive the reactions. */
SB_APART void contact(sb_sim *sim, const sb_group *group, size_t i, forces *to, double works[WORKS])
{
    const sb_f4 start = sb_ledger_start(sim, i);
    const float to_quanta = (float)(sim->state.time_step / sim->space.quantum);
    const double scale = -(double)sim->constant.mass / sim->state.time_step;
    const sb_vec3 at = sb_space_position(&sim->space, sim->state.position[i]);
    sb_f4 velocity = sim->work.end_velocity[i];
    sb_facet_contact c;
    int count = 0;
    for (; count < SB_CONTACT_PUSHES_MAX && sb_contact_find(sim, group, i, velocity, &c); count++) {
        const sb_f4 change = c.normal * sb_splat(c.push / to_quanta);
        const sb_f4 body = sb_mirror_velocity(sim, c.mirror);
        sb_body_forces_of_facet(sim, &to->on, c.mirror, at, vector(change, scale), vector(c.normal, 1));
        works[2] += sb_ledger_work((sb_f4){0}, change, body, body);
        velocity += change;
    }
    if (count == 0) return;
    works[1] += sb_ledger_work(sim->work.end_velocity[i], velocity, start, velocity);
    velocity[3] = sim->work.end_velocity[i][3];
    sim->work.end_velocity[i] = velocity;
}

/* Whether there are boundary particles around particle i that act on bodies. */
static bool has_walls(const sb_sim *sim, size_t i, const sb_wall_drag *law)
{
    if (sim->needs.wall_lists) return sim->work.wall_pairs.count[i] > 0;
    return law && sim->work.wall_body[i] != SB_WALL_NONE;
}

/* Adds the forces of particle i's pressure and drag on bodies. Returns the sum of sb_wall_drag_four; law: NULL without
   drag. */
SB_INLINE sb_f4 react(const sb_sim *sim, size_t i, const sb_wall_drag *law, sb_wall_finder *finder, forces *to)
{
    const double mass = (double)sim->constant.mass;
    const sb_f4 *velocity = sim->state.velocity; /* at the step's start */
    const bool lists = sim->needs.wall_lists;
    tally t = {.sim = sim, .to = to, .press = lists ? mass * (double)sim->work.unknown[i] : 0, .mass = mass};
    sb_f4 drag = {0}, part[4];
    t.at = sb_space_position(&sim->space, sim->state.position[i]);
    sb_wall_list walls = {.count = 0};
    if (lists) walls = sb_wall_list_of(sim, finder, i);
    t.body = lists ? sb_wall_list_body(sim, walls) : sim->work.wall_body[i];
    if (t.body != SB_WALL_SEVERAL) { /* the usual case: the sums exist already */
        t.pushed = sb_wall_vector(sim, i);
        drag = t.drag = law ? sim->work.wall_drag[i] : (sb_f4){0};
        flush(&t);
        return drag;
    }
    if (!lists) walls = sb_wall_list_of(sim, finder, i);
    t.body = sb_wall_body(sim, walls.index[0]);
    for (size_t k = 0; k < walls.count; k++) {
        if (law && k % 4 == 0) sb_wall_drag_four(sim, i, velocity[i], walls.index + k, walls.slope + k, law, part);
        if (walls.slope[k] == 0) continue;
        const sb_wall_set *set = sb_wall_set_of(sim, walls.index[k]);
        const uint32_t wall = sb_wall_particle(walls.index[k]);
        turn_to(&t, set, wall);
        t.pushed += sb_offset(sim->state.position[i], set->record[wall]) * sb_splat(walls.slope[k]);
        if (law) {
            drag += part[k % 4];
            t.drag += part[k % 4];
        }
    }
    flush(&t);
    return drag;
}

/* Adds forces (N) and moments (N m) of one group on bodies, and the works of friction and contact. law: NULL without
   drag. */
SB_MULTIVERSION
static void do_group(sb_sim *sim, const sb_group *group, const sb_wall_drag *law, const sb_wall_search *search,
                     forces *to)
{
    double works[WORKS] = {0};
    const uint32_t records = sb_around_count(sim, group);
    sb_pull pulls[SB_AROUND_MAX];
    sb_wall_finder finder;
    const bool recorded = !sim->needs.images && sb_pushes_near(sim, group);
    sb_reactions reactions = {0};
    bool beside_wall = false;
    sb_wall_finder_begin(&finder, search);
    sb_pulls_find(sim, group, pulls);
    for (size_t i = group->first; i < group->end; i++) {
        const bool reflects = sim->needs.images && (sim->work.pairs.count[i] > sim->work.pairs.direct[i] ||
                                                    sim->work.edge_pairs.count[i] > 0);
        const bool meets = sb_contact_possible(sim, group, i);
        const bool walls = has_walls(sim, i, law);
        if (!walls && !reflects && !meets) continue;
        beside_wall = true;
        if (reflects) sb_react_images(sim, group, records, pulls, i, &reactions, &to->on);
        if (meets) contact(sim, group, i, to, works);
        if (!walls) continue;
        const sb_f4 drag = react(sim, i, law, &finder, to);
        if (recorded) record_pairs(sim, i);
        if (law) works[0] += sb_ledger_work((sb_f4){0}, drag, sb_ledger_start(sim, i), sim->work.end_velocity[i]);
    }
    if (!beside_wall) return;
    for (int k = 0; k < WORKS; k++) sb_exact_add(&to->works[k], works[k]);
    sb_body_forces_close(&to->on);
}

/* Sums of all threads into `total`. False: a thread has no memory for its own. */
static bool sum_forces(sb_sim *sim, const sb_wall_drag *law, forces *total)
{
    const size_t groups = sim->groups.count, bodies = sim->model->body_count;
    const sb_wall_search search = sb_wall_search_of(sim);
    bool enough = true;
#pragma omp parallel reduction(&& : enough)
    {
        forces own = {0};
        enough = sb_body_forces_create(&own.on, bodies) == 0;
#pragma omp for schedule(dynamic, SB_GROUPS_AT_A_TIME)
        for (size_t g = 0; g < groups; g++)
            if (enough) do_group(sim, &sim->groups.group[g], law->on ? law : NULL, &search, &own);
        if (enough) {
            sb_sums_merge(total->on.all, own.on.all, bodies * SB_FORCE_VALUES);
            sb_sums_merge(total->works, own.works, WORKS);
        }
        sb_body_forces_free(&own.on);
    }
    return enough;
}

int sb_cpu_bodies(sb_sim *sim, const sb_wall_drag *law, sb_body_sums *total)
{
    forces all = {0};
    const size_t values = sim->model->body_count * SB_FORCE_VALUES;
    int status = sb_body_forces_create(&all.on, sim->model->body_count);
    if (status == 0 && !sum_forces(sim, law, &all)) status = -1;
    if (sim->exchange->agree(sim, status == 0 ? SB_OK : SB_FAILED, NULL) != SB_OK) status = -1;
    if (status == 0) {
        sim->exchange->sum(sim, all.on.all, values);
        sim->exchange->sum(sim, all.works, WORKS);
    }
    for (size_t v = 0; v < values && status == 0; v++) total->force[v] = sb_exact_value(&all.on.all[v]);
    if (status == 0) {
        total->friction = sb_exact_value(&all.works[0]);
        total->contact = sb_exact_value(&all.works[1]);
        total->contact_bodies = sb_exact_value(&all.works[2]);
    }
    sb_body_forces_free(&all.on);
    return status;
}
