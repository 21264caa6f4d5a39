/* Reads grids of rows: a header, then the heights from north to south, each row from west to east, in lines of any
   length. These are ESRI's ASCII grids and GeoClaw's topotypes 2 (one height per line) and 3. */
#include "base/memory.h"
#include "base/stop.h"
#include "geometry/grid/grid.h"

#include <ctype.h>
#include <strings.h>

size_t sb_grid_token(sb_grid_text *from)
{
    for (;; ++from->at) {
        if (*from->at == '#') from->at += strcspn(from->at, "\n");
        if (!isspace((unsigned char)*from->at)) return strcspn(from->at, " \t\r\n\v\f#");
        from->line += *from->at == '\n';
    }
}

/* A missing height may be written as nan, with a sign on some processors. */
static bool is_nan(const char *token, size_t length)
{
    const size_t sign = *token == '-' || *token == '+';
    return length == sign + 3 && strncasecmp(token + sign, "nan", 3) == 0;
}

sb_status sb_grid_number(sb_grid_text *from, const char *what, double *value, sb_error *error)
{
    const size_t length = sb_grid_token(from);
    char *end;
    *value = sb_decimal(from->at, &end);
    if (length == 0)
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: the file ends, expected %s", from->path, from->line, what);
    if (end != from->at + length || (!isfinite(*value) && !is_nan(from->at, length)))
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: \"%.*s\", expected %s", from->path, from->line,
                       (int)(length < 40 ? length : 40), from->at, what);
    from->at = end;
    return SB_OK;
}

static sb_status read_heights(sb_grid_text *from, const sb_grid_header *head, sb_grid *grid, sb_error *error)
{
    for (size_t row = grid->rows; row-- > 0;) {
        if (sb_stop_signal()) return sb_stop_fail(error, "while terrain was read");
        for (size_t column = 0; column < grid->columns; ++column) {
            double *to = grid->heights + row * grid->columns + column;
            sb_status status = sb_grid_number(from, "a height for each cell", to, error);
            if (status != SB_OK) return status;
            if (*to == head->nodata || isnan(*to)) *to = (double)NAN;
        }
    }
    if (sb_grid_token(from) > 0)
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: more numbers than the header's %zu x %zu heights", from->path,
                       from->line, grid->columns, grid->rows);
    return SB_OK;
}

sb_status sb_grid_read_ascii(const char *path, const char *text, sb_grid *grid, sb_error *error)
{
    sb_grid_text from = {path, text, 1};
    sb_grid_header head = {0};
    sb_status status = sb_grid_read_header(&from, &head, error);
    if (status != SB_OK) return status;
    sb_grid made = {.columns = head.columns, .rows = head.rows, .x = head.x, .y = head.y, .dx = head.dx, .dy = head.dy};
    /* A height takes two or more characters. A size that the text cannot hold is refused before memory is allocated
       for it. */
    if (made.columns * made.rows > strlen(from.at))
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: the file is too short for the header's %zu x %zu heights",
                       path, from.line, made.columns, made.rows);
    made.heights = sb_alloc_untouched(made.columns * made.rows, sizeof *made.heights);
    if (!made.heights) return sb_fail_memory(error, "a terrain grid");
    status = read_heights(&from, &head, &made, error);
    if (status == SB_OK)
        *grid = made;
    else
        sb_free(made.heights);
    return status;
}
