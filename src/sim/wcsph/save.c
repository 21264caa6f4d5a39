#include "sim/state/gather.h"
#include "sim/wcsph/wcsph.h"

#include <math.h>

void sb_wcsph_save(const sb_sim *sim, sb_archive_out *out)
{
    if (!sim->needs.wcsph) return;
    sb_shares shares;
    sb_gather_begin(sim, &shares, out);
    sb_gather_list(&shares, out, sim->state.excess, sizeof *sim->state.excess);
    sb_gather_end(&shares, out);
    if (sb_ranks_own(sim->ranks) > 0) return;
    sb_put_list(out, sim->walls.boundary.excess, sim->walls.boundary.count, sizeof *sim->walls.boundary.excess);
}

/* Refuses densities that are not finite and above 0. */
static void check(const sb_sim *sim, const char *of, bool may_be_dry, const float *excess, size_t count,
                  sb_archive_in *in)
{
    for (size_t k = 0; k < count; k++)
        if (isinf(excess[k]) || excess[k] <= -sim->constant.rest_density || (!may_be_dry && isnan(excess[k]))) {
            sb_archive_refuse(in, "density of %s %zu is %g kg/m^3, expected a finite value above 0", of, k,
                              (double)(sim->constant.rest_density + excess[k]));
            return;
        }
}

void sb_wcsph_load(sb_sim *sim, sb_archive_in *in)
{
    if (!sim->needs.wcsph) return;
    sb_take_part(sim, in, sim->state.excess, sizeof *sim->state.excess);
    sb_take_list(in, sim->walls.boundary.excess, sim->walls.boundary.count, sizeof *sim->walls.boundary.excess);
    check(sim, "particle", false, sim->state.excess, sim->state.n, in);
    /* NAN: dry */
    check(sim, "boundary particle", true, sim->walls.boundary.excess, sim->walls.boundary.count, in);
}
