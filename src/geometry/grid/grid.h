/* Terrain heights on a regular grid, the step between the file formats and a mesh. Private to src/geometry/grid*.c. */
#ifndef SB_GEOMETRY_GRID_H
#define SB_GEOMETRY_GRID_H

#include "geometry/mesh/mesh.h"

#include <stdlib.h>
#include <string.h>

/* Heights at (x + i dx, y + j dy), i < columns, j < rows. Row j = 0 is the southernmost. NAN marks a hole. Owned. */
typedef struct sb_grid {
    size_t columns, rows;
    double x, y, dx, dy; /* file units */
    double *heights;     /* [j * columns + i] */
} sb_grid;

/* A rectangle, of places x, y. */
typedef struct sb_terrain_area {
    double min[2], max[2];
} sb_terrain_area;

/* A text grid that is read token by token. "#" begins a comment that ends with the line. */
typedef struct sb_grid_text {
    const char *path, *at;
    size_t line;
} sb_grid_text;

typedef struct sb_grid_header {
    size_t columns, rows;
    double x, y, dx, dy, nodata; /* x, y: of the south-western node; file units */
} sb_grid_header;

/* Advances from->at to the next token and returns its length; 0 at the end of the text. */
size_t sb_grid_token(sb_grid_text *from);

/* Reads the next token as a number, including `nan`. SB_BAD_INPUT gives its line and `what` was expected. */
sb_status sb_grid_number(sb_grid_text *from, const char *what, double *value, sb_error *error);

/* Reads header lines "key value" (ESRI) or "value key" (GeoClaw), up to the first height. */
sb_status sb_grid_read_header(sb_grid_text *from, sb_grid_header *head, sb_error *error);

/* Both read the zero-terminated text of the file `path`. SB_BAD_INPUT "path:line: ...". */
sb_status sb_grid_read_ascii(const char *path, const char *text, sb_grid *grid, sb_error *error);
sb_status sb_grid_read_points(const char *path, const char *text, sb_grid *grid, sb_error *error);

/* SB_BAD_INPUT, with the figures, if the heights, vertices and holes of a grid, and `more` bytes for each node, need
   more memory than is available. */
sb_status sb_grid_room(const char *path, const sb_grid *grid, size_t more, sb_error *error);

/* Reads a text grid in the format of its name's ending. The caller frees grid->heights. */
sb_status sb_grid_read_text(const char *path, sb_grid *grid, sb_error *error);

/* Makes the open surface of a grid. SB_BAD_INPUT for a grid without triangles. */
sb_status sb_grid_mesh(const char *path, const sb_grid *grid, sb_mesh *mesh, sb_error *error);

/* Like strtod, but for decimal numbers only: of 0x10 it reads the 0. */
static inline double sb_decimal(const char *text, char **end)
{
    const char *digits = text + strspn(text, " \t\r\n\v\f");
    digits += *digits == '+' || *digits == '-';
    const double value = strtod(text, end);
    if (digits[0] != '0' || (digits[1] | 0x20) != 'x') return value;
    *end += digits + 1 - *end;
    return 0;
}

/* Largest number of nodes of a grid. It keeps vertex numbers within 32 bits and limits memory. */
enum { SB_GRID_NODES_MAX = 1 << 28 };

#endif
