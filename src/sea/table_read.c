#include "sea/table_read.h"

#include "base/columns.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { T, X, Y, ETA, U, V, COLUMNS };

static const char *const column_names[] = {"t", "x", "y", "eta", "u", "v"};

static const double metres[] = {1, 0.01, 0.001, 0.3048};
static const char *const unit_names[] = {"m", "cm", "mm", "ft"};

/* Words that are units of length or time, in headers. */
static const struct {
    const char *word, *unit;
    bool time;
} units[] = {
    {"m", "m", false},      {"metre", "m", false}, {"metres", "m", false}, {"meter", "m", false},
    {"meters", "m", false}, {"cm", "cm", false},   {"mm", "mm", false},    {"ft", "ft", false},
    {"feet", "ft", false},  {"foot", "ft", false}, {"km", "km", false},    {"s", "s", true},
    {"sec", "s", true},     {"ms", "ms", true},    {"min", "min", true},   {"minutes", "min", true},
    {"h", "h", true},       {"hr", "h", true},     {"hours", "h", true},   {"hour", "h", true},
};

/* Where each quantity is in a row; -1: nowhere. */
typedef struct layout {
    int column[COLUMNS];
    size_t cells; /* of the header, or of the first row */
} layout;

typedef struct name {
    const char *text;
    int column;
} name;

static const name names[] = {
    {"t", T},         {"time", T},    {"x", X},           {"y", Y}, {"eta", ETA},
    {"surface", ETA}, {"level", ETA}, {"elevation", ETA}, {"u", U}, {"v", V},
};

/* The quantity of a column: its name up to a unit, "eta_m", "time (s)", "u [m/s]"; COLUMNS if it is another one. */
static int column_of(const char *cell)
{
    char word[16];
    const size_t length = strcspn(cell, "_ ([");
    if (length >= sizeof word) return COLUMNS;
    for (size_t i = 0; i < length; i++) word[i] = (char)tolower((unsigned char)cell[i]);
    word[length] = '\0';
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(names[i].text, word) == 0) return names[i].column;
    return COLUMNS;
}

/* The first unit behind the name of a column that is not the expected one of its kind; NULL: none. A time has no
   length, so that "t (m)" says nothing. */
static const char *other_unit(const char *cell, int column, const char *length)
{
    static const char parts[] = " \t_()[]/.*^-";
    cell += strcspn(cell, parts);
    for (size_t width; *cell; cell += width) {
        cell += strspn(cell, parts);
        width = strcspn(cell, parts);
        for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
            if (strlen(units[i].word) != width || strncasecmp(cell, units[i].word, width) != 0) continue;
            if (strcmp(units[i].unit, units[i].time ? "s" : length) == 0 || (column == T && !units[i].time)) continue;
            return units[i].unit;
        }
    }
    return NULL;
}

/* A header may name the unit of the scene's key; another one is refused. */
static sb_status check_unit(const sb_rows *rows, size_t i, int column, sb_given_unit unit, sb_error *error)
{
    const char *found = other_unit(rows->cells[i], column, unit_names[unit]);
    if (!found) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT,
                   "%.500s:%zu: its column \"%.60s\" names the unit %s, expected seconds and %s, the unit of the key "
                   "sea.units",
                   rows->path, rows->line, rows->cells[i], found, unit_names[unit]);
}

/* Removes blanks before and within brackets, so that a unit belongs to the name before it where blanks separate. */
static void join_units(char *line)
{
    char *to = line;
    bool within = false;
    if (strpbrk(line, ",;")) return;
    for (const char *from = line; *from; from++) {
        if (*from == '(' || *from == '[') {
            while (to > line && strchr(" \t", to[-1])) to--;
            within = true;
        }
        if (*from == ')' || *from == ']') within = false;
        if (!within || !strchr(" \t", *from)) *to++ = *from;
    }
    *to = '\0';
}

/* The side at which a velocity along y comes in; NULL: none. */
static const char *side_across_y(const sb_scene *scene)
{
    return sb_scene_given_side(scene, SB_Y_MIN) ? "y_min" : sb_scene_given_side(scene, SB_Y_MAX) ? "y_max" : NULL;
}

static sb_status check_v(const sb_rows *rows, const sb_scene *scene, const layout *found, sb_error *error)
{
    const char *side = side_across_y(scene);
    if (found->column[V] >= 0 || !side) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT,
                   "%.500s:%zu: no column is v, expected v, the velocity along y, because the water is given at %s",
                   rows->path, rows->line, side);
}

static sb_status read_header(const sb_rows *rows, const sb_scene *scene, layout *found, sb_error *error)
{
    for (int c = 0; c < COLUMNS; c++) found->column[c] = -1;
    found->cells = rows->cell_count;
    for (size_t i = 0; i < rows->cell_count; i++) {
        const int column = column_of(rows->cells[i]);
        if (column == COLUMNS) continue;
        if (found->column[column] >= 0)
            return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: two columns are %s: \"%.60s\" and \"%.60s\", expected one",
                           rows->path, rows->line, column_names[column], rows->cells[found->column[column]],
                           rows->cells[i]);
        found->column[column] = (int)i;
        const sb_status status = check_unit(rows, i, column, scene->given.unit, error);
        if (status != SB_OK) return status;
    }
    const bool x = found->column[X] >= 0, y = found->column[Y] >= 0;
    const char *missing = found->column[T] < 0                ? "t"
                          : found->column[ETA] < 0            ? "eta"
                          : found->column[U] < 0              ? "u"
                          : y && !x                           ? "x"
                          : x && !y && scene->dimensions == 3 ? "y"
                                                              : NULL;
    if (!missing) return SB_OK;
    return sb_fail(
        error, SB_BAD_INPUT,
        "%.500s:%zu: no column is %s, expected t, eta, u and optionally v, and x and y together where there is more "
        "than one point",
        rows->path, rows->line, missing);
}

/* The columns of a table without a header, from their number. */
static sb_status guess_layout(const sb_rows *rows, layout *found, sb_error *error)
{
    static const layout one = {{0, -1, -1, 1, 2, -1}, 3}, one_v = {{0, -1, -1, 1, 2, 3}, 4},
                        many = {{0, 1, 2, 3, 4, 5}, 6};
    *found = rows->cell_count == 3 ? one : rows->cell_count == 4 ? one_v : many;
    if (rows->cell_count == 3 || rows->cell_count == 4 || rows->cell_count == 6) return SB_OK;
    return sb_fail(
        error, SB_BAD_INPUT,
        "%.500s:%zu: %zu columns without a header, expected t, eta, u (3), t, eta, u, v (4), t, x, y, eta, u, "
        "v (6), or a header that names the columns",
        rows->path, rows->line, rows->cell_count);
}

/* A comma within a number separates two columns: such a row has more of them than the table. */
static sb_status check_cells(const sb_rows *rows, const layout *found, sb_error *error)
{
    size_t cells = rows->cell_count;
    while (cells > found->cells && !*rows->cells[cells - 1]) cells--;
    if (cells <= found->cells) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT,
                   "%.500s:%zu: %zu columns, expected at most the %zu of the table; decimals have points", rows->path,
                   rows->line, cells, found->cells);
}

static sb_status add_row(const sb_rows *rows, const double *value, double unit, sb_line *series, sb_error *error)
{
    char place[SB_ROWS_PLACE];
    const double channels[] = {unit * value[ETA], unit * value[U], unit * value[V]};
    return sb_line_add(series, unit * value[X], unit * value[Y], value[T], channels, sb_rows_place(rows, place), error);
}

static sb_status read_csv(sb_rows *rows, char *line, const sb_scene *scene, sb_line *series, sb_error *error)
{
    layout found = {.cells = 0};
    bool known = false;
    sb_status status = SB_OK;
    for (; status == SB_OK && line; line = sb_rows_next(rows)) {
        const bool header = !known && sb_columns_header(line, strcspn(line, "#"));
        if (*line == '#') continue;
        line[strcspn(line, "#")] = '\0';
        if (header) join_units(line);
        /* "0;0,12;0" has three columns, but four cells, as t, eta, u, v would have. */
        if (status == SB_OK && !header && strchr(line, ';') && strchr(line, ','))
            return sb_fail(
                error, SB_BAD_INPUT,
                "%.500s:%zu: has commas and semicolons, expected one kind of separator; decimals have points",
                rows->path, rows->line);
        if (status == SB_OK) status = sb_rows_cut(rows, line, error);
        if (status == SB_OK && !known)
            status = header ? read_header(rows, scene, &found, error) : guess_layout(rows, &found, error);
        if (status == SB_OK && !known) status = check_v(rows, scene, &found, error);
        if (status != SB_OK) return status;
        const bool first = !known;
        known = true;
        if (first && header) continue;
        status = check_cells(rows, &found, error);
        double value[COLUMNS] = {0};
        for (int c = 0; status == SB_OK && c < COLUMNS; c++)
            if (found.column[c] >= 0)
                status = sb_rows_number(rows, (size_t)found.column[c], column_names[c], &value[c], error);
        if (status == SB_OK) status = add_row(rows, value, metres[scene->given.unit], series, error);
    }
    return status;
}

/* Reads "location=( x y )" of a gauge's first line; a point has no place without it. */
static sb_status read_location(const sb_rows *rows, const char *line, double *x, double *y, sb_error *error)
{
    const char *at = strstr(line, "location=(");
    char *end = NULL;
    *x = *y = 0;
    if (at) *x = strtod(at + strlen("location=("), &end);
    if (end) *y = strtod(end, &end);
    if (end && end[strspn(end, " \t")] == ')' && fabs(*x) <= 1e9 && fabs(*y) <= 1e9) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: a gauge of GeoClaw without its place, expected location=( x y )",
                   rows->path, rows->line);
}

/* Depth below which GeoClaw's momentum is not divided by it, m; its own default is 1e-3. */
static const double DRY = 1e-3;

/* GeoClaw can write a gauge's rows to a binary file beside the text, which then has the header only. */
static sb_status check_format(const sb_rows *rows, const char *line, sb_error *error)
{
    static const char key[] = "file format ";
    const char *at = strstr(line, key);
    if (!at || strncmp(at += strlen(key), "ascii", 5) == 0) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT,
                   "%.500s:%zu: a gauge of GeoClaw in the format %.*s, whose rows are in another file, expected ascii: "
                   "gaugedata.file_format = 'ascii' in setrun.py",
                   rows->path, rows->line, (int)strcspn(at, " ,\t\r"), at);
}

/* One gauge after another: "# gauge_id= 1 location=( x y ) ...", then rows of level, t, h, hu, hv, eta. */
static sb_status read_geoclaw(sb_rows *rows, char *line, sb_given_unit unit, sb_line *series, sb_error *error)
{
    static const char *const what[] = {"level", "t", "h", "hu", "hv", "eta"};
    double x = 0, y = 0;
    sb_status status = SB_OK;
    for (; status == SB_OK && line; line = sb_rows_next(rows)) {
        if (*line == '#') {
            if (strstr(line, "gauge_id")) status = read_location(rows, line, &x, &y, error);
            if (status == SB_OK) status = check_format(rows, line, error);
            continue;
        }
        status = sb_rows_cut(rows, line, error);
        double value[6];
        for (size_t c = 0; status == SB_OK && c < 6; c++) status = sb_rows_number(rows, c, what[c], &value[c], error);
        if (status != SB_OK) return status;
        const double over = value[2] > DRY ? 1 / value[2] : 0;
        const double row[COLUMNS] = {value[1], x, y, value[5], value[3] * over, value[4] * over};
        status = add_row(rows, row, metres[unit], series, error);
    }
    return status;
}

sb_status sb_table_read(sb_rows *rows, const sb_scene *scene, sb_line *series, sb_error *error)
{
    char *line = sb_rows_next(rows);
    if (!line) return sb_fail(error, SB_BAD_INPUT, "%.500s: is empty, expected rows of t, eta, u", rows->path);
    series->channels = SB_TABLE_CHANNELS;
    const bool geoclaw = *line == '#' && strstr(line, "gauge_id");
    return geoclaw ? read_geoclaw(rows, line, scene->given.unit, series, error)
                   : read_csv(rows, line, scene, series, error);
}
