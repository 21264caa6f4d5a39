/* The run time of the stages of a time step. */
#ifndef SB_FRAME_STAGE_TIME_H
#define SB_FRAME_STAGE_TIME_H

#include <stdint.h>

enum { SB_STAGES_MAX = 33 };

/* Seconds and calls of each stage in this process, settling included, for the stage table. */
typedef struct sb_stage_time {
    const char *name;
    double seconds;
    uint64_t calls;
} sb_stage_time;

#endif
