/* ESRI ASCII grids: a header of keys and values, then the rows from north to south. */
#include "base/memory.h"
#include "geometry/grid.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef struct scanner {
    const char *path, *at;
    size_t line;
} scanner;

typedef enum key {
    KEY_NCOLS,
    KEY_NROWS,
    KEY_XLLCORNER,
    KEY_XLLCENTER,
    KEY_YLLCORNER,
    KEY_YLLCENTER,
    KEY_CELLSIZE,
    KEY_NODATA,
    KEYS
} key;

static const char *const key_names[KEYS] = {"ncols",     "nrows",     "xllcorner", "xllcenter",
                                            "yllcorner", "yllcenter", "cellsize",  "nodata_value"};

/* Of a header without the line, which the format lets it do without. */
static const double default_nodata = -9999;

typedef struct header {
    bool has[KEYS];
    double value[KEYS];
} header;

/* The next word, which is not copied; its length, 0 at the end of the text. */
static size_t next_word(scanner *from)
{
    for (; isspace((unsigned char)*from->at); ++from->at) from->line += *from->at == '\n';
    return strcspn(from->at, " \t\r\n\v\f");
}

static sb_status next_number(scanner *from, const char *what, double *value, sb_error *error)
{
    size_t length = next_word(from);
    char *end;
    double number = sb_decimal(from->at, &end);
    if (length == 0)
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: the file ends, expected %s", from->path, from->line, what);
    if (end != from->at + length || !isfinite(number))
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: \"%.*s\", expected %s", from->path, from->line,
                       (int)(length < 40 ? length : 40), from->at, what);
    from->at = end;
    *value = number;
    return SB_OK;
}

static sb_status read_header(scanner *from, header *head, sb_error *error)
{
    size_t length;
    while ((length = next_word(from)) > 0 && isalpha((unsigned char)*from->at)) {
        int found = 0;
        while (found < KEYS &&
               !(strlen(key_names[found]) == length && strncasecmp(from->at, key_names[found], length) == 0))
            ++found;
        if (found == KEYS)
            return sb_fail(error, SB_BAD_INPUT,
                           "%.500s:%zu: \"%.*s\", expected ncols, nrows, xllcorner or xllcenter, "
                           "yllcorner or yllcenter, cellsize, nodata_value, then heights",
                           from->path, from->line, (int)(length < 40 ? length : 40), from->at);
        if (head->has[found])
            return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: a second %s, expected one", from->path, from->line,
                           key_names[found]);
        from->at += length;
        head->has[found] = true;
        sb_status status = next_number(from, "a number after the key", &head->value[found], error);
        if (status != SB_OK) return status;
    }
    return SB_OK;
}

static bool is_count(double value)
{
    return value >= 2 && value <= SB_GRID_NODES_MAX && value == floor(value);
}

static sb_status check_header(const scanner *from, const header *head, sb_error *error)
{
    const char *lacking = NULL;
    lacking = head->has[KEY_CELLSIZE] ? lacking : "cellsize";
    lacking = head->has[KEY_YLLCORNER] || head->has[KEY_YLLCENTER] ? lacking : "yllcorner";
    lacking = head->has[KEY_XLLCORNER] || head->has[KEY_XLLCENTER] ? lacking : "xllcorner";
    lacking = head->has[KEY_NROWS] ? lacking : "nrows";
    lacking = head->has[KEY_NCOLS] ? lacking : "ncols";
    if (lacking)
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: the header ends without %s", from->path, from->line, lacking);
    if ((head->has[KEY_XLLCORNER] && head->has[KEY_XLLCENTER]) ||
        (head->has[KEY_YLLCORNER] && head->has[KEY_YLLCENTER]))
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: the header has both corner and center, expected one of them",
                       from->path, from->line);
    double columns = head->value[KEY_NCOLS], rows = head->value[KEY_NROWS];
    if (!is_count(columns) || !is_count(rows) || columns * rows > SB_GRID_NODES_MAX)
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s:%zu: ncols %g, nrows %g, expected whole numbers from 2 on, at most "
                       "%d together",
                       from->path, from->line, columns, rows, SB_GRID_NODES_MAX);
    if (!(head->value[KEY_CELLSIZE] > 0))
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: cellsize %g, expected > 0", from->path, from->line,
                       head->value[KEY_CELLSIZE]);
    return SB_OK;
}

static sb_status read_heights(scanner *from, const header *head, sb_grid *grid, sb_error *error)
{
    const double nodata = head->has[KEY_NODATA] ? head->value[KEY_NODATA] : default_nodata;
    for (size_t row = grid->rows; row-- > 0;)
        for (size_t column = 0; column < grid->columns; ++column) {
            double *to = grid->heights + row * grid->columns + column;
            sb_status status = next_number(from, "a height for each cell", to, error);
            if (status != SB_OK) return status;
            if (*to == nodata) *to = (double)NAN;
        }
    if (next_word(from) > 0)
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: more numbers than the %zu x %zu of the header", from->path,
                       from->line, grid->columns, grid->rows);
    return SB_OK;
}

sb_status sb_grid_read_ascii(const char *path, const char *text, sb_grid *grid, sb_error *error)
{
    scanner from = {path, text, 1};
    header head = {0};
    sb_status status = read_header(&from, &head, error);
    if (status == SB_OK) status = check_header(&from, &head, error);
    if (status != SB_OK) return status;
    double cell = head.value[KEY_CELLSIZE];
    sb_grid made = {
        .columns = (size_t)head.value[KEY_NCOLS], .rows = (size_t)head.value[KEY_NROWS], .dx = cell, .dy = cell};
    made.x = head.has[KEY_XLLCENTER] ? head.value[KEY_XLLCENTER] : head.value[KEY_XLLCORNER] + cell / 2;
    made.y = head.has[KEY_YLLCENTER] ? head.value[KEY_YLLCENTER] : head.value[KEY_YLLCORNER] + cell / 2;
    /* A height takes two characters or more: no text is long enough for a made-up size. */
    if (made.columns * made.rows > strlen(from.at))
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: too short for the %zu x %zu of its header", path, from.line,
                       made.columns, made.rows);
    made.heights = sb_alloc_untouched(made.columns * made.rows, sizeof *made.heights);
    if (!made.heights) return sb_fail_memory(error, "a terrain grid");
    status = read_heights(&from, &head, &made, error);
    if (status == SB_OK)
        *grid = made;
    else
        sb_free(made.heights);
    return status;
}
