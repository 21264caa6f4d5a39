/* The virial pressure, which probes and particle files contain (docs/method.md, M17a). The solver pressure p = rho^2 q
   keeps the density. The pressure that a particle's neighbours exert on it is the virial of the pairs
   [Irving & Kirkwood 1950], half of each pair's to either particle, pairs with walls included:

       P_i = -(rho_0 / 2d) [sum_j m (q_i + q_j) x_ij . grad W_ij + q_i sum_b psi_b x_ib . grad W_ib]

   Under a uniform pressure P is p times the packing trace, which is below 1 in settled water. P has half of the scatter
   of p, which alternates from particle to particle. The momentum balance contains P, not p. */
#include "sim/exchange/exchange.h"
#include "sim/passes/passes.h"

void sb_sim_find_virial_pressures(sb_sim *sim)
{
    if (sim->needs.wcsph) return; /* the equation of state gives the pressures */
    if (!sim->work.lists_current || sim->work.virial_known) return;
    /* The pass moves all particles back to where they were when the lists were made. */
    sb_refresh_owners(sim, (sb_f4 *)sim->state.position);
    sb_refresh_owners(sim, sim->state.velocity);
    sb_work_enter(&sim->work, SB_PHASE_AFTER);
    sim->passes->virial(sim);
    sim->work.virial_known = true;
}
