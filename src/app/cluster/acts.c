#include "app/check/fit.h"
#include "app/check/room.h"
#include "app/cluster/orders.h"
#include "base/hash.h"
#include "base/memory.h"
#include "base/stop.h"
#include "mpi/world.h"

#include <inttypes.h>
#include <stdio.h>

/* Equal files give equal models, but a mesh on another host may be an older one. */
static sb_status compare_models(const run *r, sb_error *error)
{
    uint64_t all[SB_RANKS_MAX];
    const uint64_t own = sb_model_hash(&r->model);
    sb_ranks_gather(r->cluster.ranks, &own, sizeof own, all);
    for (int k = 1; k < r->cluster.ranks->count; k++)
        if (all[k] != all[0])
            return sb_fail(error, SB_BAD_INPUT,
                           "rank %d on %s has another model than rank 0: its particles hash to %016" PRIx64
                           ", expected %016" PRIx64 ": a mesh or grid file differs there",
                           k, sb_world_host(r->cluster.ranks, k), all[k], all[0]);
    return SB_OK;
}

/* The model of this rank, and the boundary particles near the places where all ranks measure. */
static sb_status build_part(run *r, bool estimates, sb_error *error)
{
    sb_model_place *places = NULL;
    sb_model_team team = {.ranks = r->cluster.ranks, .agree = sb_world_agree};
    sb_status status = sb_fit_check(r->scene, error);
    if (status == SB_OK) status = sb_measure_places(r->scene, &places, &team.place_count, error);
    if (sb_cluster_several(r)) status = sb_world_agree(r->cluster.ranks, status, error);
    team.places = places;
    if (status == SB_OK)
        status = sb_model_build_part(r->scene, estimates ? sb_room_needed : NULL, &team, &r->model, error);
    sb_free(places);
    return status;
}

/* Rank 0 estimates the memory, for all ranks of its host, which share it. With more hosts it is not known. It compares
   what is available when all ranks have the model. */
static sb_status act_build(run *r, const order *given, sb_error *error)
{
    const bool several = sb_cluster_several(r);
    const bool estimates = !several || (sb_cluster_leads(r) && sb_world_hosts(r->cluster.ranks) == 1);
    (void)given;
    if (several && estimates) sb_room_share(r->cluster.ranks->count);
    sb_status status = build_part(r, estimates, error);
    if (several) status = sb_world_agree(r->cluster.ranks, status, error);
    if (status != SB_OK) return status;
    if (estimates) status = sb_room_check(r->scene, &r->model, error);
    if (!several) return status;
    status = sb_world_agree(r->cluster.ranks, status, error);
    return status == SB_OK ? compare_models(r, error) : status;
}

static sb_status act_create(run *r, const order *given, sb_error *error)
{
    sb_status status = sb_sim_create(r->scene, &r->model, r->cluster.ranks, &r->sim, error);
    if (status == SB_OK && given->flag == 0) status = sb_sim_check_start(r->sim, error);
    if (status == SB_OK) status = sb_measure_prepare(r->scene, &r->model, &r->prepared, error);
    if (status == SB_OK) sb_model_free_walls(&r->model);
    return status;
}

static sb_status act_measure(run *r, const order *given, sb_error *error)
{
    if (given->flag != 0) sb_sim_find_virial_pressures(r->sim);
    const sb_status status = sb_measure_start(r->prepared, r->sim, error);
    if (status != SB_OK) return status;
    r->measure = r->prepared;
    r->prepared = NULL;
    return SB_OK;
}

/* Between two steps of settling, rank 0 gives orders, and the others follow until it orders to go on. */
static void watch_settling(void *context, int done, int most, double speed)
{
    run *r = context;
    order given = {.what = ORDER_GO_ON};
    if (sb_cluster_leads(r)) {
        r->cluster.watch(r, done, most, speed);
        (void)sb_cluster_order(r, &given, NULL);
        return;
    }
    do (void)sb_cluster_next(r, &given, NULL);
    while (given.what != ORDER_GO_ON);
}

/* Adds what was sent and waited for since `before` to that of the steps. */
static void count_step(run *r, const sb_ranks *before)
{
    const sb_ranks *now = r->cluster.ranks;
    r->cluster.steps.bytes_sent += now->bytes_sent - before->bytes_sent;
    r->cluster.steps.messages += now->messages - before->messages;
    r->cluster.steps.waited += now->waited - before->waited;
}

static sb_status act_settle(run *r, const order *given, sb_error *error)
{
    (void)given;
    if (!sb_cluster_several(r)) return sb_sim_settle_watched(r->sim, watch_settling, r, error);
    const sb_ranks before = *r->cluster.ranks;
    const sb_status status = sb_sim_settle_watched(r->sim, watch_settling, r, error);
    count_step(r, &before);
    return status;
}

static sb_status act_step(run *r, const order *given, sb_error *error)
{
    (void)given;
    if (!sb_cluster_several(r)) return sb_sim_step(r->sim, error);
    if (!sb_cluster_leads(r)) sb_model_free_particles(&r->model); /* rank 0 does this when its files are open */
    const sb_ranks before = *r->cluster.ranks;
    const sb_status status = sb_sim_step(r->sim, error);
    count_step(r, &before);
    return status;
}

static sb_status act_observe(run *r, const order *given, sb_error *error)
{
    (void)given;
    if (sb_measure_reads_pressures(r->measure, r->sim)) sb_sim_find_virial_pressures(r->sim);
    return sb_measure_step(r->measure, r->sim, error);
}

static sb_status act_pressures(run *r, const order *given, sb_error *error)
{
    (void)given;
    (void)error;
    sb_sim_find_virial_pressures(r->sim);
    return SB_OK;
}

static sb_status act_snapshot(run *r, const order *given, sb_error *error)
{
    (void)given;
    (void)error;
    r->cluster.frame = sb_sim_snapshot(r->sim);
    if (sb_cluster_leads(r)) return SB_OK;
    sb_frame_release(r->cluster.frame); /* it has no particles */
    r->cluster.frame = NULL;
    return SB_OK;
}

static sb_status act_hash(run *r, const order *given, sb_error *error)
{
    (void)given;
    (void)error;
    r->cluster.hash = sb_sim_hash(r->sim);
    return SB_OK;
}

static sb_status act_energy(run *r, const order *given, sb_error *error)
{
    (void)given;
    (void)error;
    r->cluster.energy = sb_sim_energy(r->sim);
    return SB_OK;
}

static sb_status act_trigger(run *r, const order *given, sb_error *error)
{
    return sb_sim_trigger(r->sim, (size_t)given->number, error);
}

static sb_status act_stop(run *r, const order *given, sb_error *error)
{
    (void)r;
    (void)error;
    sb_stop_accept((int)given->number, given->flag != 0);
    return SB_OK;
}

static sb_status act_nothing(run *r, const order *given, sb_error *error)
{
    (void)r;
    (void)given;
    (void)error;
    return SB_OK;
}

static sb_status act_release(run *r, const order *given, sb_error *error)
{
    (void)given;
    (void)error;
    sb_measure_destroy(r->prepared);
    sb_measure_destroy(r->measure);
    sb_sim_destroy(r->sim);
    r->prepared = r->measure = NULL;
    r->sim = NULL;
    return SB_OK;
}

const cluster_row sb_cluster_rows[ORDERS] = {
    [ORDER_BUILD] = {act_build, SAME},
    [ORDER_CREATE] = {act_create, AGREED},
    [ORDER_MEASURE] = {act_measure, NOTED},
    [ORDER_SETTLE] = {act_settle, NOTED},
    [ORDER_GO_ON] = {act_nothing, SAME},
    [ORDER_STEP] = {act_step, NOTED},
    [ORDER_OBSERVE] = {act_observe, NOTED},
    [ORDER_PRESSURES] = {act_pressures, SAME},
    [ORDER_SNAPSHOT] = {act_snapshot, SAME},
    [ORDER_PIECES] = {sb_cluster_act_pieces, AGREED},
    [ORDER_HASH] = {act_hash, SAME},
    [ORDER_ENERGY] = {act_energy, SAME},
    [ORDER_TRIGGER] = {act_trigger, SAME},
    [ORDER_SAVE] = {sb_cluster_act_save, SAME},
    [ORDER_LOAD] = {sb_cluster_act_load, SAME},
    [ORDER_STOP] = {act_stop, SAME},
    [ORDER_STAY] = {act_nothing, SAME},
    [ORDER_LOADS] = {sb_cluster_act_loads, SAME},
    [ORDER_RELEASE] = {act_release, SAME},
    [ORDER_DISMISS] = {act_nothing, SAME},
};
