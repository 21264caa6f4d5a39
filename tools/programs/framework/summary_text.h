/* Reads numbers from a run's summary.json. */
#ifndef SB_FRAMEWORK_SUMMARY_TEXT_H
#define SB_FRAMEWORK_SUMMARY_TEXT_H

/* The number after the first "key": in a JSON text; NaN: none. */
double sb_json_number_in(const char *text, const char *key);

#endif
