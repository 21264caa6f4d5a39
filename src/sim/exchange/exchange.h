/* Everything that crosses the edge of the domain that this simulation computes: the values of ghosts, and sums, maxima
   and flags over all domains. Stages use nothing else for it, so that dividing a run among domains is another row here.
   Today the simulation is alone: its ghosts are images beyond its own periodic sides, and its sums are the global ones.
 */
#ifndef SB_SIM_EXCHANGE_H
#define SB_SIM_EXCHANGE_H

#include "base/exact.h"
#include "sim/simulation.h"

/* Values to bring up to date: those of the owned particles, and those of the ghosts, `stride` bytes apart each. */
typedef struct sb_halo {
    const void *owned;
    void *ghosts;
    size_t owned_stride, ghost_stride;
    size_t size; /* bytes of a value: 4 or 16 */
} sb_halo;

typedef struct sb_exchange {
    const char *name;
    /* After the sort: makes the ghosts, in the order of their keys, with positions and cells. */
    sb_status (*make_ghosts)(sb_sim *sim, sb_error *error);
    void (*refresh)(const sb_sim *sim, const sb_halo *halo);
    /* Adds up exact sums, and counts, of all domains. */
    void (*sum)(const sb_sim *sim, sb_exact *values, size_t count);
    void (*count)(const sb_sim *sim, uint64_t *values, size_t count);
    /* The largest value of all domains; none is NaN. */
    double (*largest)(const sb_sim *sim, double value);
    /* Whether the flag is set in any domain. */
    bool (*any)(const sb_sim *sim, bool flag);
} sb_exchange;

extern const sb_exchange sb_exchange_alone;

void sb_ghosts_destroy(sb_sim *sim);

/* Refresh the ghosts of a field: the entries after the owned ones. */
void sb_refresh(const sb_sim *sim, sb_f4 *field);
void sb_refresh_values(const sb_sim *sim, float *field);
/* Sets the last lanes of the ghosts' positions to the values of their originals. */
void sb_refresh_carried(sb_sim *sim, const float *values);

#endif
