/* Puts frames together from their parts, and counts complete frames, partial frames and missing parts. */
#ifndef SB_STREAM_ASSEMBLY_H
#define SB_STREAM_ASSEMBLY_H

#include "stream/decode.h"

#include <stdbool.h>

/* Particles [first, first + count) of a frame, whose positions are relative to one corner. */
typedef struct sb_live_part {
    int64_t first;
    int32_t count; /* -1: not received */
    double corner[3];
} sb_live_part;

/* A frame. Particle i of part p: sb_point_decode(points + 8 i, parts[p].corner, quantum, speed_max, pressure_max). */
typedef struct sb_live_frame {
    int64_t frame, step;
    double time; /* s */
    int32_t decimation;
    double spacing, quantum; /* m */
    double speed_max, pressure_max;
    int64_t count;
    int32_t part_count, moved_count;
    sb_live_part *parts;
    unsigned char *points; /* SB_STREAM_POINT bytes each */
    int32_t *moved;        /* indices into the bodies of the scene */
    double *displacement;  /* m, three per moved body */
    size_t part_capacity, point_capacity, moved_capacity, displacement_capacity;
} sb_live_frame;

/* A zero-initialised struct is empty. A frame ends when a part of a later frame arrives. */
typedef struct sb_assembly {
    uint64_t frames_complete, frames_partial;
    uint64_t parts, parts_lost; /* received; missing from frames that have ended */
    uint64_t parts_repaired;    /* computed from parity; they are not lost */
    uint64_t parts_ignored;     /* duplicates, late ones, and those that contradict the others of their frame */
    int32_t received;           /* parts of the present frame */
    sb_live_frame present;      /* the frame whose parts arrive; part_count 0: none */
    sb_live_frame newest;       /* the newest complete frame; part_count 0: none */
} sb_assembly;

/* Adds one part. *complete: whether assembly->newest is now another frame. It stays valid until the next one is.
   SB_FAILED if memory runs out; the part is then ignored. */
sb_status sb_assembly_add(sb_assembly *assembly, const sb_frame_message *part, bool *complete);

/* Computes the lost part of a group, if it is the only one. *complete as above. */
void sb_assembly_repair(sb_assembly *assembly, const sb_parity_message *parity, bool *complete);

/* Forgets the present frame, because its run has ended. The newest frame and the counts stay. */
void sb_assembly_restart(sb_assembly *assembly);

/* Frees the frames and zeroes the counts. */
void sb_assembly_free(sb_assembly *assembly);

#endif
