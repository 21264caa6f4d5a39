#include "render/camera/bounds.h"

#include <math.h>

/* Widens the box by the water of a grid that frames contain beside that of the domain. */
static void add_grid(const sb_scene *scene, sb_vec3 *min, sb_vec3 *max)
{
    const sb_offshore_settings *o = &scene->offshore;
    if (!sb_scene_nested(scene)) return;
    const double x_min = fmax(o->x_min, min->x - o->drawn), x_max = fmin(o->x_max, max->x + o->drawn);
    const double y_min = fmax(o->y_min, min->y - o->drawn), y_max = fmin(o->y_max, max->y + o->drawn);
    const bool flat = scene->dimensions == 2;
    *min = sb_vec(fmin(min->x, x_min), flat ? min->y : fmin(min->y, y_min), min->z);
    *max = sb_vec(fmax(max->x, x_max), flat ? max->y : fmax(max->y, y_max), max->z);
}

void sb_bounds_find(const sb_scene *scene, const sb_model *model, sb_vec3 *min, sb_vec3 *max)
{
    *min = model->min;
    *max = model->max;
    add_grid(scene, min, max);
    for (size_t i = 0; i < model->body_count; i++)
        for (size_t v = 0; v < model->bodies[i].mesh.vertex_count; v++) {
            *min = sb_min(*min, model->bodies[i].mesh.vertices[v]);
            *max = sb_max(*max, model->bodies[i].mesh.vertices[v]);
        }
}
