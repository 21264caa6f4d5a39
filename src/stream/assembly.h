/* Book-keeping over arriving particle chunks: which frames are whole, which chunks never came. */
#ifndef SB_STREAM_ASSEMBLY_H
#define SB_STREAM_ASSEMBLY_H

#include "stream/decode.h"

/* Zero-initialised is empty. A frame is over when a chunk of another frame comes. */
typedef struct sb_assembly {
    uint64_t frames_complete, frames_partial;
    uint64_t chunks, chunks_lost; /* lost: of frames that are over */
    uint64_t chunks_odd;          /* came twice, or disagree with their frame's others: ignored */
    int64_t frame, total;         /* of the frame in the making */
    double time;                  /* s */
    int32_t chunk_count, received;
    unsigned char *seen; /* one flag per chunk of it */
    size_t seen_capacity;
} sb_assembly;

/* Books one chunk. SB_FAILED without memory for the flags, the chunk being ignored. */
sb_status sb_assembly_add(sb_assembly *assembly, const sb_particles_message *chunk);

/* Frees the flags and zeroes the counts. */
void sb_assembly_free(sb_assembly *assembly);

#endif
