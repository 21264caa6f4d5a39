/* The sections of a report's page, in its order. Each writes HTML; write errors are left in the stream. Private to
   src/report. */
#ifndef SB_REPORT_SECTIONS_H
#define SB_REPORT_SECTIONS_H

#include "report/loads.h"
#include "report/plots.h"
#include "report/run.h"

#include <stdio.h>

enum { SB_REPORT_PLOTS = SB_REPORT_ENERGY }; /* tables that are plotted: those before it */

typedef struct sb_report_page {
    const sb_report_run *run;
    const sb_loads *loads;
    const char *title;
    sb_plot plots[SB_REPORT_PLOTS]; /* of forces the greatest load first */
    bool film;                      /* embeds a film instead of the strip of pictures */
    size_t film_bytes;              /* at most, in the page */
} sb_report_page;

/* section_facts.c: title, state of the run, results at a glance; and the table of facts. */
void sb_section_head(FILE *out, const sb_report_page *page);
void sb_section_facts(FILE *out, const sb_report_page *page);
/* section_pictures.c: the picture at the time of the greatest load, and the strip or the film. Without the film,
   and with the page's head, it has at most SB_SECTION_PICTURES_BYTES. */
enum { SB_SECTION_PICTURES_BYTES = 800000 };
void sb_section_pictures(FILE *out, const sb_report_page *page);
/* section_loads.c */
void sb_section_loads(FILE *out, const sb_report_page *page);
/* section_water.c: gauges, run-up, overtopping, probes; section_waves.c: what the summary has of waves, after them. */
void sb_section_water(FILE *out, const sb_report_page *page);
void sb_section_waves(FILE *out, const sb_report_page *page);
/* section_maps.c */
void sb_section_maps(FILE *out, const sb_report_page *page);
/* section_quality.c: how far to trust the run, in words. */
void sb_section_quality(FILE *out, const sb_report_page *page);
/* section_record.c: command, version, scene. */
void sb_section_record(FILE *out, const sb_report_page *page);

/* section_data.c: chooses the series of the plots, and fits them into the page. SB_FAILED when memory runs out. */
sb_status sb_section_data_plan(sb_report_page *page, sb_error *error);
void sb_section_data_free(sb_report_page *page);

#endif
