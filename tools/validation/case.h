/* A validation case is one row: a scene, at which resolutions it runs, what is figured from a
   finished run and how it is plotted. To add one: a file case_<name>.c with its sb_case, its line
   in cases.c, its scene and reference tables in assets/validation/<folder>/. The framework
   launches, stores, judges and writes the report. */
#ifndef SB_VALIDATION_CASE_H
#define SB_VALIDATION_CASE_H

#include "figure.h"
#include "plot.h"
#include "scene/scene.h"
#include "sheet.h"

/* One resolution of a case. In every list exactly one line is judged. */
typedef struct sb_plan {
    double resolution;           /* m; 0 ends the list */
    bool judged;                 /* the reach is judged here, by the worst of the seeds */
    bool paper;                  /* the preset `paper` runs beside the default, seed 1 */
    int seeds;                   /* numerics.seed 1..seeds; 0 is 1 */
    const char *const *settings; /* further KEY=VALUE for `shorebreak run --set`, ended by NULL; NULL: none */
} sb_plan;

/* The table of a run that was read last, kept because the next curve often comes from the same one.
 */
typedef struct sb_sheet_slot {
    char *path; /* NULL: none */
    sb_sheet sheet;
} sb_sheet_slot;

/* A finished run. All of it belongs to the framework. */
typedef struct sb_case_run {
    const struct sb_case *of;
    const char *folder;    /* its scene.yaml, CSVs and summary.json */
    const char *assets;    /* assets/validation of the source tree */
    const sb_scene *scene; /* as it ran, every default filled in */
    double resolution;     /* m */
    const char *preset;    /* "default" or "paper" */
    int seed;
    bool quick, judged;
    double wall;       /* s of run time */
    double iterations; /* mean per step */
    size_t particles, steps;
    const char *label; /* for plots: "0.05 m", "0.05 m, paper", "0.05 m, seed 2" */
    sb_sheet_slot *slot;
} sb_case_run;

/* A curve of the run's table, for example ("forces.csv", "column", "time_s", "Fx_N"); see sheet.h.
 */
sb_status sb_run_curve(const sb_case_run *run, const char *table, const char *where, const char *x, const char *y,
                       sb_curve *curve, sb_error *error);
/* A curve of a reference table, its path relative to assets/validation; `where` as in sheet.h. */
sb_status sb_reference_curve(const sb_case_run *run, const char *table, const char *where, const char *x, const char *y,
                             sb_curve *curve, sb_error *error);
/* Adds a run's curve to the plot's panel, as what the run is: judged, another start seed, `paper`, or another spacing.
 */
sb_status sb_plot_run(sb_plot *plot, const sb_case_run *run, const sb_curve *curve, sb_error *error);
/* A number of the run's summary.json, by its first key of that name; NaN when there is none. */
double sb_run_number(const sb_case_run *run, const char *key);

typedef struct sb_case {
    const char *name;     /* on the command line and in file names; stable */
    const char *title;    /* its heading */
    const char *reach;    /* what it must reach, one line */
    const char *method;   /* Markdown: reference, windows, filters, lag rule, what is (not) counted */
    const char *scene;    /* relative to assets/validation */
    const char *headline; /* quantity of the figure that stands for the case in short tables */
    const sb_plan *full, *quick;
    const void *what; /* of the file's own, where several cases share its functions: run->of->what; or NULL */

    /* Figures of one run, in a stable order. Anything but SB_OK says which file or column is
     * missing. */
    sb_status (*evaluate)(const sb_case_run *run, sb_figures *figures, sb_error *error);

    /* Figures that need several runs (an order of convergence), from the finished runs of the
       default preset with seed 1, coarse to fine, and the figures that evaluate gave for each.
       NULL: none. */
    sb_status (*compare)(const sb_case_run *runs, const sb_figures *of_each, size_t count, sb_figures *figures,
                         sb_error *error);

    /* Draws the finished runs, coarse to fine, the default preset before paper, seed 1 before
     * others. */
    sb_status (*plot)(const sb_case_run *runs, size_t count, sb_plot *plot, sb_error *error);
} sb_case;

/* All cases in the order of the report, ended by NULL. */
extern const sb_case *const sb_cases[];

#endif
