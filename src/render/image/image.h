/* Pictures in memory, and as PNG files. */
#ifndef SB_RENDER_IMAGE_H
#define SB_RENDER_IMAGE_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

enum { SB_IMAGE_SIDE_MAX = 16384 }; /* px */

/* 8-bit sRGB, rows from the top down, 3 bytes per pixel without padding. A zeroed struct is empty. */
typedef struct sb_image {
    int width, height;  /* px */
    unsigned char *rgb; /* owned */
} sb_image;

/* Sets the size to width x height, each 1..SB_IMAGE_SIDE_MAX. The memory is kept if the size does not change. */
sb_status sb_image_resize(sb_image *image, int width, int height, sb_error *error);

/* Frees the pixels and zeroes the struct. Has no effect on an empty one. */
void sb_image_free(sb_image *image);

/* Writes the picture completely or not at all, compressed for speed. The text chunk
   "Software" contains "shorebreak". */
sb_status sb_png_write(const char *path, const sb_image *image, sb_error *error);

/* Reads a PNG file of at most SB_IMAGE_SIDE_MAX px in each direction; transparent pixels become white. SB_BAD_INPUT
   names the file and the reason; *image is then unchanged. */
sb_status sb_png_read(const char *path, sb_image *image, sb_error *error);

/* Writes the picture into memory, compressed as small as libpng does it by default. Free *bytes with sb_free. */
sb_status sb_png_encode(const sb_image *image, unsigned char **bytes, size_t *size, sb_error *error);

/* Makes `small` of `width` px, and of the height with the same ratio: each of its pixels is the mean, in linear light,
   of the pixels that it covers. A width that is not smaller gives a copy. */
sb_status sb_image_shrink(const sb_image *image, int width, sb_image *small, sb_error *error);

/* Returns whether `start`, the first SB_PNG_MARK_WITHIN bytes of a file, belongs to a picture from sb_png_write. */
enum { SB_PNG_MARK_WITHIN = 128 };
bool sb_png_is_own(const char *start, size_t length);

#endif
