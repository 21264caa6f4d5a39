#include "sim/exchange/domains.h"

#include "base/agree.h"
#include "base/memory.h"
#include "sim/exchange/sums.h"

sb_status sb_domains_create(sb_sim *sim, sb_error *error)
{
    sb_domains *d = sim->domains = sb_alloc(1, sizeof *d);
    if (!d) return sb_fail_memory(error, "domains");
    const size_t ranks = (size_t)sim->ranks->count;
    d->ranks = sim->ranks;
    d->cut = sb_alloc(ranks + 1, sizeof *d->cut);
    d->next = sb_alloc(ranks + 1, sizeof *d->next);
    d->column = sb_alloc(ranks, sizeof *d->column);
    d->row = sb_alloc(ranks + 1, sizeof *d->row);
    d->send = sb_alloc(ranks, sizeof *d->send);
    d->receive = sb_alloc(ranks, sizeof *d->receive);
    d->plan.sends = sb_alloc(ranks, sizeof *d->plan.sends);
    d->plan.receives = sb_alloc(ranks, sizeof *d->plan.receives);
    if (!d->cut || !d->next || !d->column || !d->row || !d->send || !d->receive || !d->plan.sends || !d->plan.receives)
        return sb_fail_memory(error, "domains");
    return SB_OK;
}

void sb_domains_destroy(sb_domains *d)
{
    if (!d) return;
    sb_free(d->cut);
    sb_free(d->next);
    sb_free(d->column);
    sb_free(d->row);
    sb_free(d->send);
    sb_free(d->receive);
    sb_free(d->plan.sends);
    sb_free(d->plan.receives);
    sb_free(d->plan.run);
    sb_free(d->plan.place);
    sb_domains_free_buffers(d);
    sb_free(d->pairs);
    sb_free(d);
}

void sb_domains_free_buffers(sb_domains *d)
{
    sb_free(d->out);
    sb_free(d->in);
    sb_free(d->migrant);
    d->out = d->in = NULL;
    d->migrant = NULL;
    d->out_capacity = d->in_capacity = d->migrant_capacity = 0;
}

size_t sb_domains_bytes(const sb_domains *d)
{
    if (!d) return 0;
    const size_t ranks = (size_t)d->ranks->count;
    return 2 * ranks * sizeof *d->column + d->out_capacity + d->in_capacity + d->migrant_capacity * sizeof *d->migrant +
           d->plan.run_capacity * sizeof *d->plan.run + d->plan.place_capacity * sizeof *d->plan.place +
           d->pairs_capacity * sizeof *d->pairs;
}

void sb_domains_swap_row(sb_domains *d)
{
    sb_ranks_swap_numbers(d->ranks, d->row, d->column);
}

sb_status sb_domains_agree(const sb_sim *sim, sb_status own, sb_error *error)
{
    sb_domains_land(sim);
    return sb_ranks_agree(sim->ranks, own, error);
}

static void sum(const sb_sim *sim, sb_exact *values, size_t count)
{
    sb_domains_land(sim);
    sb_ranks_sum(sim->ranks, values, count);
}

static double sum_and_largest(const sb_sim *sim, sb_exact *values, size_t count, double value)
{
    _Static_assert((int)SB_SUMS_MAX <= (int)SB_RANKS_SUMS, "sums of one gather");
    sb_domains_land(sim);
    return sb_ranks_sum_and_largest(sim->ranks, values, count, value);
}

static void sum_begin(const sb_sim *sim, const sb_exact *values, size_t count, double value)
{
    sb_domains_land(sim);
    sb_ranks_sum_begin(sim->ranks, &sim->domains->sums, values, count, value);
}

static double sum_end(const sb_sim *sim, sb_exact *values)
{
    return sb_ranks_sum_end(sim->ranks, &sim->domains->sums, values);
}

static bool sum_under_way(const sb_sim *sim)
{
    return sim->domains->sums.under_way;
}

static bool sum_arrived(const sb_sim *sim)
{
    return sb_ranks_sum_arrived(sim->ranks, &sim->domains->sums);
}

static void sum_counts(const sb_sim *sim, uint64_t *values, size_t count)
{
    sb_domains_land(sim);
    sb_ranks_add(sim->ranks, values, count);
}

static double largest(const sb_sim *sim, double value)
{
    sb_domains_land(sim);
    return sb_ranks_largest(sim->ranks, value);
}

static bool under_way(const sb_sim *sim)
{
    return sim->domains->under_way;
}

static void progress(const sb_sim *sim)
{
    sb_ranks_progress(sim->ranks);
}

const sb_exchange sb_exchange_domains = {
    .name = "domains",
    .migrate = sb_domains_migrate,
    .make_ghosts = sb_domains_make_ghosts,
    .balance = sb_domains_balance,
    .refresh = sb_domains_refresh,
    .begin = sb_domains_begin,
    .under_way = under_way,
    .progress = progress,
    .land = sb_domains_land,
    .sum = sum,
    .sum_and_largest = sum_and_largest,
    .sum_begin = sum_begin,
    .sum_end = sum_end,
    .sum_under_way = sum_under_way,
    .sum_arrived = sum_arrived,
    .count = sum_counts,
    .largest = largest,
    .agree = sb_domains_agree,
};
