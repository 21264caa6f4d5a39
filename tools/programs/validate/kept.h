/* Reads the figures of runs whose files are not available from the results.csv of an earlier report. A full set takes
   many hours, so that several machines share it. Figures are used only if the request and the defaults are the same. */
#ifndef SB_VALIDATE_KEPT_H
#define SB_VALIDATE_KEPT_H

#include "results.h"
#include "sheet.h"

/* Reads the table in a report's folder; the table is empty if there is none. SB_BAD_INPUT names file and line. */
sb_status sb_kept_open(const char *report_folder, sb_sheet *table, sb_error *error);

/* If r has not run and the table has its request: fills in the figures and sets r->kept and SB_RESULT_DONE. */
void sb_kept_read(const sb_sheet *table, sb_result *r);
/* Reads the figures that a case derives from several runs. */
void sb_kept_across(const sb_sheet *table, const char *name, sb_figures *figures);

#endif
