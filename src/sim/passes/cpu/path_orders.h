/* Orders of reflection at facets that meet at other than right angles. The angle round the line in which two facets
   meet is divided among the images: the particles have the weight 1, then those by one reflection, by two, and so on,
   until they fill the angle (docs/method.md, section 7). */
#ifndef SB_SIM_CPU_PATH_ORDERS_H
#define SB_SIM_CPU_PATH_ORDERS_H

#include "sim/passes/cpu/edges.h"
#include "sim/search/pairs.h"

/* The share that one order of reflections has of a path, and its derivatives by the two ends, in parts by facet: the
   sum of both parts of a facet is along its normal. */
typedef struct sb_path_share {
    float value;
    int facets, at[SB_REFLECTIONS_MAX]; /* of these places in the order; none if the share does not change */
    sb_f4 own[SB_REFLECTIONS_MAX], other[SB_REFLECTIONS_MAX];
} sb_path_share;

/* The share of a path from `source` to `self` by the facets by[], in this order. Returns false if it is 0. */
bool sb_path_order_share(const sb_near *near, const size_t *by, int count, sb_f4 self, sb_f4 source,
                         sb_path_share *out);

#endif
