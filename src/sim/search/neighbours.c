#include "sim/passes/passes.h"
#include "sim/step/stages.h"

sb_status sb_stage_neighbours(sb_sim *sim, sb_error *error)
{
    return sim->passes->neighbours(sim, error);
}
