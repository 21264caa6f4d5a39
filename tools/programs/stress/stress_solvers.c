/* Stress cases of time steps and tolerances far from the defaults, for every solver. */
#include "stresses.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *const solvers[] = {"jacobi", "chebyshev", "cg"};
enum { SOLVERS = sizeof solvers / sizeof *solvers };

/* Time at which the collapse is compared: the water has not yet broken up. */
static const double moment = 0.25; /* s */

/* kept: potential energy at that time, and that of the step before. */
enum { AT_MOMENT, BEFORE, IS_KNOWN };

static void watch(sb_driven *d)
{
    const double time = sb_sim_report(d->sim)->time, now = sb_sim_energy(d->sim).potential;
    if (time >= moment && !(d->kept[IS_KNOWN] > 0)) {
        const double before = d->kept[BEFORE] > 0 ? d->kept[BEFORE] : d->first.potential;
        d->kept[AT_MOMENT] = before + (now - before) * (moment - d->last_time) / (time - d->last_time);
        d->kept[IS_KNOWN] = 1;
    }
    d->kept[BEFORE] = now;
}

static void finish(sb_driven *d, sb_json *figures)
{
    double warnings = 0;
    for (size_t w = 0; w < d->model.warning_count; w++)
        warnings += strstr(d->model.warnings[w], "time_step_factor") != NULL;
    sb_json_number(figures, "fallen_J", d->first.potential - d->kept[AT_MOMENT]);
    sb_json_number(figures, "told", warnings);
}

static const sb_drive drive = {.watch = watch, .close = finish};

static const double steps[] = {0.25, 0.5, 1, 2, 4};
enum { STEPS = sizeof steps / sizeof *steps };

static void plan_steps(sb_trials *trials, bool quick)
{
    for (int s = 0; s < SOLVERS; s++)
        for (int k = 0; k < STEPS; k++) {
            if (quick && (s != 1 || k == 1 || k == 4)) continue;
            sb_trial *t = sb_trial_add(trials, "collapse.yaml", "%s-dt-x%g", solvers[s], steps[k]);
            sb_trial_set(t, "numerics.solver=%s", solvers[s]);
            sb_trial_set(t, "numerics.time_step_factor=%.9g", sb_trial_default(2, "time_step_factor") * steps[k]);
            sb_trial_set(t, "numerics.cfl=%.9g", fmin(1, sb_trial_default(2, "cfl") * steps[k]));
            sb_trial_drive(t, &drive, steps[k]);
            if (steps[k] > 1) t->may_lose = 0.01; /* a run warns of such steps */
            if (steps[k] > 2) t->ends |= SB_ENDS_REFUSED;
        }
}

/* Compares the loss of potential energy at that time with that of the shortest step of the same solver. */
static void judge_steps(sb_judged *j)
{
    const sb_outcome *o = &j->outcome;
    char name[SB_TRIAL_NAME];
    if (o->how == SB_ENDS_REFUSED) {
        sb_note(j, "refused: %.180s", o->last_line);
        return;
    }
    snprintf(name, sizeof name, "%.*s-dt-x0.25", (int)strcspn(j->trial->name, "-"), j->trial->name);
    const sb_judged *finest = sb_judged_find(j, name);
    const double fine = finest ? sb_outcome_number(&finest->outcome, "fallen_J") : (double)NAN;
    const double off = sb_outcome_number(o, "fallen_J") / fine - 1;
    sb_note(j, "fall %+.2f %% relative to the shortest step", 100 * off);
    sb_note(j, "%.1f sweeps", sb_outcome_number(o, "mean_iterations"));
    sb_note(j, "remaining density error %.1e", sb_outcome_number(o, "mean_density_error"));
    if (sb_outcome_number(o, "told") > 0) sb_note(j, "a warning reports that the step is too long");
    sb_require(j, fabs(off) <= 0.01 * j->trial->number, "differs by more than 1 %% per default step");
    sb_require(j, sb_outcome_number(o, "energy_peak_J") / sb_energy_of(j, false) < 1.005, "the energy increases");
}

const sb_stress sb_stress_steps = {
    .name = "time-step",
    .title = "Time steps from a quarter to four times the default's, each solver",
    .rules =
        "The fall of a collapsing column at 0.25 s differs from that with the shortest step by at most 1 % times the "
        "ratio of the time step to the default; the energy never rises by more than 0.5 %; four times the default "
        "step may be refused with the reason instead",
    .plan = plan_steps,
    .judge = judge_steps,
};

static void plan_tolerances(sb_trials *trials, bool quick)
{
    for (int s = 0; s < SOLVERS; s++) {
        for (int k = 2; k <= 5; k++) {
            if (quick && k % 2) continue;
            sb_trial *t = sb_trial_add(trials, "collapse.yaml", "%s-1e-%d", solvers[s], k);
            sb_trial_set(t, "numerics.solver=%s", solvers[s]);
            sb_trial_set(t, "numerics.tolerance_rule=density");
            sb_trial_set(t, "numerics.tolerance=1e-%d", k);
            sb_trial_set(t, "numerics.min_iterations=1");
            sb_trial_set(t, "numerics.max_iterations=5000");
            if (quick) sb_trial_set(t, "duration=0.3");
            sb_trial_drive(t, &drive, k);
        }
        sb_trial *t = sb_trial_add(trials, "collapse.yaml", "%s-capped", solvers[s]);
        sb_trial_set(t, "numerics.solver=%s", solvers[s]);
        sb_trial_set(t, "numerics.tolerance_rule=density");
        sb_trial_set(t, "numerics.tolerance=1e-9");
        sb_trial_set(t, "numerics.max_iterations=3");
        sb_trial_set(t,
                     "numerics.warm_start=0.5"); /* as in the paper: from the full pressure three sweeps add energy */
        sb_trial_drive(t, &drive, 0);
    }
}

/* The trial before with the same solver, whose tolerance is looser; NULL: none has run. */
static const sb_judged *looser_than(const sb_judged *j)
{
    const size_t solver = strcspn(j->trial->name, "-");
    for (size_t i = (size_t)(j - j->all); i-- > 0;) {
        const sb_judged *other = &j->all[i];
        if (!other->outcome.there || !(other->trial->number > 0)) continue;
        const bool same = strncmp(other->trial->name, j->trial->name, solver) == 0;
        return same && other->trial->number < j->trial->number ? other : NULL;
    }
    return NULL;
}

static void judge_tolerances(sb_judged *j)
{
    const sb_outcome *o = &j->outcome;
    const double left = sb_outcome_number(o, "mean_density_error");
    const double sweeps = sb_outcome_number(o, "mean_iterations");
    const double share = sb_outcome_number(o, "error_over_tolerance");
    sb_note(j, "remaining density error %.1e", left);
    sb_note(j, "%.1f sweeps", sweeps);
    if (!(j->trial->number > 0)) { /* it cannot converge and must report that */
        const double capped = sb_outcome_number(o, "capped_steps"), steps_done = sb_outcome_number(o, "steps");
        sb_require(j, capped > 0.9 * steps_done, "%g of %g steps counted as capped", capped, steps_done);
        return;
    }
    sb_require(j, share <= 1, "a solve left %g times its tolerance", share);
    const sb_judged *looser = looser_than(j);
    if (!looser) return;
    sb_require(j, left < sb_outcome_number(&looser->outcome, "mean_density_error"), "the error does not fall");
    sb_require(j, sweeps > sb_outcome_number(&looser->outcome, "mean_iterations"), "the sweeps do not increase");
}

const sb_stress sb_stress_tolerances = {
    .name = "tolerance",
    .title = "Tolerances from 1e-2 to 1e-5, each solver",
    .rules =
        "Every solve that is not counted as capped ends within its tolerance; from each tolerance to the next the "
        "remaining error falls and the sweeps increase; with three sweeps for 1e-9, nine steps in ten are counted as "
        "capped",
    .plan = plan_tolerances,
    .judge = judge_tolerances,
};
