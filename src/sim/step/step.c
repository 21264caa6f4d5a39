/* The time step as a table: one row per stage, and one loop that runs and times the stages. */
#include "base/clock.h"
#include "sim/pressure/pressure.h"
#include "sim/step/stages.h"
#include "sim/terms/density_correction.h"
#include "sim/terms/stress_correction.h"
#include "sim/terms/turbulence.h"

typedef struct stage {
    const char *name;
    sb_status (*run)(sb_sim *sim, sb_error *error);
    bool (*needed)(const sb_scene *scene); /* NULL: always */
} stage;

static const stage stages[] = {
    {"time_step", sb_stage_time_step, NULL},   /* dt from the present speeds */
    {"walls", sb_stage_walls, NULL},           /* paddles at t, their velocity to t + dt */
    {"sort", sb_stage_sort, NULL},             /* wrap at periodic sides; Z-order, cells */
    {"ghosts", sb_stage_ghosts, NULL},         /* images beyond periodic sides */
    {"neighbours", sb_stage_neighbours, NULL}, /* lists, density, wall vectors, diagonal */
    {"density_correction", sb_stage_density_correction,
     sb_density_correction_on}, /* density sums at surfaces and walls */
    {"stress_correction", sb_stage_stress_correction,
     sb_stress_correction_on},                             /* removes deviatoric stress of the particle packing */
    {"turbulence", sb_stage_turbulence, sb_turbulence_on}, /* eddy viscosity from the strain rate */
    {"forces", sb_stage_forces, NULL},                     /* v* = v + dt (g + viscosity + friction) */
    {"source", sb_stage_source, NULL},                     /* b = beta (rho_0 - rho) - dt div v* */
    {"pressure", sb_stage_pressure, NULL},                 /* q >= 0, A q <= b, and its acceleration */
    {"accelerate", sb_stage_accelerate, NULL},             /* v at t + dt */
    {"impulse", sb_stage_impulse, NULL},                   /* contact with walls, reactions on bodies */
    {"move", sb_stage_move, NULL},                         /* x at t + dt */
};
enum { STAGES = sizeof stages / sizeof stages[0] };
_Static_assert((int)STAGES <= (int)SB_STAGES_MAX, "stage table");

#ifdef SB_DEBUG
/* Debug builds check after every stage that all numbers are finite. */
static sb_status check_finite(const sb_sim *sim, const char *stage_name, sb_error *error)
{
    for (size_t i = 0; i < sim->n; i++)
        for (int axis = 0; axis < 4; axis++)
            if (!isfinite(sim->velocity[i][axis]))
                return sb_fail(error, SB_FAILED, "step %llu: stage %s left particle %u without a finite velocity",
                               (unsigned long long)sim->report.step, stage_name, sim->id[i]);
    return SB_OK;
}
#endif

sb_status sb_sim_step(sb_sim *sim, sb_error *error)
{
    const stage *run[STAGES];
    size_t count = 0;
    sim->lists_current = sim->virial_known = false;
    for (size_t s = 0; s < STAGES; s++) {
        if (stages[s].needed && !stages[s].needed(sim->scene)) continue;
        sim->stage[count].name = stages[s].name;
        run[count++] = &stages[s];
    }
    sim->stage_count = count;
    for (size_t s = 0; s < count; s++) {
        double start = sb_clock();
        sb_status status = run[s]->run(sim, error);
        sim->stage[s].seconds += sb_clock() - start;
        sim->stage[s].calls++;
        if (status != SB_OK) return status;
#ifdef SB_DEBUG
        status = check_finite(sim, run[s]->name, error);
        if (status != SB_OK) return status;
#endif
    }
    sim->lists_current = true;
    return SB_OK;
}
