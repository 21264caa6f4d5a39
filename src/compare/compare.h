/* The comparison of runs: a table for programs, a page for people, maps of the difference, and a film. */
#ifndef SB_COMPARE_COMPARE_H
#define SB_COMPARE_COMPARE_H

#include "base/status.h"

#include <stdbool.h>
#include <stdio.h>

/* The first bytes of the page, by which a folder of a comparison is recognised. */
#define SB_COMPARE_START "<!doctype html><!-- shorebreak comparison -->"

typedef struct sb_compare_options {
    const char *title;    /* of the page; NULL: made from the names of the runs */
    const char *dygraphs; /* folder of dygraphs; NULL: where Debian's libjs-dygraphs has it */
    bool film;            /* makes the film */
    FILE *text;           /* the table for a terminal, and what was written; NULL: none */
} sb_compare_options;

/* Compares finished runs and writes compare.html, compare.csv, depth-difference-<n>.asc for the second and later
   scenes, and compare.mp4 into `folder`, which is made if needed. Runs of one scene that differ only in the start seed
   are one entry with error bars. SB_BAD_INPUT says why runs cannot be compared, or that the folder holds other files.
 */
sb_status sb_compare_write(const char *const *directories, size_t count, const char *folder,
                           const sb_compare_options *options, sb_error *error);

#endif
