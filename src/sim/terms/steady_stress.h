/* The steady part of the stress correction (docs/method.md, M15g; docs/decisions/0060). Water at rest is in balance
   with the stress of its particle packing, and its correction would only stir it. Each particle therefore keeps the
   mean of its S_i over the time stress_memory sqrt(D/g), and what is corrected is the deviation from it. Waves pass in
   less time, so that nearly all of their stress is corrected. A run begins with the S_i of the settled water as its
   mean (docs/decisions/0095). */
#ifndef SB_SIM_STEADY_STRESS_H
#define SB_SIM_STEADY_STRESS_H

#include "sim/simulation.h"

/* The part of the mean that is taken from the present stress, q over the mean of q, at most 1: where the pressure has
   fallen, the packing carries as much less. */
static inline float sb_steady_part(float q, float mean)
{
    return q >= mean ? 1 : q > 0 ? q / mean : 0;
}

/* Brings the means up to date with the present S_i (work.stress, work.stress_xx), and takes them from it. Nothing
   happens where sb_needs has no steady_stress. */
void sb_steady_stress_take(sb_sim *sim);

/* Sets the means of a new particle, entry i, to 0. */
void sb_steady_stress_clear(sb_state *state, size_t i);

#endif
