/* A body of sb_solids. Private to section.c and section_fill.c. */
#ifndef SB_RENDER_SOLID_H
#define SB_RENDER_SOLID_H

#include "render/slice/section.h"

struct sb_solid {
    char name[SB_NAME_MAX];
    size_t body;         /* index in the model, and so in a frame */
    size_t first, count; /* of its triangles */
    bool open, terrain;
};

#endif
