/* Pressures of probes on walls: means over the interval, like forces. A single step's forces on so small a part of a
   wall are noise, and in a full flow the part may be bare for a step. */
#include "base/exact.h"
#include "base/memory.h"
#include "measure/patch.h"
#include "measure/state.h"

sb_status sb_wall_probes_start(const sb_measure *measure, sb_sim *sim, sb_error *error)
{
    const size_t probes = measure->scene->measure.probe_count;
    const size_t bodies = measure->loads ? measure->model->body_count : 0;
    sb_push_place *places = sb_alloc(bodies + probes * SB_PATCH_PLACES, sizeof *places);
    if (sb_ranks_any(sb_sim_ranks(sim), !places)) {
        sb_free(places);
        return sb_fail_memory(error, "probes on walls");
    }
    size_t count = measure->loads ? sb_loads_places(measure->loads, places) : 0;
    for (size_t i = 0; i < probes; i++) count += sb_patch_places(measure->patches[i], places + count);
    const sb_status status = sb_sim_record_pushes(sim, places, count, error);
    sb_free(places);
    return status;
}

void sb_wall_probes_step(sb_measure *measure, const sb_sim *sim, double taken)
{
    size_t count;
    const sb_wall_push *pushes = sb_sim_pushes(sim, &count);
    for (size_t i = 0; i < measure->scene->measure.probe_count; i++) {
        if (!sb_patch_on_wall(measure->patches[i])) continue;
        sb_exact sum = {0}; /* the order of the forces depends on timing */
        for (size_t k = 0; k < count; k++) sb_exact_add(&sum, sb_patch_share(measure->patches[i], &pushes[k]));
        measure->probes[i].now = measure->probes[i].last + taken * sb_exact_value(&sum);
    }
}

double sb_wall_probe_mean(sb_measure *measure, size_t probe, double fraction)
{
    probe_state *state = &measure->probes[probe];
    const double end = state->last + fraction * (state->now - state->last);
    const double mean = (end - state->boundary) / measure->interval;
    state->boundary = end;
    return mean;
}
