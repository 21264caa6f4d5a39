/* Rank 0 gives orders, the other ranks follow them. */
#include "app/checkpoint/checkpoint.h"
#include "app/cluster/orders.h"
#include "app/run/run.h"
#include "base/stop.h"
#include "mpi/starter.h"
#include "mpi/world.h"

/* ---- orders ---- */

static sb_status act(run *r, const order *given, sb_error *error)
{
    const cluster_row *row = &sb_cluster_rows[given->what];
    sb_error local = {0};
    sb_status status = row->act(r, given, &local);
    if (row->end == AGREED && sb_cluster_several(r)) status = sb_world_agree(r->cluster.ranks, status, &local);
    if (row->end == NOTED && sb_cluster_several(r) && status == SB_FAILED) sb_world_failed(r->cluster.ranks, &local);
    if (status != SB_OK && error) *error = local;
    return status;
}

sb_status sb_cluster_order(run *r, const order *given, sb_error *error)
{
    if (sb_cluster_several(r)) sb_world_order(r->cluster.ranks, given, sizeof *given);
    return act(r, given, error);
}

sb_status sb_cluster_next(run *r, order *given, sb_error *error)
{
    const int signal = sb_stop_waiting();
    if (signal != 0 && !r->cluster.told) {
        r->cluster.told = true;
        sb_world_tell_signal(r->cluster.ranks, signal);
    }
    sb_world_await(r->cluster.ranks, given, sizeof *given);
    return act(r, given, error);
}

void sb_cluster_watch(void)
{
    sb_stop_watch();
    if (sb_world_started()) sb_stop_watch_forwarded();
}

/* ---- rank 0 ---- */

sb_status sb_cluster_build(run *r, sb_error *error)
{
    return sb_cluster_order(r, &(order){.what = ORDER_BUILD}, error);
}

sb_status sb_cluster_create(run *r, bool resume, sb_error *error)
{
    const sb_status status = sb_cluster_order(r, &(order){.what = ORDER_CREATE, .flag = resume}, error);
    if (status == SB_OK && sb_cluster_several(r))
        sb_stop_defer(true); /* from now on ranks must stop at the same step */
    return status;
}

sb_status sb_cluster_measure(run *r, bool find, sb_error *error)
{
    return sb_cluster_order(r, &(order){.what = ORDER_MEASURE, .flag = find}, error);
}

sb_status sb_cluster_settle(run *r, sb_settle_watch *watch, sb_error *error)
{
    r->cluster.watch = watch;
    return sb_cluster_order(r, &(order){.what = ORDER_SETTLE}, error);
}

sb_status sb_cluster_step(run *r, sb_error *error)
{
    return sb_cluster_order(r, &(order){.what = ORDER_STEP}, error);
}

sb_status sb_cluster_observe(run *r, sb_error *error)
{
    return sb_cluster_order(r, &(order){.what = ORDER_OBSERVE}, error);
}

void sb_cluster_find_pressures(run *r)
{
    (void)sb_cluster_order(r, &(order){.what = ORDER_PRESSURES}, NULL);
}

sb_frame *sb_cluster_snapshot(run *r)
{
    (void)sb_cluster_order(r, &(order){.what = ORDER_SNAPSHOT}, NULL);
    return r->cluster.frame;
}

sb_status sb_cluster_write_pieces(run *r, uint64_t number, sb_frame **frame, sb_error *error)
{
    const sb_status status = sb_cluster_order(r, &(order){.what = ORDER_PIECES, .number = number}, error);
    *frame = r->cluster.frame;
    return status;
}

uint64_t sb_cluster_hash(run *r)
{
    (void)sb_cluster_order(r, &(order){.what = ORDER_HASH}, NULL);
    return r->cluster.hash;
}

sb_energy sb_cluster_energy(run *r)
{
    (void)sb_cluster_order(r, &(order){.what = ORDER_ENERGY}, NULL);
    return r->cluster.energy;
}

sb_status sb_cluster_trigger(run *r, size_t wavemaker, sb_error *error)
{
    return sb_cluster_order(r, &(order){.what = ORDER_TRIGGER, .number = wavemaker}, error);
}

void sb_cluster_heed(run *r)
{
    if (!sb_cluster_several(r) || sb_stop_signal()) return;
    const int own = sb_stop_waiting(), told = own ? 0 : sb_world_signal_told(r->cluster.ranks);
    if (own || told)
        (void)sb_cluster_order(
            r,
            &(order){.what = ORDER_STOP, .flag = own && sb_stop_by_command(), .number = (uint64_t)(own ? own : told)},
            NULL);
}

void sb_cluster_stay(run *r)
{
    if (sb_cluster_several(r)) (void)sb_cluster_order(r, &(order){.what = ORDER_STAY}, NULL);
}

void sb_cluster_release(run *r)
{
    (void)sb_cluster_order(r, &(order){.what = ORDER_RELEASE}, NULL);
}

void sb_cluster_dismiss(run *r)
{
    if (!sb_cluster_several(r) || r->cluster.dismissed) return;
    (void)sb_cluster_order(r, &(order){.what = ORDER_DISMISS}, NULL);
    r->cluster.dismissed = true;
    sb_stop_defer(false);
}

/* ---- the other ranks ---- */

void sb_cluster_follow(const sb_scene *scene, const char *directory, const sb_run_options *options)
{
    run r = {.resolved = *scene, .directory = directory, .lock = -1, .cluster = {.ranks = options->ranks}};
    order given = {0};
    r.scene = &r.resolved;
    sb_cluster_watch();
    sb_stop_defer(true);
    (void)sb_checkpoint_begin(&r, NULL); /* rank 0 does the same, and says why if it fails */
    while (given.what != ORDER_DISMISS) (void)sb_cluster_next(&r, &given, NULL);
    sb_measure_destroy(r.prepared);
    sb_measure_destroy(r.measure);
    sb_sim_destroy(r.sim);
    sb_checkpoint_end(&r);
    sb_model_free(&r.model);
}
