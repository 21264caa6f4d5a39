/* Paths that are blocked by a facet which they do not meet. */
#ifndef SB_SIM_CPU_PATH_BLOCKED_H
#define SB_SIM_CPU_PATH_BLOCKED_H

#include "sim/passes/cpu/path_parts.h"

/* Whether a facet other than the two given blocks the way from a to b. */
bool sb_way_blocked(const sb_weigher *w, sb_f4 a, sb_f4 b, size_t skip, size_t other);

/* Whether a facet blocks the path by one reflection at facet a, which meets the facet itself, on its way there or back.
 */
bool sb_bounce_blocked(const sb_weigher *w, size_t a, sb_f4 source, sb_f4 image);

#endif
