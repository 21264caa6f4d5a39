/* The bodies as OpenGL has them. Private to meshes.c and meshes_upload.c. */
#ifndef SB_RENDER_MESHES_PARTS_H
#define SB_RENDER_MESHES_PARTS_H

#include "base/status.h"
#include "base/vec.h"
#include "render/gl/program.h"
#include "scene/scene.h"

#include <stdbool.h>

/* One corner of a triangle. The alpha of its colour is 0 for a plain colour and 255 for the colours of terrain. */
struct corner {
    float position[3];
    signed char normal[4];
    unsigned char color[4];
};

struct part {
    char name[SB_NAME_MAX];
    size_t body; /* index in the model, and so in a frame */
    bool moves, one_sided, terrain;
    float line_alpha;
    GLint first_corner, first_line;
    GLsizei corners, line_ends;
};

typedef struct sb_meshes sb_meshes;

struct sb_meshes {
    sb_vec3 origin;
    size_t part_count;
    struct part *parts;
    GLuint face_array, face_buffer, line_array, line_buffer;
    GLuint face_program, depth_program, line_program;
    GLuint color_buffer; /* colours of corners that are not those of face_buffer; 0: none */
    GLuint speckles;     /* a periodic texture of smooth noise, 64 random values on a side */
};

/* Compiles the programs that draw the bodies. */
sb_status sb_meshes_make_programs(sb_meshes *meshes, sb_error *error);

#endif
