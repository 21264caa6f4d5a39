#include "markdown.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

sb_status sb_report_folder(const sb_common_options *options, const char *out, const char *below,
                           char folder[SB_PATH_MAX], sb_error *error)
{
    if (!options->report && below) return sb_path_join(folder, out, below, error);
    return sb_path_join(folder, "", options->report ? options->report : SB_SOURCE_DIR "/docs/results", error);
}

sb_status sb_report_write(const char *folder, const char *name, sb_put *put, const void *report, sb_error *error)
{
    sb_atomic_file file;
    sb_status status = sb_make_directories(folder, error);
    if (status == SB_OK) status = sb_atomic_open_in(&file, folder, name, error);
    if (status != SB_OK) return status;
    put(file.stream, report);
    return sb_atomic_commit(&file, 0, error);
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
