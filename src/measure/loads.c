/* A force acts on the face whose triangle is nearest to the particle and turned towards it, so that the forces on the
   faces of a body sum to the force of the pressure on it. */
#include "measure/loads.h"

#include "base/exact.h"
#include "base/memory.h"
#include "geometry/model/faces.h"

#include <math.h>
#include <string.h>

/* N s since the creation, at the last multiple of the interval, at the last step's end and after this step. */
typedef struct face_state {
    sb_vec3 boundary, last, now;
} face_state;

struct sb_loads {
    sb_faces faces;
    bool known; /* an interval has finished */
    face_state *states;
    sb_face_load *rows;
    sb_exact (*sums)[3]; /* scratch: of this step */
    uint32_t *acted_on;  /* scratch: faces on which a force of this step acts, */
    bool *acts;          /* and whether one does */
    uint32_t *face;      /* scratch: per force of this step */
    size_t capacity;     /* of it */
};

void sb_loads_destroy(sb_loads *loads)
{
    if (!loads) return;
    sb_faces_free(&loads->faces);
    sb_free(loads->states);
    sb_free(loads->rows);
    sb_free(loads->sums);
    sb_free(loads->acted_on);
    sb_free(loads->acts);
    sb_free(loads->face);
    sb_free(loads);
}

/* A particle acts on a wall within the support radius. */
static double reach_of(const sb_scene *scene)
{
    return (scene->numerics.support + 0.5) * scene->resolution;
}

sb_status sb_loads_create(const sb_scene *scene, const sb_model *model, sb_loads **loads, sb_error *error)
{
    sb_loads *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "loads on faces");
    sb_status status = sb_faces_make(model, scene->resolution, reach_of(scene), &made->faces, error);
    const size_t count = made->faces.count;
    if (status == SB_OK) {
        made->states = sb_alloc(count, sizeof *made->states);
        made->rows = sb_alloc(count, sizeof *made->rows);
        made->sums = sb_alloc(count, sizeof *made->sums);
        made->acted_on = sb_alloc(count, sizeof *made->acted_on);
        made->acts = sb_alloc(count, sizeof *made->acts);
        if (!made->states || !made->rows || !made->sums || !made->acted_on || !made->acts)
            status = sb_fail_memory(error, "loads on faces");
    }
    if (status != SB_OK) {
        sb_loads_destroy(made);
        return status;
    }
    for (size_t f = 0; f < count; f++) {
        const sb_face *face = &made->faces.list[f];
        made->rows[f] = (sb_face_load){.body = face->body, .normal = face->normal, .area = face->area};
    }
    *loads = made;
    return SB_OK;
}

size_t sb_loads_bytes(const sb_loads *loads)
{
    return sizeof *loads + sb_faces_bytes(&loads->faces) + loads->capacity * sizeof *loads->face +
           loads->faces.count * (sizeof *loads->states + sizeof *loads->rows + sizeof *loads->sums +
                                 sizeof *loads->acted_on + sizeof *loads->acts);
}

size_t sb_loads_places(const sb_loads *loads, sb_push_place *places)
{
    size_t count = 0;
    for (size_t f = 0; f < loads->faces.count; f++) {
        const size_t body = loads->faces.list[f].body;
        if (count == 0 || places[count - 1].body != body)
            places[count++] = (sb_push_place){.body = body, .range = HUGE_VAL};
    }
    return count;
}

/* ---- steps ---- */

/* The direction from the wall in which a force presses. */
static sb_vec3 direction_of(const sb_wall_push *push)
{
    const sb_vec3 away = sb_sub(push->at, push->from);
    if (sb_dot(push->normal, push->normal) > 0) return push->normal;
    return sb_normalize(sb_dot(away, away) > 0 ? away : sb_scale(push->force, -1));
}

static void add_force(sb_loads *loads, uint32_t *count, uint32_t face, sb_vec3 force)
{
    if (!loads->acts[face]) loads->acted_on[(*count)++] = face;
    loads->acts[face] = true;
    sb_exact_add(&loads->sums[face][0], force.x);
    sb_exact_add(&loads->sums[face][1], force.y);
    sb_exact_add(&loads->sums[face][2], force.z);
}

sb_status sb_loads_step(sb_loads *loads, const sb_wall_push *pushes, size_t count, double taken, sb_error *error)
{
    const sb_faces *faces = &loads->faces;
    if (sb_grow((void **)&loads->face, &loads->capacity, count, sizeof *loads->face) != 0)
        return sb_fail_memory(error, "loads on faces");
#pragma omp parallel for schedule(static)
    for (size_t k = 0; k < count; k++)
        loads->face[k] = faces->first[pushes[k].body] == faces->first[pushes[k].body + 1]
                             ? UINT32_MAX /* a body without faces, which a probe is on */
                             : sb_faces_nearest(faces, pushes[k].body, pushes[k].from, direction_of(&pushes[k]));
    uint32_t acted = 0;
    for (size_t k = 0; k < count; k++)
        if (loads->face[k] != UINT32_MAX) add_force(loads, &acted, loads->face[k], pushes[k].force);
    for (uint32_t k = 0; k < acted; k++) {
        const uint32_t f = loads->acted_on[k];
        sb_exact *sum = loads->sums[f];
        const sb_vec3 force = sb_vec(sb_exact_value(&sum[0]), sb_exact_value(&sum[1]), sb_exact_value(&sum[2]));
        loads->states[f].now = sb_madd(loads->states[f].last, taken, force);
        memset(sum, 0, sizeof loads->sums[f]);
        loads->acts[f] = false;
    }
    return SB_OK;
}

void sb_loads_boundary(sb_loads *loads, double fraction, double interval)
{
    for (size_t f = 0; f < loads->faces.count; f++) {
        face_state *s = &loads->states[f];
        const sb_vec3 end = sb_madd(s->last, fraction, sb_sub(s->now, s->last));
        loads->rows[f].force = sb_scale(sb_sub(end, s->boundary), 1 / interval);
        s->boundary = end;
    }
    loads->known = true;
}

void sb_loads_advance(sb_loads *loads)
{
    for (size_t f = 0; f < loads->faces.count; f++) loads->states[f].last = loads->states[f].now;
}

const sb_face_load *sb_loads_rows(const sb_loads *loads, size_t *count)
{
    *count = loads->known ? loads->faces.count : 0;
    return loads->rows;
}

sb_status sb_loads_fill_frame(const sb_loads *loads, sb_frame *frame, sb_error *error)
{
    if (!loads->known) return SB_OK;
    if (!sb_frame_add_faces(frame, loads->faces.count)) return sb_fail_memory(error, "loads on faces");
    for (size_t f = 0; f < loads->faces.count; f++) {
        const sb_face_load *row = &loads->rows[f];
        frame->face_pressure[f] = (float)(-sb_dot(row->force, row->normal) / row->area);
    }
    return SB_OK;
}

/* ---- archive ---- */

void sb_loads_save(const sb_loads *loads, sb_archive_out *out)
{
    sb_put_count(out, loads->faces.count);
    sb_put_flag(out, loads->known);
    for (size_t f = 0; f < loads->faces.count; f++) {
        sb_put_vector(out, loads->states[f].boundary);
        sb_put_vector(out, loads->states[f].last);
        sb_put_vector(out, loads->rows[f].force);
    }
}

void sb_loads_load(sb_loads *loads, sb_archive_in *in)
{
    if (sb_take_count(in, SIZE_MAX) != loads->faces.count)
        sb_archive_refuse(in, "loads on a different number of faces, expected %zu", loads->faces.count);
    loads->known = sb_take_flag(in);
    for (size_t f = 0; f < loads->faces.count; f++) {
        loads->states[f].boundary = sb_take_vector(in);
        loads->states[f].last = loads->states[f].now = sb_take_vector(in);
        loads->rows[f].force = sb_take_vector(in);
    }
}
