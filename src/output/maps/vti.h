/* Writes the cells of a horizontal grid as VTK image data (.vti), which ParaView reads, and reads such files. */
#ifndef SB_OUTPUT_VTI_H
#define SB_OUTPUT_VTI_H

#include "base/status.h"

#include <stddef.h>

typedef struct sb_vti_array {
    const char *name;
    size_t components;
    const float *values; /* per cell, row 0 at the smallest y */
} sb_vti_array;

typedef struct sb_vti {
    double time;          /* s */
    size_t columns, rows; /* cells */
    double x, y, cell;    /* m, corner and edge */
    size_t array_count;
    const sb_vti_array *arrays;
} sb_vti;

/* The first bytes of every file. */
#define SB_VTI_HEAD                                                                                                    \
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "                \
    "header_type=\"UInt64\">\n"

/* Folder and list of a run's files of this kind. */
#define SB_VTI_FOLDER "grid"
#define SB_VTI_LIST "grid"

/* Writes the file completely or not at all. */
sb_status sb_vti_write(const char *path, const sb_vti *image, sb_error *error);

/* Reads the wanted arrays, whose names and components are given, of a file that sb_vti_write wrote, and sets their
   values, which lie in *values: free it with sb_free. image->arrays is `wanted`. Values can be NaN. SB_BAD_INPUT: not
   such a file, damaged, or without an array; nothing is set. */
sb_status sb_vti_read(const char *path, sb_vti_array *wanted, size_t count, sb_vti *image, float **values,
                      sb_error *error);

#endif
