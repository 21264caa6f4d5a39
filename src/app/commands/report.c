#include "report/report.h"
#include "app/commands/commands.h"
#include "app/options.h"
#include "app/run/files.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char help[] =
    "usage: shorebreak report RUN_DIR [--out FILE] [--title TEXT] [--film] [--quiet]\n"
    "Writes one HTML page about a run that anyone can open without a network: pictures, forces, loads on bodies, "
    "water\n"
    "levels, inundation, how far to trust the results, and what repeats the run. Also of a run that has not ended.\n\n"
    "  --out FILE    write the page to FILE (default: RUN_DIR/report.html)\n"
    "  --title TEXT  title of the page (default: the scene's title)\n"
    "  --film        put the run's film into the page instead of the strip of pictures, if the page stays below 5 MB\n"
    "  --quiet       print nothing\n";

/* Reading a FIFO in the place of a run's file would block. */
static sb_status check_run(const char *run, sb_error *error)
{
    struct stat info;
    sb_run_files files;
    if (stat(run, &info) != 0 || !S_ISDIR(info.st_mode))
        return sb_fail(error, SB_BAD_INPUT, "%.500s: expected the folder of a run", run);
    const sb_status status = sb_run_files_find(run, NULL, &files, error);
    sb_run_files_free(&files);
    return status;
}

/* An earlier report is replaced; a file of other origin is not. */
static sb_status check_place(const char *path, sb_error *error)
{
    char start[sizeof SB_REPORT_START];
    struct stat info;
    const size_t length = sizeof SB_REPORT_START - 1;
    sb_status status = sb_file_replaceable(path, error);
    if (status != SB_OK || lstat(path, &info) != 0 || info.st_size == 0) return status;
    if (sb_file_start(path, start, length) == length && memcmp(start, SB_REPORT_START, length) == 0) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT,
                   "%.500s: is no report of shorebreak, and would be overwritten; name another file with --out", path);
}

static sb_status report(const sb_options *options, sb_error *error)
{
    char path[SB_PATH_MAX];
    size_t bytes = 0;
    const sb_report_options page = {.title = options->title, .film = options->film};
    sb_status status = check_run(options->positional, error);
    if (status == SB_OK && options->out)
        snprintf(path, sizeof path, "%s", options->out);
    else if (status == SB_OK)
        status = sb_path_join(path, options->positional, "report.html", error);
    if (status == SB_OK) status = check_place(path, error);
    if (status == SB_OK) status = sb_report_write(options->positional, path, &page, &bytes, error);
    if (status == SB_OK && !options->quiet) printf("%s: %.2f MB\n", path, (double)bytes / 1e6);
    return status;
}

int sb_command_report(int count, char **arguments)
{
    sb_options options;
    sb_error error = {0};
    sb_status status = sb_options_parse(count, arguments, SB_OPT_OUT | SB_OPT_TITLE | SB_OPT_FILM | SB_OPT_QUIET,
                                        "run directory", &options, &error);
    if (status == SB_OK && options.help) {
        fputs(help, stdout);
        return 0;
    }
    if (status == SB_OK) status = report(&options, &error);
    if (status != SB_OK) fprintf(stderr, "shorebreak: %s\n", error.text);
    sb_options_free(&options);
    return (int)status;
}
