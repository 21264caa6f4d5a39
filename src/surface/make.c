#include "surface/make.h"

#include "base/memory.h"
#include "surface/blocks.h"
#include "surface/level.h"
#include "surface/march.h"
#include "surface/smooth.h"
#include "surface/waters.h"

sb_status sb_water_mesh_make(const sb_frame *frame, double cell, int smooth, sb_water_mesh *mesh, sb_error *error)
{
    sb_blocks blocks = {0};
    sb_waters waters = {0};
    float *value = NULL;
    uint32_t *node = NULL;
    sb_water_mesh made = {.origin = frame->origin};
    sb_status status = SB_OK;
    *mesh = (sb_water_mesh){.origin = frame->origin};
    if (frame->count == 0) return SB_OK;
    if (!(cell >= SB_WATER_MESH_CELL_LEAST && cell <= SB_WATER_MESH_CELL_MOST) || smooth < 0)
        return sb_fail(error, SB_BAD_INPUT,
                       "cells of %g spacings and %d rounds of smoothing, expected %g to %g and 0 or more", cell, smooth,
                       SB_WATER_MESH_CELL_LEAST, SB_WATER_MESH_CELL_MOST);
    status = sb_blocks_build(frame, cell, SB_LEVEL_REACH, &blocks, error);
    if (status == SB_OK && !(value = sb_level_build(&blocks))) status = sb_fail_memory(error, "the field of a surface");
    if (status == SB_OK) status = sb_march(frame, &blocks, value, &made, &node, error);
    if (status == SB_OK) status = sb_waters_find(&blocks, value, node, made.vertices, &waters, error);
    if (status == SB_OK)
        status = sb_water_mesh_smooth(&made, &waters, frame->spacing, smooth, 0.25 * blocks.cell, error);
    sb_waters_free(&waters);
    sb_free(node);
    sb_free(value);
    sb_blocks_free(&blocks);
    if (status == SB_OK)
        *mesh = made;
    else
        sb_water_mesh_free(&made);
    return status;
}
