/* The bodies of connected water that a mesh encloses: a sea with the surfaces of the air in it, a drop. */
#ifndef SB_SURFACE_WATERS_H
#define SB_SURFACE_WATERS_H

#include "base/status.h"
#include "surface/blocks.h"

typedef struct sb_waters {
    size_t count;
    uint32_t *water;   /* of each vertex, 0, 1, ... */
    uint32_t *first;   /* a vertex of each water */
    double *particles; /* in each water */
} sb_waters;

/* value: the field at the nodes of the blocks. node: of each of the `vertices` vertices, the node in the water on its
   edge of the grid. Waters are connected as cubes of sb_cube_cases connect them. A particle without a node in the water
   beside it is in none. The caller frees. SB_FAILED if memory runs out. */
sb_status sb_waters_find(const sb_blocks *blocks, const float *value, const uint32_t *node, size_t vertices,
                         sb_waters *waters, sb_error *error);
void sb_waters_free(sb_waters *waters);

#endif
