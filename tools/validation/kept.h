/* Figures of runs whose files are no longer at hand, from the results.csv that a former report left: a full set takes
   more hours than one machine may have. Taken only where the very same was asked. */
#ifndef SB_VALIDATION_KEPT_H
#define SB_VALIDATION_KEPT_H

#include "results.h"
#include "sheet.h"

/* The table in a report's folder; empty when there is none. SB_BAD_INPUT names file and line. */
sb_status sb_kept_open(const char *report_folder, sb_sheet *table, sb_error *error);

/* Where r has not run and the table has what r asks for: its figures, r->kept and SB_RESULT_DONE. SB_FAILED without
 * memory. */
sb_status sb_kept_read(const sb_sheet *table, sb_result *r, sb_error *error);
/* The figures of several runs of a case. */
sb_status sb_kept_across(const sb_sheet *table, const char *name, sb_figures *figures, sb_error *error);

#endif
