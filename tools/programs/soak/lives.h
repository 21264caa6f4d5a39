/* Memory and descriptors of a run's processes, measured from outside, and their limits. */
#ifndef SB_SOAK_LIVES_H
#define SB_SOAK_LIVES_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

/* A process at one time. */
typedef struct sb_soak_sample {
    double seconds;    /* since its start */
    uint64_t resident; /* bytes */
    unsigned descriptors;
    uint64_t step; /* the last one streamed */
} sb_soak_sample;

typedef enum sb_soak_end { SB_SOAK_STOPPED, SB_SOAK_FINISHED, SB_SOAK_FAILED } sb_soak_end;

/* A life: one process from its start to its end. */
typedef struct sb_soak_life {
    double begun, seconds; /* start since the beginning of the soak, duration; s */
    bool resumed;          /* otherwise started as a new run */
    sb_soak_end end;
    char message[300];              /* how it ended, if it failed */
    uint64_t first_step, last_step; /* streamed; 0: none */
    uint64_t frames, chunks_lost;   /* frames that the subscriber received completely; missing chunks of the others */
    sb_soak_sample *samples;        /* owned */
    size_t count, capacity;
} sb_soak_life;

/* Early and late medians of a life. The time since its first streamed step counts; before it, the model is built and
   settles. The first third of that time is the warm-up (first pictures, buffers). Early: from one third to one half of
   the time. Late: the last sixth. */
typedef struct sb_soak_growth {
    bool judged;              /* the time is long enough, with enough samples in both parts */
    double early, late, peak; /* bytes resident */
    double descriptors_early, descriptors_late;
    unsigned descriptors_peak;
} sb_soak_growth;

/* Allowed growth of memory: this fraction of the early memory plus so many bytes, for buffers that follow the wave. */
extern const double sb_soak_share, sb_soak_bytes;
/* s; the growth of a shorter life is not judged, because the warm-up may be most of it. */
extern const double sb_soak_shortest;

/* Measures a process. SB_FAILED: it has ended. */
sb_status sb_soak_measure(pid_t process, sb_soak_sample *sample, sb_error *error);
/* Adds a sample. SB_FAILED: out of memory. */
sb_status sb_soak_add(sb_soak_life *life, const sb_soak_sample *sample, sb_error *error);

sb_soak_growth sb_soak_growth_of(const sb_soak_life *life);
/* Whether a life passes; otherwise `why` says why not. A life whose growth is not judged has only to end without an
   error. */
bool sb_soak_passed(const sb_soak_life *life, char why[400]);

#endif
