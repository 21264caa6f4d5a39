/* A simulation without other domains: its ghosts are images beyond its own periodic sides, and its sums are the global
   ones. */
#include "sim/exchange/exchange.h"
#include "sim/exchange/images.h"

static sb_status make_ghosts(sb_sim *sim, sb_error *error)
{
    const sb_status status = sb_images_make(sim, error);
    sim->ghosts.any = sim->ghosts.count > 0;
    return status;
}

static void refresh(const sb_sim *sim, const sb_halo *halo)
{
    sb_images_refresh(sim, halo);
}

static void sum(const sb_sim *sim, sb_exact *values, size_t count)
{
    (void)sim, (void)values, (void)count;
}

static double sum_and_largest(const sb_sim *sim, sb_exact *values, size_t count, double value)
{
    (void)sim, (void)values, (void)count;
    return value;
}

static void sum_counts(const sb_sim *sim, uint64_t *values, size_t count)
{
    (void)sim, (void)values, (void)count;
}

static double largest(const sb_sim *sim, double value)
{
    (void)sim;
    return value;
}

static sb_status agree(const sb_sim *sim, sb_status own, sb_error *error)
{
    (void)sim, (void)error;
    return own;
}

const sb_exchange sb_exchange_alone = {
    .name = "alone",
    .make_ghosts = make_ghosts,
    .refresh = refresh,
    .sum = sum,
    .sum_and_largest = sum_and_largest,
    .count = sum_counts,
    .largest = largest,
    .agree = agree,
};
