/* What a report reads from the folder of a run. Private to src/report. */
#ifndef SB_REPORT_RUN_H
#define SB_REPORT_RUN_H

#include "base/file.h"
#include "report/series_table.h"
#include "scene/scene.h"

#include <jansson.h>

/* The tables that the page plots, in its order. */
typedef enum sb_report_table {
    SB_REPORT_FORCES,
    SB_REPORT_GAUGES,
    SB_REPORT_RUNUP,
    SB_REPORT_OVERTOPPING,
    SB_REPORT_PROBES,
    SB_REPORT_ENERGY, /* not plotted */
    SB_REPORT_TABLES
} sb_report_table;

/* The name of a table; its file is <name>.csv. */
extern const char *const sb_report_table_names[SB_REPORT_TABLES];

typedef struct sb_texts {
    size_t count, capacity;
    char **texts;
} sb_texts;

/* Adds a copy; nothing is added when memory runs out. */
void sb_texts_add(sb_texts *list, const char *format, ...) __attribute__((format(printf, 2, 3)));
void sb_texts_free(sb_texts *list);

typedef struct sb_report_run {
    const char *directory;
    json_t *summary;   /* object; NULL: there is none that can be read */
    json_t *start;     /* the log's event "start" of the last process; NULL: none */
    json_t *step;      /* the log's last event "step"; NULL: none */
    json_t *arguments; /* array of the log's events "arguments" */
    char *build;       /* the log's last event "build"; NULL: none */
    sb_texts warnings; /* of the log, each once */
    char *scene_text;  /* scene.yaml; NULL: it cannot be read */
    bool has_scene;    /* scene.yaml is valid */
    sb_scene scene;
    sb_series_table tables[SB_REPORT_TABLES]; /* without series if the run has none */
    bool flat;                                /* forces are per metre of width */
    sb_texts notes;                           /* what is missing or damaged, one sentence each */
} sb_report_run;

/* Reads all; what cannot be read is a note. SB_BAD_INPUT if the folder has none of a run's files. The directory's text
   must outlive *run. */
sb_status sb_report_run_read(const char *directory, sb_report_run *run, sb_error *error);
void sb_report_run_free(sb_report_run *run);

/* "done", "interrupted", "failed" or "running"; "unknown" without a summary. */
const char *sb_report_status(const sb_report_run *run);
/* A number or a text of the summary; NaN or NULL: it has no such key. */
double sb_report_number(const sb_report_run *run, const char *key);
const char *sb_report_text(const sb_report_run *run, const char *key);
/* A number of an object of the summary; NaN: it has no such key. */
double sb_report_item_number(const json_t *item, const char *key);
/* The time that the simulation has reached, s; NaN: unknown. */
double sb_report_reached(const sb_report_run *run);

#endif
