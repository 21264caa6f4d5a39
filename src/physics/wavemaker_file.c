/* A paddle that follows a table of lines "t x" (s after the start, m), for example one measured in a flume. */
#include "base/columns.h"
#include "base/memory.h"
#include "physics/number_rows.h"
#include "physics/wavemaker.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NUMBER_LIMIT = 1000000000 };

typedef struct knot {
    double t, x, slope; /* s, m above the first, m/s */
} knot;

typedef struct table {
    knot *knots;
    size_t count, capacity;
    bool header; /* a line that names the columns was read */
} table;

static void destroy(void *state)
{
    table *law = state;
    if (law) sb_free(law->knots);
    sb_free(law);
}

/* Reads a decimal number at *at and moves *at behind it and behind its separator: blanks, or one comma or semicolon.
   Returns -1 if there is no number or it is out of range. */
static int read_number(char **at, double *value)
{
    char *end = *at + strcspn(*at, " \t\r,;");
    if (end == *at || strspn(*at, "+-.0123456789eE") != (size_t)(end - *at)) return -1;
    char *stop;
    *value = strtod(*at, &stop);
    *at = end + strspn(end, " \t\r");
    if (**at == ',' || **at == ';') *at += 1 + strspn(*at + 1, " \t\r");
    return stop == end && fabs(*value) <= NUMBER_LIMIT ? 0 : -1;
}

/* Reads a line of column names, of which one is allowed, before the first row. */
static sb_status read_header(table *law, const char *line, const char *path, size_t number, sb_error *error)
{
    const char *unit = sb_columns_unit(line, strlen(line));
    law->header = true;
    if (!unit) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: its header names the unit %s, expected seconds and metres", path,
                   number, unit);
}

/* Reads one line without its newline. A comment or an empty line adds no knot. */
static sb_status read_line(table *law, char *line, const char *path, size_t number, sb_error *error)
{
    char *at = line + strspn(line, " \t\r");
    at[strcspn(at, "#")] = '\0';
    if (!*at) return SB_OK;
    if (law->count == 0 && !law->header && sb_columns_header(at, strlen(at)))
        return read_header(law, at, path, number, error);
    knot next = {0};
    if (read_number(&at, &next.t) != 0 || read_number(&at, &next.x) != 0 || *at)
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: expected two numbers below 1e9, \"time displacement\"", path,
                       number);
    if (law->count == 0 && next.t < 0)
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: time %g s is before the start, expected 0 or later", path,
                       number, next.t);
    if (law->count > 0 && !(next.t > law->knots[law->count - 1].t))
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: time %g s does not follow %g s, expected increasing times",
                       path, number, next.t, law->knots[law->count - 1].t);
    if (law->count > 0) {
        const knot *last = &law->knots[law->count - 1];
        double speed = (next.x - last->x) / (next.t - last->t);
        if (!(fabs(speed) <= NUMBER_LIMIT))
            return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: a speed of %g m/s, expected below 1e9", path, number,
                           speed);
    }
    if (sb_grow((void **)&law->knots, &law->capacity, law->count + 1, sizeof next) != 0)
        return sb_fail_memory(error, path);
    law->knots[law->count++] = next;
    return SB_OK;
}

static sb_status read_lines(table *law, char *text, const char *path, sb_error *error)
{
    size_t number = 1;
    for (char *line = text; line; number++) {
        char *newline = strchr(line, '\n');
        if (newline) *newline = '\0';
        sb_status status = read_line(law, line, path, number, error);
        if (status != SB_OK) return status;
        line = newline ? newline + 1 : NULL;
    }
    if (law->count < 2)
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: %zu rows, expected at least 2", path, number - 1, law->count);
    return SB_OK;
}

/* Finds the slopes of a cubic that is monotone wherever the table is (Steffen 1990, eq. 11): the slope of the parabola
   through three knots, limited by the slopes of the neighbouring chords, and 0 at a turning point. The slopes at both
   ends are 0, so that the speed has no jump there. */
static void find_slopes(table *law)
{
    knot *k = law->knots;
    double first = k[0].x;
    for (size_t i = 0; i < law->count; i++) k[i].x -= first;
    for (size_t i = 1; i + 1 < law->count; i++) {
        double before = k[i].t - k[i - 1].t, after = k[i + 1].t - k[i].t;
        double left = (k[i].x - k[i - 1].x) / before, right = (k[i + 1].x - k[i].x) / after;
        double parabola = (left * after + right * before) / (before + after);
        double bound = 2 * fmin(fabs(left), fabs(right));
        k[i].slope = left * right <= 0 ? 0 : copysign(fmin(fabs(parabola), bound), left);
    }
}

static sb_status create(const sb_wavemaker_parameters *parameters, void **state, sb_error *error)
{
    const char *path = parameters->file;
    char *text = NULL;
    sb_status status = sb_number_text_read(path, &text, error);
    if (status != SB_OK) return status;
    table *made = sb_alloc(1, sizeof *made);
    if (!made)
        status = sb_fail_memory(error, path);
    else
        status = read_lines(made, text, path, error);
    sb_free(text);
    if (!made || status != SB_OK) {
        destroy(made);
        return status;
    }
    find_slopes(made);
    *state = made;
    return SB_OK;
}

static double displacement(const void *state, double t)
{
    const table *law = state;
    const knot *knots = law->knots;
    size_t low = 0, high = law->count - 1;
    if (t <= knots[low].t) return 0;
    if (t >= knots[high].t) return knots[high].x;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (knots[middle].t <= t)
            low = middle;
        else
            high = middle;
    }
    const knot *a = &knots[low], *b = &knots[high];
    double span = b->t - a->t, s = (t - a->t) / span, rest = 1 - s;
    return rest * rest * (a->x * (1 + 2 * s) + a->slope * span * s) +
           s * s * (b->x * (1 + 2 * rest) - b->slope * span * rest);
}

static double duration(const void *state)
{
    const table *law = state;
    return law->knots[law->count - 1].t;
}

const sb_wavemaker sb_wavemaker_file = {
    .name = "file",
    .summary = "paddle that follows a table of times and displacements",
    .reference = "interpolation: Steffen 1990",
    .needs = SB_WM_FILE,
    .create = create,
    .displacement = displacement,
    .duration = duration,
    .destroy = destroy,
};
