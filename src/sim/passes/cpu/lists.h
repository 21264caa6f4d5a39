/* Neighbour lists under construction: one thread writes the lists of a few groups at a time. */
#ifndef SB_SIM_LISTS_H
#define SB_SIM_LISTS_H

#include "sim/passes/cpu/vicinity.h"

typedef struct sb_list_builder {
    sb_four_pairs *four;
    uint32_t *wall;
    float *wall_slope;
    sb_run *run;
    sb_image *image;
    sb_group_plane *plane;
    sb_edge_pair *edge;
    size_t fours, walls, runs, images, planes, edges; /* written since the last copy into the pools */
    size_t capacity_four, capacity_wall, capacity_slope, capacity_run, capacity_image, capacity_plane, capacity_edge;
    bool out_of_memory;
} sb_list_builder;

/* Appends the hits as particle i's list, with the slopes of `root`. Hits beyond `count` are the particle itself. */
void sb_list_water(sb_list_builder *lists, const sb_hits *hits, sb_sim *sim, size_t i);
/* Appends hits of images to particle i's list. */
void sb_list_reflected(sb_list_builder *lists, const sb_hits *hits, sb_sim *sim, size_t i);
/* The same for boundary particles; candidates have the form of sb_pairs.index. */
void sb_list_walls(sb_list_builder *lists, const sb_hits *hits, sb_sim *sim, size_t i);
/* Appends the runs of records around a group. */
void sb_list_runs(sb_list_builder *lists, const sb_vicinity *v, sb_group *group);
void sb_list_builder_free(sb_list_builder *lists);

#endif
