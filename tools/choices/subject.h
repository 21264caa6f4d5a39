/* The scenes by which choices are judged, and what an error is in each: one row each. */
#ifndef SB_CHOICES_SUBJECT_H
#define SB_CHOICES_SUBJECT_H

#include "case.h"

enum { SB_SUBJECT_ERRORS = 4, SB_SUBJECT_SPACINGS = 3 };

/* An error: a figure's own against its reference, or, where a subject has a reference run, of this
   run's figures against that one's. */
typedef struct sb_error_measure {
    const char *name;          /* "force noise": column and axis; NULL ends the list */
    const char *unit;          /* "%" */
    const char *quantity;      /* of the case's figures; in it # stands for each of `bodies` */
    const char *const *bodies; /* ended by NULL; the error is sum |a - b| / sum |b|; NULL: one figure */
} sb_error_measure;

typedef struct sb_subject {
    const char *name, *title; /* NULL ends the table */
    const char *what;         /* its errors: of what, against what; without full stop */
    const sb_case *of;        /* whose scene runs and whose figures count */
    double full[SB_SUBJECT_SPACINGS + 1], quick[SB_SUBJECT_SPACINGS + 1]; /* m, ended by 0 */
    double full_reference, quick_reference;         /* m: a run to compare with; 0: figures have references */
    const char *const *settings;                    /* for all its runs; NULL: none */
    sb_error_measure errors[SB_SUBJECT_ERRORS + 1]; /* the first is plotted and makes the front */
} sb_subject;

extern const sb_subject sb_subjects[];

/* The error of one run, free of sign, against the mean of the references (%), or with none of them
   the figure's own (its unit). NaN where a figure is missing. */
double sb_subject_error(const sb_error_measure *measure, const sb_figures *figures, const sb_figures *const *references,
                        size_t reference_count);

#endif
