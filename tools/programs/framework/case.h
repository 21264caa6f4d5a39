/* A case: a scene, the spacings at which it runs, the figures computed from a finished run, and its plot. A study uses
   its name, scene and figures. */
#ifndef SB_FRAMEWORK_CASE_H
#define SB_FRAMEWORK_CASE_H

#include "figure.h"
#include "plot.h"
#include "scene/scene.h"
#include "sheet.h"

/* One spacing of a case. Exactly one row of every list is judged. */
typedef struct sb_plan {
    double resolution;           /* m; of a grid, the edge of its cells; 0 ends the list */
    bool judged;                 /* figures are judged at this spacing, by the worst seed */
    bool paper, wen;             /* the preset of that name runs here too, with seed 1 */
    int seeds;                   /* numerics.seed = 1..seeds; 0 means 1 */
    const char *const *settings; /* more KEY=VALUE for `shorebreak run --set`, ended by NULL; NULL: none */
    const char *variant;         /* what these settings make of the scene, "without absorption"; NULL: nothing else */
} sb_plan;

/* The table that was read last. It is kept because the next curve often comes from the same table. */
typedef struct sb_sheet_slot {
    char *path; /* NULL: none */
    sb_sheet sheet;
} sb_sheet_slot;

/* A finished run. The framework owns all of it. */
typedef struct sb_case_run {
    const struct sb_case *of;
    const char *folder;    /* has scene.yaml, the CSV tables and summary.json */
    const char *assets;    /* assets/validation of the source tree */
    const sb_scene *scene; /* as it ran, with every default filled in */
    double resolution;     /* m */
    const char *preset;    /* "default", "paper" or "wen" */
    int seed;
    bool quick, judged;
    double wall;       /* s of run time */
    double cpu;        /* s of processor time of the last process of the run */
    double iterations; /* mean per step */
    size_t particles, steps;
    const char *label; /* for plots: "0.05 m", "0.05 m, paper", "0.05 m, seed 2" */
    sb_sheet_slot *slot;
    sb_curves *made; /* curves of the case's functions, freed after them */
    sb_error *error; /* the first failure of the functions below */
} sb_case_run;

/* The following functions do nothing after a failure and then return empty curves, whose numbers are NaN, so that a
   case checks nothing: its figures or plot are not used. */

/* A table of the run; valid until the next table is read. */
const sb_sheet *sb_run_sheet(const sb_case_run *run, const char *table);
/* A curve of a table of the run, for example ("forces.csv", "column", "time_s", "Fx_N"); see sheet.h. */
sb_curve *sb_run_curve(const sb_case_run *run, const char *table, const char *where, const char *x, const char *y);
/* A curve of a reference table. table: path relative to assets/validation. where: as in sheet.h. */
sb_curve *sb_reference_curve(const sb_case_run *run, const char *table, const char *where, const char *x,
                             const char *y);
/* Frees the curves that were made. The first failure, which is then forgotten. */
sb_status sb_run_close(const sb_case_run *run, sb_error *error);

/* Adds a run's curve to the plot's panel, in the style of a judged run, another seed, another preset or another
 * spacing. */
void sb_plot_run(sb_plot *plot, const sb_case_run *run, const sb_curve *curve);
/* Adds a reference curve through `count` points. */
void sb_plot_points(sb_plot *plot, const char *label, size_t count, double *x, double *y);

enum { SB_PLANS_MAX = 4 };
typedef struct sb_case {
    const char *name;     /* on the command line and in file names; stable */
    const char *title;    /* its heading */
    const char *targets;  /* of its figures, separated by "; " */
    const char *method;   /* Markdown: reference, windows, filters, rule for a time lag, definitions */
    const char *scene;    /* relative to assets/validation */
    bool grid;            /* the scene has no particles: its resolution is that of `offshore.cell` */
    const char *headline; /* quantity of the figure that represents the case in summaries */
    sb_plan full[SB_PLANS_MAX + 1], quick[SB_PLANS_MAX + 1]; /* spacings, coarse to fine */
    const void *what; /* parameters of a file whose functions serve several cases (run->of->what); or NULL */

    /* Computes the figures of one run, in a stable order. */
    void (*evaluate)(const sb_case_run *run, sb_figures *figures);

    /* Computes figures that need several runs, such as an order of convergence. runs: finished runs of the default
       preset with seed 1, coarse to fine. of_each: their figures from evaluate. NULL: none. */
    void (*compare)(const sb_case_run *runs, const sb_figures *of_each, size_t count, sb_figures *figures);

    /* Draws the finished runs. They are sorted from coarse to fine, default before `paper` and `wen`, seed 1 before
     * others. */
    void (*plot)(const sb_case_run *runs, size_t count, sb_plot *plot);
} sb_case;

#endif
