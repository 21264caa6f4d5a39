/* Quantities of a resolution study of any scene: load on every body, crest at every gauge, run-up lines, volumes
   through planes. */
#ifndef SB_FRAMEWORK_QUANTITY_H
#define SB_FRAMEWORK_QUANTITY_H

#include "case.h"

/* The `evaluate` of an sb_case. Quantities "NAME, QUANTITY" from the run's tables, in this order:
   forces.csv   "impulse": |sum F dt| (N s; N s/m in 2D), horizontal; "vertical impulse", signed;
                "peak": largest horizontal force, a mean over the measure's interval (N)
   gauges.csv   "crest": highest surface above still water, or above z = 0 without a sea (m)
   runup.csv    "run-up height", "run-up front" (m)
   overtopping.csv  "volume" at the end (m^3)
   A table that does not exist is skipped; a quantity without a value is NaN. */
void sb_quantities_of(const sb_case_run *run, sb_figures *figures);

#endif
