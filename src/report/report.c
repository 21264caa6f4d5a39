#include "report/report.h"

#include "base/memory.h"
#include "report/sections.h"
#include "report/shell.h"

#include <stdlib.h>
#include <string.h>

static sb_status put_rest(FILE *out, const sb_report_page *page, const sb_shell *shell, sb_error *error)
{
    sb_section_loads(out, page);
    sb_section_quality(out, page);
    sb_section_water(out, page);
    sb_section_maps(out, page);
    sb_section_facts(out, page);
    sb_section_record(out, page);
    fputs("</main>\n", out);
    const sb_status status = sb_plots_put_data(out, page->plots, SB_REPORT_PLOTS, error);
    sb_shell_bottom(out, shell);
    return status;
}

/* The film may have what the rest of the page leaves of the page's size, so the rest is made before it. */
static sb_status put_page(FILE *out, sb_report_page *page, const sb_shell *shell, sb_error *error)
{
    char *rest = NULL;
    size_t size = 0;
    FILE *memory = open_memstream(&rest, &size);
    if (!memory) return sb_fail_memory(error, "a report");
    sb_status status = put_rest(memory, page, shell, error);
    if (fclose(memory) != 0 && status == SB_OK) status = sb_fail_memory(error, "a report");
    if (status == SB_OK) {
        sb_shell_top(out, shell, SB_REPORT_START, page->title);
        sb_section_head(out, page);
        page->film_bytes = size + SB_SECTION_PICTURES_BYTES < SB_REPORT_BYTES_MAX
                               ? SB_REPORT_BYTES_MAX - SB_SECTION_PICTURES_BYTES - size
                               : 0;
        sb_section_pictures(out, page);
        fwrite(rest, 1, size, out);
    }
    free(rest);
    return status;
}

static sb_status write_page(const char *path, sb_report_page *page, const sb_shell *shell, size_t *bytes,
                            sb_error *error)
{
    sb_atomic_file file;
    sb_status status = sb_atomic_open(&file, path, error);
    if (status != SB_OK) return status;
    status = put_page(file.stream, page, shell, error);
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
    sb_shell shell = {0};
    sb_status status = sb_file_replaceable(path, error);
    if (status == SB_OK) status = sb_report_run_read(directory, &run, error);
    if (status != SB_OK) return status;
    sb_report_page page = {
        .run = &run, .loads = &loads, .title = title_of(&run, options->title), .film = options->film};
    sb_shell_read(options->dygraphs, &shell);
    status = sb_loads_make(&run, &loads, error);
    if (status == SB_OK) status = sb_section_data_plan(&page, error);
    if (status == SB_OK) status = write_page(path, &page, &shell, bytes, error);
    sb_section_data_free(&page);
    sb_shell_free(&shell);
    sb_loads_free(&loads);
    sb_report_run_free(&run);
    return status;
}
