#include "compare/compare.h"

#include "base/file.h"
#include "base/memory.h"
#include "compare/film.h"
#include "compare/page.h"
#include "compare/table.h"
#include "report/report.h"
#include "report/shell.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>

/* ---- folder ---- */

/* The folder must be empty or new, or hold an earlier comparison, whose files are replaced. */
static sb_status check_folder(const char *folder, sb_error *error)
{
    char path[SB_PATH_MAX], start[sizeof SB_COMPARE_START];
    const size_t length = sizeof SB_COMPARE_START - 1;
    sb_status status = sb_make_directories(folder, error);
    if (status == SB_OK) status = sb_path_join(path, folder, "compare.html", error);
    if (status != SB_OK) return status;
    if (sb_file_start(path, start, length) == length && memcmp(start, SB_COMPARE_START, length) == 0) return SB_OK;
    DIR *entries = opendir(folder);
    for (const struct dirent *entry; entries && status == SB_OK && (entry = readdir(entries));)
        if (entry->d_name[0] != '.')
            status = sb_fail(error, SB_BAD_INPUT,
                             "%.300s: holds %.100s and no comparison: expected a new or an empty folder; name one with "
                             "--out",
                             folder, entry->d_name);
    if (entries) closedir(entries);
    return status;
}

/* ---- files ---- */

static sb_status write_csv(const char *folder, const sb_comparison *comparison, const sb_items *items, sb_error *error)
{
    sb_atomic_file file;
    const sb_status status = sb_atomic_open_in(&file, folder, "compare.csv", error);
    if (status != SB_OK) return status;
    sb_table_csv(file.stream, comparison, items);
    return sb_atomic_commit(&file, 1, error);
}

/* The film has what the rest of the page leaves of the page's size, so the rest is made before it. */
static sb_status put_page(FILE *out, const sb_compare_page *page, const sb_shell *shell, sb_error *error)
{
    enum { HEAD = 300000 }; /* bytes of what stands before the film, at most */
    char *rest = NULL;
    size_t size = 0;
    FILE *memory = open_memstream(&rest, &size);
    if (!memory) return sb_fail_memory(error, "a comparison");
    sb_compare_tables(memory, page);
    sb_compare_maps(memory, page);
    sb_compare_record(memory, page);
    sb_status status = sb_plots_put_data(memory, page->plots, SB_COMPARE_PLOTS, error);
    sb_shell_bottom(memory, shell);
    if (fclose(memory) != 0 && status == SB_OK) status = sb_fail_memory(error, "a comparison");
    if (status == SB_OK) {
        sb_shell_top(out, shell, SB_COMPARE_START, page->title);
        sb_compare_head(out, page);
        sb_compare_pictures(out, page, size + HEAD < SB_REPORT_BYTES_MAX ? SB_REPORT_BYTES_MAX - HEAD - size : 0);
        fwrite(rest, 1, size, out);
    }
    free(rest);
    return status;
}

static sb_status write_page(const sb_compare_page *page, const char *dygraphs, size_t *bytes, sb_error *error)
{
    sb_atomic_file file;
    sb_shell shell;
    sb_status status = sb_atomic_open_in(&file, page->folder, "compare.html", error);
    if (status != SB_OK) return status;
    sb_shell_read(dygraphs, &shell);
    status = put_page(file.stream, page, &shell, error);
    sb_shell_free(&shell);
    const long size = ftell(file.stream);
    *bytes = size > 0 ? (size_t)size : 0;
    if (status == SB_OK) return sb_atomic_commit(&file, 1, error);
    sb_atomic_abort(&file);
    return status;
}

/* ---- all ---- */

static void make_title(const sb_comparison *c, char *title, size_t room)
{
    size_t n = 0;
    *title = '\0';
    for (size_t g = 0; g < c->groups && n < room; g++)
        n += (size_t)snprintf(title + n, room - n, "%s%s", g > 0 ? ", " : "", c->runs[c->group[g].first].label);
}

static sb_status write_all(const sb_comparison *c, const sb_items *items, const char *folder,
                           const sb_compare_options *options, sb_error *error)
{
    char title[1024];
    sb_error why = {0};
    size_t bytes = 0;
    sb_compare_page page = {.comparison = c, .items = items, .folder = folder, .title = options->title};
    make_title(c, title, sizeof title);
    if (!page.title) page.title = title;
    sb_status status = write_csv(folder, c, items, error);
    if (status == SB_OK && !options->film) page.no_film = "The comparison was made without a film.";
    if (status == SB_OK && options->film && sb_film_make(c, folder, "compare.mp4", &why) != SB_OK)
        page.no_film = why.text;
    if (status == SB_OK) status = sb_compare_plots(&page, error);
    if (status == SB_OK) status = write_page(&page, options->dygraphs, &bytes, error);
    sb_compare_plots_free(&page);
    if (status != SB_OK || !options->text) return status;
    sb_table_text(options->text, c, items);
    for (size_t w = 0; w < c->warnings.count; w++) fprintf(options->text, "warning: %s\n", c->warnings.texts[w]);
    fprintf(options->text, "%s: %s\n", folder, page.no_film ? page.no_film : "compare.mp4 shows the runs side by side");
    fprintf(options->text, "%s/compare.html: %.2f MB\n", folder, (double)bytes / 1e6);
    return SB_OK;
}

sb_status sb_compare_write(const char *const *directories, size_t count, const char *folder,
                           const sb_compare_options *options, sb_error *error)
{
    sb_comparison comparison;
    sb_items items = {0};
    sb_status status = sb_comparison_read(directories, count, &comparison, error);
    if (status != SB_OK) return status;
    status = check_folder(folder, error);
    if (status == SB_OK) status = sb_items_make(&comparison, &items, error);
    if (status == SB_OK) status = write_all(&comparison, &items, folder, options, error);
    sb_items_free(&items);
    sb_comparison_free(&comparison);
    return status;
}
