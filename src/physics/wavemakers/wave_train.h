/* The motion of a paddle that makes waves of long duration, and the waves that it makes: a sum of harmonic parts, or a
   cnoidal wave. The laws regular, irregular, components, focused and signal share it. */
#ifndef SB_PHYSICS_WAVE_TRAIN_H
#define SB_PHYSICS_WAVE_TRAIN_H

#include "physics/wavemakers/paddle_transfer.h"
#include "physics/wavemakers/wavemaker.h"
#include "physics/waves/cnoidal.h"

#include <stdbool.h>

/* The paddle is at s sin(omega t + phase + ahead); the surface at the distance x ahead is a cos(omega t + phase - k x).
 */
typedef struct sb_train_part {
    double omega, phase;      /* 1/s, rad */
    double ahead;             /* rad: 0 but for a bound part */
    double stroke, amplitude; /* m: s and a */
    double number;            /* 1/m: k */
    double near;              /* surface of the waves that stay near the paddle over its displacement, at the place */
    bool bound;               /* travels with another part: it has no waves of its own near the paddle */
} sb_train_part;

typedef struct sb_wave_train {
    sb_paddle_motion motion;
    double depth, gravity, ramp, lasts; /* m, m/s^2, s, s */
    double origin;                      /* m, sum of the parts at t = 0 if there is no ramp */
    double place;                       /* m ahead of the paddle, where its surface is asked for */
    size_t count;
    sb_train_part *part;
    bool is_cnoidal;
    sb_cnoidal cnoidal;
    double mean; /* m, of a cnoidal wave's surface over a period at that place, which moves with the paddle */
    sb_wave_facts facts;
} sb_wave_train;

/* Allocates a train with `count` empty parts for the parameters; NULL without memory. */
sb_wave_train *sb_wave_train_create(const sb_wavemaker_parameters *parameters, size_t count);
/* Sets a part that is a free linear wave of amplitude a, and its stroke. */
void sb_wave_train_set(sb_wave_train *train, size_t i, double amplitude, double omega, double phase);
/* Sets facts.height and its name to those of the sum of all parts, by the rule of irregular waves. SB_BAD_INPUT, of the
   file that has the waves, if the sum breaks. */
sb_status sb_wave_train_sum(sb_wave_train *train, const char *path, sb_error *error);
/* Ends the creation: sets what follows from the parts. */
void sb_wave_train_complete(sb_wave_train *train);

/* The members of sb_wavemaker; state: a train. */
double sb_wave_train_displacement(const void *state, double t);
double sb_wave_train_duration(const void *state);
void sb_wave_train_place(void *state, double distance);
double sb_wave_train_surface(const void *state, double t);
size_t sb_wave_train_band(const void *state, sb_band_part *band, size_t capacity);
const sb_wave_facts *sb_wave_train_facts(const void *state);
void sb_wave_train_destroy(void *state);

#define SB_WAVE_TRAIN_LAW                                                                                              \
    .displacement = sb_wave_train_displacement, .duration = sb_wave_train_duration, .place = sb_wave_train_place,      \
    .surface = sb_wave_train_surface, .band = sb_wave_train_band, .facts = sb_wave_train_facts,                        \
    .destroy = sb_wave_train_destroy

#endif
