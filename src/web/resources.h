/* The files of the page: those that are part of the program, and dygraphs as the system has it. All are in memory. */
#ifndef SB_WEB_RESOURCES_H
#define SB_WEB_RESOURCES_H

#include <stdbool.h>
#include <stddef.h>

typedef struct sb_web_file {
    const char *url, *type;
    const unsigned char *bytes;
    size_t size;
} sb_web_file;

/* Made by the build from src/web/page. */
extern const sb_web_file sb_web_page[];
extern const size_t sb_web_page_count;

enum { SB_WEB_PLOT_FILES = 2 };
/* dygraphs.js and dygraphs.css; bytes NULL: they are not installed. */
typedef struct sb_web_plots {
    sb_web_file file[SB_WEB_PLOT_FILES];
    char *texts[SB_WEB_PLOT_FILES];
} sb_web_plots;

/* Reads dygraphs from `folder`; NULL: from where Debian's libjs-dygraphs has it. Returns whether it is complete. */
bool sb_web_plots_load(sb_web_plots *plots, const char *folder);
void sb_web_plots_free(sb_web_plots *plots);

/* The file with this URL; NULL: there is none. */
const sb_web_file *sb_web_find(const sb_web_plots *plots, const char *url);

#endif
