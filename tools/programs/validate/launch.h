/* Makes the requested runs that are not stored yet, each as a process of the real program. */
#ifndef SB_VALIDATION_LAUNCH_H
#define SB_VALIDATION_LAUNCH_H

#include "store.h"

/* Runs, in order, every request of which this build has no stored run. jobs 1: one run at a time with all cores;
   more: that many runs at a time with one thread each. Prints on stdout each run and its run time. A run that was
   stopped continues from its checkpoint. A failed run is stored as failed and counted in *failed; the others continue.
   SB_INTERRUPTED after SIGINT or SIGTERM, which is passed on to the running processes. */
sb_status sb_launch(const sb_store *store, const sb_request *requests, size_t count, int jobs, size_t *failed,
                    sb_error *error);

#endif
