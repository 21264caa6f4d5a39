/* Runs of a subject: every choice at every spacing with every seed, and their results. */
#ifndef SB_TRADEOFF_ENTRIES_H
#define SB_TRADEOFF_ENTRIES_H

#include "choice.h"
#include "runs.h"
#include "statistics.h"
#include "subject.h"

enum { SB_ENTRY_SETTINGS = 24, SB_ENTRY_SEEDS = 9, SB_REFERENCE_SEEDS = 2 };

/* One choice at one spacing. */
typedef struct sb_entry {
    const sb_choice *choice; /* NULL: the reference run */
    sb_plan plan;
    sb_case other;    /* the subject's case with the scene of the choice, if it has one */
    sb_plan recorded; /* of the runs whose records its runs replay */
    const char *settings[SB_ENTRY_SETTINGS], *recorded_settings[SB_ENTRY_SETTINGS];
    char change[SB_CHOICE_TEXT];         /* the setting in the labels of its runs; "": none */
    size_t first, seeds;                 /* its trials */
    size_t first_record;                 /* the recordings that they replay, if the choice has any */
    sb_spread time;                      /* over the seeds, s; run time, or processor time if runs shared the machine */
    sb_spread record_time;               /* the same of the recordings, which is no part of `time` */
    sb_spread errors[SB_SUBJECT_ERRORS]; /* over the seeds */
    bool front;                          /* on the front of time and first error */
} sb_entry;

typedef struct sb_contest {
    const sb_subject *subject;
    size_t entry_count, trial_count, record_count, error_count;
    int threads;       /* largest number of any run; run times of others do not count */
    sb_entry *entries; /* the reference first, if there is one */
    sb_case recorder;  /* the subject's case without figures */
    sb_result *trials, *records;
    double (*trial_errors)[SB_SUBJECT_ERRORS]; /* errors of each run; NaN: none */
} sb_contest;

/* Which runs of a subject are selected. */
typedef struct sb_contest_selection {
    bool quick;         /* the cheap form: few choices at coarse spacings */
    bool few;           /* those choices at the full form's spacings */
    int seeds;          /* start seeds of every run */
    int references;     /* seeds of the reference, at most 2; 0: as many as of other runs */
    double reference;   /* spacing of the reference, m; 0: that of the subject */
    int spacings;       /* only so many coarsest ones; 0: all */
    double spacing;     /* only this one, m; 0: all */
    const char *choice; /* only choices whose names contain it, and `default`; NULL: all */
} sb_contest_selection;

/* Prepares the selected runs, the reference first; runs nothing. If the subject does not have the selected spacing,
   or no other choice than `default` is selected, there are no runs. SB_BAD_INPUT: the scene cannot be read. */
sb_status sb_contest_begin(sb_contest *contest, const sb_subject *subject, const sb_store *store,
                           const sb_contest_selection *selection, sb_error *error);
/* replays.c: adds the runs of an entry whose records its trials replay, if its choice has any. */
void sb_contest_add_records(sb_contest *contest, sb_entry *entry);
/* Makes the runs whose records others replay, then all trials (runs.h: sb_runs_make). A trial without its record has
   failed, or with --report-only is not run. */
sb_status sb_contest_make(sb_contest *contest, sb_store *store, sb_error *error);
/* The record of trial i of an entry; NULL: it replays none. */
const sb_result *sb_contest_record(const sb_contest *contest, const sb_entry *entry, size_t i);
/* Computes times (processor times with cpu), errors and front from the trials that were read. */
sb_status sb_contest_judge(sb_contest *contest, bool cpu, sb_error *error);
void sb_contest_free(sb_contest *contest);

#endif
