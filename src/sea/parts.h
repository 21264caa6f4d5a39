/* The forms of given water behind sea.h. Private to src/sea. */
#ifndef SB_SEA_PARTS_H
#define SB_SEA_PARTS_H

#include "sea/sea.h"

enum { SB_SEA_TEXT = 400 };

/* What a form tells about itself at its creation. */
typedef struct sb_sea_notes {
    char about[SB_SEA_TEXT], warning[SB_SEA_TEXT];
} sb_sea_notes;

/* One form: create makes *state, which the other functions read. Times are seconds after sea.start. */
typedef struct sb_sea_form {
    sb_status (*create)(const sb_scene *scene, const sb_offshore_start *grid, void **state, sb_sea_notes *notes,
                        sb_error *error); /* grid: NULL for a form that has none */
    void (*at)(const void *state, double t, double x, double y, double z, double bed, sb_sea_point *out);
    double (*greatest_surface)(const void *state);
    double (*greatest_speed)(const void *state);
    void (*destroy)(void *state);
    sb_offshore *(*grid)(void *state);      /* NULL: the form has none */
    sb_offshore_maps *(*maps)(void *state); /* likewise */
} sb_sea_form;

extern const sb_sea_form sb_sea_form_theory, sb_sea_form_table, sb_sea_form_record, sb_sea_form_offshore;

/* Height of z over the bed as a fraction of the depth, 0 at the bed and 1 at the surface and above. 0 where it is dry.
 */
static inline double sb_sea_fraction(double z, double bed, double surface)
{
    if (!(surface > bed) || !(z > bed)) return 0;
    return z < surface ? (z - bed) / (surface - bed) : 1;
}

#endif
