/* Decodes the messages of a run from untrusted bytes into plain structs. */
#ifndef SB_STREAM_DECODE_H
#define SB_STREAM_DECODE_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    SB_STREAM_MESSAGE_MAX = 60000, /* bytes: larger messages lose fragments with default socket buffers */
    SB_STREAM_CHUNK = 2139,        /* particles that fit into one message */
    SB_STREAM_BODIES = 400,        /* bodies that fit into one message, with the longest names */
    SB_STREAM_CHUNKS_MAX = 1 << 20,
    SB_STREAM_NAME = 64 /* bytes of a name with its terminating zero */
};

/* Fields as in lcmtypes, in SI units. Names are printable ASCII; other bytes are replaced by '?'. */
typedef struct sb_status_message {
    char run[SB_STREAM_NAME];
    int64_t step;
    double time, duration, time_step;
    int32_t iterations;
    double density_error, max_speed, wall_seconds;
    double eta_seconds; /* negative: unknown */
    int64_t lost_particles, fluid_particles, frame;
} sb_status_message;

typedef struct sb_forces_message {
    int64_t frame;
    double time;
    int32_t total, first, count; /* bodies [first, first + count) of total */
    char names[SB_STREAM_BODIES][SB_STREAM_NAME];
    bool reported[SB_STREAM_BODIES];
    double force[3 * SB_STREAM_BODIES], moment[3 * SB_STREAM_BODIES];
    double displacement[3 * SB_STREAM_BODIES];
} sb_forces_message;

typedef struct sb_particles_message {
    int64_t frame;
    double time;
    int32_t chunk, chunk_count;
    int64_t total, first;
    int32_t decimation, count;
    double origin[3], spacing;
    float position[3 * SB_STREAM_CHUNK], velocity[3 * SB_STREAM_CHUNK], pressure[SB_STREAM_CHUNK];
} sb_particles_message;

/* Each function decodes one message of `size` bytes. SB_BAD_INPUT, with *out unchanged, if the fingerprint is that of
   another type, a count contradicts the size or another count, a name is not terminated, a number is not finite, or
   bytes are left over. error may be NULL. */
sb_status sb_stream_decode_status(const void *buffer, size_t size, sb_status_message *out, sb_error *error);
sb_status sb_stream_decode_forces(const void *buffer, size_t size, sb_forces_message *out, sb_error *error);
sb_status sb_stream_decode_particles(const void *buffer, size_t size, sb_particles_message *out, sb_error *error);

#endif
