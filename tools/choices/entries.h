/* A subject's runs: every choice at every spacing with every seed, and what comes of them. */
#ifndef SB_CHOICES_ENTRIES_H
#define SB_CHOICES_ENTRIES_H

#include "choice.h"
#include "subject.h"
#include "trials.h"

enum { SB_ENTRY_SETTINGS = 10, SB_ENTRY_SEEDS = 9, SB_REFERENCE_SEEDS = 2 };

/* Over the seeds; NaN: none has run. */
typedef struct sb_spread {
    double mean, low, high;
} sb_spread;

/* One choice at one spacing. */
typedef struct sb_entry {
    const sb_choice *choice; /* NULL: the reference run */
    sb_plan plan;
    const char *settings[SB_ENTRY_SETTINGS];
    char change[SB_CHOICE_TEXT]; /* the setting that labels its runs; "": none */
    size_t first, seeds;         /* its trials */
    sb_spread time;              /* s: run time, or processor time when runs shared the machine */
    sb_spread errors[SB_SUBJECT_ERRORS];
    bool front; /* of time and the first error */
} sb_entry;

typedef struct sb_contest {
    const sb_subject *subject;
    size_t entry_count, trial_count, error_count;
    int threads;       /* the most that any run had: run times of others do not count */
    sb_entry *entries; /* the reference first, where there is one */
    sb_result *trials;
    double (*trial_errors)[SB_SUBJECT_ERRORS]; /* each run's own; NaN: none */
} sb_contest;

/* What of a subject is wanted. */
typedef struct sb_contest_selection {
    bool quick;     /* the cheap form: few choices at coarse spacings */
    bool few;       /* those choices at the full form's spacings */
    int seeds;      /* of every run */
    int references; /* seeds of the reference, at most 2; 0: as many as of the others */
    int spacings;   /* the coarsest so many alone; 0: all */
    double spacing; /* this one alone, m; 0: all */
} sb_contest_selection;

/* The runs that are wanted, the reference first; nothing is run. A wish for a spacing that the subject has not gives
   none. SB_BAD_INPUT: the scene cannot be read. */
sb_status sb_contest_begin(sb_contest *contest, const sb_subject *subject, const sb_store *store,
                           const sb_contest_selection *wish, sb_error *error);
/* From read trials: times (of the processor with cpu), errors, front. */
sb_status sb_contest_judge(sb_contest *contest, bool cpu, sb_error *error);
void sb_contest_free(sb_contest *contest);

#endif
