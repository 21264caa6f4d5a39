/* The tables of a run as rows. */
#ifndef SB_OUTPUT_CSV_TABLES_H
#define SB_OUTPUT_CSV_TABLES_H

#include "frame/records.h"
#include "geometry/model/model.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stdio.h>

enum { SB_CSV_TABLES = 9 };

typedef struct sb_csv_table {
    const char *name;                      /* <name>.csv */
    const char *header, *flat_header;      /* in 3D; in 2D, where extensive quantities are per metre of width */
    bool (*wanted)(const sb_scene *scene); /* whether the scene has the table; NULL: always */
    /* The number of new lines, and the writer of line i without its end. */
    size_t (*count)(const sb_measure_records *records);
    void (*write)(FILE *stream, const sb_scene *scene, const sb_model *model, const sb_measure_records *records,
                  size_t i);
} sb_csv_table;

/* In the order of sb_csv_marks. */
extern const sb_csv_table sb_csv_tables[];

/* The name of a table; NULL after the last one. */
const char *sb_csv_name(size_t table);

/* Writes a name as a cell, quoted only where RFC 4180 requires it. */
void sb_csv_put_name(FILE *stream, const char *name);

/* Writes a comma and a number, or nothing behind the comma for NaN. */
void sb_csv_put_number(FILE *stream, double value);

#endif
