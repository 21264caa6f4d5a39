/* The plots of a page: which rows of their tables the page holds, their place in the page, and their rows as JSON. */
#ifndef SB_REPORT_PLOTS_H
#define SB_REPORT_PLOTS_H

#include "report/series_table.h"

#include <stdio.h>

typedef struct sb_plot_line {
    const sb_series_table *table;
    const sb_series *series; /* of this table */
    const char *name;        /* in the legend, and of the CSV file */
    const char *item;        /* the plot shows the lines of one item at a time; NULL in all lines: it shows all */
    int colour;              /* its number; with items only */
} sb_plot_line;

typedef struct sb_plot {
    const char *table; /* forces, gauges, ...: it determines what the plot can show */
    size_t budget;     /* bytes of its rows in the page */
    size_t count;      /* of lines in the page */
    size_t all;        /* lines that there are; those after `count` are left out */
    sb_plot_line *lines;
    size_t pixels;     /* for sb_thin; 0: all rows */
    size_t rows, kept; /* of these lines: in the tables, in the page */
} sb_plot;

/* Thins the rows until each plot fits into its budget, and what other plots leave of theirs. Sets pixels, rows, kept.
   SB_FAILED when memory runs out. */
sb_status sb_plots_fit(sb_plot *plots, size_t count, sb_error *error);

/* Writes the element "data" with the rows of all plots. SB_FAILED when memory runs out. */
sb_status sb_plots_put_data(FILE *out, const sb_plot *plots, size_t count, sb_error *error);

/* The part of a page that dygraphs fills, with its controls and a sentence on thinned rows; nothing without rows. */
void sb_plot_put(FILE *out, const sb_plot *plot, const char *caption);

#endif
