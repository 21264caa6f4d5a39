/* The runs that Sampath, Montanari, Akinci, Prescott and Smith (2016), "Large-scale solitary wave
   simulation with implicit incompressible SPH", report in their Tables 1 to 10: a plant and a 25 m wave, 90 s, on two
   Xeon E5-2680 v2 of ten cores each. */
#ifndef SB_PAPER_STUDIES_PUBLISHED_H
#define SB_PAPER_STUDIES_PUBLISHED_H

#include <stddef.h>

enum { SB_PUBLISHED_CORES = 20, SB_PUBLISHED_SECONDS = 90, SB_PUBLISHED_DEFAULT = 2 };

/* NaN: not printed. Times in s. */
typedef struct sb_published {
    int number;                                          /* the paper's No.; 0 ends the list */
    double spacing;                                      /* m */
    double fluid, boundary;                              /* particles */
    double tolerance;                                    /* xi, 1 for 100 % */
    double table;                                        /* m, slots of its hash table */
    double lambda;                                       /* lambda_max, 1/s */
    double step, sweeps;                                 /* mean time step (s), mean iterations of the solver */
    double total, structure, query, advection, pressure; /* T, T_c, T_q, T_a, T_p */
} sb_published;

extern const sb_published sb_published_runs[];

/* The run of that number; NULL: none. */
const sb_published *sb_published_find(int number);

/* The four sets in the order of the tables. numbers: ended by 0. */
typedef struct sb_published_set {
    const char *title; /* NULL ends the list */
    const char *tables;
    const int *numbers;
} sb_published_set;
extern const sb_published_set sb_published_sets[];
enum { SB_SET_LAMBDA, SB_SET_TABLE, SB_SET_TOLERANCE, SB_SET_SPACING };

#endif
