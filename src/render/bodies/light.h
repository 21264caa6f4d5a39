/* Sun, sky and haze, shared by all surfaces: a shadow map, and a ground map of the fraction of the sky that is visible
   from each point of the ground. Both are computed once, from the bodies that never move. */
#ifndef SB_RENDER_LIGHT_H
#define SB_RENDER_LIGHT_H

#include "base/vec.h"
#include "render/camera/camera.h"
#include "render/gl/program.h"
#include "render/water/density.h"

#include <stdbool.h>

typedef struct sb_meshes sb_meshes;

typedef struct sb_light {
    GLuint shadow, ground; /* depth as seen from the sun; height and visible fraction of the sky as seen from above */
    float to_shadow[16];   /* from positions relative to origin to the shadow map, 0..1 */
    float ground_frame[3]; /* m: x, y of the ground map's corner; 1/m: one over its side */
    sb_vec3 origin;        /* m, scene: the origin of the two members above */
    double size;           /* m, diagonal of the lit box */
    sb_ground solid;       /* heights of the bodies that never move */
    double sea_level;      /* m, scene */
    bool shadows;          /* whether bodies and water cast shadows */
} sb_light;

/* GLSL functions for fragment shaders: vec3 sky(vec3 direction), vec3 lit(vec3 albedo, vec3 place, vec3 normal, float
   sunny, float open), vec3 hazed(vec3 color, vec3 place), vec4 encoded(vec3 color), and the uniforms that they read.
   Without the macro SHADOWS the sun is not shaded.
   Colours are linear; the picture is encoded with a gamma of 2. */
extern const char sb_light_source[];

/* Creates the maps. [min, max] is the lit box in scene coordinates. The context must be current. A zeroed sb_light may
   be destroyed. */
sb_status sb_light_create(const sb_meshes *meshes, sb_vec3 origin, sb_vec3 min, sb_vec3 max, double sea_level,
                          sb_light *light, sb_error *error);
void sb_light_destroy(sb_light *light);

/* Returns sb_light.size of a box, whose corners are relative to the light's origin. */
double sb_light_size(sb_vec3 min, sb_vec3 max);

/* Sets the uniforms of sb_light_source for the program in use. Uses the texture units 4 and 5. */
void sb_light_bind(const sb_light *light, const sb_view *view, GLuint program);

/* Sets the uniforms from which passes over the whole picture compute the ray of a pixel: right, up, back (the camera's
   axes) and lens (half the picture's width and height at depth 1). sb_light_bind sets them, too. */
void sb_light_bind_rays(const sb_view *view, GLuint program);

/* Computes the fraction of the sky, 0..1, that is visible from each cell of an n x n height field (m, row by row) over
   its surroundings. cell: side of a cell, m. Used for the ground map and by tests. */
void sb_light_openness(const float *height, int n, double cell, float *openness);

#endif
