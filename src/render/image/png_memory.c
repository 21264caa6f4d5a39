/* PNG from files of a run to memory, and back, for pages that contain pictures. */
#include "render/image/image.h"

#include "base/input.h"
#include "base/memory.h"

#include <png.h>
#include <string.h>

/* Reads the pixels behind the header, which `png` has read. */
static sb_status read_pixels(const char *path, png_image *png, sb_image *image, sb_error *error)
{
    static const png_color white = {255, 255, 255};
    sb_image made = {0};
    if (png->width > SB_IMAGE_SIDE_MAX || png->height > SB_IMAGE_SIDE_MAX)
        return sb_fail(error, SB_BAD_INPUT, "%.500s: %u x %u px: expected at most %d px in each direction", path,
                       png->width, png->height, SB_IMAGE_SIDE_MAX);
    png->format = PNG_FORMAT_RGB;
    sb_status status = sb_image_resize(&made, (int)png->width, (int)png->height, error);
    if (status != SB_OK) return status;
    if (!png_image_finish_read(png, &white, made.rgb, 3 * made.width, NULL)) {
        sb_image_free(&made);
        return sb_fail(error, SB_BAD_INPUT, "%.500s: %s: expected a complete PNG picture", path, png->message);
    }
    sb_image_free(image);
    *image = made;
    return SB_OK;
}

sb_status sb_png_read(const char *path, sb_image *image, sb_error *error)
{
    FILE *stream = NULL;
    sb_status status = sb_input_open(path, &stream, error);
    if (status != SB_OK) return status;
    png_image png = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_stdio(&png, stream))
        status = sb_fail(error, SB_BAD_INPUT, "%.500s: %s: expected a PNG picture", path, png.message);
    else
        status = read_pixels(path, &png, image, error);
    png_image_free(&png);
    fclose(stream);
    return status;
}

sb_status sb_png_encode(const sb_image *image, unsigned char **bytes, size_t *size, sb_error *error)
{
    png_image png = {.version = PNG_IMAGE_VERSION, .format = PNG_FORMAT_RGB};
    if (!image->rgb) return sb_fail(error, SB_BAD_INPUT, "an empty picture cannot be written");
    png.width = (png_uint_32)image->width;
    png.height = (png_uint_32)image->height;
    png_alloc_size_t length = PNG_IMAGE_PNG_SIZE_MAX(png);
    unsigned char *made = sb_alloc_untouched(length, 1);
    if (!made) return sb_fail_memory(error, "a picture");
    if (!png_image_write_to_memory(&png, made, &length, 0, image->rgb, 3 * image->width, NULL)) {
        sb_free(made);
        return sb_fail(error, SB_FAILED, "a picture cannot be compressed: %s", png.message);
    }
    *bytes = made;
    *size = length;
    return SB_OK;
}
