/* What crosses the outer edge of a strip. Each column of the edge has rows of particles; a row counts the water that
   has come in through it until now, in particles, less the particles that have come in, or plus those that have left.
   It lets one in when half a particle is owed, or from 0 on where no other is near, at the place to which its water has
   come: water that turns round brings back a particle where one has left. The volume that comes in is that of the given
   velocity, and nothing else: the strip's content is not controlled (docs/decisions/0084). What is owed to a column
   that falls dry is dropped. */
#include "base/memory.h"
#include "sim/exchange/domains.h"
#include "sim/sea/strip.h"
#include "sim/search/departures.h"
#include "sim/search/sort.h"
#include "sim/step/ledger.h"
#include "sim/terms/steady_stress.h"

#include <math.h>

/* A column gets other rows when those that it has would be stretched or pressed together by more than this factor. */
static const double STRETCHED = 1.6;

/* A row with half a particle owed lets one in where no other is nearer than NEAR, in spacings of the rows; with less,
   where none is nearer than FAR. Water that has turned round does not come back as a lattice. */
static const double NEAR = 0.7, FAR = 1.2;

static double particle_volume(const sb_sim *sim)
{
    const double dr = sim->scene->resolution;
    return sim->constant.dimension == 2 ? dr * dr : dr * dr * dr;
}

static double height_of(const sb_sim *sim, sb_record at)
{
    return sim->space.origin.z + at[2] * sim->space.quantum;
}

/* Counts the particles that will leave through the side when they are sorted. Beyond a corner one leaves through one
   side only. */
static void count_leaving(sb_sim *sim, sb_strip_side *s)
{
    const size_t n = sim->state.n;
    memset(s->left, 0, s->columns * s->rows * sizeof *s->left);
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        const sb_record at = sim->state.position[i];
        if (sb_strip_inwards(s, at) >= 0 || sb_exit_of(sim, at).side != s->side) continue;
        const double along = sb_strip_along(sim, s, at), z = height_of(sim, at);
        const size_t column = sb_strip_column(sim, s, along);
        sb_given given;
        if (s->row_count[column] == 0) continue;
        sb_strip_given(sim, s, sim->state.time, 0, along, z, &given);
        const size_t row = sb_strip_row(z, given.bed, given.surface, s->row_count[column]);
        __atomic_fetch_add(&s->left[column * s->rows + row], 1u, __ATOMIC_RELAXED);
    }
    sim->exchange->count(sim, s->left, s->columns * s->rows);
}

/* Makes room for more particles. Returns 0, or -1 without memory. */
static int make_room(sb_sim *sim, size_t particles)
{
    sb_state *state = &sim->state;
    if (particles <= state->owned) return 0;
    const size_t owned = particles + particles / 16 + 1024;
    if (sb_state_grow(state, state->n, owned) != 0) return -1;
    return sb_work_create(&sim->work, &sim->needs, state->owned, state->capacity); /* nothing in it is alive */
}

/* A row that lets a particle in: where, and with what. */
typedef struct entry {
    sb_vec3 at;
    const sb_given *given;
    float correction;
} entry;

static const char INCOMING[] = "particles that come in from the sea";

/* Appends the particle, in the domain that has the place. */
static sb_status append(sb_sim *sim, sb_record at, sb_f4 velocity, float correction, sb_error *error)
{
    sb_state *state = &sim->state;
    const size_t i = state->n;
    if (sim->domains && !sb_domains_owns(sim->domains, sb_space_key(&sim->space, at))) return SB_OK;
    if (make_room(sim, i + 1) != 0) return sb_fail_memory(error, INCOMING);
    state->position[i] = at;
    state->velocity[i] = velocity;
    state->id[i] = state->next_id;
    if (state->density_correction) state->density_correction[i] = correction;
    sb_steady_stress_clear(state, i);
    state->n++;
    return SB_OK;
}

static sb_status let_in(sb_sim *sim, const entry *e, sb_error *error)
{
    sb_state *state = &sim->state;
    if (state->next_id == UINT32_MAX)
        return sb_fail(error, SB_FAILED, "step %llu: 2^32 particles have come in: no numbers are left",
                       (unsigned long long)state->step + 1);
    if (sim->work.everywhere + 1 >= (uint64_t)1 << SB_INDEX_BITS)
        return sb_fail(error, SB_FAILED, "step %llu: more water comes in from the sea than %d particles can hold",
                       (unsigned long long)state->step + 1, 1 << SB_INDEX_BITS);
    const double *v = e->given->velocity, mass = (double)sim->constant.mass;
    const sb_record at = sb_space_record(&sim->space, e->at);
    const sb_f4 has = {(float)v[0], (float)v[1], (float)v[2], (float)e->given->pressure};
    const sb_status status = append(sim, at, has, e->correction, error);
    if (status != SB_OK) return status;
    state->next_id++;
    sim->work.everywhere++;
    const double square = sb_ledger_work((sb_f4){0}, has, has, has);
    const double base = sim->model->min.z - sim->space.origin.z;
    const double height = at[2] * sim->space.quantum - base;
    const double energy = mass * (0.5 * square + (double)sim->constant.gravity * height);
    state->ledger.sea += energy;
    state->crossing.in++;
    state->crossing.energy += energy;
    state->crossing.momentum =
        sb_madd(state->crossing.momentum, mass, sb_vec((double)has[0], (double)has[1], (double)has[2]));
    return SB_OK;
}

/* Particles of the strip, and those that have come in in this step: whose order has no meaning. */
typedef struct edge {
    sb_vec3 *at; /* m */
    size_t count, capacity;
} edge;

static int add_to_edge(edge *e, sb_vec3 at)
{
    if (sb_grow((void **)&e->at, &e->capacity, e->count + 1, sizeof *e->at) != 0) return -1;
    e->at[e->count++] = at;
    return 0;
}

/* Adds the particles of other domains. Returns 0, or -1 if any domain has no memory. */
static int share_edge(const sb_sim *sim, edge *e, bool failed)
{
    sb_ranks *ranks = sim->ranks;
    if (!sb_ranks_several(ranks)) return failed ? -1 : 0;
    size_t sizes[SB_RANKS_MAX], all = 0;
    const size_t own = e->count * sizeof *e->at;
    sb_ranks_gather(ranks, &own, sizeof own, sizes);
    for (int r = 0; r < ranks->count; r++) all += sizes[r];
    sb_vec3 *at = sb_alloc_untouched(all, 1);
    failed = sb_ranks_any(ranks, failed || !at);
    if (!failed) {
        sb_ranks_spread(ranks, e->at, at, sizes);
        sb_free(e->at);
        *e = (edge){at, all / sizeof *at, all / sizeof *at};
    } else
        sb_free(at);
    return failed ? -1 : 0;
}

static int find_edge(const sb_sim *sim, const sb_strip_side *s, edge *e)
{
    const size_t n = sim->state.n;
    int failed = 0;
#pragma omp parallel for schedule(static) reduction(|| : failed)
    for (size_t i = 0; i < n; i++) {
        const int64_t inwards = sb_strip_inwards(s, sim->state.position[i]);
        if (inwards < 0 || inwards > s->width) continue;
#pragma omp critical(sb_edge)
        failed = add_to_edge(e, sb_space_position(&sim->space, sim->state.position[i])) != 0 || failed;
    }
    return share_edge(sim, e, failed);
}

/* Distance to the nearest particle at the edge, with the spacings of a column's rows along each axis as unit. */
static double gap_at(const edge *e, sb_vec3 at, sb_vec3 spacing)
{
    double least = (double)INFINITY;
    for (size_t k = 0; k < e->count; k++) {
        const sb_vec3 d = sb_sub(e->at[k], at);
        const double x = d.x / spacing.x, y = d.y / spacing.y, z = d.z / spacing.z;
        least = fmin(least, x * x + y * y + z * z);
    }
    return sqrt(least);
}

/* Adds the particles that left through a column to what is owed to its rows, and sets their number for the present
   depth; what is owed is divided among them. */
static void set_rows(const sb_sim *sim, sb_strip_side *s, size_t column, double depth)
{
    const double dr = sim->scene->resolution, has = s->row_count[column] * dr;
    double *owed = s->owed + column * s->rows, sum = 0;
    for (int k = 0; k < s->row_count[column]; k++) owed[k] += (double)s->left[column * s->rows + (size_t)k];
    if (has > 0 && depth < STRETCHED * has && depth > 1 / STRETCHED * has) return;
    const int wanted = depth > 0.5 * dr ? (int)fmin(fmax(round(depth / dr), 1), (double)s->rows) : 0;
    if (wanted == s->row_count[column]) return;
    for (int k = 0; k < s->row_count[column]; k++) sum += owed[k];
    for (size_t k = 0; k < s->rows; k++) owed[k] = k < (size_t)wanted ? sum / wanted : 0;
    s->row_count[column] = wanted;
}

/* The density correction of a row: that of the same share of the depth at rest. */
static float correction_of(const sb_strip_side *s, size_t column, size_t row)
{
    const int still = s->still_rows[column];
    if (still == 0) return NAN;
    return s->correction[column * s->rows + sb_strip_row((double)row + 0.5, 0, s->row_count[column], still)];
}

/* Whether a column has a spacing of given water; *at: on its ground; *surface: m. */
static bool is_wet(const sb_sim *sim, const sb_strip_side *s, size_t column, sb_vec3 *at, double *surface)
{
    const double along = ((double)column + 0.5) * sim->model->sea[s->side].pitch;
    sb_sea_point point;
    *at = sb_model_sea_place(sim->model, s->side, 0, along);
    at->z = sb_strip_bed(sim, s, 0, along);
    sb_strip_source(sim, s, sim->state.time, *at, at->z, &point);
    *surface = point.surface;
    return point.surface - at->z >= sim->scene->resolution;
}

/* Refuses a theory, table or record whose water leaves a side dry everywhere that has SB_SEA_DEEP layers at rest: it is
   probably meant otherwise. Its shore may recede along the side. A grid computes where its water falls dry. */
static sb_status check_depth(const sb_sim *sim, const sb_strip_side *s, sb_error *error)
{
    size_t deepest = SIZE_MAX;
    sb_vec3 at, lowest = {0};
    double surface, left = 0;
    if (sim->scene->given.source == SB_GIVEN_OFFSHORE) return SB_OK;
    for (size_t column = 0; column < s->columns; column++) {
        if (s->still_rows[column] < SB_SEA_DEEP) continue;
        if (is_wet(sim, s, column, &at, &surface)) return SB_OK;
        if (deepest != SIZE_MAX && at.z >= lowest.z) continue;
        deepest = column;
        lowest = at;
        left = surface;
    }
    if (deepest == SIZE_MAX) return SB_OK;
    return sb_fail(error, SB_FAILED,
                   "t = %g s: the given sea at %s falls to %g m at (%g, %g), over ground at %g m, the lowest there, "
                   "expected at least one spacing of water: the strip would be dry",
                   sim->state.time, sb_side_names[s->side], left, lowest.x, lowest.y, lowest.z);
}

/* A column in one step: its rows, and the sides of the water of a particle in them. */
typedef struct column_now {
    sb_strip_side *s;
    size_t index;
    double along, bed; /* m */
    double tall;       /* m, height of a row */
    double length;     /* m, a particle's share of a row */
    sb_vec3 spacing;   /* m, the same along each axis */
} column_now;

/* Lets a particle into a row if it owes half of one and there is room, or if it owes none and there is much. */
static sb_status fill_row(sb_sim *sim, const column_now *c, edge *near, int row, sb_error *error)
{
    double *owed = &c->s->owed[c->index * c->s->rows + (size_t)row];
    const double z = c->bed + (row + 0.5) * c->tall, sign = c->s->side % 2 ? -1 : 1;
    sb_given given;
    sb_strip_given(sim, c->s, sim->state.time, 0, c->along, z, &given);
    const double u = sign * given.velocity[c->s->axis];
    if (!(u > 0) || *owed < 0) return SB_OK;
    const double inwards = fmin(fmax(*owed - 0.5, 0) * c->length, u * sim->state.time_step);
    entry e = {sb_model_sea_place(sim->model, c->s->side, inwards, c->along), &given,
               correction_of(c->s, c->index, (size_t)row)};
    e.at.z = z;
    if (gap_at(near, e.at, c->spacing) < (*owed < 0.5 ? FAR : NEAR)) return SB_OK;
    *owed -= 1;
    if (add_to_edge(near, e.at) != 0) return sb_fail_memory(error, "particles at a side");
    return let_in(sim, &e, error);
}

/* The water that comes in through a row in this step, in particles: with the velocity with which the strip moves. */
static double comes_in(const sb_sim *sim, const column_now *c, int row)
{
    const double dt = sim->state.time_step;
    sb_given given;
    sb_strip_given(sim, c->s, sim->state.time + 0.5 * dt, 0, c->along, c->bed + (row + 0.5) * c->tall, &given);
    return (c->s->side % 2 ? -1 : 1) * given.velocity[c->s->axis] * dt / c->length;
}

/* Lets particles into a column, and advances its rows by a step. */
static sb_status advance_column(sb_sim *sim, sb_strip_side *s, edge *near, size_t column, sb_error *error)
{
    const double pitch = sim->model->sea[s->side].pitch, along = ((double)column + 0.5) * pitch;
    const double width = sim->constant.dimension == 2 ? 1 : pitch;
    sb_given given;
    sb_status status = SB_OK;
    sb_strip_given(sim, s, sim->state.time, 0, along, sim->scene->sea.level, &given);
    const double depth = given.surface - given.bed;
    set_rows(sim, s, column, depth);
    const int rows = s->row_count[column];
    if (rows == 0) return SB_OK;
    column_now c = {.s = s, .index = column, .along = along, .bed = given.bed, .tall = depth / rows};
    c.length = particle_volume(sim) / (c.tall * width);
    c.spacing = s->axis == 0 ? sb_vec(c.length, pitch, c.tall) : sb_vec(pitch, c.length, c.tall);
    for (int row = 0; row < rows && status == SB_OK; row++) {
        status = fill_row(sim, &c, near, row, error);
        s->owed[column * s->rows + (size_t)row] += comes_in(sim, &c, row);
    }
    return status;
}

sb_status sb_stage_inflow(sb_sim *sim, sb_error *error)
{
    if (!sim->policy->runs) return SB_OK;
    sb_status status = sb_strip_measure(sim, error);
    if (status == SB_OK) status = sb_strip_advance_grid(sim, error);
    status = sim->exchange->agree(sim, status, error);
    for (size_t k = 0; k < sim->strip->count && status == SB_OK; k++) {
        sb_strip_side *s = &sim->strip->side[k];
        count_leaving(sim, s);
        edge near = {0};
        if (find_edge(sim, s, &near) != 0) status = sb_fail_memory(error, "particles at a side");
        if (status == SB_OK) status = check_depth(sim, s, error);
        for (size_t column = 0; column < s->columns && status == SB_OK; column++)
            status = advance_column(sim, s, &near, column, error);
        status = sim->exchange->agree(sim, status, error);
        sb_free(near.at);
    }
    return status;
}
