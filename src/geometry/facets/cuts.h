/* Cuts outlines along the lines in which surfaces of other bodies cross them. */
#ifndef SB_GEOMETRY_CUTS_H
#define SB_GEOMETRY_CUTS_H

#include "geometry/facets/outlines.h"

/* Cuts each outline along the planes of those outlines of another body that cross it, or end within `reach` (m) before
   it, and bend from it by less than `bend` (cosine of the angle between the normals). Lines shorter than `near` (m),
   and parts narrower than `near`, do not count. Corners stay in order. Returns 0, or -1 without memory. */
int sb_outlines_cut(sb_outlines *outlines, const sb_outlines *by, double bend, double near, double reach);

#endif
