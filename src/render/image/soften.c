/* Anti-aliasing of a finished picture. */
#include "render/image/soften.h"

#include <stddef.h>
#include <stdlib.h>

enum { LEAST_CONTRAST = 14 };

/* Brightness. Green has double weight because the eye is most sensitive to it. */
static int luma(const unsigned char *pixel)
{
    return (pixel[0] + 2 * pixel[1] + pixel[2]) >> 2;
}

static int larger(int a, int b)
{
    return a > b ? a : b;
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

/* The weight, in 1/256, of the colour across the edge: none for a pixel that equals the mean of its neighbours, up to
   half for a pixel that differs from them, as at the corners of a jagged edge. */
static int share(int here, int north, int south, int west, int east, int contrast)
{
    int away = abs((north + south + west + east + 2) / 4 - here);
    int part = smaller(256, 256 * away / contrast);
    return part * part / 512;
}

static void soften_row(const unsigned char *row, ptrdiff_t stride, int width, unsigned char *to)
{
    for (int x = 1; x < width - 1; x++) {
        const unsigned char *pixel = row + 4 * (ptrdiff_t)x;
        int here = luma(pixel), west = luma(pixel - 4), east = luma(pixel + 4);
        int north = luma(pixel + stride), south = luma(pixel - stride);
        int high = larger(larger(north, south), larger(larger(west, east), here));
        int low = smaller(smaller(north, south), smaller(smaller(west, east), here));
        if (high - low < LEAST_CONTRAST) continue;
        const unsigned char *other;
        if (abs(north + south - 2 * here) >= abs(west + east - 2 * here))
            other = pixel + (abs(north - here) >= abs(south - here) ? stride : -stride);
        else
            other = pixel + (abs(east - here) >= abs(west - here) ? 4 : -4);
        int part = share(here, north, south, west, east, high - low);
        for (int c = 0; c < 3; c++)
            to[3 * x + c] = (unsigned char)((pixel[c] * (256 - part) + other[c] * part + 128) >> 8);
    }
}

void sb_soften(const unsigned char *rgba, sb_image *image)
{
    ptrdiff_t stride = 4 * (ptrdiff_t)image->width;
    for (int y = 0; y < image->height; y++) {
        const unsigned char *row = rgba + stride * (image->height - 1 - y);
        unsigned char *to = image->rgb + 3 * (ptrdiff_t)image->width * y;
        for (int x = 0; x < image->width; x++)
            for (int c = 0; c < 3; c++) to[3 * x + c] = row[4 * x + c];
        if (y > 0 && y < image->height - 1) soften_row(row, stride, image->width, to);
    }
}
