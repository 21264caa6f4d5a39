/* A trial: one run that a stress case asks for, by the program itself or driven step by step. */
#ifndef SB_BATTERY_TRIAL_H
#define SB_BATTERY_TRIAL_H

#include "drive.h"

enum { SB_TRIAL_SETTINGS = 24, SB_TRIAL_TEXT = 200, SB_TRIAL_NAME = 96 };

typedef enum sb_trial_kind {
    SB_TRIAL_RUN,   /* `shorebreak run` in a process of its own */
    SB_TRIAL_CHECK, /* `shorebreak check` */
    SB_TRIAL_DRIVEN /* src/sim step by step in a process of its own, see drive.h */
} sb_trial_kind;

/* Ways to end, as bits. */
enum {
    SB_ENDS_WELL = 1,
    SB_ENDS_REFUSED = 2, /* exit status 1 and one line that says why */
    SB_ENDS_FAILED = 4,  /* exit status 2 and one line that says why */
    SB_ENDS_STOPPED = 8  /* told to stop, it did */
};

typedef struct sb_trial {
    char name[SB_TRIAL_NAME]; /* unlike all others of its case, stable; also a folder's name */
    sb_trial_kind kind;
    const char *scene;                               /* relative to assets/stress */
    char settings[SB_TRIAL_SETTINGS][SB_TRIAL_TEXT]; /* KEY=VALUE */
    size_t setting_count;
    const sb_drive *drive; /* of a driven trial */
    double number;         /* what the drive makes of it */
    unsigned ends;         /* bits: how it may end; SB_ENDS_WELL to begin with */
    double patience;       /* s until it counts as hung and is killed */
    double stop_after;     /* s until it is told to stop; 0: never */
} sb_trial;

/* Zero-initialised is empty. */
typedef struct sb_trials {
    size_t count, capacity;
    sb_trial *list;
    const char *assets; /* assets/stress, for plans that read a scene; NULL: none are there */
    sb_trial spare;     /* what is filled when memory is out */
    bool incomplete;    /* memory was out */
} sb_trials;

/* A new trial of this scene with the defaults above, to be filled in before the next is added. Never NULL. */
sb_trial *sb_trial_add(sb_trials *trials, const char *scene, const char *name, ...)
    __attribute__((format(printf, 3, 4)));
/* One more KEY=VALUE. */
void sb_trial_set(sb_trial *trial, const char *setting, ...) __attribute__((format(printf, 2, 3)));
/* Makes it a driven one. */
void sb_trial_drive(sb_trial *trial, const sb_drive *drive, double number);
void sb_trials_free(sb_trials *trials);

/* The number that the default preset gives to a key of `numerics`. */
double sb_trial_default(const char *key);

/* The scene that a trial runs. SB_BAD_INPUT as sb_scene_read. */
sb_status sb_trial_scene(const sb_trial *trial, const char *assets, sb_scene *scene, sb_error *error);

#endif
