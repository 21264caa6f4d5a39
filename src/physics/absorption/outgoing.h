/* The law by which a boundary lets waves out: from what is measured some distance inside to the motion of the water at
   the boundary. Time is that of the wave; x inwards. */
#ifndef SB_PHYSICS_OUTGOING_H
#define SB_PHYSICS_OUTGOING_H

/* With r = u - 2 sqrt(g h) that the wave adds to the water inside, a mean with the weight 1 + cos(pi s / distance) over
   |s| < distance: y + lag y' + inertia y'' = r. At the boundary, the mean velocity inwards of the wave is
   (y + lead y'')/2. */
typedef struct sb_outgoing_law {
    double lag;     /* s, > 0 */
    double inertia; /* s^2, > 0 */
    double lead;    /* s^2, >= 0 */
} sb_outgoing_law;

/* The law with which no wave comes back that is long, or has kh = 1.2; with a distance of half a depth at most 1 %
   comes back of waves between them (docs/decisions/0096). With distances above 0.83 depths, k * distance = 1 takes the
   place of kh = 1.2, and above 0.95 depths the lead would be negative: it is 0, and long waves remain. depth and
   distance in m, gravity in m/s^2, > 0. late: s, age of what is measured, less than distance/sqrt(g depth). */
sb_outgoing_law sb_outgoing_law_make(double depth, double distance, double late, double gravity);

#endif
