/* Warns of sponges and sets of gauges whose depth is not that of the still water there. */
#include "geometry/model/parts.h"

#include <math.h>
#include <stdio.h>

/* As in check.c: the difference that is accepted, in spacings and of the depth. */
static const double SLACK = 1.5, SHARE = 0.05;

/* Places at which the depth in a sponge is found: along it and across. */
enum { ALONG = 16, ACROSS = 5 };

typedef struct range {
    double least, most; /* m; least > most: no water was found */
} range;

static void add_place(const sb_scene *scene, const sb_model *model, const sb_model_space *space, double x, double y,
                      range *found)
{
    const double depth = sb_model_still_depth(scene, model, space, x, y);
    if (depth < 0.5 * model->spacing) return;
    found->least = fmin(found->least, depth);
    found->most = fmax(found->most, depth);
}

static sb_status compare(const char *what, const char *name, double depth, range there, sb_model *model,
                         sb_error *error)
{
    char text[60];
    const double slack = fmax(SLACK * model->spacing, SHARE * there.most);
    if (there.least > there.most || (depth >= there.least - slack && depth <= there.most + slack)) return SB_OK;
    snprintf(text, sizeof text, "%.3g m", there.least);
    if (there.most - there.least > 0.1 * model->spacing)
        snprintf(text, sizeof text, "%.3g to %.3g m", there.least, there.most);
    return sb_model_warn(model, error,
                         "%s \"%s\": its depth is %g m, but the still water there is %s deep: its waves have another "
                         "length; expected that depth",
                         what, name, depth, text);
}

/* The part of the domain in which a sponge slows water down. */
static range depths_in(const sb_scene *scene, const sb_model *model, const sb_model_space *space,
                       const sb_sponge *sponge)
{
    const sb_domain *domain = &scene->domain;
    const int axis = sponge->side / 2, across = scene->dimensions == 2 ? 1 : ACROSS;
    const double front = sponge->end + (sponge->side % 2 ? -1 : 1) * sponge->length;
    const double from = sb_component(domain->min, 1 - axis), to = sb_component(domain->max, 1 - axis);
    range found = {(double)INFINITY, -(double)INFINITY};
    for (int i = 0; i < ALONG * across; i++) {
        const double along = front + (sponge->end - front) * (i % ALONG + 0.5) / ALONG;
        const double beside = from + (to - from) * (i / ALONG + 0.5) / across;
        if (along < sb_component(domain->min, axis) || along > sb_component(domain->max, axis)) continue;
        add_place(scene, model, space, axis == 0 ? along : beside, axis == 0 ? beside : along, &found);
    }
    return found;
}

static range depths_at(const sb_scene *scene, const sb_model *model, const sb_model_space *space,
                       const sb_reflection_set *set)
{
    range found = {(double)INFINITY, -(double)INFINITY};
    for (size_t i = 0; i < set->gauge_count; i++) {
        const sb_gauge *gauge = &scene->measure.gauges[sb_scene_gauge(scene, set->gauges[i].name)];
        if (gauge->water != SB_GAUGE_GRID) add_place(scene, model, space, gauge->x, gauge->y, &found);
    }
    return found;
}

sb_status sb_model_warn_depths(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t s = 0; s < scene->sponge_count && status == SB_OK; s++) {
        const sb_sponge *sponge = &scene->sponges[s];
        status = compare("sponge", sponge->name, sponge->depth, depths_in(scene, model, space, sponge), model, error);
    }
    for (size_t r = 0; r < scene->measure.reflection_count && status == SB_OK; r++) {
        const sb_reflection_set *set = &scene->measure.reflections[r];
        status =
            compare("measure.reflections", set->name, set->depth, depths_at(scene, model, space, set), model, error);
    }
    return status;
}
