/* A trial: one run of a stress case, by the program itself or driven step by step. */
#ifndef SB_STRESS_TRIAL_H
#define SB_STRESS_TRIAL_H

#include "drive.h"

enum { SB_TRIAL_SETTINGS = 24, SB_TRIAL_TEXT = 200, SB_TRIAL_NAME = 96 };

typedef enum sb_trial_kind {
    SB_TRIAL_RUN,   /* `shorebreak run` in a process of its own */
    SB_TRIAL_CHECK, /* `shorebreak check` */
    SB_TRIAL_DRIVEN /* src/sim step by step in a process of its own, see drive.h */
} sb_trial_kind;

/* Ways in which a trial may end, as bits. */
enum {
    SB_ENDS_WELL = 1,
    SB_ENDS_REFUSED = 2, /* exit status 1 and one line with the reason */
    SB_ENDS_FAILED = 4,  /* exit status 2 and one line with the reason */
    SB_ENDS_STOPPED = 8  /* stopped after SIGTERM */
};

typedef struct sb_trial {
    char name[SB_TRIAL_NAME]; /* unique within its case, stable; also the name of a folder */
    sb_trial_kind kind;
    const char *scene;                               /* relative to assets/stress */
    char settings[SB_TRIAL_SETTINGS][SB_TRIAL_TEXT]; /* KEY=VALUE */
    size_t setting_count;
    const sb_drive *drive; /* of a driven trial */
    double number;         /* parameter of the drive */
    double may_lose;       /* share of the particles that may pass walls; 0: none */
    unsigned ends;         /* bits: how it may end; initially SB_ENDS_WELL */
    double time_limit;     /* s; after it the trial counts as hung and is killed */
    double stop_after;     /* s until SIGTERM is sent; 0: never */
} sb_trial;

/* A zero-initialised list is empty. */
typedef struct sb_trials {
    size_t count, capacity;
    sb_trial *list;
    const char *assets; /* assets/stress, for plans that read a scene; NULL: none */
    sb_trial spare;     /* filled in if memory is exhausted */
    bool incomplete;    /* memory was exhausted */
} sb_trials;

/* Adds a trial of this scene with the defaults above. Fill it in before the next is added. Never NULL. */
sb_trial *sb_trial_add(sb_trials *trials, const char *scene, const char *name, ...)
    __attribute__((format(printf, 3, 4)));
/* Adds a setting KEY=VALUE. */
void sb_trial_set(sb_trial *trial, const char *setting, ...) __attribute__((format(printf, 2, 3)));
/* Makes the trial a driven one. */
void sb_trial_drive(sb_trial *trial, const sb_drive *drive, double number);
void sb_trials_free(sb_trials *trials);

/* Value of a key of `numerics` in the default preset, in a scene of that many dimensions. */
double sb_trial_default(int dimensions, const char *key);

/* Reads the scene of a trial. SB_BAD_INPUT as sb_scene_read. */
sb_status sb_trial_scene(const sb_trial *trial, const char *assets, sb_scene *scene, sb_error *error);

#endif
