/* Decodes the messages of a run from untrusted bytes into plain structs. */
#ifndef SB_STREAM_DECODE_H
#define SB_STREAM_DECODE_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    SB_STREAM_VERSION = 2,         /* of the message types */
    SB_STREAM_MESSAGE_MAX = 60000, /* bytes: larger messages lose fragments with default socket buffers */
    SB_STREAM_POINT = 8,           /* bytes of a particle */
    SB_STREAM_POINTS = 7100,       /* particles that fit into one part of a frame, beside the displaced bodies */
    SB_STREAM_MOVED = 100,         /* displaced bodies that a frame can list */
    SB_STREAM_PARTS_MAX = 1 << 16, /* parts of a frame */
    SB_STREAM_TOTAL_MAX = 1 << 26, /* particles of a frame */
    SB_STREAM_ROWS = 350,          /* bodies or gauges that fit into one message, with the longest names */
    SB_STREAM_PIECE = 59000,       /* bytes of the scene that fit into one message */
    SB_STREAM_SCENE_MAX = 1 << 27, /* bytes of an encoded scene */
    SB_STREAM_STAGES = 32,         /* stages of a time step: SB_STAGES_MAX */
    SB_STREAM_NAME = 64            /* bytes of a name with its terminating zero */
};

/* The largest run id: numbers up to it are exact in every language. */
#define SB_STREAM_RUN_MAX (((int64_t)1 << 53) - 1)

typedef enum sb_run_state { SB_RUN_RUNNING, SB_RUN_PAUSED, SB_RUN_DONE, SB_RUN_STATES } sb_run_state;

/* The state's name: "running", "paused" or "done". */
const char *sb_run_state_name(sb_run_state state);

/* The run and the sequence number, with which every message begins. */
typedef struct sb_message_head {
    int64_t run_id, sequence;
} sb_message_head;

/* Fields as in lcmtypes, in SI units. Names are printable ASCII; other bytes are replaced by '?'. */
typedef struct sb_status_message {
    sb_message_head head;
    char run[SB_STREAM_NAME];
    sb_run_state state;
    int64_t step;
    double time, duration, time_step;
    int32_t iterations;
    int64_t capped_steps;
    double density_error, density_error_max, tolerance;
    double max_speed, wall_seconds;
    double eta_seconds; /* negative: unknown */
    int64_t lost_particles, fluid_particles, frame;
    int64_t messages, bytes, errors, frames_skipped;
    double rate; /* frames per second of wall time, at most; 0: no limit */
    int32_t decimation;
    double region_min[3], region_max[3];
    int32_t stage_count;
    char stages[SB_STREAM_STAGES][SB_STREAM_NAME];
    double stage_seconds[SB_STREAM_STAGES];
} sb_status_message;

typedef struct sb_forces_message {
    sb_message_head head;
    double time;
    int32_t total, first, count; /* rows [first, first + count) of total */
    char names[SB_STREAM_ROWS][SB_STREAM_NAME];
    int32_t body[SB_STREAM_ROWS];
    double force[3 * SB_STREAM_ROWS], moment[3 * SB_STREAM_ROWS];
    double pressure[3 * SB_STREAM_ROWS], friction[3 * SB_STREAM_ROWS];
} sb_forces_message;

typedef struct sb_gauges_message {
    sb_message_head head;
    double time;
    int32_t total, first, count; /* gauges [first, first + count) of total */
    char names[SB_STREAM_ROWS][SB_STREAM_NAME];
    unsigned char wet[SB_STREAM_ROWS];
    double eta[SB_STREAM_ROWS], z[SB_STREAM_ROWS];
} sb_gauges_message;

typedef struct sb_frame_message {
    sb_message_head head;
    int64_t frame, step;
    double time;
    int32_t part, part_count;
    int64_t total, first;
    int32_t decimation;
    double spacing, quantum, corner[3], speed_max, pressure_max;
    int32_t moved_count;
    int32_t moved[SB_STREAM_MOVED];
    double displacement[3 * SB_STREAM_MOVED];
    int32_t count;
    const unsigned char *points; /* SB_STREAM_POINT bytes each, within the decoded buffer */
} sb_frame_message;

typedef struct sb_parity_message {
    sb_message_head head;
    int64_t frame;
    int32_t part_count, group, group_count;
    int32_t count;             /* bytes: those of a full part */
    const unsigned char *data; /* within the decoded buffer */
} sb_parity_message;

enum { SB_STREAM_TEXT = 256 }; /* bytes of the text of a reply with its terminating zero */

typedef struct sb_reply_message {
    sb_message_head head;
    int64_t id, counter; /* of the command */
    bool refused;
    int64_t step;
    double time; /* s, simulated */
    char text[SB_STREAM_TEXT];
} sb_reply_message;

typedef struct sb_scene_piece_message {
    sb_message_head head;
    int64_t scene_id, total;
    int32_t piece, piece_count;
    int64_t offset;
    int32_t count;
    const unsigned char *data; /* within the decoded buffer */
} sb_scene_piece_message;

/* Each function decodes one message of `size` bytes. SB_BAD_INPUT, with *out unchanged, if the fingerprint or version
   is that of another type, a count contradicts the size or another count, a name is not terminated, a number is not
   finite or out of its range, or bytes are left over. error may be NULL. */
sb_status sb_stream_decode_status(const void *buffer, size_t size, sb_status_message *out, sb_error *error);
sb_status sb_stream_decode_forces(const void *buffer, size_t size, sb_forces_message *out, sb_error *error);
sb_status sb_stream_decode_gauges(const void *buffer, size_t size, sb_gauges_message *out, sb_error *error);
sb_status sb_stream_decode_frame(const void *buffer, size_t size, sb_frame_message *out, sb_error *error);
sb_status sb_stream_decode_parity(const void *buffer, size_t size, sb_parity_message *out, sb_error *error);
sb_status sb_stream_decode_reply(const void *buffer, size_t size, sb_reply_message *out, sb_error *error);
sb_status sb_stream_decode_piece(const void *buffer, size_t size, sb_scene_piece_message *out, sb_error *error);

#endif
