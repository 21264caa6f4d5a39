/* The halo: the particles of other domains around the own groups, and their values. */
#include "base/memory.h"
#include "sim/exchange/domains.h"
#include "sim/exchange/images.h"

#include <string.h>

/* Notes what this rank receives. Returns the size of the halo. */
static size_t plan_receives(sb_sim *sim)
{
    sb_domains *d = sim->domains;
    const size_t ranks = (size_t)d->ranks->count, own = (size_t)d->ranks->rank;
    size_t halo = 0;
    sim->ghosts.lower = 0;
    for (size_t r = 0; r < ranks; r++) {
        d->plan.receives[r] = d->column[r];
        halo += d->plan.receives[r];
        if (r < own) sim->ghosts.lower += d->plan.receives[r];
    }
    return halo;
}

/* Room for the halo, its cells' particles and the bytes that are sent. Returns 0, or -1 without memory. */
static int reserve(sb_sim *sim, size_t halo)
{
    sb_domains *d = sim->domains;
    const size_t most = sizeof(sb_f4);
    if (sb_grow((void **)&d->out, &d->out_capacity, d->plan.sent * most, 1) != 0 ||
        sb_grow((void **)&d->in, &d->in_capacity, halo * sizeof(float), 1) != 0)
        return -1;
    return sb_ghosts_reserve(sim, halo, 0);
}

/* Makes the halo's positions and cells. */
static sb_status make_halo(sb_sim *sim, sb_error *error)
{
    sb_domains *d = sim->domains;
    sb_ghosts *g = &sim->ghosts;
    sb_domains_land(sim);
    g->halo = g->lower = g->count = 0;
    int failed = sb_domains_plan_sends(sim);
    for (int r = 0; r < d->ranks->count; r++) d->row[r] = d->plan.sends[r];
    sb_domains_swap_row(d);
    const size_t halo = plan_receives(sim);
    if (failed == 0) failed = reserve(sim, halo);
    sb_status status =
        sb_domains_agree(sim, failed ? sb_fail_memory(error, "particles of other domains") : SB_OK, error);
    if (status != SB_OK) return status;
    g->halo = halo;
    sb_refresh_owners(sim, (sb_f4 *)sim->state.position);
    if (sb_cells_build(&g->halo_cells, sim->state.position + sim->state.n, halo, sim->space.shift) != 0)
        status = sb_fail_memory(error, "cells");
    return status;
}

sb_status sb_domains_make_ghosts(sb_sim *sim, sb_error *error)
{
    sb_status status = make_halo(sim, error);
    if (status == SB_OK) status = sb_images_make(sim, error);
    if (sim->space.repeats) sim->ghosts.any = sb_ranks_any(sim->ranks, sim->ghosts.count > 0);
    return sb_domains_agree(sim, status, error);
}

static void pack_4(sb_run run, const sb_halo *halo, char *out)
{
    for (size_t k = 0; k < run.count; k++)
        memcpy(out + 4 * k, (const char *)halo->owned + (run.begin + k) * halo->owned_stride, 4);
}

static void pack_16(sb_run run, const sb_halo *halo, char *out)
{
    memcpy(out, (const char *)halo->owned + run.begin * sizeof(sb_f4), run.count * sizeof(sb_f4));
}

/* Whether what is received needs no other place on its way. */
static bool arrives_in_place(const sb_halo *halo)
{
    return halo->ghost_stride == halo->size;
}

/* Packs the values for all ranks. Returns the number of parcels. */
static size_t make_parcels(const sb_domains *d, const sb_halo *halo)
{
    const sb_halo_plan *plan = &d->plan;
    const size_t runs = plan->runs;
#pragma omp parallel for schedule(static)
    for (size_t r = 0; r < runs; r++)
        (halo->size == 4 ? pack_4 : pack_16)(plan->run[r], halo, d->out + plan->place[r] * halo->size);
    size_t parcels = 0;
    char *out = d->out;
    for (int r = 0; r < d->ranks->count; r++) {
        const size_t size = plan->sends[r] * halo->size;
        if (size > 0) d->send[parcels++] = (sb_parcel){r, out, size};
        out += size;
    }
    return parcels;
}

void sb_domains_begin(const sb_sim *sim, const sb_halo *halo)
{
    sb_domains *d = sim->domains;
    sb_domains_land(sim);
    char *in = arrives_in_place(halo) ? halo->ghosts : d->in;
    const size_t sends = make_parcels(d, halo);
    size_t receives = 0, at = 0;
    for (int r = 0; r < d->ranks->count; r++) {
        const size_t size = d->plan.receives[r] * halo->size;
        if (size > 0) d->receive[receives++] = (sb_parcel){r, in + at, size};
        at += size;
    }
    sb_ranks_start(d->ranks, d->send, sends, d->receive, receives);
    d->flight = *halo;
    d->under_way = true;
}

void sb_domains_land(const sb_sim *sim)
{
    sb_domains *d = sim->domains;
    if (!d || !d->under_way) return; /* none yet: the creation has failed here or in another domain */
    const sb_halo *halo = &d->flight;
    sb_ranks_finish(d->ranks);
    d->under_way = false;
    const size_t apart = arrives_in_place(halo) ? 0 : sim->ghosts.halo;
#pragma omp parallel for schedule(static)
    for (size_t k = 0; k < apart; k++) memcpy((char *)halo->ghosts + k * halo->ghost_stride, d->in + 4 * k, 4);
    sb_images_refresh(sim, halo);
}

void sb_domains_refresh(const sb_sim *sim, const sb_halo *halo)
{
    sb_domains_begin(sim, halo);
    sb_domains_land(sim);
}
