#include "sensitivity.h"

#include "cases.h"
#include "markdown.h"

#include "base/memory.h"

static const double factors[SB_SENSITIVITY_PAIR] = {0.75, 1.25};

size_t sb_sensitivity_rows(void)
{
    size_t rows = 1;
    while (sb_sensitivity_keys[rows - 1].key) rows++;
    return rows;
}

sb_result *sb_sensitivity_pair(const sb_sensitivity_study *s, size_t of, size_t row)
{
    return &s->runs[s->count + SB_SENSITIVITY_PAIR * (of * sb_sensitivity_rows() + row)];
}

static const sb_plan *judged_plan(const sb_case *of)
{
    const sb_plan *plan = of->quick;
    while (!plan->judged && plan[1].resolution > 0) plan++;
    return plan;
}

/* Requests the changed runs of a case whose run with the defaults is known. */
static void request_changes(const sb_sensitivity_study *s, size_t of)
{
    const sb_result *base = &s->runs[of];
    for (size_t row = 0; base->state == SB_RESULT_DONE && row < sb_sensitivity_rows(); row++)
        for (size_t one = 0; one < SB_SENSITIVITY_PAIR; one++) {
            sb_request *request = &sb_sensitivity_pair(s, of, row)[one].request;
            *request = base->request;
            if (row == 0)
                request->seed += 1 + (int)one;
            else
                sb_sensitivity_change(&sb_sensitivity_keys[row - 1], &base->run.scene.numerics, factors[one],
                                      request->change);
            if (row > 0 && !request->change[0]) request->of = NULL;
        }
}

sb_status sb_sensitivity(sb_store *store, const sb_selection *cases, sb_error *error)
{
    static const sb_report_file files[] = {{"sensitivity.md", sb_sensitivity_report}, {NULL, NULL}};
    const size_t count = cases->count, more = count * SB_SENSITIVITY_PAIR * sb_sensitivity_rows();
    sb_sensitivity_study s = {.store = store, .count = count};
    s.runs = sb_alloc(count + more, sizeof *s.runs);
    if (!s.runs) return sb_fail_memory(error, "studies");
    for (size_t i = 0; i < count; i++) {
        const sb_case *of = sb_cases[cases->rows[i]];
        s.runs[i].request = (sb_request){.of = of, .plan = judged_plan(of), .quick = true, .seed = 1};
    }
    sb_status status = sb_runs_make(store, s.runs, count, error);
    for (size_t i = 0; i < count; i++) request_changes(&s, i);
    if (status == SB_OK) status = sb_runs_make(store, s.runs + count, more, error);
    if (status == SB_OK) status = sb_store_report(store, NULL, error);
    if (status == SB_OK) status = sb_reports_write(store, files, &s, error);
    sb_results_free(s.runs, count + more);
    sb_free(s.runs);
    return status;
}
