/* Where the keys are cut anew into domains while the run lasts. A cut decides how long a step takes, and nothing else.
 */
#include "sim/exchange/domains.h"

#include <math.h>
#include <string.h>

/* A block's own cells, and what a step costs per particle besides its pairs, in pairs. */
enum { CELLS_OF_BLOCK = 1 << SB_CELLS_BITS, PAIRS_PER_PARTICLE = 16 };

/* The load is looked at after every so many searches. The keys are cut anew if the largest load is above the mean by
   more than a share IMBALANCE, and if the new cut removes at least the share WORTH of that. */
enum { SEARCHES = 8 };
static const double IMBALANCE = 0.05, WORTH = 0.25;

static uint64_t block_begin(uint64_t key)
{
    return key & ~(uint64_t)(CELLS_OF_BLOCK - 1);
}

/* What the step costs for a group: pairs of neighbours, and what it costs per particle. */
static uint64_t load_of(const sb_sim *sim, const sb_group *group)
{
    uint64_t load = PAIRS_PER_PARTICLE * (uint64_t)(group->end - group->first);
    for (size_t i = group->first; i < group->end; i++)
        load += 4 * (uint64_t)sim->work.pairs.count[i] + (sim->needs.wall_lists ? sim->work.wall_pairs.count[i] : 0);
    return load;
}

static uint64_t load_of_all(const sb_sim *sim)
{
    uint64_t load = 0;
    const size_t groups = sim->groups.count;
#pragma omp parallel for schedule(static) reduction(+ : load)
    for (size_t g = 0; g < groups; g++) load += load_of(sim, &sim->groups.group[g]);
    return load;
}

/* A cut that a rank proposes, because the load's share lies among its groups: the key, and the load before it. All 0:
   the share lies among the groups of another rank. */
typedef struct proposal {
    uint64_t key, before;
    uint64_t ranks; /* that propose it: 1, or 0 */
} proposal;

static uint64_t block_of_group(const sb_sim *sim, const sb_group *group)
{
    return block_begin(sb_space_key(&sim->space, sim->state.position[group->first]));
}

/* Fills in the proposals for the shares r/ranks of `all` that lie among this rank's groups; before: the load of the
   ranks before this one. A block may hold several groups, and is not cut. */
static void propose(const sb_sim *sim, uint64_t before, uint64_t all, proposal *made)
{
    const uint64_t ranks = (uint64_t)sim->ranks->count;
    const sb_groups *groups = &sim->groups;
    uint64_t load = before;
    size_t r = 1;
    for (size_t g = 0, next; g < groups->count; g = next) {
        const uint64_t block = block_of_group(sim, &groups->group[g]), start = load;
        for (next = g; next < groups->count && block_of_group(sim, &groups->group[next]) == block; next++)
            load += load_of(sim, &groups->group[next]);
        for (; r < ranks && all / ranks * r < load; r++) {
            const uint64_t share = all / ranks * r;
            if (share < start) continue;
            const bool at_start = share - start <= load - share;
            made[r] = (proposal){at_start ? block : block + CELLS_OF_BLOCK, at_start ? start : load, 1};
        }
    }
}

/* The largest load of the domains that the proposals make. */
static uint64_t largest_load(const proposal *made, size_t ranks, uint64_t all)
{
    uint64_t largest = 0, before = 0;
    for (size_t r = 1; r <= ranks; r++) {
        const uint64_t end = r < ranks ? made[r].before : all;
        largest = end - before > largest ? end - before : largest;
        before = end;
    }
    return largest;
}

/* Collects the proposals of all ranks, of which at most one proposes each cut. Returns whether there is one for each.
 */
static bool collect(sb_ranks *ranks, proposal *made)
{
    enum { VALUES = sizeof(proposal) / sizeof(uint64_t) };
    _Static_assert(sizeof(proposal) == 3 * sizeof(uint64_t), "no padding");
    bool complete = true;
    sb_ranks_add(ranks, &made[1].key, VALUES * (size_t)(ranks->count - 1));
    for (int r = 1; r < ranks->count; r++) complete &= made[r].ranks == 1;
    return complete;
}

void sb_domains_balance(sb_sim *sim, bool found)
{
    sb_domains *d = sim->domains;
    const size_t ranks = (size_t)d->ranks->count;
    if (d->searches++ % SEARCHES != 0) return;
    sb_domains_land(sim);
    uint64_t load[SB_RANKS_MAX], own = found ? load_of_all(sim) : 0, all = 0, before = 0, largest = 0;
    sb_ranks_gather(d->ranks, &own, sizeof own, load);
    for (size_t r = 0; r < ranks; r++) {
        before += r < (size_t)d->ranks->rank ? load[r] : 0;
        all += load[r];
        largest = load[r] > largest ? load[r] : largest;
    }
    const double mean = (double)all / (double)ranks, excess = (double)largest - mean;
    d->imbalance = all > 0 ? excess / mean : 0;
    if (d->counts > 0) {
        d->mean += (d->imbalance - d->mean) / (double)d->counts;
        d->worst = fmax(d->worst, d->imbalance);
    }
    d->counts++;
    if (!(excess > IMBALANCE * mean)) return;
    proposal made[SB_RANKS_MAX];
    memset(made, 0, sizeof made);
    if (found) propose(sim, before, all, made);
    if (!collect(d->ranks, made) || (double)largest_load(made, ranks, all) - mean > (1 - WORTH) * excess) return;
    for (size_t r = 1; r < ranks; r++) d->next[r] = made[r].key;
    d->next[0] = 0;
    d->next[ranks] = UINT64_MAX;
    d->recut = true;
    d->cuts++;
}
