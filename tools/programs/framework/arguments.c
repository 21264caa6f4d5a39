#include "arguments.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Appends a text to the command, in quotes if a shell would split or expand it. */
static void append(const sb_command_line *line, const char *text)
{
    if (!line->command) return;
    const size_t length = strlen(line->command);
    const char *quote = strpbrk(text, " *?[{\"") ? "'" : "";
    snprintf(line->command + length, line->command_size - length, " %s%.200s%s", quote, text, quote);
}

static sb_status take_count(const sb_argument *option, const char *value, sb_error *error)
{
    char *end;
    const long count = strtol(value, &end, 10);
    if (end == value || *end || count < 1 || (double)count > option->most)
        return sb_fail(error, SB_BAD_INPUT, "%s: %.50s is not a number from 1 to %.0f", option->name, value,
                       option->most);
    *option->count = (int)count;
    return SB_OK;
}

static sb_status take_number(const sb_argument *option, const char *value, sb_error *error)
{
    char *end;
    const double number = strtod(value, &end);
    if (end == value || *end || !isfinite(number) || number <= 0 || number > option->most)
        return sb_fail(error, SB_BAD_INPUT, "%s: %.50s is not a number above 0 and at most %g", option->name, value,
                       option->most);
    *option->number = number;
    return SB_OK;
}

static sb_status take_value(const sb_command_line *line, const sb_argument *option, const char *value, sb_error *error)
{
    if (!value) return sb_fail(error, SB_BAD_INPUT, "%s: expected a value; see --help", option->name);
    if (option->repeated) append(line, value);
    if (option->count) return take_count(option, value, error);
    if (option->number) return take_number(option, value, error);
    if (option->take) return option->take(line->user, value, error);
    *option->text = value;
    return SB_OK;
}

static const sb_argument *find(const sb_command_line *line, const char *name)
{
    for (size_t k = 0; k < line->option_count; k++)
        if (strcmp(name, line->options[k].name) == 0) return &line->options[k];
    return NULL;
}

/* Reads one argument and, if it takes one, its value. *taken: number of arguments read. */
static sb_status take(const sb_command_line *line, char **at, int left, int *taken, sb_error *error)
{
    const sb_argument *option = find(line, at[0]);
    *taken = 1;
    if (option) {
        if (option->repeated) append(line, option->name);
        if (option->flag) {
            *option->flag = true;
            return SB_OK;
        }
        *taken = 2;
        return take_value(line, option, left > 1 ? at[1] : NULL, error);
    }
    if (at[0][0] == '-' || !line->operand)
        return sb_fail(error, SB_BAD_INPUT, "%.200s: no such option; see --help", at[0]);
    append(line, at[0]);
    return line->operand(line->user, at[0], error);
}

sb_status sb_command_line_read(const sb_command_line *line, int count, char **arguments, sb_error *error)
{
    sb_status status = SB_OK;
    for (int i = 1, taken = 1; status == SB_OK && i < count; i += taken) {
        if (strcmp(arguments[i], "--help") == 0) {
            *line->help = true;
            return SB_OK;
        }
        status = take(line, arguments + i, count - i, &taken, error);
    }
    return status;
}
