#include "sea/sea.h"

#include "base/memory.h"
#include "sea/parts.h"

#include <stdio.h>

struct sb_sea_source {
    const sb_sea_form *form; /* NULL: still water */
    void *state;
    double level, start;
    sb_sea_notes notes;
};

/* In the order of sb_given_source. */
static const sb_sea_form *const forms[] = {NULL, &sb_sea_form_theory, &sb_sea_form_table, &sb_sea_form_record,
                                           &sb_sea_form_offshore};

/* Refuses water that the domain cannot hold, or that no run could follow. */
static sb_status check_greatest(const sb_sea_source *sea, const sb_scene *scene, sb_error *error)
{
    const double top = sb_sea_greatest_surface(sea), speed = sb_sea_greatest_speed(sea);
    if (!(top <= scene->domain.max.z))
        return sb_fail(
            error, SB_BAD_INPUT,
            "%.300s: sea: the given water rises to %g m, above the domain, expected at most its max z of %g m",
            scene->path ? scene->path : "scene", top, scene->domain.max.z);
    if (!(speed <= sb_scene_speed_limit(scene)))
        return sb_fail(error, SB_BAD_INPUT,
                       "%.300s: sea: the given water has a speed of %g m/s, above the limit of the scene, expected at "
                       "most %.4g m/s",
                       scene->path ? scene->path : "scene", speed, sb_scene_speed_limit(scene));
    return SB_OK;
}

sb_status sb_sea_create(const sb_scene *scene, const sb_offshore_start *grid, sb_sea_source **out, sb_error *error)
{
    sb_sea_source *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "the given sea");
    made->form = forms[scene->given.source];
    made->level = made->form ? scene->given.level : scene->sea.level;
    made->start = scene->given.start;
    snprintf(made->notes.about, sizeof made->notes.about, "still water at %g m", made->level);
    sb_status status = made->form ? made->form->create(scene, grid, &made->state, &made->notes, error) : SB_OK;
    if (status == SB_OK && made->form) status = check_greatest(made, scene, error);
    if (status != SB_OK) {
        sb_sea_destroy(made);
        return status;
    }
    *out = made;
    return SB_OK;
}

void sb_sea_destroy(sb_sea_source *sea)
{
    if (!sea) return;
    if (sea->form) sea->form->destroy(sea->state);
    sb_free(sea);
}

void sb_sea_at(const sb_sea_source *sea, double t, double x, double y, double z, double bed, sb_sea_point *out)
{
    *out = (sb_sea_point){.surface = sea->level};
    if (sea->form) sea->form->at(sea->state, t - sea->start, x, y, z, bed, out);
}

sb_offshore *sb_sea_grid(sb_sea_source *sea)
{
    return sea->form && sea->form->grid ? sea->form->grid(sea->state) : NULL;
}

sb_offshore_maps *sb_sea_maps(sb_sea_source *sea)
{
    return sea->form && sea->form->maps ? sea->form->maps(sea->state) : NULL;
}

double sb_sea_greatest_surface(const sb_sea_source *sea)
{
    return sea->form ? sea->form->greatest_surface(sea->state) : sea->level;
}

double sb_sea_greatest_speed(const sb_sea_source *sea)
{
    return sea->form ? sea->form->greatest_speed(sea->state) : 0;
}

const char *sb_sea_about(const sb_sea_source *sea)
{
    return sea->notes.about;
}

const char *sb_sea_warning(const sb_sea_source *sea)
{
    return *sea->notes.warning ? sea->notes.warning : NULL;
}
