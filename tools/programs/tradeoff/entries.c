#include "entries.h"

#include "pareto.h"

#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Reads the scene's numerics with the preset `default`, of which a choice changes one by a factor. */
static sb_status read_defaults(const sb_subject *subject, const sb_store *store, sb_numerics *defaults, sb_error *error)
{
    char path[SB_PATH_MAX];
    sb_scene scene = {0};
    sb_status status = sb_path_join(path, store->assets, subject->of->scene, error);
    if (status == SB_OK) status = sb_scene_read(path, "default", NULL, 0, &scene, error);
    if (status != SB_OK) return status;
    *defaults = scene.numerics;
    sb_scene_free(&scene);
    return SB_OK;
}

static int reference_seeds(const sb_contest_selection *selection)
{
    const int seeds = selection->references ? selection->references : selection->seeds;
    return seeds < SB_REFERENCE_SEEDS ? seeds : SB_REFERENCE_SEEDS;
}

/* Spacing of the reference run; 0: the subject has none. */
static double reference_spacing(const sb_contest_selection *selection, const sb_subject *subject)
{
    const double own = selection->quick ? subject->quick_reference : subject->full_reference;
    return own > 0 && selection->reference > 0 ? selection->reference : own;
}

/* Adds an entry, which must not move afterwards: its plan points into it. A choice that changes nothing
   (a factor of a default of 0) is omitted: its runs would be those of `default`. */
static void add(sb_contest *c, const sb_choice *choice, double spacing, const sb_contest_selection *selection,
                const sb_numerics *defaults)
{
    const int seeds = choice ? selection->seeds : reference_seeds(selection);
    sb_entry *e = &c->entries[c->entry_count];
    size_t used = 0;
    *e = (sb_entry){.choice = choice, .first = c->trial_count, .seeds = (size_t)seeds};
    for (const char *const *s = c->subject->settings; s && *s; s++) e->settings[used++] = *s;
    if (choice) sb_choice_change(choice, defaults, e->change);
    if (choice && choice->key && !e->change[0]) return;
    c->entry_count++;
    for (int i = 0; choice && i < SB_CHOICE_FIXED && choice->fixed[i]; i++)
        if (e->change[0])
            e->settings[used++] = choice->fixed[i];
        else
            snprintf(e->change, sizeof e->change, "%s", choice->fixed[i]);
    const sb_case *of = c->subject->of;
    if (choice && choice->scene) {
        e->other = *of;
        e->other.scene = choice->scene;
        of = &e->other;
    }
    e->plan = (sb_plan){.resolution = spacing, .settings = e->settings};
    for (int seed = 1; seed <= seeds; seed++) {
        sb_request *request = &c->trials[c->trial_count++].request;
        *request = (sb_request){.of = of,
                                .plan = &e->plan,
                                .preset = choice && choice->paper ? "paper" : NULL,
                                .quick = selection->quick,
                                .seed = seed};
        snprintf(request->change, sizeof request->change, "%s", e->change);
    }
    sb_contest_add_records(c, e);
}

static bool is_selected(const sb_contest_selection *selection, const double *spacings, size_t i)
{
    if (selection->spacing > 0 && fabs(spacings[i] - selection->spacing) > 1e-6 * selection->spacing) return false;
    return !selection->spacings || i < (size_t)selection->spacings;
}

/* Whether a choice is selected for a subject: by its name, or by the form. */
static bool is_chosen(const sb_contest_selection *selection, const sb_choice *choice, const sb_subject *subject)
{
    if ((choice->slow && !subject->slow) || !sb_choice_is_for(choice, subject->name)) return false;
    if (selection->choice) return choice == sb_choices || strstr(choice->name, selection->choice);
    return choice->quick || !(selection->quick || selection->few);
}

sb_status sb_contest_begin(sb_contest *c, const sb_subject *subject, const sb_store *store,
                           const sb_contest_selection *selection, sb_error *error)
{
    const double *spacings = selection->quick ? subject->quick : subject->full;
    const double reference = reference_spacing(selection, subject);
    const size_t most = sb_choice_count() * SB_SUBJECT_SPACINGS + 1;
    bool any = false, others = !selection->choice;
    sb_numerics defaults;
    *c = (sb_contest){.subject = subject};
    while (subject->errors[c->error_count].name) c->error_count++;
    sb_status status = read_defaults(subject, store, &defaults, error);
    if (status != SB_OK) return status;
    c->entries = sb_alloc(most, sizeof *c->entries);
    const size_t runs = most * (size_t)selection->seeds + SB_REFERENCE_SEEDS;
    c->trials = sb_alloc(runs, sizeof *c->trials);
    c->records = sb_alloc(runs, sizeof *c->records);
    c->trial_errors = sb_alloc(runs, sizeof *c->trial_errors);
    if (!c->entries || !c->trials || !c->records || !c->trial_errors) {
        sb_contest_free(c);
        return sb_fail_memory(error, "runs");
    }
    for (size_t i = 0; spacings[i] > 0; i++) any |= is_selected(selection, spacings, i);
    for (const sb_choice *choice = sb_choices + 1; choice->name; choice++)
        others |= is_chosen(selection, choice, subject);
    if (!others) return SB_OK;
    if (reference > 0 && any) add(c, NULL, reference, selection, &defaults);
    for (size_t i = 0; spacings[i] > 0; i++)
        for (const sb_choice *choice = sb_choices; choice->name && is_selected(selection, spacings, i); choice++)
            if (is_chosen(selection, choice, subject)) add(c, choice, spacings[i], selection, &defaults);
    return SB_OK;
}

/* A run time counts only for runs with the largest number of threads: others ran with other --jobs. */
static double time_of(const sb_result *trial, bool cpu, int threads)
{
    if (cpu) return trial->run.cpu;
    return trial->run.threads == threads ? trial->run.view.wall : (double)NAN;
}

/* A reference is compared with those of the other seeds: smaller errors than their difference are not significant. */
static double error_of(const sb_contest *c, const sb_entry *e, size_t trial, size_t k,
                       const sb_figures *const *references, size_t count)
{
    const sb_figures *own = &c->trials[trial].figures, *others[SB_ENTRY_SEEDS];
    size_t other = 0;
    if (e->choice) return sb_subject_error(&c->subject->errors[k], own, references, count);
    for (size_t i = 0; i < count; i++)
        if (references[i] != own) others[other++] = references[i];
    return other ? sb_subject_error(&c->subject->errors[k], own, others, other) : (double)NAN;
}

/* missing: the reference has not run, so that there are no errors. */
static void judge_entry(const sb_contest *c, sb_entry *e, bool cpu, const sb_figures *const *references, size_t count,
                        bool missing)
{
    e->time = e->record_time = sb_spread_none;
    for (size_t i = e->first; i < e->first + e->seeds; i++) {
        const sb_result *record = sb_contest_record(c, e, i);
        if (c->trials[i].state != SB_RESULT_DONE) continue;
        sb_spread_add(&e->time, time_of(&c->trials[i], cpu, c->threads));
        if (record) sb_spread_add(&e->record_time, time_of(record, cpu, c->threads));
    }
    for (size_t k = 0; k < c->error_count; k++) {
        e->errors[k] = sb_spread_none;
        for (size_t i = e->first; i < e->first + e->seeds; i++) {
            const bool done = !missing && c->trials[i].state == SB_RESULT_DONE;
            c->trial_errors[i][k] = done ? error_of(c, e, i, k, references, count) : (double)NAN;
            sb_spread_add(&e->errors[k], c->trial_errors[i][k]);
        }
    }
}

/* Finds the figures of the references: none if the subject has no reference, or if none has run (*missing). */
static size_t references_of(const sb_contest *c, const sb_figures *found[SB_ENTRY_SEEDS], bool *missing)
{
    const sb_entry *e = &c->entries[0];
    size_t count = 0;
    *missing = false;
    if (c->entry_count == 0 || e->choice) return 0;
    for (size_t i = e->first; i < e->first + e->seeds; i++)
        if (c->trials[i].state == SB_RESULT_DONE) found[count++] = &c->trials[i].figures;
    *missing = count == 0;
    return count;
}

/* The reference is not part of the front. */
static sb_status find_front(sb_contest *c, sb_error *error)
{
    size_t n = c->entry_count;
    double *times = sb_alloc(n, sizeof *times), *errors = sb_alloc(n, sizeof *errors);
    bool *front = sb_alloc(n, sizeof *front);
    sb_status status = times && errors && front ? SB_OK : sb_fail_memory(error, "a front");
    for (size_t i = 0; status == SB_OK && i < n; i++) {
        times[i] = c->entries[i].choice ? c->entries[i].time.mean : (double)NAN;
        errors[i] = c->entries[i].errors[0].mean;
    }
    if (status == SB_OK) sb_pareto_front(times, errors, n, front);
    for (size_t i = 0; status == SB_OK && i < n; i++) c->entries[i].front = front[i];
    sb_free(times);
    sb_free(errors);
    sb_free(front);
    return status;
}

sb_status sb_contest_judge(sb_contest *c, bool cpu, sb_error *error)
{
    const sb_figures *references[SB_ENTRY_SEEDS];
    bool missing;
    size_t count = references_of(c, references, &missing);
    c->threads = 0;
    for (size_t i = 0; i < c->trial_count; i++)
        if (c->trials[i].state == SB_RESULT_DONE && c->trials[i].run.threads > c->threads)
            c->threads = c->trials[i].run.threads;
    for (size_t i = 0; i < c->entry_count; i++) judge_entry(c, &c->entries[i], cpu, references, count, missing);
    return find_front(c, error);
}

void sb_contest_free(sb_contest *c)
{
    sb_results_free(c->trials, c->trial_count);
    sb_results_free(c->records, c->record_count);
    sb_free(c->trials);
    sb_free(c->records);
    sb_free(c->trial_errors);
    sb_free(c->entries);
    *c = (sb_contest){0};
}
