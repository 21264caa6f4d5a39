/* The particles of a frame sorted into the blocks of a sparse background grid. Lengths are in cells of the grid, whose
   places in space do not depend on the frame, so that surfaces of successive frames do not jump. */
#ifndef SB_SURFACE_BLOCKS_H
#define SB_SURFACE_BLOCKS_H

#include "base/status.h"
#include "frame/frame.h"

/* A block has 8 x 8 x 8 nodes and the cells beside them towards greater coordinates. */
enum { SB_BLOCK_SIDE = 8, SB_BLOCK_NODES = 512, SB_BLOCK_NONE = -1 };

typedef struct sb_blocks {
    double cell;     /* m */
    double start[3]; /* m relative to the frame's origin: node 0 of a block with the key 0 */
    float reach;     /* cells: the support radius of the kernel */
    int bins;        /* of a block along an axis; a bin is at least `reach` wide */
    size_t all_bins; /* bins^3 */
    size_t count;    /* of blocks: those with particles, and all their neighbours */
    uint64_t *keys;  /* ascending: z, y, x of the block */
    size_t particles;
    float *place[3];     /* of each particle, relative to node 0 of its block */
    float *weight;       /* of each particle in the field; filled by sb_level_build */
    uint32_t *source;    /* index of each particle in the frame */
    uint32_t *bin_first; /* first particle of each bin; bins^3 per block, and one more at the end */
} sb_blocks;

/* The particles of a block and of the bins around it, bin by bin along x first; places relative to the block. A
   zero-initialised one is valid, and can be used for one block after another. */
typedef struct sb_near {
    size_t count, capacity;
    int bins;            /* along an axis: those of a block and 2 more */
    uint32_t first[217]; /* of each bin */
    float *x, *y, *z, *weight;
    uint32_t *particle; /* index in sb_blocks */
    float *carried[4];  /* velocity and pressure, if a frame was given */
} sb_near;

/* cell: in spacings, 0.25 to 1. SB_BAD_INPUT for particles further apart than the keys can hold. The caller frees. */
sb_status sb_blocks_build(const sb_frame *frame, double cell, double reach, sb_blocks *blocks, sb_error *error);
void sb_blocks_free(sb_blocks *blocks);

/* The index of the block so many blocks away, SB_BLOCK_NONE if there is none. */
int64_t sb_blocks_at(const sb_blocks *blocks, size_t block, int x, int y, int z);

bool sb_blocks_has_particles(const sb_blocks *blocks, size_t block);

/* Node 0 of a block in m relative to the frame's origin. */
void sb_blocks_start(const sb_blocks *blocks, size_t block, double start[3]);

/* Fills *near; returns 0, or -1 if memory runs out. frame: whose velocities and pressures are wanted too; or NULL. The
   arrays are longer than their contents by 8 values, so that loops over eight of them at a time may read on. */
int sb_near_fill(const sb_blocks *blocks, size_t block, const sb_frame *frame, sb_near *near);
void sb_near_free(sb_near *near);

#endif
