/* A stress case is one row: the trials it asks for, and the rule that their outcomes are judged by. To add one:
   a file stress_<name>.c with its sb_stress, its line in stresses.c, its scene in assets/stress. */
#ifndef SB_BATTERY_STRESS_H
#define SB_BATTERY_STRESS_H

#include "outcome.h"
#include "trial.h"

/* What is said of one trial. */
typedef struct sb_judged {
    const sb_trial *trial;
    sb_outcome outcome;
    bool fails;       /* some rule is broken */
    char figure[240]; /* what was measured, for the table */
    char why[400];    /* what is broken */
} sb_judged;

typedef struct sb_stress {
    const char *name;  /* on the command line and in folders; stable */
    const char *title; /* its heading */
    const char *rule;  /* what must hold beside the common rules, one line of Markdown */
    void (*plan)(sb_trials *trials, bool quick);
    /* All trials of the case, in the order planned; those not run have outcome.there false and are left alone.
       The common rules have been judged. NULL: those alone. */
    void (*judge)(sb_judged *all, size_t count);
} sb_stress;

/* All cases in the order of the report, ended by NULL. */
extern const sb_stress *const sb_stresses[];

/* Unless it holds, the trial fails, and why is noted, as printf does. A NaN compares false, so it fails. */
void sb_require(sb_judged *judged, bool holds, const char *why, ...) __attribute__((format(printf, 3, 4)));
/* Adds to the figure, as printf does, after a comma. */
void sb_note(sb_judged *judged, const char *figure, ...) __attribute__((format(printf, 2, 3)));

/* The rules that every trial is under: it ends in one of the ways it may, in time, with one line on what was wrong
   where it did not end well; no table and no particle holds a NaN; no particle is lost or within a solid deeper than
   its boundary particles; all particles are accounted for; a solve that stops above its tolerance is counted. */
void sb_judge_common(sb_judged *judged);

/* The trial of that name, or NULL. */
sb_judged *sb_judged_find(sb_judged *all, size_t count, const char *name);
/* kinetic_J + potential_J, at the start or the end; the potential energy counts from the domain's floor. */
double sb_energy_of(const sb_judged *judged, bool end);

#endif
