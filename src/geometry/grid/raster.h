/* Grids in binary files: GeoTIFF and NetCDF. A child process with limits reads them (mesh/child.h), because a crafted
   file may crash or take over the library that reads it. Private to src/geometry/grid. */
#ifndef SB_GEOMETRY_RASTER_H
#define SB_GEOMETRY_RASTER_H

#include "geometry/grid/grid.h"

typedef enum sb_raster_crs {
    SB_RASTER_CRS_NONE, /* the file names no coordinate system */
    SB_RASTER_CRS_EPSG, /* about.epsg */
    SB_RASTER_CRS_OTHER /* described by parameters, without an EPSG code */
} sb_raster_crs;

/* What a file states of its grid. Node (0, 0) is the south-western one; coordinates in file units (m, degrees). */
typedef struct sb_raster_about {
    uint64_t columns, rows;
    double x, y, dx, dy;     /* dx, dy > 0 */
    uint32_t flip_x, flip_y; /* the file stores its columns from east to west, its rows from north to south */
    uint32_t crs, epsg;      /* sb_raster_crs; EPSG code, 0: none */
    uint32_t geographic;     /* x, y are longitude and latitude in degrees */
    uint32_t down;           /* the file states that its numbers are depths */
    uint32_t vertical;       /* EPSG code of the vertical system, 0: none */
    char note[SB_NAME_MAX];  /* what the file says of its heights, or "" */
} sb_raster_about;

/* A part of a grid, in nodes. */
typedef struct sb_raster_part {
    uint64_t column, row, columns, rows; /* columns 0: none, only `about` is wanted */
} sb_raster_part;

/* Whether the ending is that of a GeoTIFF (.tif, .tiff) or NetCDF (.nc, .nc4, .grd) file. */
bool sb_raster_is(const char *path);

/* Reads what the file states of its grid. SB_BAD_INPUT "file: what, expected", SB_INTERRUPTED. */
sb_status sb_raster_about_file(const char *path, sb_raster_about *about, sb_error *error);

/* Reads the heights of a part that lies within the grid. NAN marks missing heights. The caller frees grid->heights. */
sb_status sb_raster_read(const char *path, const sb_raster_part *part, sb_grid *grid, sb_error *error);

/* Run in the child. `heights` has part->columns * part->rows values, from south to north; NULL: not wanted. A failure
   fills *error with the reason, without the file's name. */
typedef struct sb_raster_file {
    const char *path;
    int descriptor;
    size_t size; /* bytes */
    void *bytes; /* the whole file, mapped; NetCDF only */
} sb_raster_file;
typedef sb_status sb_raster_load(sb_error *error);
typedef sb_status sb_raster_take(const sb_raster_file *file, const sb_raster_part *part, sb_raster_about *about,
                                 double *heights, sb_error *error);
sb_raster_load sb_geotiff_load, sb_netcdf_load;
sb_raster_take sb_geotiff_take, sb_netcdf_take;

#endif
