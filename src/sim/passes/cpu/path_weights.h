/* Weights of paths: the parts that the facets have of a path by way of reflections, without what other facets hide or
   block (docs/method.md, section 7). The weight of a path between i and j is the same seen from either end. */
#ifndef SB_SIM_CPU_PATH_WEIGHTS_H
#define SB_SIM_CPU_PATH_WEIGHTS_H

#include "sim/passes/cpu/path_parts.h"

/* Parts of the weight of a path by facet, and their product. */
typedef struct sb_weight_parts {
    size_t count, facet[2 * SB_REFLECTIONS_MAX + 1];
    sb_weight part[2 * SB_REFLECTIONS_MAX + 1];
    float value;
} sb_weight_parts;

/* Multiplies by the part that a facet has. */
SB_INLINE void sb_take_part(sb_weight_parts *all, size_t facet, sb_weight part)
{
    all->facet[all->count] = facet;
    all->part[all->count++] = part;
    all->value *= part.value;
}

/* What hides or blocks a path by reflections at right angles, after the parts of its facets. */
void sb_finish_path(const sb_weigher *w, const size_t *by, int count, sb_f4 source, sb_f4 image, bool meets,
                    sb_weight_parts *all);

/* Weight of a path by any facets. Facets that face each other are met one after the other; others in any order,
   with the share of sb_path_order_share. */
void sb_path_weight(const sb_weigher *w, const size_t *by, int count, sb_f4 source, sb_f4 image, sb_weight_parts *all);

#endif
