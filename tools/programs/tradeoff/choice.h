/* The choices of solver and parameters that are compared: one row each. */
#ifndef SB_TRADEOFF_CHOICE_H
#define SB_TRADEOFF_CHOICE_H

#include "case.h"

enum { SB_CHOICE_FIXED = 16, SB_CHOICE_TEXT = 64 };

typedef struct sb_choice {
    const char *name;                   /* NULL ends the table; stable */
    bool paper;                         /* preset `paper` instead of `default` */
    bool quick;                         /* part of the quick forms */
    bool slow;                          /* takes many times as long: only for subjects with few steps */
    const char *fixed[SB_CHOICE_FIXED]; /* KEY=VALUE */
    const char *key;                    /* of the sensitivity study's table of defaults; NULL: none */
    double factor;                      /* of that default */
    const char *subject;                /* the only subject that has this row; NULL: all */
    const char *scene;   /* its scene instead of the subject's, relative to assets/validation; NULL: none */
    const char *records; /* KEY=VALUE of a run of the subject's scene whose record is the sea of this one; NULL: none */
} sb_choice;

/* The first is the unchanged default preset. */
extern const sb_choice sb_choices[];
size_t sb_choice_count(void);

/* Whether a subject of that name has the row. */
bool sb_choice_is_for(const sb_choice *choice, const char *subject);

/* Writes "numerics.KEY=VALUE" for a row with a key: the default, as read from a scene, times the factor. "": the row
   has no key, or nothing changes. */
void sb_choice_change(const sb_choice *choice, const sb_numerics *defaults, char change[SB_CHOICE_TEXT]);

#endif
