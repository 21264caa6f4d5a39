/* Reads a GeoTIFF of one band, in the child process: strips or tiles of whole numbers or floating-point numbers, with
   any compression that libtiff has. Sources: OGC 19-008r4 (GeoTIFF 1.1), for tags and keys; the tag 42113 for missing
   heights is GDAL's. */
#include "base/library.h"
#include "base/memory.h"
#include "geometry/grid/raster.h"

#include <geotiff/geotiff.h>
#include <geotiff/geovalues.h>
#include <geotiff/xtiffio.h>
#include <stdarg.h>
#include <stdio.h>

enum { TAG_NODATA = 42113 };

/* Values of keys: undefined, user-defined, and metre as unit. */
enum { KEY_UNDEFINED = 0, KEY_USER = 32767, UNIT_METRE = 9001 };

/* In bytes: largest strip or tile. A damaged file may state any size. */
static const uint64_t BLOCK_MOST = UINT64_C(1) << 30;

/* Looked up in the child, so that the parent never maps the libraries. */
static struct {
    __typeof__(XTIFFInitialize) *initialize;
    __typeof__(TIFFFdOpen) *open;
    __typeof__(TIFFClose) *close;
    __typeof__(TIFFGetField) *get;
    __typeof__(TIFFGetFieldDefaulted) *get_default;
    __typeof__(TIFFIsTiled) *is_tiled;
    __typeof__(TIFFTileSize64) *tile_size;
    __typeof__(TIFFStripSize64) *strip_size;
    __typeof__(TIFFComputeTile) *tile_of;
    __typeof__(TIFFReadEncodedTile) *read_tile;
    __typeof__(TIFFReadEncodedStrip) *read_strip;
    __typeof__(TIFFSetErrorHandler) *on_error;
    __typeof__(TIFFSetWarningHandler) *on_warning;
} tiff;
static struct {
    __typeof__(GTIFNew) *open;
    __typeof__(GTIFFree) *close;
    __typeof__(GTIFKeyGetSHORT) *key;
    __typeof__(GTIFImageToPCS) *place;
} geo;

static char reason[200]; /* the first error that libtiff reports */

__attribute__((format(printf, 2, 0))) static void keep_reason(const char *module, const char *text, va_list values)
{
    (void)module;
    if (reason[0] == '\0') vsnprintf(reason, sizeof reason, text, values);
}

sb_status sb_geotiff_load(sb_error *error)
{
    const sb_library_function of_tiff[] = {
        {"TIFFFdOpen", &tiff.open},
        {"TIFFClose", &tiff.close},
        {"TIFFGetField", &tiff.get},
        {"TIFFGetFieldDefaulted", &tiff.get_default},
        {"TIFFIsTiled", &tiff.is_tiled},
        {"TIFFTileSize64", &tiff.tile_size},
        {"TIFFStripSize64", &tiff.strip_size},
        {"TIFFComputeTile", &tiff.tile_of},
        {"TIFFReadEncodedTile", &tiff.read_tile},
        {"TIFFReadEncodedStrip", &tiff.read_strip},
        {"TIFFSetErrorHandler", &tiff.on_error},
        {"TIFFSetWarningHandler", &tiff.on_warning},
    };
    const sb_library_function of_geo[] = {
        {"XTIFFInitialize", &tiff.initialize}, {"GTIFNew", &geo.open},         {"GTIFFree", &geo.close},
        {"GTIFKeyGetSHORT", &geo.key},         {"GTIFImageToPCS", &geo.place},
    };
    sb_status status = sb_library_load("libtiff.so.6", of_tiff, sizeof of_tiff / sizeof *of_tiff, error);
    if (status == SB_OK) status = sb_library_load("libgeotiff.so.5", of_geo, sizeof of_geo / sizeof *of_geo, error);
    return status;
}

typedef struct image {
    TIFF *file;
    uint32_t width, height; /* pixels */
    uint32_t across, down;  /* pixels of a tile; of a strip: width, rows */
    uint16_t bits, kind;    /* of a sample */
    uint64_t block;         /* bytes of a tile or strip */
    bool tiled, has_nodata;
    double nodata;
} image;

static sb_status read_layout(image *of, sb_error *error)
{
    uint16_t samples = 1;
    tiff.get(of->file, TIFFTAG_IMAGEWIDTH, &of->width);
    tiff.get(of->file, TIFFTAG_IMAGELENGTH, &of->height);
    tiff.get_default(of->file, TIFFTAG_SAMPLESPERPIXEL, &samples);
    tiff.get_default(of->file, TIFFTAG_BITSPERSAMPLE, &of->bits);
    tiff.get_default(of->file, TIFFTAG_SAMPLEFORMAT, &of->kind);
    of->tiled = tiff.is_tiled(of->file);
    of->across = of->width;
    if (of->tiled) {
        tiff.get(of->file, TIFFTAG_TILEWIDTH, &of->across);
        tiff.get(of->file, TIFFTAG_TILELENGTH, &of->down);
    } else {
        tiff.get_default(of->file, TIFFTAG_ROWSPERSTRIP, &of->down);
        if (of->down > of->height) of->down = of->height;
    }
    of->block = of->tiled ? tiff.tile_size(of->file) : tiff.strip_size(of->file);
    if (samples != 1) return sb_fail(error, SB_BAD_INPUT, "%u bands, expected one band of heights", samples);
    const bool real = of->kind == SAMPLEFORMAT_IEEEFP && (of->bits == 32 || of->bits == 64);
    const bool whole = (of->kind == SAMPLEFORMAT_INT || of->kind == SAMPLEFORMAT_UINT) &&
                       (of->bits == 8 || of->bits == 16 || of->bits == 32);
    if (!real && !whole)
        return sb_fail(error, SB_BAD_INPUT,
                       "samples of %u bits and format %u, expected whole numbers of 8, 16 or 32 bits (format 1 or 2), "
                       "or floating-point numbers of 32 or 64 bits (format 3)",
                       of->bits, of->kind);
    if (of->width == 0 || of->height == 0 || of->across == 0 || of->down == 0 || of->block > BLOCK_MOST ||
        of->block < (uint64_t)of->across * of->down * (of->bits / 8))
        return sb_fail(error, SB_BAD_INPUT, "%u x %u pixels in blocks of %u x %u, expected blocks of at most 1 GiB",
                       of->width, of->height, of->across, of->down);
    return SB_OK;
}

static sb_status read_nodata(image *of, sb_error *error)
{
    uint32_t length = 0;
    const char *text = NULL;
    char copy[64], *end;
    if (!tiff.get(of->file, TAG_NODATA, &length, &text) || !text || length == 0) return SB_OK;
    if (length >= sizeof copy) length = sizeof copy - 1;
    memcpy(copy, text, length);
    copy[length] = '\0';
    of->nodata = strtod(copy, &end);
    of->has_nodata = end != copy;
    /* GDAL writes the decimal number of a float, which may be another double. */
    if (of->kind == SAMPLEFORMAT_IEEEFP && of->bits == 32) of->nodata = (double)(float)of->nodata;
    if (!of->has_nodata || *(end + strspn(end, " ")) != '\0')
        return sb_fail(error, SB_BAD_INPUT, "tag 42113 (missing heights) is \"%s\", expected a number", copy);
    return SB_OK;
}

static double sample(const image *of, const unsigned char *at)
{
    int8_t i8;
    int16_t i16;
    uint16_t u16;
    int32_t i32;
    uint32_t u32;
    float f32;
    double f64;
#define AS(type) return memcpy(&type, at, sizeof type), (double)type
    if (of->kind == SAMPLEFORMAT_IEEEFP) {
        if (of->bits == 64) AS(f64);
        AS(f32);
    }
    if (of->kind == SAMPLEFORMAT_INT) {
        if (of->bits == 8) AS(i8);
        if (of->bits == 16) AS(i16);
        AS(i32);
    }
    if (of->bits == 8) return (double)*at;
    if (of->bits == 16) AS(u16);
    AS(u32);
#undef AS
}

/* Copies the pixels of a block that lie in the part. Row 0 of the image is at the top, row 0 of the part below. */
static void copy_block(const image *of, const sb_raster_about *about, const sb_raster_part *part, uint32_t left,
                       uint32_t top, const unsigned char *bytes, double *heights)
{
    const size_t size = of->bits / 8;
    for (uint32_t r = 0; r < of->down && top + r < of->height; ++r) {
        const uint64_t row = about->flip_y ? of->height - 1 - (top + r) : top + r;
        if (row < part->row || row >= part->row + part->rows) continue;
        for (uint32_t c = 0; c < of->across && left + c < of->width; ++c) {
            const uint64_t column = about->flip_x ? of->width - 1 - (left + c) : left + c;
            if (column < part->column || column >= part->column + part->columns) continue;
            const double value = sample(of, bytes + ((size_t)r * of->across + c) * size);
            heights[(row - part->row) * part->columns + (column - part->column)] =
                of->has_nodata && value == of->nodata ? (double)NAN : value;
        }
    }
}

static sb_status read_blocks(const image *of, const sb_raster_about *about, const sb_raster_part *part, double *heights,
                             sb_error *error)
{
    const uint64_t top = about->flip_y ? of->height - part->row - part->rows : part->row;
    const uint64_t left = about->flip_x ? of->width - part->column - part->columns : part->column;
    unsigned char *bytes = sb_alloc((size_t)of->block, 1);
    sb_status status = bytes ? SB_OK : sb_fail(error, SB_BAD_INPUT, "a block of it does not fit into memory");
    for (uint64_t y = top / of->down * of->down; y < top + part->rows && status == SB_OK; y += of->down)
        for (uint64_t x = left / of->across * of->across; x < left + part->columns && status == SB_OK;
             x += of->across) {
            const uint32_t strip = (uint32_t)(y / of->down);
            const tmsize_t got = of->tiled
                                     ? tiff.read_tile(of->file, tiff.tile_of(of->file, (uint32_t)x, (uint32_t)y, 0, 0),
                                                      bytes, (tmsize_t)of->block)
                                     : tiff.read_strip(of->file, strip, bytes, (tmsize_t)of->block);
            if (got < 0)
                status = sb_fail(error, SB_BAD_INPUT,
                                 "pixels at column %u, row %u cannot be read: %s, expected a "
                                 "whole file",
                                 (unsigned)x, (unsigned)y, reason[0] ? reason : "no reason given");
            else
                copy_block(of, about, part, (uint32_t)x, (uint32_t)y, bytes, heights);
        }
    sb_free(bytes);
    return status;
}

static unsigned key_of(GTIF *keys, geokey_t key)
{
    unsigned short value = KEY_UNDEFINED;
    return geo.key(keys, key, &value, 0, 1) == 1 ? value : KEY_UNDEFINED;
}

/* A pixel's height belongs to its centre, unless the file says that it belongs to a point. */
static sb_status read_places(const image *of, GTIF *keys, sb_raster_about *about, sb_error *error)
{
    const double half = key_of(keys, GTRasterTypeGeoKey) == RasterPixelIsPoint ? 0 : 0.5;
    double x[3] = {half, half + (double)(of->width - 1), half}, y[3] = {half, half, half + (double)(of->height - 1)};
    for (int k = 0; k < 3; ++k)
        if (!geo.place(keys, &x[k], &y[k]))
            return sb_fail(error, SB_BAD_INPUT,
                           "it states no position of its pixels, expected the tags ModelPixelScale and ModelTiepoint");
    const double width = x[1] - x[0], height = y[2] - y[0];
    /* A rotated image is not a grid along x and y. */
    if (fabs(y[1] - y[0]) > 1e-6 * fabs(height) || fabs(x[2] - x[0]) > 1e-6 * fabs(width))
        return sb_fail(error, SB_BAD_INPUT, "its rows are rotated, expected rows along x");
    about->columns = of->width;
    about->rows = of->height;
    about->flip_x = width < 0;
    about->flip_y = height < 0;
    about->x = fmin(x[0], x[1]);
    about->y = fmin(y[0], y[2]);
    about->dx = fabs(width) / fmax(1, (double)(of->width - 1));
    about->dy = fabs(height) / fmax(1, (double)(of->height - 1));
    return SB_OK;
}

static sb_status read_system(GTIF *keys, sb_raster_about *about, sb_error *error)
{
    const unsigned model = key_of(keys, GTModelTypeGeoKey), unit = key_of(keys, VerticalUnitsGeoKey);
    const unsigned code = key_of(keys, model == ModelTypeGeographic ? GeographicTypeGeoKey : ProjectedCSTypeGeoKey);
    const unsigned vertical = key_of(keys, VerticalCSTypeGeoKey);
    if (model == ModelTypeGeocentric)
        return sb_fail(error, SB_BAD_INPUT, "its coordinate system is geocentric, expected projected or geographic");
    about->geographic = model == ModelTypeGeographic;
    about->vertical = vertical == KEY_USER ? 0 : vertical;
    if (model == ModelTypeProjected || model == ModelTypeGeographic)
        about->crs = code == KEY_UNDEFINED || code == KEY_USER ? SB_RASTER_CRS_OTHER : SB_RASTER_CRS_EPSG;
    about->epsg = about->crs == SB_RASTER_CRS_EPSG ? code : 0;
    if (unit != KEY_UNDEFINED && unit != UNIT_METRE && unit != KEY_USER)
        return sb_fail(error, SB_BAD_INPUT, "its heights have the unit EPSG:%u, expected metres (EPSG:9001)", unit);
    return SB_OK;
}

sb_status sb_geotiff_take(const sb_raster_file *file, const sb_raster_part *part, sb_raster_about *about,
                          double *heights, sb_error *error)
{
    GTIF *keys = NULL;
    tiff.on_error(keep_reason);
    tiff.on_warning(NULL);
    tiff.initialize();
    image of = {.file = tiff.open(file->descriptor, "the file", "rm")};
    sb_status status = SB_OK;
    if (!of.file)
        return sb_fail(error, SB_BAD_INPUT, "not readable as GeoTIFF: %s; expected a whole file",
                       reason[0] ? reason : "no reason given");
    status = read_layout(&of, error);
    if (status == SB_OK) status = read_nodata(&of, error);
    if (status == SB_OK && !(keys = geo.open(of.file)))
        status = sb_fail(error, SB_BAD_INPUT, "its GeoTIFF keys are damaged, expected a GeoTIFF");
    if (status == SB_OK) status = read_places(&of, keys, about, error);
    if (status == SB_OK) status = read_system(keys, about, error);
    if (status == SB_OK && heights && (part->column + part->columns > of.width || part->row + part->rows > of.height))
        status = sb_fail(error, SB_BAD_INPUT, "it changed while it was read");
    if (status == SB_OK && heights) {
        for (size_t i = 0; i < part->columns * part->rows; ++i) heights[i] = (double)NAN;
        status = read_blocks(&of, about, part, heights, error);
    }
    return status; /* the process ends: the file is not closed */
}
