/* The report of a run: one HTML page with all that it needs inside, which reads no other file and no network. */
#ifndef SB_REPORT_REPORT_H
#define SB_REPORT_REPORT_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

/* The first bytes of a report, by which one is recognised as ours. */
#define SB_REPORT_START "<!doctype html><!-- shorebreak report -->"

enum { SB_REPORT_BYTES_MAX = 5000000 }; /* of a page: its parts have limits that add up to less */

typedef struct sb_report_options {
    const char *title;    /* of the page; NULL: the scene's title */
    bool film;            /* the film of the first camera that has one, instead of the strip of pictures */
    const char *dygraphs; /* folder of dygraphs; NULL: where Debian's libjs-dygraphs has it */
} sb_report_options;

/* Writes the report of the run in `directory` to the file `path`, completely or not at all. What is missing or damaged
   is said on the page. SB_BAD_INPUT if the directory has neither log, summary nor tables of a run, or if another kind
   of file is at `path`. *bytes (may be NULL): the page's size. */
sb_status sb_report_write(const char *directory, const char *path, const sb_report_options *options, size_t *bytes,
                          sb_error *error);

#endif
