/* The tables of a run: one row per item and instant, appended and flushed at each interval, so that a stopped run
   leaves complete files. In 2D the names of columns with extensive quantities end in _per_m. */
#ifndef SB_OUTPUT_CSV_H
#define SB_OUTPUT_CSV_H

#include "base/archive.h"
#include "base/status.h"
#include "frame/records.h"
#include "geometry/model/model.h"
#include "output/tables/csv_tables.h"
#include "scene/scene.h"

typedef struct sb_csv sb_csv;

/* Creates forces.csv, gauges.csv, probes.csv, energy.csv and, when the scene has them,
   overtopping.csv, runup.csv, reflections.csv, record.csv and absorbers.csv in the directory (which
   exists). scene and model must outlive it. SB_FAILED names the file and the system's reason. */
sb_status sb_csv_open(const char *directory, const sb_scene *scene, const sb_model *model, sb_csv **csv,
                      sb_error *error);

/* Where a resumed run continues to write: each table's length in bytes and its hash. 0: the scene does not have this
   table. */
typedef struct sb_csv_marks {
    uint64_t bytes[SB_CSV_TABLES], hash[SB_CSV_TABLES];
} sb_csv_marks;

/* Writes all rows to disk and marks the ends of the tables. SB_FAILED on a write error. */
sb_status sb_csv_sync(sb_csv *csv, sb_csv_marks *marks, sb_error *error);

/* Checks that the directory has this scene's tables, that each is unchanged up to its mark, and that it has this
   version's columns. SB_BAD_INPUT names the first table for which this does not hold. */
sb_status sb_csv_check(const char *directory, const sb_scene *scene, const sb_csv_marks *marks, sb_error *error);

/* As sb_csv_open, but continues the existing tables, cut at their marks. Call sb_csv_check first. */
sb_status sb_csv_resume(const char *directory, const sb_scene *scene, const sb_model *model, const sb_csv_marks *marks,
                        sb_csv **csv, sb_error *error);

/* Appends the rows, and flushes if there are any. SB_FAILED on a write error, or if a table was removed. */
sb_status sb_csv_write(sb_csv *csv, const sb_measure_records *records, sb_error *error);

/* Closes all files and frees; SB_FAILED on a late write error. NULL is allowed. */
sb_status sb_csv_close(sb_csv *csv, sb_error *error);

#endif
