/* The quantities of a comparison as text: for a terminal, and as CSV for programs. Private to src/compare. */
#ifndef SB_COMPARE_TABLE_H
#define SB_COMPARE_TABLE_H

#include "compare/quantities.h"

#include <stdio.h>

/* The difference between a group's mean and that of group 0, for people: "-34 %" or "+2.5 s", with "~" in front if both
   have error bars and these overlap; "" for group 0 and where one of them has no value. */
enum { SB_CHANGE_MAX = 64 };
const char *sb_change_text(char out[SB_CHANGE_MAX], const sb_quantity *quantity, const sb_spread *first,
                           const sb_spread *other);

/* Writes one row per item, quantity and group, without units' prefixes. */
void sb_table_csv(FILE *out, const sb_comparison *comparison, const sb_items *items);
#define SB_TABLE_CSV_HEADER                                                                                            \
    "kind,name,quantity,unit,run,runs,mean,least,greatest,difference,difference_percent,reliable"

/* Writes a table for a terminal: for each kind of item one line per item and group. */
void sb_table_text(FILE *out, const sb_comparison *comparison, const sb_items *items);

#endif
