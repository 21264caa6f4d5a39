/* The loads on the bodies of a run, from forces.csv, and how far to trust them, from summary.json. */
#ifndef SB_REPORT_LOADS_H
#define SB_REPORT_LOADS_H

#include "report/run.h"

/* Forces in N, moments in N m, impulses in N s; in 2D per metre of width. Peaks are those of the means over
   measure.interval. */
typedef struct sb_load {
    const char *name;
    const sb_series *series;
    double horizontal, horizontal_time; /* greatest horizontal force, and the end of its interval, s */
    double direction[2];                /* its x and y */
    double total, total_time;           /* greatest |F| */
    double up, down;                    /* greatest Fz, and the least; 0: never above, never below 0 */
    double impulse, impulse_horizontal; /* |sum F dt|, and its horizontal part */
    double moment, moment_time;         /* overturning: greatest horizontal moment about `point` */
    bool judged;                        /* the run has ended, and the rest is known */
    bool has_point, coarse, narrow;
    double point[3];    /* m, about which moments are taken */
    double layers, gap; /* flow_layers, spacings, and gap_m, m; NaN: not determined, none */
} sb_load;

typedef struct sb_loads {
    size_t count;
    sb_load *loads; /* by greatest horizontal force, the greatest first */
    size_t reached; /* the first ones, on which there was any force */
} sb_loads;

/* The texts in *loads are those of the run, which must outlive it. */
sb_status sb_loads_make(const sb_report_run *run, sb_loads *loads, sb_error *error);
void sb_loads_free(sb_loads *loads);

/* kN or MN, by the greatest of the values; per_m: "/m" follows in 2D. Returns the factor from N. */
double sb_force_unit(double greatest, bool per_m, const char **name);

#endif
