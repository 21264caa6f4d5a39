#include "web/resources.h"

#include "base/file.h"
#include "base/memory.h"

#include <stdio.h>
#include <string.h>

#define FOLDER "/usr/share/javascript/dygraphs"
enum { LIMIT = 4 << 20 }; /* bytes of a file of dygraphs */

static const struct {
    const char *name, *url, *type;
} plot_files[SB_WEB_PLOT_FILES] = {
    {"dygraph.min.js", "/dygraphs.js", "text/javascript; charset=utf-8"},
    {"dygraph.min.css", "/dygraphs.css", "text/css; charset=utf-8"},
};

bool sb_web_plots_load(sb_web_plots *plots, const char *folder)
{
    *plots = (sb_web_plots){0};
    for (size_t f = 0; f < SB_WEB_PLOT_FILES; f++) {
        char path[SB_PATH_MAX];
        size_t length = 0;
        if (sb_path_join(path, folder ? folder : FOLDER, plot_files[f].name, NULL) != SB_OK ||
            sb_file_read(path, LIMIT, &plots->texts[f], &length, NULL) != SB_OK) {
            sb_web_plots_free(plots);
            return false;
        }
        plots->file[f] =
            (sb_web_file){plot_files[f].url, plot_files[f].type, (const unsigned char *)plots->texts[f], length};
    }
    return true;
}

void sb_web_plots_free(sb_web_plots *plots)
{
    for (size_t f = 0; f < SB_WEB_PLOT_FILES; f++) sb_free(plots->texts[f]);
    *plots = (sb_web_plots){0};
}

const sb_web_file *sb_web_find(const sb_web_plots *plots, const char *url)
{
    for (size_t f = 0; f < sb_web_page_count; f++)
        if (strcmp(sb_web_page[f].url, url) == 0) return &sb_web_page[f];
    for (size_t f = 0; f < SB_WEB_PLOT_FILES; f++)
        if (plots->file[f].url && strcmp(plots->file[f].url, url) == 0) return &plots->file[f];
    return NULL;
}
