/* Runs what is wanted and not yet there, as processes of the real program. */
#ifndef SB_VALIDATION_LAUNCH_H
#define SB_VALIDATION_LAUNCH_H

#include "store.h"

/* Runs every request that the store lacks for this build, in their order. jobs 1: one at a time
   with all cores; more: that many at a time with one thread each. Says on stdout what is run and
   how long it took. One that was stopped goes on from its checkpoint. A run that fails is stored as
   failed, counted in *failed, and the others go on.
   SB_INTERRUPTED after SIGINT or SIGTERM, which the running ones are told. */
sb_status sb_launch(const sb_store *store, const sb_request *requests, size_t count, int jobs, size_t *failed,
                    sb_error *error);

#endif
