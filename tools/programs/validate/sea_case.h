/* What the cases of sides of kind sea share. */
#ifndef SB_VALIDATE_SEA_CASE_H
#define SB_VALIDATE_SEA_CASE_H

#include "case.h"

/* The runs of a case with the keys `given`, NULL for none: 0.1 m, and from three seeds 0.05 m and 0.025 m, which is
   judged. */
#define SB_SEA_RUNS(given)                                                                                             \
    .full = {{.resolution = 0.1, .settings = given},                                                                   \
             {.resolution = 0.05, .seeds = 3, .settings = given},                                                      \
             {.resolution = 0.025, .judged = true, .seeds = 3, .settings = given}},                                    \
    .quick = {{.resolution = 0.1, .judged = true, .settings = given}}

#endif
