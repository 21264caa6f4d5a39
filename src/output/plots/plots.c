#include "output/plots/plots.h"

#include "output/plots/plot_parts.h"
#include "output/plots/tool.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

void sb_plot_quote(FILE *stream, const char *text)
{
    fputc('\'', stream);
    for (; *text; text++) {
        if (*text == '\'') fputc('\'', stream);
        fputc((unsigned char)*text < 0x20 ? ' ' : *text, stream);
    }
    fputc('\'', stream);
}

FILE *sb_plot_open(const char *directory, const char *name, const char *ending, char path[SB_PATH_MAX], sb_error *error)
{
    int length = snprintf(path, SB_PATH_MAX, "%s/plots/%s.%s", directory, name, ending);
    FILE *stream = NULL;
    if (length < SB_PATH_MAX)
        sb_file_open(path, "w", &stream, error);
    else
        sb_fail(error, SB_FAILED, "%.500s: longer than a path may be", path);
    return stream;
}

sb_status sb_plot_draw(const char *program, const char *directory, const char *folder, const char *name,
                       sb_error *error)
{
    char script[128], picture[128], part[SB_PATH_MAX], to[SB_PATH_MAX];
    snprintf(script, sizeof script, "plots/%s.gp", name);
    snprintf(picture, sizeof picture, "%s/%s.png", folder, name);
    char *const arguments[] = {"gnuplot", script, NULL};
    sb_status status = sb_path_join(part, directory, SB_PLOT_PART, error);
    if (status == SB_OK) status = sb_path_join(to, directory, picture, error);
    if (status == SB_OK) status = sb_file_replaceable(to, error);
    if (status != SB_OK) return status;
    unlink(part); /* may be a link */
    status = sb_tool_run(program, arguments, directory, error);
    if (status == SB_OK && rename(part, to) != 0) status = sb_fail(error, SB_FAILED, "%.500s: %s", to, strerror(errno));
    if (status != SB_OK) unlink(part);
    return status;
}

int sb_plots_write(const char *directory, const sb_scene *scene, sb_runlog *log)
{
    char program[SB_PATH_MAX], path[SB_PATH_MAX];
    sb_error error = {0};
    if (!sb_tool_find("gnuplot", program)) {
        sb_runlog_event(log, "skipped", "plots: gnuplot was not found");
        return 0;
    }
    if (sb_make_folder(path, directory, "plots", &error) != SB_OK) {
        sb_runlog_warning(log, "plots: %s", error.text);
        return 0;
    }
    const int drawn = sb_plot_series(program, directory, scene, log);
    return drawn + sb_plot_maps(program, directory, scene, log);
}
