/* Joins bodies, water and sky to a picture: light, shadows, reflection, and the bed seen through shallow water. */
#ifndef SB_RENDER_COMPOSE_H
#define SB_RENDER_COMPOSE_H

#include "render/bodies/occlusion.h"
#include "render/bodies/scenery.h"
#include "render/overlay/colormap.h"
#include "render/water/water.h"

enum { SB_COMPOSE_PASSES = 4 };

typedef struct sb_compose {
    GLuint programs[SB_COMPOSE_PASSES], empty;
    GLuint colors[SB_COLORMAPS];
} sb_compose;

/* What a picture consists of. */
typedef struct sb_parts {
    const sb_scenery *scenery;
    const sb_water *water;
    const sb_light *light;
    const sb_occlusion *occlusion; /* NULL: none */
    const float *kinds;            /* as in kinds.h, per pixel; NULL: OpenGL finds them */
    GLuint kind_depth;             /* texture of the depths of the bound framebuffer, which kinds replace */
    GLuint foam;                   /* texture of sb_foam_layer.pixels; 0: the picture has none */
    GLuint shade;                  /* texture of the water as seen from the sun */
    double shade_bias;             /* heights of `shade` by which water does not shade itself */
    GLuint reached;                /* of the highest water so far, m above the light's origin; 0 without the next two */
    bool wet;                      /* ground and bodies that the water has reached are darker */
    bool painted;                  /* paint the greatest depth on the ground and on bodies */
    bool loaded;                   /* bodies have colours of loads: both are on terrain only */
    double depth_max;              /* m, greatest depth at the upper end of its colours */
    double thickest;               /* m, above which the thickness of the water is unknown */
    int map;                       /* of the water's colours */
} sb_parts;

/* What pictures may have. The programs have no code for what they may not have, because OpenGL in software executes
   both sides of a branch. */
typedef struct sb_effects {
    bool foam, shadows, occlusion;
    bool reached; /* sb_parts.reached */
} sb_effects;

/* Length of water, m, through which the bed is seen by 1/e. */
static inline double sb_compose_clarity(const sb_light *light)
{
    return light->size / 500;
}

sb_status sb_compose_create(const sb_effects *effects, sb_compose *compose, sb_error *error);
void sb_compose_destroy(sb_compose *compose);

/* Draws all pixels of the bound framebuffer; its depths are then kinds. */
void sb_compose_draw(const sb_compose *compose, const sb_parts *parts, const sb_view *view);

#endif
