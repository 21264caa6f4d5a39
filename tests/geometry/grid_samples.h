/* Writes GeoTIFF and NetCDF files for tests. */
#ifndef SB_TESTS_GRID_SAMPLES_H
#define SB_TESTS_GRID_SAMPLES_H

#include <stdbool.h>
#include <stddef.h>

/* A grid to write: the height at column i, row j (from the south) is height(x, y), with (x, y) the place of its node.
 */
typedef struct grid_sample {
    size_t columns, rows;
    double x, y, dx, dy; /* of the south-western node, file units */
    double (*height)(double x, double y);
    double nodata;                    /* stored where height() is NAN; 0: none is stated */
    unsigned epsg;                    /* 0: none */
    bool geographic;                  /* degrees */
    unsigned vertical, vertical_unit; /* GeoTIFF: EPSG codes; 0: none */
    bool whole;     /* int16 instead of float32; in NetCDF packed with scale_factor 0.5, add_offset 10 */
    unsigned tile;  /* GeoTIFF: pixels of a tile's side; 0: strips. NetCDF: > 0: HDF5, compressed */
    bool point;     /* GeoTIFF: pixels are points */
    bool northward; /* NetCDF: rows from south to north (GEBCO); GeoTIFF rows always run from the north */
    unsigned bands; /* GeoTIFF; 0: 1 */
    const char *names[3], *units[3]; /* NetCDF: of x, y, z; NULL: lon, lat, elevation or x, y, z; no units */
    const char *standard_name;       /* NetCDF: of z; NULL: none */
    const char *positive;            /* likewise */
} grid_sample;

/* Write the file; they abort on failure. */
void grid_sample_tiff(const grid_sample *of, const char *path);
void grid_sample_netcdf(const grid_sample *of, const char *path);

#endif
