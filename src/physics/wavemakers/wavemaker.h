/* Paddle laws: the displacement along the paddle's direction as a function of time. Each law is one row of a table.
   docs/adding-a-wavemaker.md describes how to add a law. */
#ifndef SB_PHYSICS_WAVEMAKER_H
#define SB_PHYSICS_WAVEMAKER_H

#include "base/status.h"
#include "physics/wavemakers/paddle_transfer.h"
#include "physics/waves/regular_wave.h"
#include "physics/waves/spectrum.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct sb_wavemaker sb_wavemaker;

typedef enum sb_after_stroke { SB_AFTER_STAY, SB_AFTER_RETURN } sb_after_stroke;

/* Values from the scene. Each law states which of them it needs. */
typedef struct sb_wavemaker_parameters {
    const sb_wavemaker *kind;
    double start;   /* s, when the motion begins; infinity: when sb_sim_trigger is called */
    double height;  /* m, wave height H */
    double depth;   /* m, still depth h at the paddle */
    double stroke;  /* m, full travel */
    double speed;   /* m/s */
    double gravity; /* m/s^2, from the scene */
    char *file;     /* absolute path of a time-displacement table */
    sb_after_stroke after;
    double return_time; /* s, duration of the slow return, when after is RETURN */
    /* wave trains */
    double period;        /* s, of regular waves; at the peak of a spectrum */
    sb_wave_order theory; /* of regular waves */
    sb_paddle_motion motion;
    double ramp, lasts; /* s, from rest to the full motion, negative: by the law; end of the motion, or infinity */
    sb_spectrum_kind spectrum;
    double gamma;    /* peak enhancement of JONSWAP */
    int components;  /* waves by which a spectrum is represented */
    uint64_t seed;   /* of their phases and frequencies */
    double distance; /* m ahead of the paddle: where waves focus, or a signal was measured */
    double focus;    /* s after the start, when they focus */
    bool absorb;     /* the paddle also takes waves that come back */
    double reach;    /* m, the farthest that it moves from its law for that */
} sb_wavemaker_parameters;

enum {
    SB_WM_HEIGHT = 1,
    SB_WM_DEPTH = 2,
    SB_WM_STROKE = 4,
    SB_WM_SPEED = 8,
    SB_WM_FILE = 16,
    SB_WM_PERIOD = 32,
    SB_WM_DISTANCE = 64,
    SB_WM_FOCUS = 128,
    SB_WM_TRAIN = 256, /* motion, ramp, lasts */
    SB_WM_THEORY = 512,
    SB_WM_SPECTRUM = 1024, /* spectrum, gamma, components */
    SB_WM_SEED = 2048
};

/* What a wave train is, for the user. */
typedef struct sb_wave_facts {
    const char *theory;            /* static text */
    const char *height_name;       /* "height", "significant height", ...: static text */
    double height, period, depth;  /* m; s, at the peak of a spectrum; m */
    double crest;                  /* m above the still level, of sums the significant height at most; 0: no waves */
    double highest;                /* m, of a signal the highest wave by zero crossing; 0: not known */
    double length, number, ursell; /* m; 1/m; H L^2/d^3 with the length of the linear wave, which decides */
    double ramp;                   /* s */
    double slow;                   /* 1/s, rate at which an absorbing paddle forgets levels and returns */
    size_t count;                  /* parts of the sum; 0: a cnoidal wave */
    bool repeats;                  /* after one period */
} sb_wave_facts;

struct sb_wavemaker {
    const char *name, *summary, *reference;
    unsigned needs; /* SB_WM_* bits: keys that the scene must give; other keys are an error */
    /* Creates *state (may stay NULL) from values that sb_wavemaker_check has accepted. Values that this law cannot use
       are an error, with one line in *error. */
    sb_status (*create)(const sb_wavemaker_parameters *parameters, void **state, sb_error *error);
    /* Displacement X in m at t seconds after the start; 0 for t <= 0; constant beyond duration. */
    double (*displacement)(const void *state, double t);
    /* Duration of the stroke, s. */
    double (*duration)(const void *state);
    void (*destroy)(void *state);
    /* Returns a warning (static text) when the theory is not valid for the parameters, else NULL. May be NULL. */
    const char *(*warning)(const sb_wavemaker_parameters *parameters);
    /* The following are NULL, except for wave trains (wave_train.h), whose duration may be infinite.
       place sets the distance ahead of the paddle at which surface is asked for; surface is that of the waves, m above
       their mean there, t seconds after the start, the waves that stay near the paddle included. */
    void (*place)(void *state, double distance);
    double (*surface)(const void *state, double t);
    /* Writes at most `capacity` frequencies of the waves, and returns their number. */
    size_t (*band)(const void *state, sb_band_part *band, size_t capacity);
    const sb_wave_facts *(*facts)(const void *state);
};

/* All laws; the last entry is NULL. */
extern const sb_wavemaker *const sb_wavemakers[];
const sb_wavemaker *sb_wavemaker_find(const char *name);

/* Checks the parameters. SB_BAD_INPUT unless every value that the law needs is finite and above 0 (a file: its name is
   given), the start is a number, and return_time is above 0 where it is used. sb_paddle_create calls this first. */
sb_status sb_wavemaker_check(const sb_wavemaker_parameters *parameters, sb_error *error);

/* A paddle that moves by a law, with the start of its motion and what it does after the stroke. */
typedef struct sb_paddle {
    const sb_wavemaker *kind;
    void *state;
    double start, duration, stroke_end; /* s, s, m: displacement at the stroke's end */
    sb_after_stroke after;
    double return_time;
} sb_paddle;

sb_status sb_paddle_create(const sb_wavemaker_parameters *parameters, sb_paddle *paddle, sb_error *error);
/* Returns the displacement in m at scene time t. It is continuous, and its speed is continuous during the return. */
double sb_paddle_displacement(const sb_paddle *paddle, double t);
void sb_paddle_destroy(sb_paddle *paddle);

/* Returns the frequencies of the waves of a train's paddle, which the caller frees with sb_free; NULL without memory.
 */
sb_band_part *sb_paddle_band(const sb_paddle *paddle, size_t *count);

/* Speed of the waves that the paddle makes if they keep their form, m/s; 0: they do not, or the law does not tell. */
double sb_paddle_celerity(const sb_wavemaker_parameters *parameters, const sb_paddle *paddle);

/* Fits the filter of an absorbing paddle to its waves, for a surface that is measured `distance` ahead of its face, and
   sets the place of its law. SB_BAD_INPUT if its waves are too short for that distance. */
sb_status sb_paddle_fit_absorption(const sb_wavemaker_parameters *parameters, sb_paddle *paddle, double distance,
                                   sb_absorbing_filter *filter, sb_error *error);
/* Reflected over incident amplitude of all waves of a paddle by linear theory: root mean square over their energy. NaN
   without memory. */
double sb_paddle_reflection(const sb_wavemaker_parameters *parameters, const sb_paddle *paddle,
                            const sb_absorbing_filter *filter, double distance);
/* Distance ahead of an absorbing paddle at which its water is measured, in spacings. */
#define SB_ABSORB_DISTANCE 3

#endif
