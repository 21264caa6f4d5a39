/* A stress case: its trials, and the rules by which their outcomes are judged. To add one, write stress_<name>.c with
   its sb_stress, add its row to stresses.h, and put its scene into assets/stress. */
#ifndef SB_STRESS_STRESS_H
#define SB_STRESS_STRESS_H

#include "outcome.h"
#include "statistics.h"
#include "trial.h"

/* A trial with its judgement. */
typedef struct sb_judged {
    const sb_trial *trial;
    sb_outcome outcome;
    bool fails;            /* a rule is violated */
    char figure[240];      /* measured values, for the table */
    char why[400];         /* violated rules */
    struct sb_judged *all; /* trials of the case, in the order planned */
    size_t count;
} sb_judged;

typedef struct sb_stress {
    const char *name;  /* on the command line and in folders; stable */
    const char *title; /* its heading */
    const char *rules; /* beside the common rules, separated by "; "; Markdown */
    void (*plan)(sb_trials *trials, bool quick);
    /* Judges a trial that was run, after the common rules. NULL: only the common rules. */
    void (*judge)(sb_judged *judged);
} sb_stress;

/* All cases in the order of the report, ended by NULL. */
extern const sb_stress *const sb_stresses[];

/* If the rule does not hold, the trial fails and the reason (printf) is noted. Comparisons with NaN are false, so it
 * fails. */
void sb_require(sb_judged *judged, bool holds, const char *why, ...) __attribute__((format(printf, 3, 4)));
/* Appends measured values (printf) to the figure, after a comma. */
void sb_note(sb_judged *judged, const char *figure, ...) __attribute__((format(printf, 2, 3)));

/* Judges the common rules. The trial ends in time and in an allowed way; a refusal or failure gives its reason in one
   line. No table and no particle contains NaN. No particle is lost or within a solid deeper than its boundary
   particles. All particles are accounted for. A solve that stops above its tolerance is counted. */
void sb_judge_common(sb_judged *judged);

/* Another trial of the case, of that name, that was run, or NULL. */
const sb_judged *sb_judged_find(const sb_judged *judged, const char *name);

/* A value over those trials of the case that were run and whose names begin so. */
sb_spread sb_judged_spread(const sb_judged *judged, const char *prefix, double (*value)(const sb_judged *judged));
/* kinetic_J + potential_J, at the start or the end; the potential energy counts from the domain's floor. */
double sb_energy_of(const sb_judged *judged, bool end);

#endif
