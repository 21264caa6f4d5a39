/* Numbers of a run's summary.json. */
#ifndef SB_COMMON_SUMMARY_TEXT_H
#define SB_COMMON_SUMMARY_TEXT_H

/* The number behind the first "key": in a JSON text; NaN when there is none. */
double sb_json_number_in(const char *text, const char *key);

#endif
