/* Allocates pictures. */
#include "render/image/image.h"

#include "base/memory.h"

sb_status sb_image_resize(sb_image *image, int width, int height, sb_error *error)
{
    if (width < 1 || height < 1 || width > SB_IMAGE_SIDE_MAX || height > SB_IMAGE_SIDE_MAX)
        return sb_fail(error, SB_BAD_INPUT, "image: %d x %d px, expected 1 to %d on each side", width, height,
                       SB_IMAGE_SIDE_MAX);
    if (image->rgb && image->width == width && image->height == height) return SB_OK;
    unsigned char *rgb = sb_alloc((size_t)width * (size_t)height, 3);
    if (!rgb) return sb_fail_memory(error, "a picture");
    sb_free(image->rgb);
    *image = (sb_image){width, height, rgb};
    return SB_OK;
}

void sb_image_free(sb_image *image)
{
    sb_free(image->rgb);
    *image = (sb_image){0};
}
