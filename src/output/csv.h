/* The tables of a run: one row per item and instant, appended and flushed at each interval, so that
   a stopped run leaves whole files. In 2D the columns of extensive quantities end in _per_m. */
#ifndef SB_OUTPUT_CSV_H
#define SB_OUTPUT_CSV_H

#include "base/archive.h"
#include "base/status.h"
#include "geometry/model.h"
#include "measure/records.h"
#include "scene/scene.h"

typedef struct sb_csv sb_csv;

/* The tables that a run may have: <name>.csv, ended by NULL. */
enum { SB_CSV_TABLES = 6 };
extern const char *const sb_csv_names[SB_CSV_TABLES + 1];

/* Starts forces.csv, gauges.csv, probes.csv, energy.csv and, when the scene has planes or lines,
   overtopping.csv and runup.csv in the directory (which exists). scene and model must outlive it.
   SB_FAILED names the file and the system's reason. */
sb_status sb_csv_open(const char *directory, const sb_scene *scene, const sb_model *model, sb_csv **csv,
                      sb_error *error);

/* Where a resumed run goes on writing: how long each table is, in bytes, and their hash. 0: a table that this scene has
   not. */
typedef struct sb_csv_marks {
    uint64_t bytes[SB_CSV_TABLES], hash[SB_CSV_TABLES];
} sb_csv_marks;

/* Puts all rows on disk and marks where the tables end. SB_FAILED when the disk refuses. */
sb_status sb_csv_sync(sb_csv *csv, sb_csv_marks *marks, sb_error *error);

/* Whether the directory has this scene's tables, each beginning with what was written up to its mark and having
   this version's columns. SB_BAD_INPUT names the first that does not. */
sb_status sb_csv_check(const char *directory, const sb_scene *scene, const sb_csv_marks *marks, sb_error *error);

/* As sb_csv_open, but goes on with the tables that are there, cut at their marks, which sb_csv_check has passed. */
sb_status sb_csv_resume(const char *directory, const sb_scene *scene, const sb_model *model, const sb_csv_marks *marks,
                        sb_csv **csv, sb_error *error);

/* Appends the rows; flushes when there were any. SB_FAILED when the disk refuses, or when a table was removed. */
sb_status sb_csv_write(sb_csv *csv, const sb_measure_records *records, sb_error *error);

/* Closes all files and frees; a late write error is SB_FAILED. NULL is fine. */
sb_status sb_csv_close(sb_csv *csv, sb_error *error);

#endif
