/* The choices held against each other: one row each. */
#ifndef SB_CHOICES_CHOICE_H
#define SB_CHOICES_CHOICE_H

#include "scene/scene.h"

enum { SB_CHOICE_FIXED = 3, SB_CHOICE_TEXT = 64 };

typedef struct sb_choice {
    const char *name;                   /* NULL ends the table; stable */
    bool paper;                         /* preset `paper` instead of `default` */
    bool quick;                         /* among the quick ones */
    const char *fixed[SB_CHOICE_FIXED]; /* KEY=VALUE */
    const char *key;                    /* of the defaults' sensitivity table; NULL: none */
    double factor;                      /* on that default */
} sb_choice;

/* The first is the default preset as it is. */
extern const sb_choice sb_choices[];
size_t sb_choice_count(void);

/* "numerics.KEY=VALUE" of a row with a key: the default, as read from a scene, times its factor; ""
   for rows without, and where the change would be none. */
void sb_choice_change(const sb_choice *choice, const sb_numerics *defaults, char change[SB_CHOICE_TEXT]);

#endif
