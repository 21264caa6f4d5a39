/* Particles as integers of eight bytes each (lcmtypes/frame_t.lcm). */
#ifndef SB_STREAM_POINTS_H
#define SB_STREAM_POINTS_H

#include "frame/frame.h"
#include "stream/decode.h"

/* Positions are multiples of spacing / SB_POINTS_PER_SPACING from the corner of their part. They are off by at most
   half of that along each axis: 0.0078 spacings, or 0.0136 as a distance. */
enum { SB_POINTS_PER_SPACING = 64 };

/* Which particles of a frame are sent: one in `decimation`, within the region (m). */
typedef struct sb_points_choice {
    uint64_t decimation; /* at least 1 */
    sb_vec3 min, max;
} sb_points_choice;

/* Particles [first, first + count) of the sent ones, whose positions are relative to one corner. */
typedef struct sb_points_part {
    size_t first, count;
    double corner[3]; /* m */
} sb_points_part;

/* The sent particles of a frame. A zero-initialised struct is empty; its memory is used again for the next frame. */
typedef struct sb_points {
    size_t count, part_count; /* at least one part, which may be empty */
    double quantum;           /* m */
    float speed_max, pressure_max;
    sb_points_part *parts;
    unsigned char *bytes;
    uint32_t *chosen; /* indices in the frame */
    size_t part_capacity, byte_capacity, chosen_capacity;
} sb_points;

/* Chooses and encodes the particles of a frame. The choice is by a hash of the particle's id: the same particles in
   every frame, and, unlike every n-th particle of a lattice, without preference for a lattice plane. A part ends after
   SB_STREAM_POINTS particles, and where the next one would be more than 65535 quanta away from another one of the part.
   SB_FAILED without memory, or if the frame needs more than SB_STREAM_PARTS_MAX parts. */
sb_status sb_points_encode(sb_points *points, const sb_frame *frame, const sb_points_choice *choice, sb_error *error);
void sb_points_free(sb_points *points);

/* One particle as decoded from its eight bytes. */
typedef struct sb_point {
    double position[3]; /* m */
    float speed, pressure;
} sb_point;
sb_point sb_point_decode(const unsigned char bytes[SB_STREAM_POINT], const double corner[3], double quantum,
                         double speed_max, double pressure_max);

#endif
