#include "results.h"

#include "kept.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Adds a request to a list with room for it. */
static void add_request(sb_request *requests, size_t *count, const sb_case *of, const sb_plan *plan, bool quick,
                        const char *preset, int seed)
{
    requests[(*count)++] = (sb_request){.of = of, .plan = plan, .quick = quick, .preset = preset, .seed = seed};
}

sb_status sb_case_requests(const sb_case *of, bool quick, sb_request **requests, size_t *count, sb_error *error)
{
    const sb_plan *plans = quick ? of->quick : of->full;
    size_t room = 0, n = 0;
    for (const sb_plan *plan = plans; plan->resolution > 0; plan++)
        room += 1 + (size_t)plan->paper + (size_t)plan->wen + (size_t)(plan->seeds > 1 ? plan->seeds - 1 : 0);
    sb_request *made = sb_alloc(room, sizeof *made);
    if (!made) return sb_fail_memory(error, "runs");
    for (const sb_plan *plan = plans; plan->resolution > 0; plan++) add_request(made, &n, of, plan, quick, NULL, 1);
    for (const sb_plan *plan = plans; plan->resolution > 0; plan++)
        if (plan->paper) add_request(made, &n, of, plan, quick, "paper", 1);
    for (const sb_plan *plan = plans; plan->resolution > 0; plan++)
        if (plan->wen) add_request(made, &n, of, plan, quick, "wen", 1);
    for (const sb_plan *plan = plans; plan->resolution > 0; plan++)
        for (int seed = 2; seed <= plan->seeds; seed++) add_request(made, &n, of, plan, quick, NULL, seed);
    *requests = made;
    *count = n;
    return SB_OK;
}

/* Whether the run's files are available. */
static bool has_files(const sb_result *r)
{
    return r->state == SB_RESULT_DONE && !r->kept;
}

/* Whether the runs that figures across spacings are derived from were made by several programs. */
static bool several_builds(const sb_case_results *results, bool kept)
{
    const sb_result *first = NULL;
    for (size_t i = 0; i < results->count; i++) {
        const sb_result *r = &results->runs[i];
        if (r->state != SB_RESULT_DONE || r->kept != kept || r->request.preset || r->request.seed != 1) continue;
        if (first && strcmp(r->run.build, first->run.build) != 0) return true;
        if (!first) first = r;
    }
    return false;
}

static void compare_runs(sb_case_results *results, sb_case_run *runs, sb_figures *figures)
{
    size_t count = 0;
    for (size_t i = 0; i < results->count; i++) {
        const sb_result *r = &results->runs[i];
        if (!has_files(r) || r->request.preset || r->request.seed != 1) continue;
        runs[count] = r->run.view;
        figures[count++] = r->figures;
    }
    if (count < 2) return;
    results->across_builds = several_builds(results, false);
    results->of->compare(runs, figures, count, &results->across);
    snprintf(results->problem, sizeof results->problem, "%.600s", results->across.error.text);
}

/* Takes figures across spacings from an earlier report if the judged run is kept, too. */
static void keep_across(sb_case_results *results, const sb_sheet *former)
{
    const sb_result *judged = sb_results_judged(results);
    if (results->across.count > 0 || !judged || !judged->kept) return;
    results->across_builds = several_builds(results, true);
    sb_kept_across(former, results->of->name, &results->across);
}

sb_status sb_results_collect(sb_store *store, const sb_case *of, const sb_sheet *former, sb_case_results *results,
                             sb_error *error)
{
    sb_request *requests = NULL;
    size_t count = 0;
    *results = (sb_case_results){.of = of};
    sb_status status = sb_case_requests(of, store->options->quick, &requests, &count, error);
    if (status != SB_OK) return status;
    sb_case_run *views = sb_alloc(count, sizeof *views);
    sb_figures *figures = sb_alloc(count, sizeof *figures);
    results->runs = sb_alloc(count, sizeof *results->runs);
    if (!views || !figures || !results->runs) status = sb_fail_memory(error, "results");
    for (size_t i = 0; status == SB_OK && i < count; i++) {
        results->runs[i].request = requests[i];
        sb_result_read(store, true, &results->runs[i]);
        sb_kept_read(former, &results->runs[i]);
        store->found += results->runs[i].kept;
        results->count++;
    }
    if (status == SB_OK && of->compare) compare_runs(results, views, figures);
    if (status == SB_OK) keep_across(results, former);
    sb_free(views);
    sb_free(figures);
    sb_free(requests);
    return status;
}

void sb_case_results_free(sb_case_results *results)
{
    sb_results_free(results->runs, results->count);
    sb_figures_free(&results->across);
    sb_free(results->runs);
    *results = (sb_case_results){0};
}

const sb_result *sb_results_judged(const sb_case_results *results)
{
    for (size_t i = 0; i < results->count; i++) {
        const sb_result *r = &results->runs[i];
        if (r->request.plan->judged && !r->request.preset && r->request.seed == 1 && r->state == SB_RESULT_DONE)
            return r;
    }
    return NULL;
}

const sb_result *sb_results_finest(const sb_case_results *results)
{
    const sb_result *finest = NULL;
    for (size_t i = 0; i < results->count; i++) {
        const sb_result *r = &results->runs[i];
        if (r->state != SB_RESULT_DONE || r->request.preset || r->request.seed != 1) continue;
        if (!r->request.plan->variant || !finest || finest->request.plan->variant) finest = r;
    }
    return finest;
}

/* Size of an error for comparisons. */
static double size_of(const sb_figure *figure, double error)
{
    return figure->one_sided ? error : fabs(error);
}

/* Whether r differs from `first` in the seed only, or is `first`. */
static bool is_seed_of(const sb_result *r, const sb_result *first)
{
    return r->request.plan == first->request.plan && !r->request.preset && r->state == SB_RESULT_DONE &&
           strcmp(r->run.build, first->run.build) == 0;
}

sb_judgement sb_results_judge(const sb_case_results *results, size_t i)
{
    const sb_result *judged = sb_results_judged(results);
    sb_judgement j = {.figure = &judged->figures.rows[i], .pass = true};
    double sum = 0;
    j.worst = j.figure->error;
    for (size_t k = 0; k < results->count; k++) {
        if (!is_seed_of(&results->runs[k], judged)) continue;
        const sb_figure *f = sb_figures_find(&results->runs[k].figures, j.figure->quantity);
        if (!f) continue;
        sum += f->value;
        if (isnan(f->error) || size_of(f, f->error) > size_of(f, j.worst)) j.worst = f->error;
        j.pass = j.pass && f->pass;
        j.seeds++;
    }
    j.mean = sum / (double)j.seeds;
    return j;
}

/* Spread over the seeds of `first`, including `first`. */
static sb_seed_spread spread_of(const sb_case_results *results, const sb_result *first, const char *quantity)
{
    double low = (double)INFINITY, high = -(double)INFINITY;
    size_t seeds = 0;
    for (size_t k = 0; k < results->count; k++) {
        if (!is_seed_of(&results->runs[k], first)) continue;
        const sb_figure *f = sb_figures_find(&results->runs[k].figures, quantity);
        if (!f) continue;
        if (isnan(f->value)) return (sb_seed_spread){(double)NAN, first->request.plan->resolution};
        low = f->value < low ? f->value : low;
        high = f->value > high ? f->value : high;
        seeds++;
    }
    return (sb_seed_spread){seeds > 1 ? high - low : (double)NAN, first->request.plan->resolution};
}

sb_seed_spread sb_results_spread(const sb_case_results *results, const char *quantity)
{
    sb_seed_spread finest = {.value = (double)NAN};
    for (size_t k = 0; k < results->count; k++) {
        const sb_result *first = &results->runs[k];
        if (first->request.seed != 1 || first->request.preset || first->state != SB_RESULT_DONE) continue;
        const sb_seed_spread here = spread_of(results, first, quantity);
        if (isnan(here.value)) continue;
        finest = here;
        if (first->request.plan->judged) break;
    }
    return finest;
}

bool sb_results_incomplete(const sb_case_results *results)
{
    size_t compared = 0;
    for (size_t i = 0; i < results->count; i++)
        compared += !results->runs[i].request.preset && results->runs[i].request.seed == 1;
    return results->of->compare && compared > 1 && sb_results_judged(results) && results->across.count == 0;
}

void sb_results_count(const sb_case_results *results, size_t *limited, size_t *passed)
{
    const sb_result *judged = sb_results_judged(results);
    *limited = *passed = 0;
    for (size_t i = 0; judged && i < judged->figures.count; i++) {
        if (isnan(judged->figures.rows[i].limit)) continue;
        ++*limited;
        *passed += sb_results_judge(results, i).pass;
    }
    for (size_t i = 0; i < results->across.count; i++) {
        if (isnan(results->across.rows[i].limit)) continue;
        ++*limited;
        *passed += results->across.rows[i].pass;
    }
}
