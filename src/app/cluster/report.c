/* How the ranks shared the work, and what they sent to each other. */
#include "app/cluster/orders.h"
#include "app/run/parts.h"
#include "mpi/world.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>

/* What one rank tells the others, since its start. */
typedef struct share {
    double particles, halo; /* owned now; of others that it reads */
    double bytes, messages; /* sent */
    double stages, waited;  /* s of wall time: of all stages, and of it the part in which it waited for others */
    double steps, heap;     /* with those of settling; bytes of the simulation */
} share;

static share share_of(const run *r)
{
    const sb_ranks *ranks = &r->cluster.steps;
    const sb_stage_time *stages;
    const size_t count = sb_sim_stages(r->sim, &stages);
    const sb_division division = sb_sim_division(r->sim);
    share own = {.particles = (double)division.owned,
                 .halo = (double)division.halo,
                 .bytes = (double)ranks->bytes_sent,
                 .messages = (double)ranks->messages,
                 .waited = ranks->waited,
                 .steps = count > 0 ? (double)stages[0].calls : 0,
                 .heap = (double)sb_sim_bytes(r->sim)};
    for (size_t s = 0; s < count; s++) own.stages += stages[s].seconds;
    return own;
}

static double part(double of, double all)
{
    return all > 0 ? of / all : 0;
}

/* Sums and largest values over the ranks. */
static sb_rank_load sum_up(const share *all, int ranks)
{
    sb_rank_load sum = {0};
    double most_busy = 0, busy = 0, particles = 0, halo = 0, waited = 0, stages = 0, bytes = 0, messages = 0;
    for (int k = 0; k < ranks; k++) {
        const double own = all[k].stages - all[k].waited;
        busy += own;
        most_busy = fmax(most_busy, own);
        particles += all[k].particles;
        halo += all[k].halo;
        sum.most_particles = fmax(sum.most_particles, all[k].particles);
        waited += all[k].waited;
        stages += all[k].stages;
        bytes += all[k].bytes;
        messages += all[k].messages;
        sum.heap += all[k].heap;
    }
    sum.imbalance = busy > 0 ? most_busy * ranks / busy - 1 : 0;
    sum.mean_particles = particles / ranks;
    sum.mean_halo = halo / ranks;
    sum.waited = part(waited, stages);
    sum.bytes = part(bytes / ranks, all[0].steps);
    sum.messages = part(messages / ranks, all[0].steps);
    return sum;
}

sb_status sb_cluster_act_loads(run *r, const order *given, sb_error *error)
{
    share all[SB_RANKS_MAX];
    const share own = share_of(r);
    (void)given;
    (void)error;
    sb_ranks_gather(r->cluster.ranks, &own, sizeof own, all);
    const sb_division division = sb_sim_division(r->sim);
    r->cluster.load = sum_up(all, r->cluster.ranks->count);
    r->cluster.load.mean_excess = division.mean;
    r->cluster.load.worst_excess = division.worst;
    r->cluster.load.cuts = (double)division.cuts;
    return SB_OK;
}

size_t sb_cluster_bytes(const run *r)
{
    return sb_cluster_several(r) ? (size_t)r->cluster.load.heap : sb_sim_bytes(r->sim);
}

static void describe(const sb_rank_load *load, char text[500])
{
    snprintf(
        text, 500,
        "%.0f particles on average, at most %.0f, and %.0f of others; the largest load by pairs is %.1f %% above the "
        "mean, at most %.1f %% (cuts of the water: %.0f); computing differs by %.1f %%; a rank sends %.4g kB in %.4g "
        "messages "
        "per step, and waits %.1f %% of its time",
        load->mean_particles, load->most_particles, load->mean_halo, 100 * load->mean_excess, 100 * load->worst_excess,
        load->cuts, 100 * load->imbalance, 1e-3 * load->bytes, load->messages, 100 * load->waited);
}

void sb_cluster_log_start(run *r)
{
    if (!sb_cluster_several(r)) return;
    const int hosts = sb_world_hosts(r->cluster.ranks);
    sb_runlog_event(r->log, "ranks", "%d on %d host%s, %d thread%s each", r->cluster.ranks->count, hosts,
                    hosts == 1 ? "" : "s", omp_get_max_threads(), omp_get_max_threads() == 1 ? "" : "s");
}

void sb_cluster_log(run *r)
{
    char text[500];
    if (!sb_cluster_several(r)) return;
    (void)sb_cluster_order(r, &(order){.what = ORDER_LOADS}, NULL);
    describe(&r->cluster.load, text);
    sb_runlog_event(r->log, "load", "%s", text);
}

void sb_cluster_print(const run *r)
{
    char text[500];
    if (!sb_cluster_several(r) || !r->sim) return;
    describe(&r->cluster.load, text);
    printf("%d ranks: %s\n", r->cluster.ranks->count, text);
}
