#include "battery.h"

#include "base/memory.h"

sb_status sb_stress_collect(sb_store *store, const sb_stress *of, sb_stress_results *results, sb_error *error)
{
    *results = (sb_stress_results){.of = of, .trials.assets = store->assets};
    of->plan(&results->trials, store->options->quick);
    const size_t count = results->trials.count;
    results->judged = sb_alloc(count, sizeof *results->judged);
    if (results->trials.incomplete || !results->judged) return sb_fail_memory(error, "trials");
    for (size_t i = 0; i < count; i++) {
        const sb_job job = {of, &results->trials.list[i]};
        results->judged[i] = (sb_judged){.trial = job.trial, .outcome = sb_trial_read(store, &job)};
        results->judged[i].all = results->judged;
        results->judged[i].count = count;
    }
    for (sb_judged *j = results->judged; j < results->judged + count; j++) {
        if (!j->outcome.there) continue;
        sb_judge_common(j);
        if (of->judge) of->judge(j);
        results->run++;
        store->found++;
        results->failed += j->fails;
    }
    return SB_OK;
}

void sb_stress_results_free(sb_stress_results *results)
{
    for (size_t i = 0; results->judged && i < results->trials.count; i++) sb_outcome_free(&results->judged[i].outcome);
    sb_free(results->judged);
    sb_trials_free(&results->trials);
    *results = (sb_stress_results){0};
}
