/* The scenes for which choices are compared, and the errors of each: one row each. */
#ifndef SB_TRADEOFF_SUBJECT_H
#define SB_TRADEOFF_SUBJECT_H

#include "case.h"

enum { SB_SUBJECT_ERRORS = 4, SB_SUBJECT_SPACINGS = 3 };

/* An error: that of a figure against its reference or, if a subject has a reference run, the difference of a run's
   figures from those of the reference run. */
typedef struct sb_error_measure {
    const char *name;          /* "force noise": column and axis; NULL ends the list */
    const char *unit;          /* "%" */
    const char *quantity;      /* of the case's figures; # stands for each of `bodies` */
    const char *const *bodies; /* ended by NULL; the error is sum |a - b| / sum |b|; NULL: one figure */
} sb_error_measure;

typedef struct sb_subject {
    const char *name, *title; /* NULL ends the table */
    const char *what;         /* explanation of its errors, without full stop */
    const sb_case *of;        /* case with its scene and figures */
    double full[SB_SUBJECT_SPACINGS + 1], quick[SB_SUBJECT_SPACINGS + 1]; /* m, ended by 0; no quick form: none */
    double full_reference, quick_reference;         /* m, spacing of the reference run; 0: figures have references */
    const char *const *settings;                    /* of all its runs; NULL: none */
    bool slow;                                      /* slow choices are affordable */
    sb_error_measure errors[SB_SUBJECT_ERRORS + 1]; /* the first is plotted and defines the front */
} sb_subject;

extern const sb_subject sb_subjects[];

/* Absolute error of a run: against the mean of the references (%), or without references that of the figure (in its
   unit). NaN: a figure is missing. */
double sb_subject_error(const sb_error_measure *measure, const sb_figures *figures, const sb_figures *const *references,
                        size_t reference_count);

#endif
