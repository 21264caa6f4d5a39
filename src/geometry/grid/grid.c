/* Reads text grids by the format of their names, and makes open surface meshes of grids. */
#include "geometry/grid/grid.h"

#include "base/file.h"
#include "base/memory.h"

#include <string.h>
#include <strings.h>

static const size_t file_limit = (size_t)4 << 30;

/* Cuts the square whose lower left node is `node` into at most two triangles, counter-clockwise seen from above. The
   cut runs along the diagonal with the smaller difference in height, which keeps ridges and valleys. With one hole
   among its corners the square gives one triangle. */
static size_t cut_square(const sb_grid *grid, size_t node, size_t triangles[2][3])
{
    const size_t corner[4] = {node, node + 1, node + 1 + grid->columns, node + grid->columns};
    double z[4];
    size_t holes = 0, hole = 0;
    for (size_t k = 0; k < 4; ++k) {
        z[k] = grid->heights[corner[k]];
        if (isnan(z[k])) {
            ++holes;
            hole = k;
        }
    }
    if (holes > 1) return 0;
    /* The cut runs from corner `from` to the opposite corner. A hole must not lie on it. */
    size_t from = holes ? (hole + 1) % 4 : fabs(z[0] - z[2]) <= fabs(z[1] - z[3]) ? 0 : 1;
    for (size_t k = 0; k < 3; ++k) {
        triangles[0][k] = corner[(from + k) % 4];
        triangles[1][k] = corner[(from + 2 + k) % 4];
    }
    return holes ? 1 : 2;
}

static size_t count_triangles(const sb_grid *grid)
{
    size_t count = 0, triangles[2][3];
    for (size_t j = 0; j + 1 < grid->rows; ++j)
        for (size_t i = 0; i + 1 < grid->columns; ++i) count += cut_square(grid, j * grid->columns + i, triangles);
    return count;
}

/* Fills the mesh. Each node that a triangle uses becomes a vertex, in the order of the nodes. */
static void fill_mesh(const sb_grid *grid, uint32_t *vertex_of, sb_mesh *mesh)
{
    size_t triangle = 0, triangles[2][3];
    for (size_t j = 0; j + 1 < grid->rows; ++j)
        for (size_t i = 0; i + 1 < grid->columns; ++i) {
            size_t count = cut_square(grid, j * grid->columns + i, triangles);
            for (size_t t = 0; t < count; ++t, ++triangle)
                for (int k = 0; k < 3; ++k) {
                    mesh->triangles[triangle][k] = (uint32_t)triangles[t][k];
                    vertex_of[triangles[t][k]] = 1;
                }
        }
    uint32_t vertices = 0;
    for (size_t j = 0, node = 0; j < grid->rows; ++j)
        for (size_t i = 0; i < grid->columns; ++i, ++node) {
            if (!vertex_of[node]) continue;
            mesh->vertices[vertices] =
                sb_vec(grid->x + (double)i * grid->dx, grid->y + (double)j * grid->dy, grid->heights[node]);
            vertex_of[node] = vertices++;
        }
    for (size_t i = 0; i < mesh->triangle_count; ++i)
        for (int k = 0; k < 3; ++k) mesh->triangles[i][k] = vertex_of[mesh->triangles[i][k]];
    mesh->vertex_count = mesh->node_count = vertices;
}

/* Lists the nodes without a height. */
static sb_status list_holes(const sb_grid *grid, sb_mesh *mesh, sb_error *error)
{
    size_t count = 0;
    for (size_t node = 0; node < grid->rows * grid->columns; ++node) count += isnan(grid->heights[node]) != 0;
    if (count == 0) return SB_OK;
    mesh->holes = sb_alloc_untouched(count, sizeof *mesh->holes);
    if (!mesh->holes) return sb_fail_memory(error, "a terrain grid");
    for (size_t j = 0, node = 0; j < grid->rows; ++j)
        for (size_t i = 0; i < grid->columns; ++i, ++node)
            if (isnan(grid->heights[node]))
                mesh->holes[mesh->hole_count++] =
                    sb_vec(grid->x + (double)i * grid->dx, grid->y + (double)j * grid->dy, 0);
    return SB_OK;
}

/* Adding steps to numbers near DBL_MAX may give infinity. */
static sb_status check_range(const char *path, const sb_mesh *mesh, sb_error *error)
{
    for (size_t i = 0; i < mesh->vertex_count; ++i)
        if (!sb_isfinite(mesh->vertices[i]))
            return sb_fail(error, SB_BAD_INPUT, "%.500s: a node at (%g, %g, %g), expected finite numbers", path,
                           mesh->vertices[i].x, mesh->vertices[i].y, mesh->vertices[i].z);
    return SB_OK;
}

sb_status sb_grid_mesh(const char *path, const sb_grid *grid, sb_mesh *mesh, sb_error *error)
{
    size_t triangles = count_triangles(grid);
    if (triangles == 0)
        return sb_fail(error, SB_BAD_INPUT, "%.500s: the file has no three neighbouring heights, expected terrain",
                       path);
    uint32_t *vertex_of = sb_alloc(grid->rows * grid->columns, sizeof *vertex_of);
    if (!vertex_of) return sb_fail_memory(error, "a terrain grid");
    sb_mesh made;
    sb_status status = sb_mesh_alloc(&made, grid->rows * grid->columns, triangles, error);
    if (status == SB_OK) {
        fill_mesh(grid, vertex_of, &made);
        status = check_range(path, &made, error);
        if (status == SB_OK) status = list_holes(grid, &made, error);
        if (status == SB_OK)
            *mesh = made;
        else
            sb_mesh_free(&made);
    }
    sb_free(vertex_of);
    return status;
}

typedef sb_status read_grid(const char *path, const char *text, sb_grid *grid, sb_error *error);

/* Chooses the reader by the file name's extension. The extensions with tt and topotype are GeoClaw's. */
static read_grid *reader_of(const char *path)
{
    static const struct {
        const char *ending;
        read_grid *read;
    } known[] = {
        {".asc", sb_grid_read_ascii},       {".tt2", sb_grid_read_ascii},        {".tt3", sb_grid_read_ascii},
        {".topotype2", sb_grid_read_ascii}, {".topotype3", sb_grid_read_ascii},  {".xyz", sb_grid_read_points},
        {".tt1", sb_grid_read_points},      {".topotype1", sb_grid_read_points},
    };
    const char *dot = strrchr(path, '.');
    for (size_t i = 0; dot && i < sizeof known / sizeof *known; ++i)
        if (strcasecmp(dot, known[i].ending) == 0) return known[i].read;
    return NULL;
}

sb_status sb_grid_room(const char *path, const sb_grid *grid, size_t more, sb_error *error)
{
    const double node = (double)(sizeof(double) + sizeof(uint32_t) + sizeof(sb_vec3) + more);
    const double needed = node * (double)grid->columns * (double)grid->rows, there = (double)sb_memory_available();
    if (!(there > 0) || needed < (1 - SB_MEMORY_SPARE) * there) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT,
                   "%.500s: %zu x %zu grid lines take %.3g GB of memory, and %.3g GB are available, of which a fifth "
                   "is left free; expected fewer",
                   path, grid->columns, grid->rows, needed / 1e9, there / 1e9);
}

sb_status sb_grid_read_text(const char *path, sb_grid *grid, sb_error *error)
{
    read_grid *const read = reader_of(path);
    if (!read)
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s: unknown grid format, expected .asc, .tt2 or .tt3 (rows), .xyz or .tt1 (points), .tif "
                       "(GeoTIFF), .nc or .grd (NetCDF)",
                       path);
    char *text = NULL;
    size_t length = 0;
    sb_status status = sb_text_read(path, file_limit, &text, &length, error);
    if (status != SB_OK) return status;
    if (strlen(text) != length)
        status = sb_fail(error, SB_BAD_INPUT, "%.500s: byte %zu is zero, expected text", path, strlen(text));
    else
        status = read(path, text, grid, error);
    sb_free(text);
    return status;
}
