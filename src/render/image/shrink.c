/* Smaller copies of pictures. */
#include "render/image/image.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

/* sRGB [IEC 61966-2-1]: a mean of coded values would be too dark at edges. */
static float decoded(int value)
{
    const float v = (float)value / 255;
    return v <= 0.04045f ? v / 12.92f : powf((v + 0.055f) / 1.055f, 2.4f);
}

static unsigned char encoded(float linear)
{
    const float v = linear <= 0.0031308f ? 12.92f * linear : 1.055f * powf(linear, 1 / 2.4f) - 0.055f;
    return (unsigned char)lrintf(255 * fminf(fmaxf(v, 0), 1));
}

/* Adds `weight` times the part [from, to) of a row, in pixels with fractions, to sum. */
static void add_row(const float light[256], const unsigned char *row, double from, double to, double weight,
                    double sum[3])
{
    for (int x = (int)from; x < to; x++) {
        const double part = fmin(to, x + 1) - fmax(from, x);
        for (int c = 0; c < 3; c++) sum[c] += weight * part * (double)light[row[3 * x + c]];
    }
}

static void shrink_pixel(const float light[256], const sb_image *image, double scale_x, double scale_y, int x, int y,
                         unsigned char rgb[3])
{
    const double left = x * scale_x, right = fmin((x + 1) * scale_x, image->width);
    const double top = y * scale_y, bottom = fmin((y + 1) * scale_y, image->height);
    double sum[3] = {0};
    for (int row = (int)top; row < bottom; row++)
        add_row(light, image->rgb + 3 * (size_t)row * (size_t)image->width, left, right,
                fmin(bottom, row + 1) - fmax(top, row), sum);
    for (int c = 0; c < 3; c++) rgb[c] = encoded((float)(sum[c] / ((right - left) * (bottom - top))));
}

sb_status sb_image_shrink(const sb_image *image, int width, sb_image *small, sb_error *error)
{
    float light[256];
    if (!image->rgb || width < 1) return sb_fail(error, SB_BAD_INPUT, "an empty picture cannot be made smaller");
    if (width > image->width) width = image->width;
    const int fitting = (int)lround((double)image->height * width / image->width), height = fitting > 1 ? fitting : 1;
    sb_status status = sb_image_resize(small, width, height, error);
    if (status != SB_OK) return status;
    if (width == image->width) {
        memcpy(small->rgb, image->rgb, 3 * (size_t)width * (size_t)height);
        return SB_OK;
    }
    for (int v = 0; v < 256; v++) light[v] = decoded(v);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            shrink_pixel(light, image, (double)image->width / width, (double)image->height / height, x, y,
                         small->rgb + 3 * ((size_t)y * (size_t)width + (size_t)x));
    return SB_OK;
}
