/* Surface tension against air (docs/method.md, section 6; docs/decisions/0059): the stress of a stretched surface,

       f = div T,   T = sigma (|grad phi| 1 - grad phi (x) grad phi / |grad phi|)

   which is the force sigma kappa grad phi of [T19, eq. 15] in the form of a divergence. phi, 1 in water and 0 in air,
   is the volume of the particles on a grid of nodes. The forces of all nodes sum to 0, and each is divided among the
   particles around it, so that momentum is conserved. Walls are not wetted: water meets them as it meets air. */
#ifndef SB_SIM_SURFACE_TENSION_H
#define SB_SIM_SURFACE_TENSION_H

#include "sim/simulation.h"

/* Memory of the term: values per node. */
enum { SB_TENSION_VALUES = 11 };

/* Stage. Adds dt times the acceleration by surface tension to v*, and leaves the acceleration in sim->work.pull.
   SB_FAILED without memory. */
sb_status sb_stage_surface_tension(sb_sim *sim, sb_error *error);
/* Stage. Sums the work of that into sim->work, before particles move. Never fails. */
sb_status sb_stage_surface_work(sb_sim *sim, sb_error *error);

/* The tension of a plane surface of the grid over the scene's: the mean over its places between nodes. 1 but for the
   gradients that the stress leaves out as noise. */
double sb_tension_of_plane(void);

#endif
