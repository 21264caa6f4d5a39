/* The command line options of all commands. */
#ifndef SB_APP_OPTIONS_H
#define SB_APP_OPTIONS_H

#include "base/status.h"
#include "scene/scene.h"

#include <stdbool.h>

enum { SB_OVERRIDES_MAX = 256, SB_POSITIONALS_MAX = 64, SB_CAMERA_OPTIONS_MAX = 64 };

typedef struct sb_options {
    const char *positional; /* scene, run directory or table, by command */
    size_t positional_count;
    const char *positionals[SB_POSITIONALS_MAX]; /* with SB_OPT_SEVERAL; the first one is `positional` */
    const char *out;                             /* --out */
    const char *preset;                          /* --preset */
    size_t camera_count;
    const char *cameras[SB_CAMERA_OPTIONS_MAX]; /* --camera, each of them */
    const char *title;                          /* --title */
    const char *url;                            /* --url */
    const char *prefix;                         /* --prefix */
    const char *format;                         /* --format */
    const char *times;                          /* --times */
    double cell;                                /* --cell; spacings */
    int smooth;                                 /* --smooth; rounds */
    double speed;                               /* --speed; 1 if it is not given */
    int live_port;                              /* --live; 0: not given */
    char live_address[64];                      /* --live=ADDRESS:PORT; empty: loopback */
    int threads;                                /* --threads; 0: OMP_NUM_THREADS, or one per core */
    double rank_deadline;                       /* --rank-deadline; s */
    bool quiet, json, profile, resume, overwrite, other_build, film, mixed, help;
    size_t override_count;
    sb_override overrides[SB_OVERRIDES_MAX];
    char *texts[SB_OVERRIDES_MAX]; /* owned copies; the overrides point into them */
} sb_options;

/* The options that a command accepts in addition to --help, as bits. */
enum {
    SB_OPT_OUT = 1,
    SB_OPT_UNTIL = 2,
    SB_OPT_THREADS = 4,
    SB_OPT_PRESET = 8,
    SB_OPT_SET = 16,
    SB_OPT_QUIET = 32,
    SB_OPT_JSON = 64,
    SB_OPT_CAMERA = 128,
    SB_OPT_PROFILE = 256,
    SB_OPT_RESUME = 512,
    SB_OPT_OTHER_BUILD = 1024,
    SB_OPT_OVERWRITE = 2048,
    SB_OPT_URL = 4096,
    SB_OPT_PREFIX = 8192,
    SB_OPT_SPEED = 16384,
    SB_OPT_CONTROL = 32768,
    SB_OPT_LIVE = 65536,
    SB_OPT_TITLE = 131072,
    SB_OPT_FORMAT = 262144,
    SB_OPT_TIMES = 524288,
    SB_OPT_CELL = 1048576,
    SB_OPT_SMOOTH = 2097152,
    SB_OPT_FILM = 4194304,
    SB_OPT_SEVERAL = 8388608,    /* more than one positional argument */
    SB_OPT_SHORT_OUT = 16777216, /* -o, the same as --out */
    SB_OPT_RANK_DEADLINE = 33554432,
    SB_OPT_MIXED = 67108864
};

/* Parses the arguments after the command's name. what: the name of the positional argument in messages. */
sb_status sb_options_parse(int count, char **arguments, unsigned accepted, const char *what, sb_options *options,
                           sb_error *error);
void sb_options_free(sb_options *options);

/* Reads the scene with the preset and overrides of the options, and sets the number of threads. */
sb_status sb_options_scene(const sb_options *options, const char *path, sb_scene *scene, sb_error *error);

#endif
