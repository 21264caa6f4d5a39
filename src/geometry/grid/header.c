/* Reads the header of a grid of rows. ESRI writes a key and its value, GeoClaw a value and its key. */
#include "geometry/grid/grid.h"

#include <ctype.h>
#include <strings.h>

typedef enum key {
    KEY_NCOLS,
    KEY_NROWS,
    KEY_XLLCORNER,
    KEY_XLLCENTER,
    KEY_YLLCORNER,
    KEY_YLLCENTER,
    KEY_CELLSIZE,
    KEY_DX,
    KEY_DY,
    KEY_NODATA,
    KEYS
} key;

/* Names of the keys. Messages use the first name of a key. */
static const struct {
    const char *name;
    key key;
} names[] = {
    {"ncols", KEY_NCOLS},
    {"mx", KEY_NCOLS},
    {"nrows", KEY_NROWS},
    {"my", KEY_NROWS},
    {"xllcorner", KEY_XLLCORNER},
    {"xllcenter", KEY_XLLCENTER},
    {"xlower", KEY_XLLCENTER},
    {"yllcorner", KEY_YLLCORNER},
    {"yllcenter", KEY_YLLCENTER},
    {"ylower", KEY_YLLCENTER},
    {"cellsize", KEY_CELLSIZE},
    {"dx", KEY_DX},
    {"dy", KEY_DY},
    {"nodata_value", KEY_NODATA},
    {"nodatavalue", KEY_NODATA},
    {"nodataval", KEY_NODATA},
    {"nodata", KEY_NODATA},
};

enum { NAMES = sizeof names / sizeof *names };

/* The value that marks missing heights when the header does not state one. */
static const double default_nodata = -9999;

typedef struct header {
    bool has[KEYS];
    double value[KEYS];
} header;

static const char *name_of(key of)
{
    size_t i = 0;
    while (names[i].key != of) ++i;
    return names[i].name;
}

static int shown(size_t length)
{
    return (int)(length < 40 ? length : 40);
}

static bool is_nan(const char *token, size_t length)
{
    return length == 3 && strncasecmp(token, "nan", 3) == 0;
}

static bool is_key(const char *token, size_t length)
{
    return length > 0 && isalpha((unsigned char)*token) && !is_nan(token, length);
}

/* Reads the key that begins at from->at, without its value. */
static sb_status take_key(sb_grid_text *from, size_t length, const header *head, key *found, sb_error *error)
{
    size_t i = 0;
    while (i < NAMES && !(strlen(names[i].name) == length && strncasecmp(from->at, names[i].name, length) == 0)) ++i;
    if (i == NAMES)
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s:%zu: \"%.*s\", expected ncols, nrows, xllcorner, xllcenter or xlower, yllcorner, "
                       "yllcenter or ylower, cellsize or dx and dy, nodata_value, then heights",
                       from->path, from->line, shown(length), from->at);
    *found = names[i].key;
    if (head->has[*found])
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: a second %s, expected one", from->path, from->line,
                       name_of(*found));
    from->at += length;
    return SB_OK;
}

/* Reads the next token of the same line if it is a number, without advancing. */
static bool peek_number(const char *at, const char **after, double *value)
{
    char *end;
    at += strspn(at, " \t");
    const size_t length = strcspn(at, " \t\r\n\v\f");
    if (length == 0) return false;
    *value = sb_decimal(at, &end);
    *after = end;
    return end == at + length;
}

static bool line_ends(const char *at)
{
    at += strspn(at, " \t\r");
    return *at == '\0' || *at == '\n' || *at == '#';
}

static void put(header *head, key of, double value)
{
    head->has[of] = true;
    head->value[of] = value;
}

/* "cellsize dx dy": the two steps may differ. */
static void put_cellsize(header *head, double dx, double dy)
{
    put(head, KEY_DX, dx);
    put(head, KEY_DY, dy);
}

static sb_status read_key_first(sb_grid_text *from, size_t length, header *head, sb_error *error)
{
    key found;
    double value, second;
    const char *after;
    sb_status status = take_key(from, length, head, &found, error);
    if (status == SB_OK) status = sb_grid_number(from, "a number after the key", &value, error);
    if (status != SB_OK) return status;
    if (found == KEY_CELLSIZE && peek_number(from->at, &after, &second) && line_ends(after)) {
        put_cellsize(head, value, second);
        from->at = after;
    } else {
        put(head, found, value);
    }
    return SB_OK;
}

/* Reads the line if it has one or two numbers followed by a key, and sets *taken. Otherwise nothing is read. */
static sb_status read_value_first(sb_grid_text *from, header *head, bool *taken, sb_error *error)
{
    key found;
    double values[3];
    size_t count = 0;
    const char *at = from->at, *after;
    while (count < 3 && peek_number(at, &after, &values[count])) {
        ++count;
        at = after;
    }
    at += strspn(at, " \t");
    const size_t length = strcspn(at, " \t\r\n\v\f");
    *taken = count > 0 && count < 3 && is_key(at, length);
    if (!*taken) return SB_OK;
    from->at = at;
    sb_status status = take_key(from, length, head, &found, error);
    if (status != SB_OK) return status;
    if (count == 2 && found != KEY_CELLSIZE)
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: two numbers before %s, expected one", from->path, from->line,
                       name_of(found));
    if (count == 2)
        put_cellsize(head, values[0], values[1]);
    else
        put(head, found, values[0]);
    return SB_OK;
}

static sb_status read_lines(sb_grid_text *from, header *head, sb_error *error)
{
    size_t length;
    bool taken = true;
    sb_status status = SB_OK;
    while (status == SB_OK && taken && (length = sb_grid_token(from)) > 0)
        if (is_key(from->at, length))
            status = read_key_first(from, length, head, error);
        else
            status = read_value_first(from, head, &taken, error);
    return status;
}

static bool is_count(double value)
{
    return value >= 2 && value <= SB_GRID_NODES_MAX && value == floor(value);
}

static const char *missing(const header *head)
{
    const bool *has = head->has;
    if (!has[KEY_NCOLS]) return "ncols";
    if (!has[KEY_NROWS]) return "nrows";
    if (!has[KEY_XLLCORNER] && !has[KEY_XLLCENTER]) return "xllcorner";
    if (!has[KEY_YLLCORNER] && !has[KEY_YLLCENTER]) return "yllcorner";
    if (has[KEY_CELLSIZE] || (has[KEY_DX] && has[KEY_DY])) return NULL;
    return has[KEY_DX] ? "dy" : has[KEY_DY] ? "dx" : "cellsize";
}

static sb_status check_both(const sb_grid_text *from, const header *head, sb_error *error)
{
    const bool *has = head->has;
    if ((has[KEY_XLLCORNER] && has[KEY_XLLCENTER]) || (has[KEY_YLLCORNER] && has[KEY_YLLCENTER]))
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: the header has both corner and center, expected one of them",
                       from->path, from->line);
    if (has[KEY_CELLSIZE] && (has[KEY_DX] || has[KEY_DY]))
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: the header has cellsize and %s, expected one of them",
                       from->path, from->line, has[KEY_DX] ? "dx" : "dy");
    return SB_OK;
}

static sb_status check_numbers(const sb_grid_text *from, const header *head, sb_error *error)
{
    const double columns = head->value[KEY_NCOLS], rows = head->value[KEY_NROWS];
    if (!is_count(columns) || !is_count(rows) || columns * rows > SB_GRID_NODES_MAX)
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s:%zu: ncols %g, nrows %g, expected whole numbers of at least 2 "
                       "with a product of at most %d",
                       from->path, from->line, columns, rows, SB_GRID_NODES_MAX);
    for (key k = KEY_XLLCORNER; k <= KEY_DY; ++k)
        if (head->has[k] && !isfinite(head->value[k]))
            return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: %s is not a number, expected one", from->path, from->line,
                           name_of(k));
    for (key k = KEY_CELLSIZE; k <= KEY_DY; ++k)
        if (head->has[k] && !(head->value[k] > 0))
            return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: %s %g, expected > 0", from->path, from->line, name_of(k),
                           head->value[k]);
    return SB_OK;
}

sb_status sb_grid_read_header(sb_grid_text *from, sb_grid_header *head, sb_error *error)
{
    header read = {0};
    sb_status status = read_lines(from, &read, error);
    if (status != SB_OK) return status;
    const char *absent = missing(&read);
    if (absent)
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: the header ends without %s", from->path, from->line, absent);
    status = check_both(from, &read, error);
    if (status == SB_OK) status = check_numbers(from, &read, error);
    if (status != SB_OK) return status;
    const double *value = read.value;
    *head = (sb_grid_header){.columns = (size_t)value[KEY_NCOLS],
                             .rows = (size_t)value[KEY_NROWS],
                             .dx = value[read.has[KEY_DX] ? KEY_DX : KEY_CELLSIZE],
                             .dy = value[read.has[KEY_DY] ? KEY_DY : KEY_CELLSIZE],
                             .nodata = read.has[KEY_NODATA] ? value[KEY_NODATA] : default_nodata};
    head->x = read.has[KEY_XLLCENTER] ? value[KEY_XLLCENTER] : value[KEY_XLLCORNER] + head->dx / 2;
    head->y = read.has[KEY_YLLCENTER] ? value[KEY_YLLCENTER] : value[KEY_YLLCORNER] + head->dy / 2;
    return SB_OK;
}
