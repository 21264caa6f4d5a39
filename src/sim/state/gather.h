/* What leaves the simulation from all domains together, in the order that a simulation alone has. */
#ifndef SB_SIM_GATHER_H
#define SB_SIM_GATHER_H

#include "base/archive_ranks.h"
#include "sim/simulation.h"

/* The particles of each domain, and of all. */
typedef struct sb_shares {
    uint64_t count[SB_RANKS_MAX], all;
    sb_archive_ranks lists; /* from sb_gather_begin to sb_gather_end */
} sb_shares;
void sb_gather_shares(const sb_sim *sim, sb_shares *shares);

/* Fields of all particles as lists of an archive, which the first domain has; `out` is NULL in the others. Begin counts
   the particles; then any number of lists (field NULL: an empty one); then the end (base/archive_ranks.h). */
void sb_gather_begin(const sb_sim *sim, sb_shares *shares, sb_archive_out *out);
void sb_gather_list(sb_shares *shares, sb_archive_out *out, void *field, size_t size);
void sb_gather_end(sb_shares *shares, sb_archive_out *out);

/* The part of a saved list of all particles that this domain takes: as many as another one, in their order. */
typedef struct sb_part {
    size_t from, count;
} sb_part;
sb_part sb_gather_part(const sb_sim *sim, size_t all);
/* Takes this domain's part of a list of sim->work.everywhere elements into `entries`; NULL: the list is empty. Returns
   where the list is; NULL: an error. */
const void *sb_take_part(const sb_sim *sim, sb_archive_in *in, void *entries, size_t size);

/* Puts `size` bytes for each particle, domain after domain, into `all` in the first domain; it is NULL in the others.
   own: of the own particles. */
void sb_gather_first(const sb_sim *sim, const sb_shares *shares, void *own, size_t size, void *all);

/* A sample, and the number of the cell in which a query found it, in the order in which a query visits cells. */
typedef struct sb_placed_sample {
    uint64_t cell;
    sb_fluid_sample sample;
} sb_placed_sample;

/* Merges the samples of all domains. own: in the order of their cells; NULL: this domain had no memory for them. Writes
   at most `capacity`. Returns the number of all, SIZE_MAX without memory in any domain. */
size_t sb_gather_samples(const sb_sim *sim, sb_placed_sample *own, size_t count, sb_fluid_sample *samples,
                         size_t capacity);

#endif
