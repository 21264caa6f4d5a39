/* Sums the pressure of the water next to bodies. */
#include "render/bodies/face_loads.h"

#include "base/memory.h"
#include "render/bodies/meshes.h"
#include "render/overlay/colormap.h"
#include "render/water/density.h"

#include <math.h>
#include <string.h>

static void find_paint(sb_face_loads *loads, const sb_model *model)
{
    size_t corner = 0;
    for (size_t b = 0; b < model->body_count; b++) {
        unsigned char paint[4];
        sb_meshes_paint(&model->bodies[b], paint);
        for (size_t c = 0; c < 3 * model->bodies[b].mesh.triangle_count; c++) memcpy(loads->paint[corner++], paint, 4);
    }
}

sb_status sb_face_loads_create(const sb_model *model, double spacing, sb_face_loads *loads, sb_error *error)
{
    sb_face_loads made = {0};
    sb_status status = sb_faces_make(model, spacing, spacing, &made.faces, error);
    if (status != SB_OK) return status;
    made.force = sb_alloc(made.faces.count, sizeof *made.force);
    made.paint = sb_alloc(3 * made.faces.all_count, sizeof *made.paint);
    made.colors = sb_alloc(3 * made.faces.all_count, sizeof *made.colors);
    if (!made.force || !made.paint || !made.colors) {
        sb_face_loads_free(&made);
        return sb_fail_memory(error, "the loads of a picture");
    }
    find_paint(&made, model);
    *loads = made;
    return SB_OK;
}

void sb_face_loads_free(sb_face_loads *loads)
{
    sb_faces_free(&loads->faces);
    sb_free(loads->force);
    sb_free(loads->paint);
    sb_free(loads->colors);
    *loads = (sb_face_loads){0};
}

/* Whether a place is in the layer of one spacing before a triangle. */
static bool is_before(const sb_face_triangle *t, sb_vec3 at, double spacing)
{
    const double off = sb_dot(t->normal, sb_sub(at, t->corner[0]));
    if (!(off > 0 && off <= spacing)) return false;
    for (int k = 0; k < 3; k++) {
        const sb_vec3 side = sb_sub(t->corner[(k + 1) % 3], t->corner[k]);
        if (sb_dot(sb_cross(side, sb_sub(at, t->corner[k])), t->normal) < 0) return false;
    }
    return true;
}

/* Adds the pressure of a particle to each face that it is next to, but once. */
static void add_particle(sb_face_loads *loads, sb_vec3 at, double spacing, double force)
{
    const uint32_t *near = NULL;
    const size_t count = sb_faces_near(&loads->faces, at, &near);
    uint32_t last = UINT32_MAX;
    for (size_t k = 0; k < count; k++) {
        const sb_face_triangle *t = &loads->faces.triangles[near[k]];
        if (t->face == last || !is_before(t, at, spacing)) continue;
        loads->force[t->face] += force;
        last = t->face; /* triangles of one face follow each other */
    }
}

static void add_particles(sb_face_loads *loads, const sb_frame *frame)
{
    const double square = frame->spacing * frame->spacing;
    for (size_t i = 0; i < frame->count; i++) {
        const float *p = frame->position + 3 * i;
        const sb_vec3 at = sb_add(frame->origin, sb_vec((double)p[0], (double)p[1], (double)p[2]));
        if (sb_density_counts(p)) add_particle(loads, at, frame->spacing, square * (double)frame->pressure[i]);
    }
}

static void find_colors(sb_face_loads *loads, double most)
{
    for (size_t t = 0; t < loads->faces.all_count; t++) {
        const uint32_t face = loads->faces.of[t];
        const double share = face == UINT32_MAX ? 0 : loads->force[face] / (loads->faces.list[face].area * most);
        /* Faces without a load keep their colour. */
        const double tint = 0.9 * fmin(50 * fmax(share, 0), 1);
        float rgb[3];
        sb_colormap(SB_COLORMAP_FIRE, share, rgb);
        for (size_t c = 3 * t; c < 3 * t + 3; c++) {
            for (int k = 0; k < 3; k++)
                loads->colors[c][k] =
                    (unsigned char)((1 - tint) * loads->paint[c][k] + tint * 255 * (double)rgb[k] + 0.5);
            loads->colors[c][3] = loads->paint[c][3];
        }
    }
}

void sb_face_loads_compute(sb_face_loads *loads, const sb_frame *frame, double most)
{
    const size_t count = loads->faces.count;
    const bool known = count > 0 && frame->face_count == count;
    for (size_t f = 0; f < count; f++)
        loads->force[f] = known ? (double)frame->face_pressure[f] * loads->faces.list[f].area : 0;
    if (!known) add_particles(loads, frame);
    find_colors(loads, most);
}
