/* The style and the program of the page, made by the build from src/report/page. */
#ifndef SB_REPORT_PAGE_H
#define SB_REPORT_PAGE_H

#include <stddef.h>

typedef struct sb_report_file {
    const char *url, *type; /* "/report.css", "text/css..." */
    const unsigned char *bytes;
    size_t size;
} sb_report_file;

extern const sb_report_file sb_report_files[];
extern const size_t sb_report_files_count;

#endif
