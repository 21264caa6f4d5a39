/* Pictures in memory, and as PNG files. */
#ifndef SB_RENDER_IMAGE_H
#define SB_RENDER_IMAGE_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

enum { SB_IMAGE_SIDE_MAX = 16384 }; /* px */

/* 8-bit sRGB, rows from the top down, 3 bytes per pixel without padding. Zeroed is empty. */
typedef struct sb_image {
    int width, height;  /* px */
    unsigned char *rgb; /* owned */
} sb_image;

/* Makes it width x height, keeping the memory when the size is the same;
 * sizes 1..SB_IMAGE_SIDE_MAX. */
sb_status sb_image_resize(sb_image *image, int width, int height, sb_error *error);

/* Frees the pixels and zeroes it; fine on an empty one. */
void sb_image_free(sb_image *image);

/* Writes the picture whole or not at all. Fast settings: level 3, no filter. Its text "Software" is "shorebreak". */
sb_status sb_png_write(const char *path, const sb_image *image, sb_error *error);

/* Whether the first bytes of a file, SB_PNG_MARK_WITHIN of them, are those of a picture that sb_png_write wrote. */
enum { SB_PNG_MARK_WITHIN = 128 };
bool sb_png_is_own(const char *start, size_t length);

#endif
