/* Images of the records around a group, reflected at walls: further candidates of the neighbour search. A pair with an
   image is a path from one particle to another by way of reflections; its length is the distance to the image. */
#ifndef SB_SIM_CPU_IMAGES_H
#define SB_SIM_CPU_IMAGES_H

#include "sim/passes/cpu/cull.h"
#include "sim/passes/cpu/edges.h"
#include "sim/passes/cpu/lists.h"
#include "sim/passes/cpu/routes.h"
#include "sim/walls/mirrors.h"

/* How the weight of one path changes with the places of its ends, by one facet: the derivatives by x_i and x_j in
   1/quanta. hit: of the image, or with `direct` of the particle. */
typedef struct sb_weight_slope {
    sb_f4 own, other;
    uint32_t hit, facet;
    bool direct;
} sb_weight_slope;

/* A particle's place relative to the facets and their edges. */
typedef struct sb_standing {
    uint64_t behind; /* as sb_images_around.behind */
    float above[SB_NEAR_MAX];
    uint32_t edge[SB_NEAR_MAX];
    sb_half_angle angle[SB_NEAR_EDGES_MAX]; /* by edge */
} sb_standing;

enum { SB_WEIGHT_SLOPES_MAX = 4096, SB_HALF_ANGLES_MAX = 131072 };
#define SB_ANGLES_UNKNOWN UINT32_MAX

/* Images around a group: that of candidate count + k of the vicinity is of candidate source[k]. */
typedef struct sb_images_around {
    sb_near near;
    sb_cull cull;
    sb_sources sources; /* of one cell, while images are gathered */
    sb_relations relations;
    uint32_t source[SB_AROUND_MAX + SB_HIT_SPARE];
    uint32_t path[SB_AROUND_MAX + SB_HIT_SPARE];
    bool whole[SB_AROUND_MAX + SB_HIT_SPARE]; /* one reflection, with no edge near its paths */
    /* Of an image by one reflection: the original's distance before the facet; and, known when needed, the edge of the
       facet that it is farthest beyond or nearest to, and where its positions about the facet's edges begin. */
    float above[SB_AROUND_MAX + SB_HIT_SPARE];
    uint32_t edge[SB_AROUND_MAX + SB_HIT_SPARE], angles[SB_AROUND_MAX + SB_HIT_SPARE];
    size_t angle_count;
    sb_half_angle angle[SB_HALF_ANGLES_MAX];
    uint64_t behind[SB_AROUND_MAX + SB_HIT_SPARE]; /* of a record, unless near.simple: the facets that it is behind */
    uint64_t parts;                                /* the facets with water on both sides */
    /* The images that lists refer to, in the order of their first use, and the number of each; UINT32_MAX: none. */
    uint32_t used, listed[SB_AROUND_MAX + SB_HIT_SPARE], number[SB_AROUND_MAX + SB_HIT_SPARE];
    sb_standing standing; /* of the present particle */
    size_t slopes;        /* of the present particle; above SB_WEIGHT_SLOPES_MAX: too many */
    sb_weight_slope slope[SB_WEIGHT_SLOPES_MAX];
} sb_images_around;

/* Adds the images to the candidates. Returns false if there are too many. */
bool sb_images_gather(const sb_sim *sim, const sb_group *group, sb_vicinity *v, sb_images_around *images);

/* Weights of paths from the particle at `self` (from the group's corner), as the root of each hit: for hits of
   particles the part that no wall hides (first, for each particle), for hits of images that of their path. The latter
   have 1 as their roots before, or 0 where no weight is needed. */
void sb_images_weigh(const sb_sim *sim, const sb_vicinity *v, sb_images_around *images, sb_f4 self, sb_hits *hits);
void sb_images_weigh_direct(const sb_sim *sim, sb_images_around *images, sb_f4 self, sb_hits *hits);

/* Gives the hits of images the candidates that they have in lists, which refer only to images in use. */
void sb_images_number(const sb_vicinity *v, sb_images_around *images, sb_hits *hits);

/* Appends those images that the lists of the group refer to, and the planes of all facets near it, at which contact is
   resolved. images: NULL without images. */
void sb_list_images(sb_list_builder *lists, const sb_vicinity *v, sb_images_around *images, sb_group *group);

#endif
