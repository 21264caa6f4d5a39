/* Choices whose sea is the record of another run: that run is made first, and its time counts apart. */
#include "entries.h"

#include <stdio.h>

const sb_result *sb_contest_record(const sb_contest *c, const sb_entry *e, size_t i)
{
    return e->choice && e->choice->records ? &c->records[e->first_record + i - e->first] : NULL;
}

/* A recording is read for its time; its figures are those of `default`. */
static void no_figures(const sb_case_run *run, sb_figures *figures)
{
    (void)run;
    (void)figures;
}

void sb_contest_add_records(sb_contest *c, sb_entry *e)
{
    size_t used = 0;
    if (!e->choice || !e->choice->records) return;
    e->first_record = c->record_count;
    for (const char *const *s = c->subject->settings; s && *s; s++) e->recorded_settings[used++] = *s;
    e->recorded_settings[used] = e->choice->records;
    e->recorded = (sb_plan){.resolution = e->plan.resolution, .settings = e->recorded_settings, .variant = "recorded"};
    c->recorder = *c->subject->of;
    c->recorder.evaluate = no_figures;
    for (size_t i = e->first; i < e->first + e->seeds; i++) {
        sb_request *request = &c->records[c->record_count++].request;
        *request = c->trials[i].request;
        request->of = &c->recorder;
        request->plan = &e->recorded;
        request->change[0] = '\0';
    }
}

/* Gives a trial its record. False: there is none. */
static bool join(const sb_result *record, sb_result *trial)
{
    if (record->state == SB_RESULT_DONE) {
        trial->request.replays = record->run.folder;
        return true;
    }
    trial->state = record->state;
    snprintf(trial->problem, sizeof trial->problem, "the run whose record it replays: %.600s", record->problem);
    return false;
}

/* Gives each trial its record; `of` is NULL while a trial has none, so that it is not run. */
static void join_all(sb_contest *c, bool after)
{
    for (sb_entry *e = c->entries; e < c->entries + c->entry_count; e++)
        for (size_t i = e->first; i < e->first + e->seeds; i++) {
            const sb_result *record = sb_contest_record(c, e, i);
            if (record && after)
                c->trials[i].request.of = &e->other;
            else if (record && !join(record, &c->trials[i]))
                c->trials[i].request.of = NULL;
        }
}

sb_status sb_contest_make(sb_contest *c, sb_store *store, sb_error *error)
{
    sb_status status = sb_runs_make(store, c->records, c->record_count, error);
    if (status != SB_OK) return status;
    join_all(c, false);
    status = sb_runs_make(store, c->trials, c->trial_count, error);
    join_all(c, true);
    return status;
}
