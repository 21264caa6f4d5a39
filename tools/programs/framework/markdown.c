#include "markdown.h"

#include <ctype.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

sb_status sb_report_write(const char *folder, const char *name, sb_put *put, const void *report, sb_error *error)
{
    char path[SB_PATH_MAX], parent[SB_PATH_MAX];
    sb_atomic_file file;
    sb_status status = sb_path_join(path, folder, name, error);
    if (status != SB_OK) return status;
    sb_path_folder(parent, path);
    status = sb_make_directories(parent, error);
    if (status == SB_OK) status = sb_atomic_open(&file, path, error);
    if (status != SB_OK) return status;
    put(file.stream, report);
    return sb_atomic_commit(&file, 0, error);
}

sb_status sb_reports_write(const sb_store *store, const sb_report_file *files, const void *report, sb_error *error)
{
    char path[SB_PATH_MAX];
    const sb_report_file *last = files;
    while (last[1].name) last++;
    sb_status status = sb_path_join(path, store->report, last->name, error);
    if (status == SB_OK && store->options->report_only && !store->found && access(path, F_OK) == 0) {
        printf("%s: not changed, because %s contains no run of it\n", path, store->out);
        return SB_OK;
    }
    for (const sb_report_file *f = files; status == SB_OK && f->name; f++)
        status = sb_report_write(store->report, f->name, f->put, report, error);
    if (status == SB_OK) printf("%s\n", path);
    return status;
}

void sb_text_number(char text[48], double value)
{
    if (isnan(value))
        snprintf(text, 48, "–");
    else
        snprintf(text, 48, "%.4g", value);
}

void sb_text_error(char text[48], double error, const char *unit)
{
    if (isnan(error))
        snprintf(text, 48, "–");
    else
        snprintf(text, 48, "%+.3g%s%s", error, unit[0] ? " " : "", unit);
}

void sb_put_cell(FILE *out, const char *text)
{
    fputc(' ', out);
    for (; *text; text++) fprintf(out, *text == '|' ? "\\%c" : "%c", *text);
    fputs(" |", out);
}

void sb_put_number(FILE *out, double value)
{
    char text[48];
    sb_text_number(text, value);
    sb_put_cell(out, text);
}

void sb_put_rule(FILE *out, size_t columns)
{
    fputc('|', out);
    while (columns--) fputs("---|", out);
    fputc('\n', out);
}

void sb_put_items(FILE *out, const char *text, bool capital)
{
    for (const char *at = text, *end; *at; at = end) {
        end = strstr(at, "; ");
        const size_t length = end ? (size_t)(end - at) : strlen(at);
        fprintf(out, "- %c%.*s\n", capital ? toupper((unsigned char)*at) : *at, (int)length - 1, at + 1);
        end = end ? end + 2 : at + length;
    }
}

void sb_put_picture(FILE *out, const sb_error *reason, const char *picture)
{
    if (reason->text[0])
        fprintf(out, "No plot: %s.\n", reason->text);
    else
        fputs(picture, out);
}

void sb_put_field(FILE *out, double value)
{
    if (!isnan(value)) fprintf(out, "%.9g", value);
    fputc(',', out);
}
