/* The time step as a table: one row per stage, and one loop that runs and times the stages. */
#include "base/clock.h"
#include "sim/exchange/exchange.h"
#include "sim/foam/foam.h"
#include "sim/report/report.h"
#include "sim/sea/strip.h"
#include "sim/step/stages.h"
#include "sim/terms/density_correction.h"
#include "sim/terms/hyperviscosity.h"
#include "sim/terms/packing_strain.h"
#include "sim/terms/sponge.h"
#include "sim/terms/stress_correction.h"
#include "sim/terms/surface_tension.h"
#include "sim/terms/turbulence.h"
#include "sim/walls/pushes.h"
#include "sim/wcsph/boundary.h"
#include "sim/wcsph/wcsph.h"

typedef struct stage {
    const char *name;
    sb_phase phase; /* the first of its phases */
    sb_status (*run)(sb_sim *sim, sb_error *error);
    size_t needed; /* flag of sb_needs, or SB_ALWAYS */
    int halves;    /* of an explicit step that have it; an implicit step has no halves and runs them all */
} stage;

enum {
    FIRST = 1,
    SECOND = 2,
    BOTH = FIRST | SECOND,
    IMPLICIT = 4 /* no half of an explicit step has it */,
    ALL = BOTH | IMPLICIT
};

static const stage stages[] = {
    /* dt from the present speeds */
    {"time_step", SB_PHASES, sb_stage_time_step, SB_ALWAYS, FIRST},
    /* paddles at t, their velocity to t + dt */
    {"walls", SB_PHASES, sb_stage_walls, SB_ALWAYS, FIRST},
    /* outgoing waves at sides of kind sea; particles that come in */
    {"inflow", SB_PHASES, sb_stage_inflow, SB_NEEDS(sea), IMPLICIT},
    /* wrap at periodic sides; Z-order, cells */
    {"sort", SB_PHASE_SORT, sb_stage_sort, SB_ALWAYS, BOTH},
    /* images beyond periodic sides */
    {"ghosts", SB_PHASE_GHOSTS, sb_stage_ghosts, SB_ALWAYS, BOTH},
    /* lists, density, wall vectors, diagonal */
    {"neighbours", SB_PHASE_NEIGHBOURS, sb_stage_neighbours, SB_ALWAYS, BOTH},
    /* wcsph: densities of the continuity equation */
    {"densities", SB_PHASES, sb_stage_wcsph_densities, SB_NEEDS(wcsph), BOTH},
    /* wcsph: pressures of boundary particles, and rates of their densities */
    {"boundary", SB_PHASES, sb_stage_boundary, SB_NEEDS(dynamic_walls), BOTH},
    /* density sums at surfaces and walls */
    {"density_correction", SB_PHASE_DENSITY_CORRECTION, sb_stage_density_correction, SB_NEEDS(density_correction),
     IMPLICIT},
    /* particles of the strips of given water */
    {"held", SB_PHASES, sb_stage_held, SB_NEEDS(sea), IMPLICIT},
    /* density sums of a strained particle packing */
    {"packing_strain", SB_PHASE_STRAIN, sb_stage_packing_strain, SB_NEEDS(packing_strain), IMPLICIT},
    /* removes deviatoric stress of the particle packing */
    {"stress_correction", SB_PHASE_DEVIATOR, sb_stage_stress_correction, SB_NEEDS(stress_correction), IMPLICIT},
    /* eddy viscosity from the strain rate */
    {"turbulence", SB_PHASE_TURBULENCE, sb_stage_turbulence, SB_NEEDS(turbulence), BOTH},
    /* adds the viscosity of sponges */
    {"viscous_sponge", SB_PHASE_TURBULENCE, sb_stage_viscous_sponge, SB_NEEDS(viscous_sponge), BOTH},
    /* v* = v + dt (g + viscosity + friction + hydrostatic push of images) */
    {"forces", SB_PHASE_FORCES, sb_stage_forces, SB_ALWAYS, BOTH},
    /* v* += dt (damping of motion of the scale of the spacing) */
    {"hyperviscosity", SB_PHASES, sb_stage_hyperviscosity, SB_NEEDS(hyperviscosity), IMPLICIT},
    /* v* += dt (surface tension) */
    {"surface_tension", SB_PHASES, sb_stage_surface_tension, SB_NEEDS(surface_tension), IMPLICIT},
    /* slows water down */
    {"sponge", SB_PHASES, sb_stage_sponge, SB_NEEDS(sponge), BOTH},
    /* their velocity and pressure */
    {"hold", SB_PHASES, sb_stage_hold, SB_NEEDS(sea), IMPLICIT},
    /* b = beta (rho_0 - rho) - dt div v* */
    {"source", SB_PHASE_SOURCE, sb_stage_source, SB_NEEDS(implicit), IMPLICIT},
    /* q >= 0, A q <= b, and its acceleration */
    {"pressure", SB_PHASE_PRESSURE, sb_stage_pressure, SB_NEEDS(implicit), IMPLICIT},
    /* wcsph: acceleration by the pressure, rates of the densities */
    {"rates", SB_PHASE_PRESSURE, sb_stage_wcsph_rates, SB_NEEDS(wcsph), BOTH},
    /* wcsph: the middle of the step */
    {"predict", SB_PHASES, sb_stage_wcsph_predict, SB_NEEDS(wcsph), FIRST},
    /* wcsph: densities at t + dt, from those at t */
    {"correct", SB_PHASES, sb_stage_wcsph_correct, SB_NEEDS(wcsph), SECOND},
    /* wcsph: forces on bodies by the pressures of boundary particles */
    {"boundary_forces", SB_PHASES, sb_stage_boundary_forces, SB_NEEDS(dynamic_walls), SECOND},
    /* v at t + dt */
    {"accelerate", SB_PHASE_ACCELERATE, sb_stage_accelerate, SB_ALWAYS, SECOND},
    /* contact with walls, reactions on bodies */
    {"impulse", SB_PHASE_IMPULSE, sb_stage_impulse, SB_ALWAYS, SECOND},
    /* what has held them */
    {"book", SB_PHASES, sb_stage_book, SB_NEEDS(sea), IMPLICIT},
    /* what sponges have taken */
    {"drained", SB_PHASES, sb_stage_drained, SB_NEEDS(sponge), SECOND},
    /* work of surface tension */
    {"surface_work", SB_PHASES, sb_stage_surface_work, SB_NEEDS(surface_tension), IMPLICIT},
    /* spray, foam and bubbles, which nothing else reads */
    {"foam", SB_PHASE_FOAM, sb_stage_foam, SB_NEEDS(foam), IMPLICIT},
    /* wcsph: velocities at t, for the ledger; pressures at t + dt */
    {"finish", SB_PHASES, sb_stage_wcsph_finish, SB_NEEDS(wcsph), SECOND},
    /* x at t + dt */
    {"move", SB_PHASE_MOVE, sb_stage_move, SB_ALWAYS, SECOND},
};
enum { STAGES = sizeof stages / sizeof stages[0] };
_Static_assert((int)STAGES <= (int)SB_STAGES_MAX, "stage table");

#ifdef SB_DEBUG
/* Debug builds check after every stage that all numbers are finite. */
static sb_status check_finite(const sb_sim *sim, const char *stage_name, sb_error *error)
{
    for (size_t i = 0; i < sim->state.n; i++)
        for (int axis = 0; axis < 4; axis++)
            if (!isfinite(sim->state.velocity[i][axis]))
                return sb_fail(error, SB_FAILED, "step %llu: stage %s left particle %u without a finite velocity",
                               (unsigned long long)sim->state.step, stage_name, sim->state.id[i]);
    return SB_OK;
}
#endif

/* Runs the stages that have one of these. */
static sb_status run_stages(sb_sim *sim, int halves, sb_error *error)
{
    sb_status status = SB_OK;
    sb_phase phase = SB_PHASES; /* the last that has begun; two stages may share one */
    size_t count = 0;
    for (size_t s = 0; s < STAGES && status == SB_OK; s++) {
        if (!sb_needed(&sim->needs, stages[s].needed)) continue;
        sb_stage_time *time = &sim->stage[count++];
        time->name = stages[s].name;
        if (!(stages[s].halves & halves)) continue;
        const double start = sb_clock();
        if (stages[s].phase != SB_PHASES && stages[s].phase != phase) {
            phase = stages[s].phase;
            sb_work_enter(&sim->work, phase);
        }
        sb_status own = stages[s].run(sim, error);
#ifdef SB_DEBUG
        if (own == SB_OK) own = check_finite(sim, stages[s].name, error);
#endif
        status = sim->exchange->agree(sim, own, error);
        time->seconds += sb_clock() - start;
        time->calls++;
    }
    sim->stage_count = count > sim->stage_count ? count : sim->stage_count;
    return status;
}

sb_status sb_sim_step(sb_sim *sim, sb_error *error)
{
    sim->work.lists_current = sim->work.virial_known = false;
    sb_pushes_clear(sim->pushes);
    sb_status status = run_stages(sim, sim->needs.wcsph ? FIRST : ALL, error);
    if (sim->needs.wcsph && status == SB_OK) status = run_stages(sim, SECOND, error);
    sim->work.lists_current = status == SB_OK;
    sb_report_update(sim);
    return status;
}
