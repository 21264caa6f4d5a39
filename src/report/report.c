#include "report/report.h"

#include "base/memory.h"
#include "report/html.h"
#include "report/page.h"
#include "report/sections.h"

#include <stdlib.h>
#include <string.h>

#define DYGRAPHS "/usr/share/javascript/dygraphs"
enum { DYGRAPHS_LIMIT = 1 << 20 };

/* dygraphs' style and program as the system has them. Returns whether both are there. */
static bool read_dygraphs(const char *folder, char *texts[2], size_t sizes[2])
{
    static const char *const names[2] = {"dygraph.min.css", "dygraph.min.js"};
    for (int f = 0; f < 2; f++) {
        char path[SB_PATH_MAX];
        if (sb_path_join(path, folder ? folder : DYGRAPHS, names[f], NULL) != SB_OK ||
            sb_file_read(path, DYGRAPHS_LIMIT, &texts[f], &sizes[f], NULL) != SB_OK)
            return false;
    }
    return true;
}

static void put_own(FILE *out, const char *url)
{
    for (size_t f = 0; f < sb_report_files_count; f++)
        if (strcmp(sb_report_files[f].url, url) == 0)
            sb_html_inline(out, (const char *)sb_report_files[f].bytes, sb_report_files[f].size);
}

/* The policy forbids the page to read anything from elsewhere, whatever a name or a scene's text contains. */
static void put_top(FILE *out, const char *title, const char *style, size_t size)
{
    fputs(SB_REPORT_START
          "\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
          "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data: blob:; "
          "style-src 'unsafe-inline'; script-src 'unsafe-inline'; base-uri 'none'; form-action 'none'\">\n"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n",
          out);
    sb_html_put(out, "<title>%s</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>", title);
    if (style) sb_html_inline(out, style, size);
    put_own(out, "/report.css");
    fputs("</style></head>\n<body>\n", out);
}

static sb_status put_page(FILE *out, const sb_report_page *page, char *const texts[2], const size_t sizes[2],
                          sb_error *error)
{
    put_top(out, page->title, page->has_plots ? texts[0] : NULL, sizes[0]);
    sb_section_head(out, page);
    sb_section_pictures(out, page);
    sb_section_loads(out, page);
    sb_section_quality(out, page);
    sb_section_water(out, page);
    sb_section_maps(out, page);
    sb_section_facts(out, page);
    sb_section_record(out, page);
    fputs("</main>\n", out);
    const sb_status status = sb_section_data(out, page, error);
    if (page->has_plots) {
        fputs("<script>", out);
        sb_html_inline(out, texts[1], sizes[1]);
        fputs("</script>\n", out);
    }
    fputs("<script>", out);
    put_own(out, "/report.js");
    fputs("</script>\n</body></html>\n", out);
    return status;
}

static sb_status write_page(const char *path, const sb_report_page *page, char *const texts[2], const size_t sizes[2],
                            size_t *bytes, sb_error *error)
{
    sb_atomic_file file;
    sb_status status = sb_atomic_open(&file, path, error);
    if (status != SB_OK) return status;
    status = put_page(file.stream, page, texts, sizes, error);
    const long size = ftell(file.stream);
    if (status != SB_OK) {
        sb_atomic_abort(&file);
        return status;
    }
    if (bytes) *bytes = size > 0 ? (size_t)size : 0;
    return sb_atomic_commit(&file, 1, error);
}

static const char *title_of(const sb_report_run *run, const char *wanted)
{
    const char *title = wanted ? wanted : sb_report_text(run, "title");
    if (!title && run->has_scene) title = run->scene.title;
    return title && *title ? title : "A run of shorebreak";
}

sb_status sb_report_write(const char *directory, const char *path, const sb_report_options *options, size_t *bytes,
                          sb_error *error)
{
    sb_report_run run;
    sb_loads loads = {0};
    char *texts[2] = {NULL, NULL};
    size_t sizes[2] = {0, 0};
    sb_status status = sb_file_replaceable(path, error);
    if (status == SB_OK) status = sb_report_run_read(directory, &run, error);
    if (status != SB_OK) return status;
    sb_report_page page = {.run = &run, .loads = &loads, .title = title_of(&run, options->title)};
    page.has_plots = read_dygraphs(options->dygraphs, texts, sizes);
    status = sb_loads_make(&run, &loads, error);
    if (status == SB_OK) status = sb_section_data_plan(&page, error);
    if (status == SB_OK) status = write_page(path, &page, texts, sizes, bytes, error);
    for (int f = 0; f < 2; f++) sb_free(texts[f]);
    sb_loads_free(&loads);
    sb_report_run_free(&run);
    return status;
}
