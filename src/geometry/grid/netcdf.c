/* Reads a NetCDF grid, in the child process: one variable z(y, x) with coordinate variables, as GEBCO, ETOPO and GMT
   write it. Source: CF conventions 1.10 (coordinates, packed data, missing data, grid mappings). */
#include "base/library.h"
#include "base/memory.h"
#include "geometry/grid/raster.h"

#include <netcdf.h>
#include <netcdf_mem.h>
#include <stdio.h>
#include <strings.h>

/* A coordinate may differ from a regular grid by this part of the step, because files store it as float. */
static const double off_line = 0.05;

static struct {
    __typeof__(nc_initialize) *initialize;
    __typeof__(nc_open_mem) *open;
    __typeof__(nc_strerror) *reason;
    __typeof__(nc_inq_nvars) *count;
    __typeof__(nc_inq_var) *variable;
    __typeof__(nc_inq_varid) *find;
    __typeof__(nc_inq_dim) *dimension;
    __typeof__(nc_inq_att) *attribute;
    __typeof__(nc_get_att_text) *text;
    __typeof__(nc_get_att_double) *number;
    __typeof__(nc_get_vara_double) *values;
} nc;

sb_status sb_netcdf_load(sb_error *error)
{
    const sb_library_function functions[] = {
        {"nc_initialize", &nc.initialize}, {"nc_open_mem", &nc.open},          {"nc_strerror", &nc.reason},
        {"nc_inq_nvars", &nc.count},       {"nc_inq_var", &nc.variable},       {"nc_inq_varid", &nc.find},
        {"nc_inq_dim", &nc.dimension},     {"nc_inq_att", &nc.attribute},      {"nc_get_att_text", &nc.text},
        {"nc_get_att_double", &nc.number}, {"nc_get_vara_double", &nc.values},
    };
    sb_status status = sb_library_load("libnetcdf.so.19", functions, sizeof functions / sizeof *functions, error);
    /* It looks for settings and filters, which the fence would refuse. */
    if (status == SB_OK && nc.initialize() != NC_NOERR) return sb_fail(error, SB_FAILED, "NetCDF does not start");
    return status;
}

typedef struct variable {
    int file, id;
    nc_type type;
    char name[NC_MAX_NAME + 1];
    int lines[2]; /* variables of the coordinates y, x */
    size_t size[2];
} variable;

/* Reads a text attribute, cut to the size. Returns false if there is none. */
static bool read_text(int file, int id, const char *name, char *text, size_t size)
{
    nc_type type;
    size_t length;
    text[0] = '\0';
    if (nc.attribute(file, id, name, &type, &length) != NC_NOERR || type != NC_CHAR || length > 65536) return false;
    char *whole = sb_alloc(length + 1, 1);
    if (!whole) return false;
    const bool read = nc.text(file, id, name, whole) == NC_NOERR;
    if (read) snprintf(text, size, "%s", whole);
    sb_free(whole);
    return read;
}

/* Reads a number attribute of one value; otherwise leaves *value. */
static bool read_number(int file, int id, const char *name, double *value)
{
    nc_type type;
    size_t length;
    return nc.attribute(file, id, name, &type, &length) == NC_NOERR && length == 1 && type != NC_CHAR &&
           type <= NC_UINT64 && nc.number(file, id, name, value) == NC_NOERR;
}

static bool is_any(const char *text, const char *const *words)
{
    for (; *words; ++words)
        if (strcasecmp(text, *words) == 0) return true;
    return false;
}

/* Whether the variable is a grid z(y, x) of numbers; then fills its lines and sizes. */
static bool is_grid(int file, int id, variable *found)
{
    int dims, dim[NC_MAX_VAR_DIMS], attributes;
    nc_type type;
    *found = (variable){.file = file, .id = id};
    if (nc.variable(file, id, found->name, &type, &dims, dim, &attributes) != NC_NOERR) return false;
    found->type = type;
    if (dims != 2 || type == NC_CHAR || type > NC_UINT64) return false;
    for (int k = 0; k < 2; ++k) {
        char name[NC_MAX_NAME + 1];
        int own, own_dims, own_dim[NC_MAX_VAR_DIMS];
        if (nc.dimension(file, dim[k], name, &found->size[k]) != NC_NOERR) return false;
        if (nc.find(file, name, &found->lines[k]) != NC_NOERR) return false;
        if (nc.variable(file, found->lines[k], name, &type, &own_dims, own_dim, &own) != NC_NOERR) return false;
        if (own_dims != 1 || own_dim[0] != dim[k] || type == NC_CHAR || type > NC_UINT64) return false;
    }
    return true;
}

static sb_status find_grid(int file, variable *found, sb_error *error)
{
    static const char *const usual[] = {"elevation", "z",     "Band1",    "topo",  "bathymetry",
                                        "height",    "bathy", "altitude", "depth", NULL};
    int count = 0, grids = 0, named = 0;
    variable each;
    nc.count(file, &count);
    for (int id = 0; id < count; ++id) {
        if (!is_grid(file, id, &each)) continue;
        const bool known = is_any(each.name, usual);
        if (grids == 0 || (known && named == 0)) *found = each;
        ++grids;
        named += known;
    }
    if (grids == 1 || named == 1) return SB_OK;
    if (grids == 0)
        return sb_fail(error, SB_BAD_INPUT,
                       "none of its %d variables is a grid, expected z(y, x) or elevation(lat, lon) with the "
                       "coordinates as variables named as the dimensions",
                       count);
    return sb_fail(error, SB_BAD_INPUT, "%d of its variables are grids, expected one, or one named elevation or z",
                   grids);
}

/* A file that ends too early gives codes of the system, such as EPERM, whose texts mislead. */
static const char *reason_of(int failed)
{
    return failed > 0 ? "reading failed, expected a whole file" : nc.reason(failed);
}

/* The library reads on behind a header without variables, so that one with nothing behind it seems to end early. */
static const char *open_reason(int failed)
{
    return failed > 0 ? "its header has no variable of heights, or ends too early" : nc.reason(failed);
}

/* Reads the coordinates along one axis, which must be regular. */
static sb_status read_line(const variable *of, int k, double *low, double *step, uint32_t *flip, sb_error *error)
{
    const size_t count = of->size[k], first = 0;
    if (count < 2 || count > (1u << 24))
        return sb_fail(error, SB_BAD_INPUT, "%zu coordinates %c, expected 2 to 2^24", count, "yx"[k]);
    double *at = sb_alloc(count, sizeof *at);
    if (!at) return sb_fail_memory(error, "coordinates");
    const int failed = nc.values(of->file, of->lines[k], &first, &count, at);
    sb_status status = SB_OK;
    if (failed != NC_NOERR)
        status = sb_fail(error, SB_BAD_INPUT, "its coordinates %c cannot be read: %s", "yx"[k], reason_of(failed));
    const double range = at[count - 1] - at[0], each = range / (double)(count - 1);
    for (size_t i = 0; i < count && status == SB_OK; ++i)
        if (!(fabs(at[i] - at[0] - (double)i * each) <= off_line * fabs(each)) || each == 0)
            status = sb_fail(error, SB_BAD_INPUT, "coordinate %c number %zu is %.12g, expected %.12g of a regular grid",
                             "yx"[k], i, at[i], at[0] + (double)i * each);
    *low = fmin(at[0], at[count - 1]);
    *step = fabs(each);
    *flip = each < 0;
    sb_free(at);
    return status;
}

/* Returns the last EPSG code of a WKT text, which is that of the whole system; 0: none. */
static uint32_t code_of(const char *wkt)
{
    unsigned long code = 0;
    for (const char *at = wkt; (at = strstr(at, "\"EPSG\",")) != NULL; ++at)
        code = strtoul(at + 7 + (at[7] == '"'), NULL, 10);
    return code < 100000 ? (uint32_t)code : 0;
}

static void read_mapping(const variable *of, sb_raster_about *about)
{
    static const char *const names[] = {"crs_wkt", "spatial_ref", "epsg_code", NULL};
    char mapping[NC_MAX_NAME + 1];
    int id;
    if (!read_text(of->file, of->id, "grid_mapping", mapping, sizeof mapping)) return;
    if (nc.find(of->file, mapping, &id) != NC_NOERR) return;
    char *text = sb_alloc(65536, 1);
    double code = 0;
    for (int k = 0; text && names[k] && about->epsg == 0; ++k)
        if (read_text(of->file, id, names[k], text, 65536))
            about->epsg =
                k < 2 ? code_of(text) : (uint32_t)strtoul(strncasecmp(text, "EPSG:", 5) ? text : text + 5, NULL, 10);
    if (about->epsg == 0 && read_number(of->file, id, "epsg_code", &code) && code > 0 && code < 1e5)
        about->epsg = (uint32_t)code;
    sb_free(text);
    if (about->epsg > 0)
        about->crs = SB_RASTER_CRS_EPSG;
    else if (!about->geographic)
        about->crs = SB_RASTER_CRS_OTHER;
}

/* Which of the coordinates is x follows from their names, units or standard names. */
static sb_status read_axes(const variable *of, sb_raster_about *about, sb_error *error)
{
    static const char *const east[] = {"degrees_east", "degree_east", "degrees_E", "degree_E", NULL};
    static const char *const eastern[] = {"x", "lon", "longitude", "easting", NULL};
    static const char *const metres[] = {"m", "metre", "meter", "metres", "meters", "", NULL};
    char name[2][NC_MAX_NAME + 1], units[2][64];
    for (int k = 0; k < 2; ++k) {
        int dims, dim[NC_MAX_VAR_DIMS], attributes;
        nc_type type;
        nc.variable(of->file, of->lines[k], name[k], &type, &dims, dim, &attributes);
        read_text(of->file, of->lines[k], "units", units[k], sizeof units[k]);
    }
    if (is_any(name[0], eastern) || is_any(units[0], east))
        return sb_fail(error, SB_BAD_INPUT, "%.100s has the dimensions (%.100s, %.100s), expected y or lat first",
                       of->name, name[0], name[1]);
    const bool named = strncasecmp(name[1], "lon", 3) == 0 && strncasecmp(name[0], "lat", 3) == 0;
    about->geographic = is_any(units[1], east) || (units[1][0] == '\0' && named);
    if (about->geographic) return SB_OK;
    for (int k = 0; k < 2; ++k)
        if (!is_any(units[k], metres))
            return sb_fail(error, SB_BAD_INPUT, "coordinate %.100s has the units \"%.60s\", expected m or degrees_east",
                           name[k], units[k]);
    return SB_OK;
}

static sb_status read_about(const variable *of, sb_raster_about *about, sb_error *error)
{
    static const char *const metres[] = {"m", "metre", "meter", "metres", "meters", "1", "", NULL};
    char text[SB_NAME_MAX];
    about->columns = of->size[1];
    about->rows = of->size[0];
    sb_status status = read_line(of, 1, &about->x, &about->dx, &about->flip_x, error);
    if (status == SB_OK) status = read_line(of, 0, &about->y, &about->dy, &about->flip_y, error);
    if (status == SB_OK) status = read_axes(of, about, error);
    if (status != SB_OK) return status;
    read_mapping(of, about);
    if (about->geographic && about->crs == SB_RASTER_CRS_NONE) {
        /* CF: longitude and latitude without a grid mapping are on no stated figure of the Earth. */
        about->crs = SB_RASTER_CRS_EPSG;
        about->epsg = 4326;
    }
    read_text(of->file, of->id, "units", text, sizeof text);
    if (!is_any(text, metres))
        return sb_fail(error, SB_BAD_INPUT, "%.100s has the units \"%s\", expected m", of->name, text);
    about->down = read_text(of->file, of->id, "positive", text, sizeof text) && strcasecmp(text, "down") == 0;
    if (!read_text(of->file, of->id, "standard_name", about->note, sizeof about->note))
        read_text(of->file, of->id, "long_name", about->note, sizeof about->note);
    return SB_OK;
}

/* What the library writes where a program wrote nothing. */
static double default_fill(nc_type type)
{
    return type == NC_SHORT ? NC_FILL_SHORT : type == NC_INT ? NC_FILL_INT : (double)NC_FILL_FLOAT;
}

/* The order and the direction of rows and columns are those of the file. */
static sb_status read_heights(const variable *of, const sb_raster_about *about, const sb_raster_part *part,
                              double *heights, sb_error *error)
{
    double factor = 1, offset = 0, missing[2] = {default_fill(of->type), (double)NAN};
    read_number(of->file, of->id, "scale_factor", &factor);
    read_number(of->file, of->id, "add_offset", &offset);
    read_number(of->file, of->id, "_FillValue", &missing[0]);
    read_number(of->file, of->id, "missing_value", &missing[1]);
    const size_t columns = (size_t)part->columns, rows = (size_t)part->rows;
    const size_t left = (size_t)(about->flip_x ? of->size[1] - part->column - columns : part->column);
    const size_t top = (size_t)(about->flip_y ? of->size[0] - part->row - rows : part->row);
    const size_t first[2] = {top, left}, count[2] = {rows, columns};
    const int failed = nc.values(of->file, of->id, first, count, heights);
    if (failed != NC_NOERR)
        return sb_fail(error, SB_BAD_INPUT, "%.100s cannot be read at row %zu, column %zu: %s", of->name, top, left,
                       reason_of(failed));
    for (size_t i = 0; i < rows * columns; ++i)
        heights[i] = heights[i] == missing[0] || heights[i] == missing[1] ? (double)NAN : heights[i] * factor + offset;
    for (size_t j = 0; about->flip_y && j < rows / 2; ++j)
        for (size_t i = 0; i < columns; ++i) {
            double *low = heights + j * columns + i, *high = heights + (rows - 1 - j) * columns + i, kept = *low;
            *low = *high;
            *high = kept;
        }
    for (size_t j = 0; about->flip_x && j < rows; ++j)
        for (size_t i = 0; i < columns / 2; ++i) {
            double *west = heights + j * columns + i, *east = heights + (j + 1) * columns - 1 - i, kept = *west;
            *west = *east;
            *east = kept;
        }
    return SB_OK;
}

sb_status sb_netcdf_take(const sb_raster_file *file, const sb_raster_part *part, sb_raster_about *about,
                         double *heights, sb_error *error)
{
    int id = 0;
    variable of = {0};
    const int failed = nc.open(file->path, NC_NOWRITE, file->size, file->bytes, &id);
    if (failed != NC_NOERR)
        return sb_fail(error, SB_BAD_INPUT, "not readable as NetCDF: %s; expected a whole file", open_reason(failed));
    sb_status status = find_grid(id, &of, error);
    if (status == SB_OK) status = read_about(&of, about, error);
    if (status == SB_OK && heights &&
        (part->column + part->columns > of.size[1] || part->row + part->rows > of.size[0]))
        status = sb_fail(error, SB_BAD_INPUT, "it changed while it was read");
    if (status == SB_OK && heights) status = read_heights(&of, about, part, heights, error);
    return status; /* the process ends: the file is not closed */
}
