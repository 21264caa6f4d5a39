#include "arguments.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A command line while it is read. */
typedef struct reading {
    const sb_command_line *line;
    sb_common_options *common;
    bool help, version;
} reading;

/* Appends a text to the command, in quotes if a shell would split or expand it. */
static void append(sb_common_options *common, const char *text)
{
    const size_t length = strlen(common->command);
    const char *quote = strpbrk(text, " *?[{\"") ? "'" : "";
    snprintf(common->command + length, sizeof common->command - length, " %s%.200s%s", quote, text, quote);
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

static sb_status take_value(const reading *r, const sb_argument *option, const char *value, sb_error *error)
{
    if (!value) return sb_fail(error, SB_BAD_INPUT, "%s: expected a value; see --help", option->name);
    if (option->repeated) append(r->common, value);
    if (option->count) return take_count(option, value, error);
    if (option->number) return take_number(option, value, error);
    if (option->take) return option->take(r->line->user, value, error);
    *option->text = value;
    return SB_OK;
}

/* Finds the option among those of the tool and the common ones. */
static bool find(reading *r, const char *name, sb_argument *found)
{
    sb_common_options *o = r->common;
    const struct {
        unsigned bit;
        sb_argument option;
    } common[] = {{SB_HAS_ALL, {.name = "--all", .flag = &o->all, .repeated = true}},
                  {SB_HAS_QUICK, {.name = "--quick", .flag = &o->quick, .repeated = true}},
                  {SB_HAS_LIST, {.name = "--list", .flag = &o->list}},
                  {SB_HAS_REPORT_ONLY, {.name = "--report-only", .flag = &o->report_only, .repeated = true}},
                  {SB_HAS_JOBS, {.name = "--jobs", .count = &o->jobs, .most = 256, .repeated = true}},
                  {SB_HAS_OUT, {.name = "--out", .text = &o->out}},
                  {SB_HAS_REPORT, {.name = "--report", .text = &o->report}},
                  {SB_HAS_PROGRAM, {.name = "--shorebreak", .text = &o->program}}};
    for (size_t k = 0; k < r->line->option_count; k++)
        if (strcmp(name, r->line->options[k].name) == 0) {
            *found = r->line->options[k];
            return true;
        }
    for (size_t k = 0; k < sizeof common / sizeof *common; k++)
        if ((r->line->has & common[k].bit) && strcmp(name, common[k].option.name) == 0) {
            *found = common[k].option;
            return true;
        }
    return false;
}

static sb_status select_row(sb_selection *s, const char *name, sb_error *error)
{
    for (size_t row = 0; s->name(row); row++) {
        if (strcmp(s->name(row), name) != 0) continue;
        if (!sb_selection_has(s, row)) s->rows[s->count++] = row;
        return SB_OK;
    }
    return sb_fail(error, SB_BAD_INPUT, "%.200s: no such %s; --list shows the %ss", name, s->what, s->what);
}

/* Reads one argument and, if it takes one, its value. *taken: number of arguments read. */
static sb_status take(reading *r, char **at, int left, int *taken, sb_error *error)
{
    sb_argument option;
    *taken = 1;
    if (find(r, at[0], &option)) {
        if (option.repeated) append(r->common, option.name);
        if (option.flag) {
            *option.flag = true;
            return SB_OK;
        }
        *taken = 2;
        return take_value(r, &option, left > 1 ? at[1] : NULL, error);
    }
    if (at[0][0] == '-' || !(r->line->operand || r->line->selection))
        return sb_fail(error, SB_BAD_INPUT, "%.200s: no such option; see --help", at[0]);
    append(r->common, at[0]);
    return r->line->selection ? select_row(r->line->selection, at[0], error)
                              : r->line->operand(r->line->user, at[0], error);
}

static void answer(const reading *r)
{
    if (r->help)
        fputs(r->line->help, stdout);
    else if (r->version)
        printf("shorebreak-%s %s\n", r->line->tool, SB_VERSION);
    else if (r->common->list)
        r->line->list();
    r->common->answered = r->help || r->version || r->common->list;
}

sb_status sb_command_line_read(const sb_command_line *line, int count, char **arguments, sb_common_options *common,
                               sb_error *error)
{
    reading r = {.line = line, .common = common};
    sb_status status = SB_OK;
    *common = (sb_common_options){0};
    snprintf(common->command, sizeof common->command, "tools/%s", line->tool);
    setvbuf(stdout, NULL, _IOLBF, 0);
    r.version = count == 2 && strcmp(arguments[1], "--version") == 0;
    for (int i = 1, taken = 1; status == SB_OK && i < count && !r.help && !r.version; i += taken) {
        r.help = strcmp(arguments[i], "--help") == 0;
        if (!r.help) status = take(&r, arguments + i, count - i, &taken, error);
    }
    if (status == SB_OK) answer(&r);
    return status;
}

void sb_selection_all(sb_selection *s)
{
    for (s->count = 0; s->name(s->count); s->count++) s->rows[s->count] = s->count;
}

sb_status sb_selection_check(const sb_selection *s, sb_error *error)
{
    if (s->count) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT, "no %s given; --list shows the %ss, --all selects all", s->what, s->what);
}

bool sb_selection_has(const sb_selection *s, size_t row)
{
    for (size_t k = 0; k < s->count; k++)
        if (s->rows[k] == row) return true;
    return false;
}

int sb_tool_end(const char *tool, sb_status status, int result, const sb_error *error)
{
    if (status == SB_OK) return result;
    fprintf(stderr, "%s: %s\n", tool, error->text);
    return status == SB_INTERRUPTED ? 130 : (int)status;
}
