/* Reads numbers from a run's summary.json. */
#ifndef SB_FRAMEWORK_SUMMARY_TEXT_H
#define SB_FRAMEWORK_SUMMARY_TEXT_H

#include "base/status.h"

/* Reads folder/summary.json; free the text with sb_free. SB_BAD_INPUT or SB_FAILED: it cannot be read. */
sb_status sb_summary_read(const char *folder, char **text, sb_error *error);
/* The number after the first "key": in a JSON text; NaN: none. */
double sb_json_number_in(const char *text, const char *key);

#endif
