/* Which pass of sb_compose_draw draws a pixel. The passes select their pixels by an early depth test against these. */
#ifndef SB_RENDER_KINDS_H
#define SB_RENDER_KINDS_H

#include "render/camera/camera.h"
#include "render/water/splat.h"

/* The depths that stand for: only bodies and sky; water through which nothing is seen; a mixture. */
#define SB_KIND_BEHIND 0.0f
#define SB_KIND_WATER 0.5f
#define SB_KIND_MIXTURE 1.0f

/* What the kinds depend on. */
typedef struct sb_kind_parts {
    const sb_splat *splat;
    const float *bodies; /* per pixel: their value in the depth buffer */
    const float *foam;   /* as sb_foam_layer.pixels; NULL: none */
    const sb_view *view;
    double clarity, thickest; /* m: as in the shader */
    int threads;
} sb_kind_parts;

/* Writes the kind of each pixel. */
void sb_kinds_find(const sb_kind_parts *parts, float *kinds);

#endif
