#include "figure.h"

#include "base/memory.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void sb_figures_free(sb_figures *figures)
{
    sb_free(figures->rows);
    *figures = (sb_figures){0};
}

const sb_figure *sb_figures_find(const sb_figures *figures, const char *quantity)
{
    for (size_t i = 0; i < figures->count; i++)
        if (strcmp(figures->rows[i].quantity, quantity) == 0) return &figures->rows[i];
    return NULL;
}

void sb_figures_add(sb_figures *figures, const sb_figure *figure)
{
    if (sb_grow((void **)&figures->rows, &figures->capacity, figures->count + 1, sizeof *figures->rows) != 0)
        sb_fail_memory(&figures->error, "figures");
    else
        figures->rows[figures->count++] = *figure;
}

/* Judges and appends a figure. A NaN error misses any target. */
static void add(sb_figures *figures, sb_figure figure, const char *quantity, const char *unit, const char *error_unit,
                const char *note, va_list arguments)
{
    snprintf(figure.quantity, sizeof figure.quantity, "%s", quantity);
    snprintf(figure.unit, sizeof figure.unit, "%s", unit);
    snprintf(figure.error_unit, sizeof figure.error_unit, "%s", error_unit);
    vsnprintf(figure.note, sizeof figure.note, note, arguments);
    double size = figure.one_sided ? figure.error : fabs(figure.error);
    figure.pass = isnan(figure.limit) || size <= figure.limit;
    sb_figures_add(figures, &figure);
}

void sb_figure_share(sb_figures *figures, const char *quantity, const char *unit, double reference, double value,
                     double scale, double limit, const char *note, ...)
{
    va_list arguments;
    va_start(arguments, note);
    sb_figure figure = {
        .reference = reference, .value = value, .error = 100 * (value - reference) / scale, .limit = limit};
    add(figures, figure, quantity, unit, "%", note, arguments);
    va_end(arguments);
}

void sb_figure_difference(sb_figures *figures, const char *quantity, const char *unit, double reference, double value,
                          double limit, const char *note, ...)
{
    va_list arguments;
    va_start(arguments, note);
    sb_figure figure = {.reference = reference, .value = value, .error = value - reference, .limit = limit};
    add(figures, figure, quantity, unit, unit, note, arguments);
    va_end(arguments);
}

void sb_figure_below(sb_figures *figures, const char *quantity, const char *unit, double value, double limit,
                     const char *note, ...)
{
    va_list arguments;
    va_start(arguments, note);
    sb_figure figure = {.reference = (double)NAN, .value = value, .error = value, .limit = limit, .one_sided = true};
    add(figures, figure, quantity, unit, unit, note, arguments);
    va_end(arguments);
}

void sb_figure_band(sb_figures *figures, const char *quantity, const char *unit, double low, double high, double value,
                    double limit, const char *note, ...)
{
    double outside = 0;
    if (isnan(value)) outside = value;
    if (value < low) outside = 100 * (value - low) / fabs(low);
    if (value > high) outside = 100 * (value - high) / fabs(high);
    va_list arguments;
    va_start(arguments, note);
    sb_figure figure = {
        .reference = 0.5 * (low + high), .low = low, .high = high, .value = value, .error = outside, .limit = limit};
    add(figures, figure, quantity, unit, "%", note, arguments);
    va_end(arguments);
}

void sb_figure_report(sb_figures *figures, const char *quantity, const char *unit, double reference, double value,
                      const char *note, ...)
{
    va_list arguments;
    va_start(arguments, note);
    double miss = reference != 0 ? 100 * (value - reference) / fabs(reference) : (double)NAN;
    sb_figure figure = {.reference = reference, .value = value, .error = miss, .limit = (double)NAN};
    add(figures, figure, quantity, unit, "%", note, arguments);
    va_end(arguments);
}
