/* Runs of the depth-averaged model alone: scenes with `offshore` and without particles. */
#ifndef SB_APP_GRID_WATER_H
#define SB_APP_GRID_WATER_H

#include "app/check/warnings.h"
#include "app/run/run.h"
#include "offshore/start.h"

/* What check and the log tell about the model before the first step. */
typedef struct sb_grid_facts {
    size_t columns, rows, wet, uncovered; /* cells: wet at the start; beside all bodies */
    double deepest, time_step, bytes;     /* m, s, bytes */
} sb_grid_facts;

/* Makes the model of a scene at t = 0. *told: what the grids of its bed state, and warnings, freed by the caller.
   SB_BAD_INPUT also when there is no water, SB_FAILED when it does not fit into memory. */
sb_status sb_grid_water_create(const sb_scene *scene, sb_offshore **water, sb_grid_facts *facts,
                               sb_offshore_told_list *told, sb_error *error);

/* Settings of the scene that have no effect here, doubtful ones, and the warnings of its bed. */
void sb_grid_water_warnings(const sb_scene *scene, const sb_grid_facts *facts, const sb_offshore_told_list *told,
                            sb_warning_visit *visit, void *context);

/* Doubtful settings of its initial wave; those of sb_grid_water_warnings contain them. */
void sb_grid_wave_warnings(const sb_scene *scene, sb_warning_visit *visit, void *context);

/* As sb_run, for a scene with `offshore`. */
sb_status sb_grid_run(const sb_scene *scene, const char *directory, const sb_run_options *options, sb_error *error);

/* Prints what `check` tells. */
sb_status sb_grid_check(const sb_scene *scene, bool json, sb_error *error);

/* SB_BAD_INPUT for a scene with `offshore`, for commands that need particles; command: its name. */
sb_status sb_grid_refuse(const sb_scene *scene, const char *command, sb_error *error);

#endif
