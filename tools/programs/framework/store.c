#include "store.h"

#include "origin.h"
#include "process.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

sb_status sb_store_report(sb_store *store, const char *below, sb_error *error)
{
    const char *given = store->options->report;
    if (!given && below) return sb_path_join(store->report, store->out, below, error);
    if (!given) given = SB_SOURCE_DIR "/docs/results";
    return sb_path_join(store->report, given[0] == '/' ? "" : ".", given, error);
}

sb_status sb_store_open(sb_store *store, const sb_common_options *options, const char *out, const char *assets,
                        bool with_tool, sb_error *error)
{
    sb_store made = {.options = options};
    char beside[SB_PATH_MAX], own[SB_PATH_MAX], real[SB_PATH_MAX];
    sb_status status = sb_process_beside("shorebreak", beside, error);
    if (status == SB_OK) status = sb_process_beside(NULL, own, error);
    if (options->out) out = options->out;
    if (status == SB_OK) status = sb_make_directories(out, error);
    if (status != SB_OK) return status;
    const char *program = options->program ? options->program : beside;
    if (!realpath(out, made.out)) return sb_fail(error, SB_FAILED, "%.400s: %s", out, strerror(errno));
    if (!realpath(program, made.program) || access(made.program, X_OK) != 0)
        return sb_fail(error, SB_BAD_INPUT, "%.400s: no such program", program);
    status = sb_path_join(real, SB_SOURCE_DIR, assets, error);
    if (status == SB_OK && !realpath(real, made.assets))
        status = sb_fail(error, SB_BAD_INPUT, "%.400s: %s", real, strerror(errno));
    if (status == SB_OK) status = sb_hash_file(made.program, &made.build, error);
    if (status == SB_OK && with_tool) status = sb_hash_file(own, &made.build, error);
    if (status != SB_OK) return status;
    /* A program that was built beside this tool belongs to this source tree. */
    if (with_tool || (realpath(beside, real) && strcmp(real, made.program) == 0))
        sb_origin_commit(SB_SOURCE_DIR, made.commit);
    sb_origin_machine(made.machine);
    *store = made;
    return sb_store_report(store, options->quick ? "quick" : NULL, error);
}

void sb_record_text(const char *folder, const char *key, char *value, size_t size)
{
    char path[SB_PATH_MAX], line[512];
    size_t length = strlen(key);
    value[0] = '\0';
    FILE *in = sb_path_join(path, folder, SB_RECORD_NAME, NULL) == SB_OK ? fopen(path, "r") : NULL;
    while (in && fgets(line, sizeof line, in)) {
        if (strncmp(line, key, length) != 0 || strncmp(line + length, ": ", 2) != 0) continue;
        line[strcspn(line, "\n")] = '\0';
        snprintf(value, size, "%s", line + length + 2);
    }
    if (in) fclose(in);
}

double sb_record_number(const char *folder, const char *key)
{
    char text[64], *end;
    sb_record_text(folder, key, text, sizeof text);
    const double value = strtod(text, &end);
    return end == text ? (double)NAN : value;
}

sb_status sb_record_write(const char *folder, const char *name, sb_error *error, const char *format, ...)
{
    sb_atomic_file file;
    sb_status status = sb_atomic_open_in(&file, folder, name, error);
    if (status != SB_OK) return status;
    va_list arguments;
    va_start(arguments, format);
    vfprintf(file.stream, format, arguments);
    va_end(arguments);
    return sb_atomic_commit(&file, 0, error);
}
