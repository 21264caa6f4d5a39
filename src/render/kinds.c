/* OpenGL in software takes ten times as long for the same. */
#include "render/kinds.h"

#include <math.h>

/* What one row needs. */
typedef struct kind_lens {
    float clip[2], thickest, opaque; /* opaque: m of water through which less than 2 % is seen */
    float left, step, slope_y;       /* slope of a ray: left + (x + 0.5) step */
} kind_lens;

/* share: of the pixel that the water covers, where it is before the bodies. */
static void find_row(const kind_lens *l, int width, const float *restrict surface, const float *restrict cover,
                     const float *restrict bodies, const float *restrict foam, float *restrict kinds)
{
#pragma omp simd
    for (int x = 0; x < width; x++) {
        const float w = surface[4 * x], thickness = cover[4 * x + 1];
        const float z = l->clip[1] / (2 * bodies[x] - 1 - l->clip[0]);
        const float share = w > 0 && w < z ? cover[4 * x] : 0;
        const float slope = l->left + ((float)x + 0.5f) * l->step;
        const float path = (z > w ? z - w : 0) * sqrtf(slope * slope + l->slope_y * l->slope_y + 1);
        const float thick = thickness > 0.8f * l->thickest || path < thickness ? path : thickness;
        const bool drops = (cover[4 * x + 2] > 0.004f && cover[4 * x + 3] < z) || (foam && foam[4 * x + 1] > 0.004f);
        kinds[x] = share < 0.004f && !drops                        ? SB_KIND_BEHIND
                   : share > 0.996f && !drops && thick > l->opaque ? SB_KIND_WATER
                                                                   : SB_KIND_MIXTURE;
    }
}

void sb_kinds_find(const sb_kind_parts *parts, float *kinds)
{
    const int width = parts->splat->width, height = parts->splat->height;
    const sb_view *view = parts->view;
    const float step = (float)(2 * view->tangent / height);
    /* The bed's part is 0.85 exp(-thick / clarity), as in the shader. */
    const kind_lens lens = {.clip = {-view->projection[10], view->projection[14]},
                            .thickest = (float)parts->thickest,
                            .opaque = (float)(parts->clarity * log(0.85 / 0.02)),
                            .left = -0.5f * step * (float)width,
                            .step = step};
#pragma omp parallel for num_threads(parts->threads) schedule(static)
    for (int y = 0; y < height; y++) {
        const size_t row = (size_t)y * (size_t)width;
        kind_lens own = lens;
        own.slope_y = step * ((float)y + 0.5f - 0.5f * (float)height);
        find_row(&own, width, parts->splat->surface + 4 * row, parts->splat->cover + 4 * row, parts->bodies + row,
                 parts->foam ? parts->foam + 4 * row : NULL, kinds + row);
    }
}
