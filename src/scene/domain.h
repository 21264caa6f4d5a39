/* The domain of a scene and its sides. */
#ifndef SB_SCENE_DOMAIN_H
#define SB_SCENE_DOMAIN_H

#include "base/vec.h"

enum { SB_NAME_MAX = 64 };

typedef enum sb_side_kind { SB_SIDE_WALL, SB_SIDE_OPEN, SB_SIDE_PERIODIC, SB_SIDE_SEA } sb_side_kind;
enum { SB_X_MIN, SB_X_MAX, SB_Y_MIN, SB_Y_MAX, SB_Z_MIN, SB_Z_MAX, SB_SIDES };

typedef struct sb_domain {
    sb_vec3 min, max;            /* m */
    sb_side_kind side[SB_SIDES]; /* periodic: pairs along x or y; sea: not along z */
} sb_domain;

/* Place along a horizontal direction at which the domain ends, m. */
static inline double sb_domain_end(const sb_domain *domain, sb_vec3 direction)
{
    return direction.x * (direction.x > 0 ? domain->max.x : domain->min.x) +
           direction.y * (direction.y > 0 ? domain->max.y : domain->min.y);
}

/* How far a body may move against a horizontal direction until it is at the side of the domain, m. front, back: where
   it ends along the direction, m. A body that ends at the side or beyond it may move its front up to there. */
static inline double sb_domain_room(const sb_domain *domain, sb_vec3 direction, double front, double back)
{
    const double end = sb_domain_end(domain, sb_scale(direction, -1));
    return end + back > 0 ? end + back : fmax(end + front, 0);
}

#endif
