/* The sections of a report's page, in its order. Each writes HTML; write errors are left in the stream. Private to
   src/report. */
#ifndef SB_REPORT_SECTIONS_H
#define SB_REPORT_SECTIONS_H

#include "report/loads.h"
#include "report/run.h"

#include <stdio.h>

enum { SB_REPORT_PLOTS = SB_REPORT_ENERGY }; /* tables that are plotted: those before it */

/* How many rows of a table the page holds. */
typedef struct sb_report_share {
    size_t series;     /* of the table, the first ones; of forces those with the greatest loads */
    size_t pixels;     /* for sb_thin; 0: all rows */
    size_t rows, kept; /* of these series: in the table, in the page */
} sb_report_share;

typedef struct sb_report_page {
    const sb_report_run *run;
    const sb_loads *loads;
    const char *title;
    bool has_plots; /* dygraphs is there */
    sb_report_share shares[SB_REPORT_PLOTS];
} sb_report_page;

/* section_facts.c: title, state of the run, results at a glance; and the table of facts. */
void sb_section_head(FILE *out, const sb_report_page *page);
void sb_section_facts(FILE *out, const sb_report_page *page);
/* section_pictures.c: the picture at the time of the greatest load, and the strip. */
void sb_section_pictures(FILE *out, const sb_report_page *page);
/* section_loads.c */
void sb_section_loads(FILE *out, const sb_report_page *page);
/* section_water.c: gauges, run-up, overtopping, probes. */
void sb_section_water(FILE *out, const sb_report_page *page);
/* section_maps.c */
void sb_section_maps(FILE *out, const sb_report_page *page);
/* section_quality.c: how far to trust the run, in words. */
void sb_section_quality(FILE *out, const sb_report_page *page);
/* section_record.c: command, version, scene. */
void sb_section_record(FILE *out, const sb_report_page *page);

/* section_data.c: chooses the shares; SB_FAILED when memory runs out. Then writes the rows as JSON. */
sb_status sb_section_data_plan(sb_report_page *page, sb_error *error);
sb_status sb_section_data(FILE *out, const sb_report_page *page, sb_error *error);

/* The series of a plotted table in the page's order: of forces the greatest load first. */
const sb_series *sb_report_series(const sb_report_page *page, sb_report_table table, size_t i);

/* The part of a page that dygraphs fills, with its controls and a sentence on thinned rows. */
void sb_report_plot(FILE *out, const sb_report_page *page, sb_report_table table, const char *caption);

/* kN or MN, by the greatest of the values; per_m: "/m" follows in 2D. Returns the factor from N. */
double sb_report_force_unit(double greatest, bool per_m, const char **name);

#endif
