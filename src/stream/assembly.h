/* Counts the particle chunks that a subscriber receives: complete frames, partial frames and missing chunks. */
#ifndef SB_STREAM_ASSEMBLY_H
#define SB_STREAM_ASSEMBLY_H

#include "stream/decode.h"

/* A zero-initialised struct is empty. A frame ends when a chunk of another frame arrives. */
typedef struct sb_assembly {
    uint64_t frames_complete, frames_partial;
    uint64_t chunks, chunks_lost; /* received; missing from frames that have ended */
    uint64_t chunks_ignored;      /* duplicates, and chunks that contradict the others of their frame */
    int64_t frame, total;         /* of the current frame */
    double time;                  /* s */
    int32_t chunk_count, received;
    unsigned char *seen; /* one flag per chunk of the current frame */
    size_t seen_capacity;
} sb_assembly;

/* Counts one chunk. SB_FAILED if memory for the flags runs out; the chunk is then ignored. */
sb_status sb_assembly_add(sb_assembly *assembly, const sb_particles_message *chunk);

/* Frees the flags and zeroes the counts. */
void sb_assembly_free(sb_assembly *assembly);

#endif
