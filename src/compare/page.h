/* The page of a comparison. Private to src/compare. */
#ifndef SB_COMPARE_PAGE_H
#define SB_COMPARE_PAGE_H

#include "compare/quantities.h"
#include "report/plots.h"

#include <stdio.h>

enum { SB_COMPARE_PLOTS = 4 }; /* forces, gauges, run-up, overtopping */

typedef struct sb_compare_page {
    const sb_comparison *comparison;
    const sb_items *items;
    const char *title;
    const char *folder;  /* of the results */
    const char *no_film; /* why there is none; NULL: compare.mp4 is in the folder */
    sb_plot plots[SB_COMPARE_PLOTS];
} sb_compare_page;

/* page_plots.c: chooses and fits the series; each of a kind's items has one line per run. SB_FAILED when memory runs
   out. */
sb_status sb_compare_plots(sb_compare_page *page, sb_error *error);
void sb_compare_plots_free(sb_compare_page *page);

/* page_head.c: title, warnings, the greatest differences, what differs between the scenes. */
void sb_compare_head(FILE *out, const sb_compare_page *page);
/* page_pictures.c: the film and pictures side by side; within `most` bytes. */
void sb_compare_pictures(FILE *out, const sb_compare_page *page, size_t most);
/* page_tables.c: plots and tables of bodies and water. */
void sb_compare_tables(FILE *out, const sb_compare_page *page);
/* page_maps.c: writes depth-difference-<n>.asc and shows the maps. */
void sb_compare_maps(FILE *out, const sb_compare_page *page);
/* page_head.c: how the values are made, and the runs. */
void sb_compare_record(FILE *out, const sb_compare_page *page);

#endif
