/* Everything that crosses the edge of the domain that this simulation computes: particles that move to another domain,
   the values of ghosts, and sums and maxima over all domains. Stages use nothing else for it. A simulation is
   alone, or one of several domains (sim/exchange/domains.h); either is a row here. All domains call these functions in
   the same order. */
#ifndef SB_SIM_EXCHANGE_H
#define SB_SIM_EXCHANGE_H

#include "base/exact.h"
#include "sim/simulation.h"

/* Values to bring up to date: those of the owned particles, and those of the ghosts, `stride` bytes apart each. */
typedef struct sb_halo {
    const void *owned;
    void *ghosts;
    size_t owned_stride, ghost_stride;
    size_t size;         /* bytes of a value: 4 or 16 */
    bool without_images; /* only those of particles of other domains */
} sb_halo;

typedef struct sb_exchange {
    const char *name;
    /* Before the sort: hands over the particles that are in other domains now. NULL: there are none. */
    sb_status (*migrate)(sb_sim *sim, sb_error *error);
    /* After the sort: makes the ghosts, each kind in the order of its keys, with positions and cells. */
    sb_status (*make_ghosts)(sb_sim *sim, sb_error *error);
    /* After the search for neighbours, which has found them or has failed: decides whether the domains are to be cut
     * anew. NULL: there is one. */
    void (*balance)(sb_sim *sim, bool found);
    void (*refresh)(const sb_sim *sim, const sb_halo *halo);
    /* Begins a refresh, which `land` ends; every other function here ends it first. The values of the owned particles
       may not change in between, those of the ghosts may not be read. */
    void (*begin)(const sb_sim *sim, const sb_halo *halo); /* NULL, as the next three: values are there at once */
    /* Whether a refresh is under way. */
    bool (*under_way)(const sb_sim *sim);
    void (*progress)(const sb_sim *sim); /* sb_ranks_progress */
    void (*land)(const sb_sim *sim);
    /* Adds up exact sums, and counts, of all domains. */
    void (*sum)(const sb_sim *sim, sb_exact *values, size_t count);
    /* Adds up at most SB_SUMS_MAX sums, and returns the largest value. */
    double (*sum_and_largest)(const sb_sim *sim, sb_exact *values, size_t count, double value);
    /* The same in two parts. In between, no other function here but the next two may be called. NULL, as these: sums
       are there at once. */
    void (*sum_begin)(const sb_sim *sim, const sb_exact *values, size_t count, double value);
    double (*sum_end)(const sb_sim *sim, sb_exact *values);
    bool (*sum_under_way)(const sb_sim *sim);
    bool (*sum_arrived)(const sb_sim *sim); /* moves them on; whether the end will not wait */
    void (*count)(const sb_sim *sim, uint64_t *values, size_t count);
    /* The largest value of all domains; none is NaN. */
    double (*largest)(const sb_sim *sim, double value);
    /* The status in all domains: the failure of the first that has one, with its message. */
    sb_status (*agree)(const sb_sim *sim, sb_status own, sb_error *error);
} sb_exchange;

extern const sb_exchange sb_exchange_alone, sb_exchange_domains;

void sb_ghosts_destroy(sb_sim *sim);

/* Refresh the ghosts of a field: the entries after the owned ones. */
void sb_refresh(const sb_sim *sim, sb_f4 *field);
void sb_refresh_values(const sb_sim *sim, float *field);
/* Begins to refresh the ghosts of a field for the pass over groups that comes next (sim/passes/groups.h). */
void sb_refresh_begin(const sb_sim *sim, sb_f4 *field);
/* Sets the last lanes of the ghosts' positions to the values of their originals. */
void sb_refresh_carried(sb_sim *sim, const float *values);
void sb_refresh_carried_begin(sb_sim *sim, const float *values);
/* Refresh only what sb_entry_owner leads to: the particles of other domains. */
void sb_refresh_owners(const sb_sim *sim, sb_f4 *field);
void sb_refresh_owners_values(const sb_sim *sim, float *field);

#endif
