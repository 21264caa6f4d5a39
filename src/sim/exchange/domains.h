/* Domains: the parts of the water that the ranks of a run compute. A domain is a range of keys along the Z-curve, cut
   between blocks of 2 x 2 x 2 cells, so that a group of particles lies in one domain, and the particles of all domains,
   one domain after another, have the order that they have without domains. Groups, lists and sums are therefore the
   same however the keys are cut (docs/decisions/0061). */
#ifndef SB_SIM_DOMAINS_H
#define SB_SIM_DOMAINS_H

#include "base/ranks.h"
#include "sim/exchange/exchange.h"
#include "sim/search/pairs.h"

/* The last bits of a key: the cell within its block. A group is the content of a block: block_of in search/around.c has
   the same cells. Blocks of particles (SB_BLOCK) are something else. */
enum { SB_CELLS_BITS = 3 };

/* A particle that another domain takes over. */
typedef struct sb_migrant {
    uint32_t particle;
    int32_t to; /* rank */
} sb_migrant;

/* What this domain sends in each exchange of values, and what it receives, by rank. */
typedef struct sb_halo_plan {
    sb_run *run;   /* entries to send, rank after rank */
    size_t *place; /* of each run among all entries sent */
    size_t runs, run_capacity, place_capacity;
    size_t *sends, *receives; /* ranks: particles */
    size_t sent;              /* particles to all ranks */
} sb_halo_plan;

typedef struct sb_domains {
    sb_ranks *ranks;
    uint64_t *cut;  /* ranks + 1: rank r has the keys [cut[r], cut[r + 1]) */
    uint64_t *next; /* the same from the next sort on, if `recut` */
    bool recut;
    uint64_t searches;  /* for neighbours, so far */
    uint64_t cuts;      /* made anew, so far */
    double imbalance;   /* largest load over the mean, less 1, when it was last counted */
    double mean, worst; /* of all counts but the first, when each rank had as many particles */
    uint64_t counts;
    sb_halo_plan plan;
    bool under_way; /* a refresh: that of `flight` */
    sb_halo flight;
    sb_flying_sums sums;

    /* buffers */
    uint64_t *row;             /* ranks + 1: numbers for the others */
    uint64_t *column;          /* ranks: what the others have for this one */
    sb_parcel *send, *receive; /* ranks */
    char *out, *in;            /* bytes sent and received */
    size_t out_capacity, in_capacity;
    sb_migrant *migrant;
    size_t migrant_capacity;
    uint64_t *pairs; /* of rank and cell, for the halo */
    size_t pairs_capacity;
} sb_domains;

/* Makes the domains of sim->ranks, which are not cut yet. SB_FAILED without memory. */
sb_status sb_domains_create(sb_sim *sim, sb_error *error);
void sb_domains_destroy(sb_domains *domains);
size_t sb_domains_bytes(const sb_domains *domains);
/* Frees the buffers of particles that are handed over: at the start there are many, later few. */
void sb_domains_free_buffers(sb_domains *domains);

/* The rank that has a key. */
static inline int sb_domains_owner(const sb_domains *domains, uint64_t key)
{
    int low = 0, high = domains->ranks->count - 1;
    while (low < high) {
        const int middle = (low + high + 1) / 2;
        if (domains->cut[middle] <= key)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

static inline bool sb_domains_owns(const sb_domains *domains, uint64_t key)
{
    const int own = domains->ranks->rank;
    return key >= domains->cut[own] && key < domains->cut[own + 1];
}

/* The same failure in all domains: that of the first rank that has one with a message. */
sb_status sb_domains_agree(const sb_sim *sim, sb_status own, sb_error *error);

/* Gives each rank its number of `domains->row`, and gets those for this one into `domains->column`. */
void sb_domains_swap_row(sb_domains *domains);

/* first_cut.c. The place of particle i of a set of all particles. */
typedef sb_record sb_place_of(const sb_sim *sim, const void *set, size_t i);
/* Cuts the keys so that each domain has about the same number of the set's particles. This rank knows the places of the
   particles [from, from + count); the parts of all ranks make up the set. SB_FAILED without memory. */
sb_status sb_domains_cut_parts(sb_sim *sim, sb_place_of *place, const void *set, size_t from, size_t count,
                               sb_error *error);
/* The same, of `count` particles whose places all ranks know. */
sb_status sb_domains_cut(sb_sim *sim, sb_place_of *place, const void *set, size_t count, sb_error *error);

/* cut.c */
/* Once in several searches weighs the domains by their pairs of neighbours and, if one has too many, cuts them anew
   from the next sort on. found: whether this domain's search has succeeded. */
void sb_domains_balance(sb_sim *sim, bool found);

/* migrate.c */
sb_status sb_domains_migrate(sb_sim *sim, sb_error *error);

/* halo_plan.c: makes the plan of what this rank sends. Returns 0, or -1 without memory. */
int sb_domains_plan_sends(sb_sim *sim);
/* Finds the ranks, this one included, whose groups read the cell of `at`, images beyond periodic sides aside. Returns
   their number. */
size_t sb_domains_readers(const sb_sim *sim, sb_record at, int rank[SB_RANKS_MAX]);

/* halo.c */
sb_status sb_domains_make_ghosts(sb_sim *sim, sb_error *error);
void sb_domains_refresh(const sb_sim *sim, const sb_halo *halo);
void sb_domains_begin(const sb_sim *sim, const sb_halo *halo);
/* Ends the refresh that is under way, if one is. */
void sb_domains_land(const sb_sim *sim);

#endif
