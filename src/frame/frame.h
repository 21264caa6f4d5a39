/* A frame: an immutable copy of the simulation's state at one time, shared by reference among its consumers (files,
   pictures, stream). */
#ifndef SB_FRAME_FRAME_H
#define SB_FRAME_FRAME_H

#include "base/status.h"
#include "base/vec.h"
#include "frame/foam.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct sb_frame_body {
    char name[64];
    sb_vec3 displacement;  /* m since t = 0 */
    sb_vec3 velocity;      /* m/s in the last step; 0 if it is not known */
    sb_vec3 force, moment; /* N, Nm: mean over the last finished interval */
    bool report;           /* forces on this body are reported to the user */
} sb_frame_body;

typedef struct sb_frame_status {
    uint64_t step;
    double time, duration, time_step; /* s */
    int iterations;                   /* of the last pressure solve */
    double density_error;             /* mean relative compression after the solve */
    double max_speed;                 /* m/s */
    double wall_seconds, eta_seconds; /* run time so far, and estimated to the end */
    uint64_t lost_particles;
} sb_frame_status;

enum { SB_FRAME_FILM = 1, SB_FRAME_STILL = 2 };

/* Read-only once published. The arrays have one entry (or 3 floats) per particle; positions are relative to origin. */
typedef struct sb_frame {
    sb_frame_status status;
    uint64_t index;       /* 1, 2, ... over all frames of the run, for all consumers together */
    unsigned drawn;       /* SB_FRAME_FILM and SB_FRAME_STILL: what is drawn of it; 0: a picture of the film */
    sb_vec3 origin;       /* m, added to every position */
    double spacing;       /* m */
    size_t count;         /* fluid particles */
    float *position;      /* m, 3 per particle */
    float *velocity;      /* m/s, 3 per particle */
    float *pressure;      /* Pa */
    uint32_t *id;         /* stable through the run */
    float *density_error; /* density over that at rest, minus 1, when the step began; NULL: it is not known */
    sb_frame_foam foam;   /* empty unless the scene has foam */
    size_t body_count;
    sb_frame_body *bodies;
    size_t face_count;    /* faces of bodies, numbered as by sb_faces_make; 0: their loads are not known */
    float *face_pressure; /* Pa, mean over the face and over the last finished interval */
    _Atomic int references;
} sb_frame;

/* Carries the particles, the foam and the bodies of a frame that is not published yet from the end of its step to
   `time` within that step, along their velocities, as the step moved them. Velocities and pressures stay those of the
   step. */
void sb_frame_carry(sb_frame *frame, double time);

/* Returns the displacement of a body by its index in the model, else by its name; zero if the frame does not have it.
 */
sb_vec3 sb_frame_displacement(const sb_frame *frame, size_t index, const char *name);

/* Creates a frame with all arrays allocated and one reference; the caller fills the arrays. NULL if memory runs out. */
sb_frame *sb_frame_create(size_t count, size_t body_count);
/* Allocates the arrays of the foam of a frame without foam that is not published yet. Returns 0, or -1 without memory;
   the frame then has no foam. */
int sb_frame_add_foam(sb_frame *frame, size_t count);
/* Adds the array density_error to a frame that is not published yet, without initialising it. False if memory runs
   out. */
bool sb_frame_add_density_error(sb_frame *frame);
/* Allocates the array face_pressure of a frame that is not published yet, without initialising it. False if memory runs
   out: the frame then has no faces. */
bool sb_frame_add_faces(sb_frame *frame, size_t count);
/* Makes room for more particles at the end, which the caller fills but for the density error, which is 0, in a frame
   that is not published yet. Returns 0, or -1 if memory runs out: the frame is then unchanged. */
int sb_frame_extend(sb_frame *frame, size_t more);
/* sb_frame_retain adds a reference and returns the frame. sb_frame_release removes one and frees the frame with the
   last. NULL has no effect. */
const sb_frame *sb_frame_retain(const sb_frame *frame);
void sb_frame_release(const sb_frame *frame);

#endif
