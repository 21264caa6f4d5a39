/* Reads GeoTIFF and NetCDF grids in a child process, and checks all that the child sends. */
#include "geometry/grid/raster.h"

#include "base/file.h"
#include "base/input.h"
#include "base/memory.h"
#include "geometry/mesh/child.h"
#include "geometry/mesh/fence.h"

#include <errno.h>
#include <stdio.h>
#include <strings.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MAGIC = 0x53424731, REASON_MAX = 400 };

/* A NetCDF file is mapped as a whole, and lies within the child's limit of memory. */
static const uint64_t SIZE_MOST = UINT64_C(64) << 30, MEMORY = UINT64_C(4) << 30;

/* What the child sends first. Heights follow if they were wanted and there is no reason. */
typedef struct reply {
    uint32_t magic, failed;
    sb_raster_about about;
    char reason[REASON_MAX];
} reply;

typedef struct format {
    const char *ending;
    sb_raster_load *load;
    sb_raster_take *take;
    bool map;
} format;

static const format formats[] = {
    {".tif", sb_geotiff_load, sb_geotiff_take, false}, {".tiff", sb_geotiff_load, sb_geotiff_take, false},
    {".nc", sb_netcdf_load, sb_netcdf_take, true},     {".nc4", sb_netcdf_load, sb_netcdf_take, true},
    {".grd", sb_netcdf_load, sb_netcdf_take, true},
};

static const format *format_of(const char *path)
{
    const char *dot = strrchr(path, '.');
    for (size_t i = 0; dot && i < sizeof formats / sizeof *formats; ++i)
        if (strcasecmp(dot, formats[i].ending) == 0) return &formats[i];
    return NULL;
}

bool sb_raster_is(const char *path)
{
    return format_of(path) != NULL;
}

/* ------------------------------------------------------------------ the child */

static sb_status open_content(const char *path, int descriptor, const format *as, sb_raster_file *file, sb_error *error)
{
    struct stat found;
    if (fstat(descriptor, &found) != 0) return sb_fail(error, SB_BAD_INPUT, "cannot be read: %s", strerror(errno));
    *file = (sb_raster_file){.path = path, .descriptor = descriptor, .size = (size_t)found.st_size};
    if (!as->map) return SB_OK;
    /* NetCDF may write to the memory that it is given: a private mapping leaves the file as it is. */
    file->bytes = mmap(NULL, file->size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_NORESERVE, descriptor, 0);
    if (file->bytes == MAP_FAILED) return sb_fail(error, SB_BAD_INPUT, "cannot be mapped: %s", strerror(errno));
    return SB_OK;
}

static void send_grid(const char *path, int descriptor, int pipe, const void *wanted)
{
    const sb_raster_part *part = wanted;
    const format *as = format_of(path);
    const size_t nodes = (size_t)(part->columns * part->rows);
    char folder[SB_PATH_MAX];
    sb_error error = {0};
    sb_raster_file file = {0};
    double *heights = NULL;
    reply answer = {.magic = MAGIC};
    sb_status status = as->load(&error);
    if (status == SB_OK) status = open_content(path, descriptor, as, &file, &error);
    sb_path_folder(folder, path);
    sb_mesh_fence(folder);
    if (status == SB_OK && nodes > 0 && !(heights = sb_alloc_untouched(nodes, sizeof *heights)))
        status = sb_fail(&error, SB_BAD_INPUT, "its heights do not fit into memory");
    if (status == SB_OK) status = as->take(&file, part, &answer.about, heights, &error);
    answer.failed = status != SB_OK;
    if (answer.failed) snprintf(answer.reason, sizeof answer.reason, "%.*s", REASON_MAX - 1, error.text);
    if (sb_mesh_link_send(pipe, &answer, sizeof answer) && heights && !answer.failed)
        sb_mesh_link_send(pipe, heights, nodes * sizeof *heights);
}

/* ----------------------------------------------------------------- the parent */

typedef struct received {
    sb_raster_about about;
    double *heights;
} received;

static sb_status check_about(const char *path, sb_raster_about *of, sb_error *error)
{
    of->note[sizeof of->note - 1] = '\0';
    sb_mesh_link_clean(of->note);
    if (of->columns < 2 || of->rows < 2 || of->columns > UINT32_MAX || of->rows > UINT32_MAX)
        return sb_fail(error, SB_BAD_INPUT, "%.500s: %llu x %llu heights, expected 2 x 2 or more", path,
                       (unsigned long long)of->columns, (unsigned long long)of->rows);
    const double ends[] = {of->x, of->y, of->x + of->dx * (double)of->columns, of->y + of->dy * (double)of->rows};
    for (size_t i = 0; i < 4; ++i)
        if (!isfinite(ends[i]) || !(of->dx > 0) || !(of->dy > 0))
            return sb_fail(error, SB_BAD_INPUT, "%.500s: nodes from (%g, %g) in steps of %g and %g, expected numbers",
                           path, of->x, of->y, of->dx, of->dy);
    if (of->geographic && (of->y < -90 - of->dy || ends[3] > 90 + 2 * of->dy || of->x < -540 || ends[2] > 540))
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s: x from %g to %g, y from %g to %g: expected degrees, as its coordinate system states",
                       path, of->x, ends[2], of->y, ends[3]);
    return SB_OK;
}

static sb_status receive_grid(sb_mesh_link *from, const void *wanted, void *into, sb_error *error)
{
    const sb_raster_part *part = wanted;
    received *to = into;
    const size_t nodes = (size_t)(part->columns * part->rows);
    reply answer;
    if (!sb_mesh_link_receive(from, &answer, sizeof answer)) return SB_FAILED;
    if (answer.magic != MAGIC)
        return sb_fail(error, SB_BAD_INPUT, "%.500s: the process that reads it sent invalid data, expected a grid",
                       from->path);
    answer.reason[REASON_MAX - 1] = '\0';
    sb_mesh_link_clean(answer.reason);
    if (answer.failed)
        return sb_fail(error, SB_BAD_INPUT, "%.500s: %s", from->path,
                       answer.reason[0] ? answer.reason : "not readable as a grid: no reason given");
    to->about = answer.about;
    sb_status status = check_about(from->path, &to->about, error);
    if (status != SB_OK || nodes == 0) return status;
    to->heights = sb_alloc_untouched(nodes, sizeof *to->heights);
    if (!to->heights) return sb_fail_memory(error, "a terrain grid");
    const bool all = sb_mesh_link_receive(from, to->heights, nodes * sizeof *to->heights);
    for (size_t i = 0; i < nodes && all; ++i)
        if (!isfinite(to->heights[i])) to->heights[i] = (double)NAN;
    if (all) return SB_OK;
    sb_free(to->heights);
    to->heights = NULL;
    return SB_FAILED;
}

static sb_status read_part(const char *path, const sb_raster_part *part, received *to, sb_error *error)
{
    struct stat found;
    int file;
    sb_status status = sb_input_descriptor(path, &file, error);
    if (status != SB_OK) return status;
    const uint64_t size = fstat(file, &found) == 0 ? (uint64_t)found.st_size : 0;
    const uint64_t heights = part->columns * part->rows * sizeof(double);
    const unsigned seconds = (unsigned)(20 + ((size < SIZE_MOST ? size : SIZE_MOST) >> 24) + (heights >> 24));
    const sb_mesh_limits limits = {.memory = MEMORY + size + heights, .seconds = seconds};
    const sb_mesh_task task = {"grid", send_grid, receive_grid, part, to};
    if (size == 0)
        status = sb_fail(error, SB_BAD_INPUT, "%.500s: is empty, expected a grid", path);
    else if (size > SIZE_MOST)
        status = sb_fail(error, SB_BAD_INPUT, "%.500s: %llu bytes, expected at most %llu", path,
                         (unsigned long long)size, (unsigned long long)SIZE_MOST);
    else
        status = sb_mesh_child_run(path, file, &limits, &task, error);
    close(file);
    return status;
}

sb_status sb_raster_about_file(const char *path, sb_raster_about *about, sb_error *error)
{
    const sb_raster_part none = {0};
    received got = {0};
    sb_status status = read_part(path, &none, &got, error);
    if (status == SB_OK) *about = got.about;
    return status;
}

sb_status sb_raster_read(const char *path, const sb_raster_part *part, sb_grid *grid, sb_error *error)
{
    received got = {0};
    if (part->columns == 0 || part->rows == 0 || part->columns > SB_GRID_NODES_MAX / part->rows)
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s: %llu x %llu heights within the window, expected at most %d: a smaller window", path,
                       (unsigned long long)part->columns, (unsigned long long)part->rows, SB_GRID_NODES_MAX);
    const sb_grid size = {.columns = (size_t)part->columns, .rows = (size_t)part->rows};
    /* The child has the heights, too. */
    sb_status status = sb_grid_room(path, &size, sizeof(double) + 6 * sizeof(uint32_t), error);
    if (status == SB_OK) status = read_part(path, part, &got, error);
    if (status != SB_OK) return status;
    const sb_raster_about *of = &got.about;
    *grid = (sb_grid){.columns = (size_t)part->columns,
                      .rows = (size_t)part->rows,
                      .x = of->x + of->dx * (double)part->column,
                      .y = of->y + of->dy * (double)part->row,
                      .dx = of->dx,
                      .dy = of->dy,
                      .heights = got.heights};
    return SB_OK;
}
