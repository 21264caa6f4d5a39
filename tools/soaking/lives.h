/* What is seen of a run's processes from outside, and what is held against it. */
#ifndef SB_SOAKING_LIVES_H
#define SB_SOAKING_LIVES_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

/* A process at one moment. */
typedef struct sb_soak_sample {
    double seconds;    /* of its life */
    uint64_t resident; /* bytes */
    unsigned descriptors;
    uint64_t step; /* the last one streamed */
} sb_soak_sample;

typedef enum sb_soak_end { SB_SOAK_STOPPED, SB_SOAK_FINISHED, SB_SOAK_BROKEN } sb_soak_end;

/* One process, from its start to its end. */
typedef struct sb_soak_life {
    double begun, seconds; /* s: since the soak's beginning; how long */
    bool resumed;          /* or begun anew */
    sb_soak_end end;
    char words[300];                /* how it ended, when broken */
    uint64_t first_step, last_step; /* streamed; 0: none */
    uint64_t frames, chunks_lost;   /* that the subscriber got whole; chunks of others that never came */
    sb_soak_sample *samples;        /* owned */
    size_t count, capacity;
} sb_soak_life;

/* A life's early and late middle values, from its first streamed step on: before that the model is made and settles.
   The first third of that span is the warm-up: first pictures, buffers. Early: from a third to a half; late: the last
   sixth. */
typedef struct sb_soak_growth {
    bool judged;              /* long enough for that, with enough samples on both sides */
    double early, late, peak; /* bytes resident */
    double descriptors_early, descriptors_late;
    unsigned descriptors_peak;
} sb_soak_growth;

/* A life may grow by this share of its early memory, and by so many bytes: pages of buffers that follow the wave. */
extern const double sb_soak_share, sb_soak_bytes;
/* s: a shorter span is not judged for growth; the warm-up may be most of it. */
extern const double sb_soak_shortest;

/* Looks at a living process. SB_FAILED when it is gone. */
sb_status sb_soak_look(pid_t process, sb_soak_sample *sample, sb_error *error);
/* SB_FAILED without memory. */
sb_status sb_soak_keep(sb_soak_life *life, const sb_soak_sample *sample, sb_error *error);

sb_soak_growth sb_soak_grown(const sb_soak_life *life);
/* Whether a life is as it should be; else why not, in a few words. A life too short to be judged for growth has only to
   end well. */
bool sb_soak_well(const sb_soak_life *life, char why[400]);

#endif
