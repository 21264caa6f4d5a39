/* Draws spray, foam and bubbles over a picture of the water: spray as soft discs in the air, foam as discs that lie in
   the surface of the water, bubbles as faint ones below it. Coverings add up, so that their order has no effect. */
#ifndef SB_RENDER_FOAM_H
#define SB_RENDER_FOAM_H

#include "frame/frame.h"
#include "render/camera/camera.h"

/* What is known of a picture without foam, by pixel, rows from the bottom up. */
typedef struct sb_foam_ground {
    int width, height;
    const float *surface; /* 4 floats, as sb_splat.surface */
    const float *bodies;  /* depth buffer of the bodies, 0..1 */
} sb_foam_ground;

/* A disc: in the plane of the picture, or in the surface of the water. */
typedef struct sb_foam_mark {
    float place[3]; /* m, along the camera's right, up and forward axes */
    float radius;   /* m */
    float strength; /* optical thickness at its centre; 0: not drawn */
    int layer;      /* 0: in the surface; 1: in the air; 3: below the surface */
} sb_foam_mark;

/* Kept from frame to frame, so that its memory is reused. A zeroed struct is empty. */
typedef struct sb_foam_layer {
    float *pixels; /* 4 floats per pixel: cover by foam, by spray, depth of the nearest spray in m, cover by bubbles */
    size_t pixel_capacity, mark_capacity, bin_capacity, first_capacity;
    sb_foam_mark *marks;
    uint32_t *bins;
    size_t *first;
} sb_foam_layer;

/* Draws the foam of a frame into layer->pixels. The result is the same for any number of threads. */
sb_status sb_foam_draw(sb_foam_layer *layer, const sb_frame *frame, const sb_view *view, const sb_foam_ground *ground,
                       int threads, sb_error *error);
void sb_foam_layer_free(sb_foam_layer *layer);

/* foam_marks.c: finds the disc of each particle. marks: as many as the frame has particles of foam. */
void sb_foam_marks(const sb_frame *frame, const sb_view *view, const sb_foam_ground *ground, int threads,
                   sb_foam_mark *marks);

/* Rays and depths of a picture. */
typedef struct sb_foam_lens {
    float step, left, bottom; /* slope of a ray: left + (x + 0.5) step */
    float near, clip[2];      /* depth of a value d of the depth buffer: clip[1]/(2 d - 1 - clip[0]) */
} sb_foam_lens;

static inline sb_foam_lens sb_foam_lens_of(const sb_view *view, const sb_foam_ground *ground)
{
    const float step = (float)(2 * view->tangent / ground->height);
    return (sb_foam_lens){.step = step,
                          .left = -0.5f * step * (float)ground->width,
                          .bottom = -0.5f * step * (float)ground->height,
                          .near = (float)view->near,
                          .clip = {-view->projection[10], view->projection[14]}};
}

/* Depth of the bodies at a pixel, m. */
static inline float sb_foam_body_depth(const sb_foam_lens *lens, const sb_foam_ground *ground, size_t pixel)
{
    return lens->clip[1] / (2 * ground->bodies[pixel] - 1 - lens->clip[0]);
}

/* Depth of the water's surface at a pixel; 0: there is none, or bodies hide it. */
static inline float sb_foam_water_depth(const sb_foam_lens *lens, const sb_foam_ground *ground, size_t pixel)
{
    const float depth = ground->surface[4 * pixel];
    return depth > 0 && depth < sb_foam_body_depth(lens, ground, pixel) ? depth : 0;
}

#endif
