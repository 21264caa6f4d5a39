#include "sim/report/report.h"

#include "sim/foam/foam.h"

void sb_report_update(sb_sim *sim)
{
    sb_step_report *report = &sim->report;
    const sb_state *state = &sim->state;
    report->step = state->step;
    report->time = state->time;
    report->time_step = state->time_step;
    report->iterations = state->sweeps;
    report->max_speed = state->max_speed;
    report->fluid_count = sim->work.everywhere;
    report->left_domain = state->left_domain;
    report->lost = state->lost;
    sb_foam_count(sim->foam, report->foam);
}

const sb_step_report *sb_sim_report(const sb_sim *sim)
{
    return &sim->report;
}

/* Appends a line to the list of skipped parts. passes: per step, over all pairs; bytes: per particle. */
static void skip(sb_sim *sim, size_t *count, const char *what, int passes, size_t bytes)
{
    if (*count < SB_SIM_SKIPPED_MAX)
        sim->skipped[(*count)++] = (sb_skipped){what, passes, bytes * sim->model->fluid_count};
}

void sb_report_skipped(sb_sim *sim)
{
    enum { CORRECTION_PASSES = 3 }; /* moments, their mean, the force */
    const sb_numerics *n = &sim->scene->numerics;
    size_t s = 0;
    if (!sim->needs.viscosity)
        skip(sim, &s,
             sim->constant.viscosity > 0
                 ? "viscosity: the fluid's is faint beside the hyperviscosity, no pass over particle pairs"
                 : "viscosity: both coefficients are 0, no pass over particle pairs",
             1, 0);
    if (!sim->needs.hyperviscosity)
        skip(sim, &s, "hyperviscosity: off, no passes over particle pairs for it", 2,
             sb_work_cost(&sim->needs, "differences"));
    if (!sim->needs.stress_correction)
        skip(sim, &s, "stress correction: off, no passes over particle pairs for it", CORRECTION_PASSES, 0);
    if (!sim->needs.packing_strain)
        skip(sim, &s, "strain of the packing: off, no passes over particle pairs for it", CORRECTION_PASSES,
             sb_work_cost(&sim->needs, "strained"));
    if (!sim->needs.turbulence)
        skip(sim, &s,
             sim->needs.eddy ? "turbulence: none, no strain rates"
                             : "turbulence: none, no strain rates and no memory for eddy viscosities",
             1, sim->needs.eddy ? 0 : sb_work_cost(&sim->needs, "eddy"));
    if (!sim->needs.implicit) skip(sim, &s, "pressure solve: none, the equation of state gives the pressure", 0, 0);
    if (!sim->needs.density_correction)
        skip(sim, &s, "density correction: off (density: summed), no memory for it", 0,
             sizeof *sim->state.density_correction);
    if (!sim->needs.surface_tension)
        skip(sim, &s, "surface tension: the coefficient is 0, no grid of nodes", 0, sb_work_cost(&sim->needs, "pull"));
    if (!(n->wall_friction > 0)) skip(sim, &s, "wall friction: the coefficient is 0", 0, 0);
    if (!sim->needs.wall_shear)
        skip(sim, &s, n->wall_shear == SB_SHEAR_NONE ? "wall shear: none" : "wall shear: the fluid has no viscosity", 0,
             sb_work_cost(&sim->needs, "wall_drag"));
    if (!sim->space.repeats) skip(sim, &s, "periodic sides: none, no ghost particles", 0, 0);
    if (sim->walls.moving_count == 0) skip(sim, &s, "moving walls: no body moves", 0, 0);
    if (sim->constant.dimension == 2) skip(sim, &s, "third dimension: 2D scene, 9 cells searched instead of 27", 0, 0);
    if (!sim->needs.direction)
        skip(sim, &s, "search direction: no memory, the solver does not use one", 0,
             sb_work_cost(&sim->needs, "direction"));
    if (!sim->needs.product)
        skip(sim, &s, "product with the search direction: no memory, the solver does not use one", 0,
             sb_work_cost(&sim->needs, "product"));
    if (!sim->needs.settling)
        skip(sim, &s, "settling: settle_steps is 0, the water starts from the initial lattice", 0, 0);
    if (!sim->needs.foam)
        skip(sim, &s, "foam: off, no spray, foam and bubbles", 1,
             sb_work_cost(&sim->needs, "surface") + sb_work_cost(&sim->needs, "emission"));
    sim->skipped[s] = (sb_skipped){.what = NULL};
}

size_t sb_sim_stages(const sb_sim *sim, const sb_stage_time **stages)
{
    *stages = sim->stage;
    return sim->stage_count;
}

const sb_skipped *sb_sim_skipped(const sb_sim *sim)
{
    return sim->skipped;
}
