/* Sun, sky and haze, shared by all surfaces: a shadow map and a map of how much sky each spot of
   the ground sees, both made once from the bodies that never move. */
#ifndef SB_RENDER_LIGHT_H
#define SB_RENDER_LIGHT_H

#include "base/vec.h"
#include "render/camera.h"
#include "render/program.h"

typedef struct sb_meshes sb_meshes;

typedef struct sb_light {
    GLuint shadow, ground; /* depth from the sun; height and openness from above */
    float to_shadow[16];   /* origin-relative place -> shadow map, 0..1 */
    float ground_frame[3]; /* m: x, y of the ground map's corner; 1/m: one over its side */
    sb_vec3 origin;        /* m, scene: what the two above are relative to */
    double size;           /* m, of all that is lit */
    double sea_level;      /* m, scene */
} sb_light;

/* GLSL for fragments: vec3 sky(vec3 direction), vec3 lit(vec3 albedo, vec3 place, vec3 normal),
   vec3 hazed(vec3 color, vec3 place), vec4 encoded(vec3 color), and the uniforms they read. Colours
   are linear; the picture's encoding is a gamma of 2. */
extern const char sb_light_source[];

/* [min, max]: all that is to be lit, in scene coordinates. Needs the context. Zeroed light is fine
   to destroy. */
sb_status sb_light_create(const sb_meshes *meshes, sb_vec3 origin, sb_vec3 min, sb_vec3 max, double sea_level,
                          sb_light *light, sb_error *error);
void sb_light_destroy(sb_light *light);

/* Sets the uniforms of sb_light_source for a program in use; takes texture units 4 and 5. */
void sb_light_bind(const sb_light *light, const sb_view *view, GLuint program);

/* The share of the sky that each cell of an n x n height field (m, row by row) sees over its
   surroundings, 0..1; cell in m. For the ground map, and for tests. */
void sb_light_openness(const float *height, int n, double cell, float *openness);

#endif
