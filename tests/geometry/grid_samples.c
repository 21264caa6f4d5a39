#include "grid_samples.h"

#include <geotiff/geotiff.h>
#include <geotiff/geovalues.h>
#include <geotiff/xtiffio.h>
#include <math.h>
#include <netcdf.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void need(bool done, const char *what)
{
    if (done) return;
    fprintf(stderr, "grid sample: %s failed\n", what);
    abort();
}

static double height_at(const grid_sample *of, size_t i, size_t j)
{
    const double z = of->height(of->x + (double)i * of->dx, of->y + (double)j * of->dy);
    return isnan(z) ? of->nodata : z;
}

static void put(const grid_sample *of, double z, unsigned char *at)
{
    const float real = (float)z;
    const int16_t whole = (int16_t)lround(z);
    if (of->whole)
        memcpy(at, &whole, sizeof whole);
    else
        memcpy(at, &real, sizeof real);
}

static void write_pixels(const grid_sample *of, TIFF *file)
{
    const size_t size = of->whole ? 2 : 4, side = of->tile;
    unsigned char *row = calloc(of->columns * (of->bands ? of->bands : 1) + side * side, size);
    need(row, "memory");
    for (size_t r = 0; r < of->rows && !side; ++r) {
        for (size_t i = 0; i < of->columns; ++i) put(of, height_at(of, i, of->rows - 1 - r), row + i * size);
        need(TIFFWriteScanline(file, row, (uint32_t)r, 0) >= 0, "TIFFWriteScanline");
    }
    for (size_t top = 0; side && top < of->rows; top += side)
        for (size_t left = 0; left < of->columns; left += side) {
            memset(row, 0, side * side * size);
            for (size_t r = top; r < top + side && r < of->rows; ++r)
                for (size_t i = left; i < left + side && i < of->columns; ++i)
                    put(of, height_at(of, i, of->rows - 1 - r), row + ((r - top) * side + i - left) * size);
            need(TIFFWriteTile(file, row, (uint32_t)left, (uint32_t)top, 0, 0) >= 0, "TIFFWriteTile");
        }
    free(row);
}

static void write_keys(const grid_sample *of, TIFF *file)
{
    GTIF *keys = GTIFNew(file);
    need(keys, "GTIFNew");
    if (of->epsg || of->geographic) {
        GTIFKeySet(keys, GTModelTypeGeoKey, TYPE_SHORT, 1, of->geographic ? ModelTypeGeographic : ModelTypeProjected);
        if (of->epsg)
            GTIFKeySet(keys, of->geographic ? GeographicTypeGeoKey : ProjectedCSTypeGeoKey, TYPE_SHORT, 1, of->epsg);
    }
    GTIFKeySet(keys, GTRasterTypeGeoKey, TYPE_SHORT, 1, of->point ? RasterPixelIsPoint : RasterPixelIsArea);
    if (of->vertical) GTIFKeySet(keys, VerticalCSTypeGeoKey, TYPE_SHORT, 1, of->vertical);
    if (of->vertical_unit) GTIFKeySet(keys, VerticalUnitsGeoKey, TYPE_SHORT, 1, of->vertical_unit);
    GTIFWriteKeys(keys);
    GTIFFree(keys);
}

void grid_sample_tiff(const grid_sample *of, const char *path)
{
    static const TIFFFieldInfo nodata[] = {
        {42113, TIFF_VARIABLE, TIFF_VARIABLE, TIFF_ASCII, FIELD_CUSTOM, 1, 0, (char *)(uintptr_t) "GDAL_NODATA"}};
    const double half = of->point ? 0 : 0.5, top = of->y + ((double)of->rows - 1 + half) * of->dy;
    const double scale[3] = {of->dx, of->dy, 0}, tie[6] = {0, 0, 0, of->x - half * of->dx, top, 0};
    TIFF *file = XTIFFOpen(path, "w");
    char text[32];
    need(file, "XTIFFOpen");
    TIFFMergeFieldInfo(file, nodata, 1);
    TIFFSetField(file, TIFFTAG_IMAGEWIDTH, (uint32_t)of->columns);
    TIFFSetField(file, TIFFTAG_IMAGELENGTH, (uint32_t)of->rows);
    TIFFSetField(file, TIFFTAG_SAMPLESPERPIXEL, of->bands ? of->bands : 1);
    TIFFSetField(file, TIFFTAG_BITSPERSAMPLE, of->whole ? 16 : 32);
    TIFFSetField(file, TIFFTAG_SAMPLEFORMAT, of->whole ? SAMPLEFORMAT_INT : SAMPLEFORMAT_IEEEFP);
    TIFFSetField(file, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(file, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    TIFFSetField(file, TIFFTAG_COMPRESSION, of->tile ? COMPRESSION_LZW : COMPRESSION_NONE);
    if (of->tile) {
        TIFFSetField(file, TIFFTAG_TILEWIDTH, of->tile);
        TIFFSetField(file, TIFFTAG_TILELENGTH, of->tile);
    } else {
        TIFFSetField(file, TIFFTAG_ROWSPERSTRIP, 3);
    }
    TIFFSetField(file, TIFFTAG_GEOPIXELSCALE, 3, scale);
    TIFFSetField(file, TIFFTAG_GEOTIEPOINTS, 6, tie);
    snprintf(text, sizeof text, "%.17g", of->nodata);
    if (of->nodata != 0) TIFFSetField(file, 42113, text);
    write_keys(of, file);
    write_pixels(of, file);
    XTIFFClose(file);
}

static void text_attribute(int file, int variable, const char *name, const char *text)
{
    if (text) need(nc_put_att_text(file, variable, name, strlen(text), text) == NC_NOERR, name);
}

/* Writes the rows of z, from the north unless they are northward. */
static void write_heights(const grid_sample *of, int file, int variable)
{
    double *row = calloc(of->columns, sizeof *row);
    need(row, "memory");
    for (size_t j = 0; j < of->rows; ++j) {
        const size_t from[2] = {of->northward ? j : of->rows - 1 - j, 0}, count[2] = {1, of->columns};
        for (size_t i = 0; i < of->columns; ++i) {
            const double z = of->height(of->x + (double)i * of->dx, of->y + (double)j * of->dy);
            row[i] = isnan(z) ? of->nodata : of->whole ? round((z - 10) / 0.5) : z;
        }
        need(nc_put_vara_double(file, variable, from, count, row) == NC_NOERR, "nc_put_vara_double");
    }
    free(row);
}

void grid_sample_netcdf(const grid_sample *of, const char *path)
{
    int file, dims[2], lines[2], z;
    const char *usual[2][3] = {{"x", "y", "z"}, {"lon", "lat", "elevation"}}, *names[3];
    for (int k = 0; k < 3; ++k) names[k] = of->names[k] ? of->names[k] : usual[of->geographic][k];
    need(nc_create(path, of->tile ? NC_NETCDF4 : NC_CLOBBER, &file) == NC_NOERR, "nc_create");
    nc_def_dim(file, names[1], of->rows, &dims[0]);
    nc_def_dim(file, names[0], of->columns, &dims[1]);
    for (int k = 0; k < 2; ++k) {
        nc_def_var(file, names[1 - k], NC_DOUBLE, 1, &dims[k], &lines[k]);
        text_attribute(file, lines[k], "units", of->units[1 - k]);
    }
    nc_def_var(file, names[2], of->whole ? NC_SHORT : NC_FLOAT, 2, dims, &z);
    if (of->tile) nc_def_var_deflate(file, z, 1, 1, 4);
    text_attribute(file, z, "units", of->units[2]);
    text_attribute(file, z, "standard_name", of->standard_name);
    text_attribute(file, z, "positive", of->positive);
    if (of->whole) {
        const double factor = 0.5, offset = 10;
        nc_put_att_double(file, z, "scale_factor", NC_DOUBLE, 1, &factor);
        nc_put_att_double(file, z, "add_offset", NC_DOUBLE, 1, &offset);
    }
    if (of->nodata != 0) nc_put_att_double(file, z, "_FillValue", of->whole ? NC_SHORT : NC_FLOAT, 1, &of->nodata);
    if (of->epsg && !of->geographic) {
        int mapping;
        char wkt[200];
        nc_def_var(file, "crs", NC_INT, 0, NULL, &mapping);
        snprintf(wkt, sizeof wkt, "PROJCS[\"x\",GEOGCS[\"y\",AUTHORITY[\"EPSG\",\"4326\"]],AUTHORITY[\"EPSG\",\"%u\"]]",
                 of->epsg);
        text_attribute(file, mapping, "crs_wkt", wkt);
        text_attribute(file, z, "grid_mapping", "crs");
    }
    need(nc_enddef(file) == NC_NOERR, "nc_enddef");
    for (size_t j = 0; j < of->rows; ++j) {
        const size_t at = of->northward ? j : of->rows - 1 - j;
        const double y = of->y + (double)j * of->dy;
        nc_put_var1_double(file, lines[0], &at, &y);
    }
    for (size_t i = 0; i < of->columns; ++i) {
        const double x = of->x + (double)i * of->dx;
        nc_put_var1_double(file, lines[1], &i, &x);
    }
    write_heights(of, file, z);
    need(nc_close(file) == NC_NOERR, "nc_close");
}
