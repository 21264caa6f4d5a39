/* Faces between two parts of the grid (sb_offshore_jump). Private to src/offshore. */
#ifndef SB_OFFSHORE_JUMP_H
#define SB_OFFSHORE_JUMP_H

#include "offshore/state.h"

/* jump_flux.c: after a stage, sets the fluxes beside the faces that each part has with the wave. */
void sb_offshore_jump_fluxes(sb_offshore *offshore, const sb_offshore_update *update);

/* The jump is no breaking wave. */
void sb_offshore_jump_breaking(const sb_offshore *offshore);

/* The system for the pressure beside the faces, where each part continues beyond the face as if there were no jump:
   before its faces are scaled. Then the forces there. */
void sb_offshore_jump_system(const sb_offshore *offshore, const sb_offshore_level *level, double ahead);
void sb_offshore_jump_forces(const sb_offshore *offshore);

#endif
