/* Saves the state between two steps into an archive and loads it again. The archive has no data that a step computes
   anew: cells, ghosts, neighbours, densities. Wall tables follow from the bodies' displacements. Stage times belong to
   the process and are not saved. */
#include "base/archive.h"
#include "base/memory.h"
#include "sim/exchange/domains.h"
#include "sim/foam/foam.h"
#include "sim/report/report.h"
#include "sim/sea/strip.h"
#include "sim/search/departures.h"
#include "sim/search/sort.h"
#include "sim/simulation.h"
#include "sim/state/gather.h"
#include "sim/step/settle.h"
#include "sim/walls/absorber.h"
#include "sim/walls/walls.h"
#include "sim/wcsph/wcsph.h"

#include <math.h>
#include <string.h>

#define SECTION "sim"

/* Number of reals that put_progress writes. */
enum { PROGRESS_REALS = 10 };

/* Writes the scalars of the state, and the last step's errors, which a resumed run reports until its next step. */
static void put_progress(sb_archive_out *out, const sb_state *s, const sb_step_report *r)
{
    sb_put_count(out, s->step);
    sb_put_count(out, (uint64_t)s->sweeps);
    sb_put_flag(out, r->capped);
    const double reals[PROGRESS_REALS] = {s->time,           s->time_step,         r->tolerance,   r->error_mean,
                                          r->error_residual, r->error_max,         r->compression, r->compression_max,
                                          s->max_speed,      r->momentum_imbalance};
    sb_put_list(out, reals, PROGRESS_REALS, sizeof *reals);
}

static void take_progress(sb_archive_in *in, sb_state *s, sb_step_report *r)
{
    double reals[PROGRESS_REALS];
    s->step = sb_take_count(in, UINT64_MAX);
    s->sweeps = (int)sb_take_count(in, INT32_MAX);
    r->capped = sb_take_flag(in);
    sb_take_list(in, reals, PROGRESS_REALS, sizeof *reals);
    double *const fields[PROGRESS_REALS] = {
        &s->time,      &s->time_step,   &r->tolerance,       &r->error_mean, &r->error_residual,
        &r->error_max, &r->compression, &r->compression_max, &s->max_speed,  &r->momentum_imbalance};
    for (size_t f = 0; f < PROGRESS_REALS; f++) *fields[f] = reals[f];
    const bool sane = s->time >= 0 && isfinite(s->time) && s->time_step >= 0 && isfinite(s->time_step) &&
                      s->max_speed >= 0 && isfinite(s->max_speed);
    if (!sane)
        sb_archive_refuse(in, "time %g s, step %g s, speed %g m/s: expected finite numbers >= 0", s->time, s->time_step,
                          s->max_speed);
}

static void put_settle(sb_archive_out *out, const sb_settle *settle)
{
    sb_put_flag(out, settle->under_way);
    sb_put_real(out, settle->done);
    if (!settle->under_way) return;
    sb_put_real(out, settle->most);
    sb_put_real(out, settle->calm);
    sb_put_real(out, settle->kinetic);
}

/* Reads a whole number within +-2^30. */
static int take_steps(sb_archive_in *in)
{
    const double value = sb_take_real(in);
    if (fabs(value) <= 0x1p30 && value == floor(value)) return (int)value;
    sb_archive_refuse(in, "%g settling steps, expected a whole number", value);
    return 0;
}

static void take_settle(sb_archive_in *in, const sb_scene *scene, sb_settle *settle)
{
    *settle = (sb_settle){.under_way = sb_take_flag(in)};
    settle->done = take_steps(in);
    if (settle->done < 0) sb_archive_refuse(in, "%d settling steps, expected 0 or more", settle->done);
    if (!settle->under_way) return;
    settle->most = take_steps(in);
    settle->calm = take_steps(in);
    settle->kinetic = sb_take_real(in);
    const int most = scene->numerics.settle_steps;
    if (sb_settle_over(settle))
        sb_archive_refuse(in, "settling has ended at step %d: expected settling in progress", settle->done);
    if (settle->calm < 0 || settle->most > most || isnan(settle->kinetic))
        sb_archive_refuse(in, "settling step %d of at most %d: expected at most %d steps", settle->done, settle->most,
                          most);
}

/* Writes the fields of the particles of all domains. */
static void put_particles(const sb_sim *sim, sb_archive_out *out)
{
    sb_shares shares;
    sb_gather_begin(sim, &shares, out);
    for (const sb_state_field *f = sb_state_fields; f->name; f++)
        if (!f->apart) sb_gather_list(&shares, out, sb_state_entries(&sim->state, f), f->size);
    sb_gather_end(&shares, out);
}

void sb_sim_save(const sb_sim *sim, sb_archive_out *out)
{
    if (sb_ranks_own(sim->ranks) > 0) {
        put_particles(sim, NULL);
        sb_wcsph_save(sim, NULL);
        sb_sim_hash(sim);
        return;
    }
    sb_archive_section(out, SECTION);
    put_progress(out, &sim->state, &sim->report);
    put_settle(out, &sim->state.settle);
    sb_put_count(out, sim->state.left_domain);
    sb_put_count(out, sim->state.lost);
    sb_departures_save(sim, out);
    put_particles(sim, out);
    sb_put_list(out, sim->state.impulse, sim->model->body_count, sizeof *sim->state.impulse);
    sb_put_list(out, &sim->state.ledger, sizeof sim->state.ledger / sizeof(double), sizeof(double));
    sb_strip_save(sim, out);
    sb_put_count(out, sim->walls.moving_count);
    for (size_t m = 0; m < sim->walls.moving_count; m++) {
        sb_put_real(out, sim->walls.moving[m].displacement);
        sb_put_real(out, sim->walls.moving[m].next_displacement);
        sb_put_vector(out, sim->walls.moving[m].velocity);
        if (sim->walls.moving[m].law->commanded) sb_put_real(out, sim->walls.moving[m].law->paddle.start);
    }
    sb_absorbers_save(sim, out);
    sb_foam_save(sim, out);
    sb_wcsph_save(sim, out);
    sb_put_count(out, sb_sim_hash(sim));
}

/* Refuses impossible values of particle fields. */
static void check_particles(const sb_sim *sim, size_t n, sb_archive_in *in)
{
    const sb_state *state = &sim->state;
    for (size_t i = 0; i < n; i++) {
        const sb_record at = state->position[i];
        if (at[0] >= SB_POSITION_END || at[1] >= SB_POSITION_END || at[2] >= SB_POSITION_END ||
            state->id[i] >= state->next_id)
            sb_archive_refuse(in,
                              "particle %u at (%u, %u, %u) quanta: expected a particle number below %u and "
                              "coordinates below %u",
                              state->id[i], at[0], at[1], at[2], state->next_id, SB_POSITION_END);
        if (state->density_correction && isinf(state->density_correction[i]))
            sb_archive_refuse(in, "density correction of particle %zu is %g kg/m^3, expected a finite value", i,
                              (double)state->density_correction[i]);
    }
}

/* Room for n particles. */
static void make_room(sb_sim *sim, size_t n, sb_archive_in *in)
{
    sb_state *state = &sim->state;
    if (n > state->owned && (sb_state_grow(state, 0, n) != 0 ||
                             sb_work_create(&sim->work, &sim->needs, state->owned, state->capacity) != 0))
        sb_archive_refuse(in, "%zu particles: not enough memory", n);
}

static sb_record place_in_list(const sb_sim *sim, const void *list, size_t i)
{
    sb_record at;
    (void)sim;
    memcpy(&at, (const char *)list + i * sizeof at, sizeof at);
    return at;
}

/* Takes this domain's part of the saved particles: as many as another one has, in their order. The cuts follow from all
   positions; the next sort takes the particles there. */
static void take_particles(sb_sim *sim, sb_archive_in *in)
{
    sb_state *state = &sim->state;
    const size_t most = sim->needs.sea ? ((size_t)1 << SB_INDEX_BITS) - 1 : sim->model->fluid_count;
    const size_t all = sb_take_length(in, sizeof *state->position, most);
    const size_t n = sb_gather_part(sim, all).count;
    const void *positions = NULL;
    sim->work.everywhere = all;
    make_room(sim, n, in);
    for (const sb_state_field *f = sb_state_fields; f->name; f++) {
        if (f->apart) continue;
        const void *list = sb_take_part(sim, in, sb_state_entries(state, f), f->size);
        if (f == sb_state_fields) positions = list;
    }
    state->n = in->error.status == SB_OK ? n : 0;
    sim->work.everywhere = in->error.status == SB_OK ? all : 0;
    if (!sim->domains) return;
    if (sb_domains_agree(sim, in->error.status, &in->error) == SB_OK)
        sb_domains_cut(sim, place_in_list, positions, all, &in->error);
}

/* In quanta: the largest displacement of a body, far outside of any domain. */
static const double FARTHEST = 1e15;

/* The start of a motion by command: a time that has passed, or infinity. */
static void take_start(const sb_sim *sim, sb_moving_body *moving, sb_archive_in *in)
{
    const double start = sb_take_real(in);
    const bool passed = start >= 0 && start <= sim->state.time;
    if (!passed && !(isinf(start) && start > 0))
        sb_archive_refuse(in, "a wave maker was started at t = %g s, expected 0 to %g s or never", start,
                          sim->state.time);
    moving->law->paddle.start = start;
}

static void take_moving(sb_sim *sim, sb_archive_in *in)
{
    if (sb_take_count(in, SIZE_MAX) != sim->walls.moving_count)
        sb_archive_refuse(in, "different number of moving bodies, expected %zu", sim->walls.moving_count);
    for (size_t m = 0; m < sim->walls.moving_count; m++) {
        sb_moving_body *moving = &sim->walls.moving[m];
        moving->displacement = sb_take_real(in);
        moving->next_displacement = sb_take_real(in);
        moving->velocity = sb_take_vector(in);
        if (moving->law->commanded) take_start(sim, moving, in);
        const double farthest = fmax(fabs(moving->displacement), fabs(moving->next_displacement));
        if (farthest < FARTHEST * sim->space.quantum && !isnan(moving->displacement) &&
            !isnan(moving->next_displacement) && sb_isfinite(moving->velocity))
            continue;
        sb_archive_refuse(in, "moving body %zu is displaced by %g m, expected less than %g m and finite velocities", m,
                          moving->displacement, FARTHEST * sim->space.quantum);
        moving->displacement = 0;
    }
}

sb_status sb_sim_load(sb_sim *sim, sb_archive_in *in, sb_error *error)
{
    sb_status status = sim->exchange->agree(sim, sb_archive_enter(in, SECTION, error), error);
    if (status != SB_OK) return status;
    take_progress(in, &sim->state, &sim->report);
    take_settle(in, sim->scene, &sim->state.settle);
    sim->state.left_domain = sb_take_count(in, UINT64_MAX);
    sim->state.lost = sb_take_count(in, UINT64_MAX);
    sb_departures_load(sim, in);
    if (!sim->state.settle.under_way) {
        sb_free(sim->state.start_velocity);
        sim->state.start_velocity = NULL;
    }
    take_particles(sim, in);
    sb_take_list(in, sim->state.impulse, sim->model->body_count, sizeof *sim->state.impulse);
    sb_take_list(in, &sim->state.ledger, sizeof sim->state.ledger / sizeof(double), sizeof(double));
    sb_strip_load(sim, in);
    check_particles(sim, sim->state.n, in);
    take_moving(sim, in);
    sb_absorbers_load(sim, in);
    sb_foam_load(sim, in);
    sb_wcsph_load(sim, in);
    const uint64_t expected = sb_take_count(in, UINT64_MAX), hash = sb_sim_hash(sim);
    if (in->error.status == SB_OK && hash != expected)
        sb_archive_refuse(in, "state hash is %016llx, expected %016llx", (unsigned long long)hash,
                          (unsigned long long)expected);
    if (status == SB_OK) status = sb_archive_leave(in, error);
    if (status == SB_OK) status = sb_walls_restore(sim, error);
    /* The lists and cells belong to the old particles: there are none until the next step. */
    sim->work.lists_current = sim->work.virial_known = false;
    sb_report_update(sim);
    sim->groups.count = 0;
    if (sb_cells_build(&sim->cells, sim->state.position, 0, sim->space.shift) != 0 && status == SB_OK)
        status = sb_fail_memory(error, "cells");
    return sim->exchange->agree(sim, status, error);
}
