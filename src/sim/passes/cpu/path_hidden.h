/* Which part of a path facets hide that have water on both sides (docs/method.md, section 7). */
#ifndef SB_SIM_CPU_PATH_HIDDEN_H
#define SB_SIM_CPU_PATH_HIDDEN_H

#include "sim/passes/cpu/path_parts.h"

/* Whether two facets of a path meet at another than a right angle. */
SB_INLINE bool sb_is_crooked(const sb_near *near, const size_t *by, int count)
{
    bool crooked = false;
    for (int k = 1; k < count; k++)
        for (int m = 0; m < k; m++) crooked |= sb_facets_crooked(near, by[k], by[m]);
    return crooked;
}

/* Part of the path from the particle to `source`, unfolded to a straight line to `image` by reflections at the `count`
   facets by[] at right angles, that no facet hides which has water on both sides and meets these facets. *by_facet: the
   facet that hides most, SIZE_MAX if none does. */
sb_weight sb_past_facets(const sb_weigher *w, const size_t *by, int count, sb_f4 source, sb_f4 image, size_t *by_facet);

#endif
