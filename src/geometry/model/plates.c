/* Paddles that are divided into push-plates, or into the rows of a flap: each plate is a body of the model. The
   boundary particles are those of the undivided paddle, so that there are none between plates. */
#include "base/memory.h"
#include "geometry/model/parts.h"

#include <string.h>

size_t sb_model_whole(const sb_model *model, size_t body)
{
    return body - model->bodies[body].plate;
}

static double *along(sb_vec3 *v, int axis)
{
    return axis == 0 ? &v->x : axis == 1 ? &v->y : &v->z;
}

sb_body sb_model_plate(const sb_body *from, const sb_plate_row *row, size_t plate)
{
    sb_body part = *from;
    const double move = *along(&part.translate, row->axis), width = (row->to - row->from) / (double)row->count;
    if (plate > 0) *along(&part.min, row->axis) = row->from + (double)plate * width - move;
    if (plate + 1 < row->count) *along(&part.max, row->axis) = row->from + (double)(plate + 1) * width - move;
    return part;
}

/* The mesh and the solid of the undivided paddle. */
typedef struct whole {
    size_t body; /* first plate */
    sb_mesh *mesh;
    size_t meshes;
    sb_mesh section; /* in 2D, of the mesh */
    sb_solid *solid;
} whole;

static const sb_mesh *surface_of(const whole *w)
{
    return w->section.triangle_count > 0 ? &w->section : w->mesh;
}

struct sb_wholes {
    size_t count;
    whole *wholes;
};

static sb_status make_whole(const sb_scene *scene, const sb_model *model, size_t body, whole *made, sb_error *error)
{
    made->body = body;
    sb_status status = sb_mesh_from_body(&scene->bodies[model->bodies[body].source], scene->resolution, &made->mesh,
                                         &made->meshes, error);
    if (status == SB_OK && model->dimensions == 2)
        status = sb_section_mesh(made->mesh, sb_model_strip_width(model), &made->section, error);
    if (status == SB_OK) status = sb_solid_create(surface_of(made), SB_ROLE_SOLID, &made->solid, error);
    return status;
}

sb_status sb_wholes_create(const sb_scene *scene, const sb_model *model, sb_wholes **wholes, sb_error *error)
{
    size_t count = 0;
    *wholes = NULL;
    for (size_t b = 0; b < model->body_count; b++) count += model->bodies[b].plates > 0 && model->bodies[b].plate == 0;
    if (count == 0) return SB_OK;
    sb_wholes *made = sb_alloc(1, sizeof *made);
    if (made) made->wholes = sb_alloc(count, sizeof *made->wholes);
    sb_status status = made && made->wholes ? SB_OK : sb_fail_memory(error, "plates");
    for (size_t b = 0; b < model->body_count && status == SB_OK; b++)
        if (model->bodies[b].plates > 0 && model->bodies[b].plate == 0)
            status = make_whole(scene, model, b, &made->wholes[made->count++], error);
    if (status != SB_OK) {
        sb_wholes_destroy(made);
        return status;
    }
    *wholes = made;
    return SB_OK;
}

void sb_wholes_destroy(sb_wholes *wholes)
{
    for (size_t w = 0; wholes && w < wholes->count; w++) {
        for (size_t m = 0; m < wholes->wholes[w].meshes; m++) sb_mesh_free(&wholes->wholes[w].mesh[m]);
        sb_free(wholes->wholes[w].mesh);
        sb_mesh_free(&wholes->wholes[w].section);
        sb_solid_destroy(wholes->wholes[w].solid);
    }
    if (wholes) sb_free(wholes->wholes);
    sb_free(wholes);
}

bool sb_wholes_source(const sb_wholes *wholes, const sb_model *model, size_t body, sb_sample_source *source)
{
    if (model->bodies[body].plate > 0) return false;
    for (size_t w = 0; wholes && w < wholes->count; w++)
        if (wholes->wholes[w].body == body) {
            source->mesh = surface_of(&wholes->wholes[w]);
            source->solid = wholes->wholes[w].solid;
        }
    return true;
}

static size_t plate_at(const sb_plate_row *row, sb_vec3 at)
{
    const double share = (*along(&at, row->axis) - row->from) / (row->to - row->from);
    return (size_t)fmin(fmax(floor(share * (double)row->count), 0), (double)row->count - 1);
}

int sb_model_share_plates(const sb_scene *scene, sb_model *model, size_t body)
{
    sb_model_body *first = &model->bodies[body];
    const size_t begin = first->begin, count = first->count;
    sb_plate_row row;
    if (first->plates == 0 || sb_scene_plates(scene, &scene->wavemakers[first->wavemaker], &row) == 0) return 0;
    sb_vec3 *position = sb_alloc(2 * count, sizeof *position);
    if (!position) return -1;
    sb_vec3 *normal = position + count;
    memcpy(position, model->wall_position + begin, count * sizeof *position);
    memcpy(normal, model->wall_normal + begin, count * sizeof *normal);
    size_t at = begin;
    for (size_t plate = 0; plate < row.count; plate++) {
        first[plate].begin = at;
        for (size_t i = 0; i < count; i++) {
            if (plate_at(&row, position[i]) != plate) continue;
            model->wall_position[at] = position[i];
            model->wall_normal[at++] = normal[i];
        }
        first[plate].count = at - first[plate].begin;
    }
    sb_free(position);
    return 0;
}
