/* Paddle laws: the displacement along the paddle's direction as a function of time. Each law is one row of a table.
   docs/adding-a-wavemaker.md describes how to add a law. */
#ifndef SB_PHYSICS_WAVEMAKER_H
#define SB_PHYSICS_WAVEMAKER_H

#include "base/status.h"

#include <stddef.h>

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
} sb_wavemaker_parameters;

enum { SB_WM_HEIGHT = 1, SB_WM_DEPTH = 2, SB_WM_STROKE = 4, SB_WM_SPEED = 8, SB_WM_FILE = 16 };

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

#endif
