/* The internal state of a run. Private to src/app. */
#ifndef SB_APP_RUN_STATE_H
#define SB_APP_RUN_STATE_H

#include "app/checkpoint/build.h"
#include "app/frames/consumers.h"
#include "app/frames/picture_times.h"
#include "app/run/files.h"
#include "app/steering/helper.h"
#include "base/ranks.h"
#include "measure/measure.h"
#include "output/log/progress.h"
#include "output/log/summary.h"
#include "output/tables/csv.h"
#include "sim/sim.h"

enum { RECORDER, PICTURES, STREAMER, CONSUMERS };
enum { SB_RUN_OFF_MAX = 6 };

/* The checkpoints of a run. */
typedef struct sb_checkpoints {
    bool on; /* the scene requests checkpoints */
    char folder[SB_PATH_MAX];
    char *identity;            /* identifies the scene */
    uint64_t model;            /* hash of the sampled particles */
    char build[SB_BUILD_TEXT]; /* identifies this program's numerics */
    bool any_build;            /* checkpoints of other builds are accepted */
    double written;            /* clock time of the last attempt, s */
    uint64_t last_step;        /* step of the last attempt, or of the checkpoint that was loaded */
    bool current;              /* a checkpoint of last_step exists */
    bool settling;             /* the last checkpoint was written during settling */
} sb_checkpoints;

/* The missed frames of one consumer. */
typedef struct sb_missed {
    uint64_t count;
    char reason[sizeof((sb_error *)0)->text]; /* of the first one */
} sb_missed;

enum { SB_STEERING_COUNTS = 5 }; /* as in sb_received: obeyed, malformed, foreign, replayed, flooded */

/* Commands to the run. */
typedef struct sb_steering {
    sb_helper helper;
    int live_port; /* of the page for browsers; 0: none */
    const char *live_address;
    bool allowed; /* the token exists */
    char token_file[SB_PATH_MAX];
    bool paused;
    uint64_t steps; /* so many steps, then the run is paused; 0: no limit */
    double counts[SB_STEERING_COUNTS], counts_before[SB_STEERING_COUNTS]; /* of this helper; of those before it */
    double pace_logged;                   /* bytes per second within a frame, when they were logged last; 0: never */
    double refused_logged, counts_logged; /* the sum of refused commands, and sb_clock(), when it was logged last */
} sb_steering;

/* Pictures that commands request. */
typedef struct sb_requested {
    sb_consumer consumer;
    sb_poses poses; /* of the scene's cameras, and of the view that a command gives; empty: no picture was requested */
    sb_renderer *renderer;
    sb_image image;
    /* Of the picture that is being drawn: */
    sb_command command;
    size_t camera;
    uint64_t step;
} sb_requested;

/* How several ranks share the work. Means are over the ranks. */
typedef struct sb_rank_load {
    double mean_particles, most_particles; /* of a rank, now */
    double mean_halo;                      /* particles of other ranks that a rank reads, now */
    double mean_excess, worst_excess;      /* of the largest load by pairs over the mean; as sb_division */
    double cuts;                           /* how often the particles were divided anew */
    double imbalance;                      /* by how much the busiest rank computed longer than the mean; 0.1: 10 % */
    double waited;                         /* share of the time of the stages in which a rank waited for others */
    double bytes, messages;                /* that a rank sent per step */
    double heap;                           /* bytes of the simulation, in all ranks */
} sb_rank_load;

/* The ranks of a run (app/cluster.h). */
typedef struct sb_cluster {
    sb_ranks *ranks;        /* NULL: this process is alone */
    sb_settle_watch *watch; /* rank 0's own, in settling */
    sb_archive_out *out;    /* rank 0: the checkpoint that is written; NULL in the others */
    sb_archive_in *in;      /* rank 0: the checkpoint that is read */
    sb_ranks steps;         /* what this rank has sent and waited for in steps alone */
    bool told;              /* rank 0 was told of a signal */
    bool dismissed;         /* the other ranks follow no more */
    /* What the last order of the kind gave. */
    sb_frame *frame;
    uint64_t hash;
    sb_energy energy;
    sb_rank_load load;
} sb_cluster;

typedef struct run {
    sb_scene resolved;     /* a shallow copy of the caller's scene, with values that depend on the model */
    const sb_scene *scene; /* points to resolved */
    const char *directory;
    bool made_directory;  /* the run has made it: if the run fails before it writes there, it is removed */
    int lock;             /* descriptor of the locked directory; -1: not locked yet */
    sb_run_files earlier; /* the files in the directory before the run began */
    sb_model model;
    sb_sim *sim;
    sb_measure *prepared; /* until the water has settled; then NULL */
    sb_measure *measure;  /* from then on */
    sb_csv *csv;
    sb_runlog *log;
    sb_progress progress;
    sb_recorder recorder;
    sb_pictures pictures;
    sb_picture_times picture_times;
    sb_streamer streamer;
    sb_consumer consumers[CONSUMERS]; /* those that the scene requests are started */
    double due[CONSUMERS];            /* simulated time of their first frames, s */
    sb_missed missed[CONSUMERS];      /* frames missed in earlier processes of this run */
    uint64_t reported[CONSUMERS];     /* changes of their trouble that were reported */
    sb_steering steering;
    sb_requested requested;
    sb_cluster cluster;
    sb_checkpoints checkpoints;
    sb_particle_list grid_frames; /* files of the depth-averaged model beside the particles */
    sb_csv_marks tables;          /* lengths and hashes of the tables that a resumed run continues */
    sb_energy first_energy;
    uint64_t iterations, capped, frames;
    double compression, compression_max; /* sum over the steps and maximum, as in sb_step_report */
    size_t departures;                   /* number of departures that were reported */
    sb_spent before; /* time of earlier processes of this run; and of this one's settling, per stage */
    uint64_t steps, iterations_before; /* steps of this process; iterations before it */
    double particle_steps, setup_seconds, settling_seconds;
    sb_skipped off[SB_RUN_OFF_MAX + 1]; /* parts other than simulation and measurements that are left out */
    bool inside_known;
    uint64_t inside, crossed; /* particles within solids at the end */
} run;

#endif
