#include "studies.h"

#include "quantity.h"
#include "summary_text.h"

#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double FEW_STEPS = 20, GRAVITY = 9.81, SUPPORT = 2; /* of the preset `paper` */

static const sb_case plant = {.name = "plant",
                              .title = "A 25 m wave at a coastal plant",
                              .scene = "../scenes/plant.yaml",
                              .evaluate = sb_quantities_of};

/* Whether only some steps are run, because the whole run would take days. */
static bool is_few(const sb_published *p)
{
    return p->spacing < 2;
}

/* Whether the run differs only in the size of its hash table, which shorebreak has no parameter for. */
static bool only_table_differs(const sb_published *p)
{
    return p->number >= 5 && p->number <= 7;
}

static void add(sb_paper_studies *s, const sb_published *like, bool paper)
{
    sb_paper_trial *row = &s->rows[s->count];
    size_t used = 0;
    *row = (sb_paper_trial){
        .number = like->number, .paper = paper, .few = is_few(like), .spacing = like->spacing * s->scale};
    for (size_t i = 0; i < SB_PLAIN_SETTINGS; i++) row->settings[used++] = sb_plain_settings[i];
    if (paper) {
        snprintf(row->texts[0], SB_PAPER_TEXT, "numerics.time_step_factor=%.6g", like->lambda);
        snprintf(row->texts[1], SB_PAPER_TEXT, "numerics.tolerance=%.6g", like->tolerance);
        row->settings[used++] = row->texts[0];
        row->settings[used++] = row->texts[1];
    }
    if (row->few) {
        snprintf(row->texts[2], SB_PAPER_TEXT, "duration=%.6g",
                 FEW_STEPS * like->lambda * SUPPORT * row->spacing / GRAVITY);
        row->settings[used++] = row->texts[2];
    }
    row->plan = (sb_plan){.resolution = row->spacing, .settings = row->settings};
    s->trials[s->count++].request =
        (sb_request){.of = &plant, .plan = &row->plan, .preset = paper ? "paper" : NULL, .seed = 1};
}

void sb_paper_begin(sb_paper_studies *s, const sb_store *store, double scale)
{
    *s = (sb_paper_studies){.store = store, .scale = scale};
    /* The coarsest spacing first, so that most tables are complete early. */
    for (const int *n = sb_published_sets[SB_SET_SPACING].numbers; *n; n++) {
        const sb_published *shared = sb_published_find(*n);
        for (const sb_published *p = sb_published_runs; p->number; p++)
            if (p->spacing == shared->spacing && !only_table_differs(p)) add(s, p, true);
        if (!is_few(shared)) add(s, shared, false);
    }
}

sb_status sb_paper_costs(sb_paper_studies *s, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t i = 0; status == SB_OK && i < s->count; i++) {
        char *text;
        if (s->trials[i].state != SB_RESULT_DONE) continue;
        status = sb_summary_read(s->trials[i].run.folder, &text, error);
        if (status != SB_OK) return status;
        status = sb_cost_read(text, &s->rows[i].cost, error);
        sb_free(text);
    }
    return status;
}

const sb_paper_trial *sb_paper_row(const sb_paper_studies *s, int number, bool paper)
{
    for (size_t i = 0; i < s->count; i++)
        if (s->rows[i].number == number && s->rows[i].paper == paper && s->trials[i].state == SB_RESULT_DONE)
            return &s->rows[i];
    return NULL;
}
