/* Volume through a vertical plane. Each particle near the plane is remembered with its place, so a
   passage is a change of side between two sightings of the same particle: whatever goes through is
   counted once and with its sign, to the last bit, and what comes back is taken off again. Beside a
   periodic side a particle may be seen more than once; a sighting goes on from the nearest one. */
#include "base/memory.h"
#include "measure/parts.h"

#include <stdlib.h>

typedef struct sighting {
    uint32_t id;
    sb_vec3 position;
} sighting;

struct sb_gate {
    const sb_flow_plane *plane;
    double ax, ay, tx, ty, nx, ny, length; /* start, unit tangent, unit normal to the right, m */
    double margin, particle_volume;
    double stride; /* m: two sightings farther apart are of two images */
    bool flat;
    size_t count, capacity, next_capacity;
    sighting *seen, *next; /* sorted by id */
};

static int compare_ids(const void *left, const void *right)
{
    const sighting *a = left, *b = right;
    return (a->id > b->id) - (a->id < b->id);
}

static double side_of(const sb_gate *gate, sb_vec3 p)
{
    return (p.x - gate->ax) * gate->nx + (p.y - gate->ay) * gate->ny;
}

/* All particles within the margin of the plane, sorted by id, into gate->next. */
static sb_status look(sb_gate *gate, const sb_sight *sight, size_t *count, sb_error *error)
{
    double pad = gate->margin;
    double bx = gate->ax + gate->tx * gate->length, by = gate->ay + gate->ty * gate->length;
    sb_vec3 min =
        sb_vec(fmin(gate->ax, bx) - pad, fmin(gate->ay, by) - pad, fmax(gate->plane->z_min, sight->min.z) - pad);
    sb_vec3 max =
        sb_vec(fmax(gate->ax, bx) + pad, fmax(gate->ay, by) + pad, fmin(gate->plane->z_max, sight->max.z) + pad);
    sb_status status = sb_cloud_query(sight->cloud, sight->sim, min, max, 0, error);
    if (status != SB_OK) return status;
    *count = 0;
    if (sb_grow((void **)&gate->next, &gate->next_capacity, sight->cloud->count, sizeof *gate->next) != 0)
        return sb_fail_memory(error, gate->plane->name);
    for (size_t i = 0; i < sight->cloud->count; i++) {
        const sb_fluid_sample *sample = &sight->cloud->samples[i];
        if (fabs(side_of(gate, sample->position)) <= gate->margin)
            gate->next[(*count)++] = (sighting){sample->id, sample->position};
    }
    if (*count > 1) qsort(gate->next, *count, sizeof *gate->next, compare_ids);
    return SB_OK;
}

static void keep(sb_gate *gate, size_t count)
{
    sighting *seen = gate->seen;
    size_t capacity = gate->capacity;
    gate->seen = gate->next;
    gate->capacity = gate->next_capacity;
    gate->count = count;
    gate->next = seen;
    gate->next_capacity = capacity;
}

sb_status sb_gate_create(const sb_sight *sight, const sb_flow_plane *plane, sb_gate **gate, sb_error *error)
{
    sb_gate *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, plane->name);
    double spacing = sight->scene->resolution;
    made->plane = plane;
    made->flat = sight->scene->dimensions == 2;
    made->particle_volume = made->flat ? spacing * spacing : spacing * spacing * spacing;
    /* Farther than a step moves a particle, half as fast again as the one that its length is taken from: whoever
       passes was seen before. */
    const sb_numerics *numerics = &sight->scene->numerics;
    made->margin = fmax(2, 1.5 * numerics->cfl * numerics->support) * spacing;
    made->stride = HUGE_VAL;
    for (int axis = 0; axis < 2; axis++) {
        double length = sb_repeat_length(sight->scene, sight->min, sight->max, axis);
        if (length > 0) made->stride = fmin(made->stride, 0.5 * length);
    }
    made->ax = plane->ax;
    if (made->flat) {
        made->nx = plane->by < plane->ay ? -1 : 1;
    } else {
        double dx = plane->bx - plane->ax, dy = plane->by - plane->ay;
        made->ay = plane->ay;
        made->length = hypot(dx, dy);
        made->tx = made->length > 0 ? dx / made->length : 0;
        made->ty = made->length > 0 ? dy / made->length : 1;
        made->nx = made->ty;
        made->ny = -made->tx;
    }
    size_t count;
    sb_status status = look(made, sight, &count, error);
    if (status != SB_OK) {
        sb_gate_destroy(made);
        return status;
    }
    keep(made, count);
    *gate = made;
    return SB_OK;
}

void sb_gate_destroy(sb_gate *gate)
{
    if (!gate) return;
    sb_free(gate->seen);
    sb_free(gate->next);
    sb_free(gate);
}

/* +1, -1 or 0: did the way from p to q lead through the rectangle, and to which side. */
static int passage(const sb_gate *gate, sb_vec3 p, sb_vec3 q)
{
    double before = side_of(gate, p), after = side_of(gate, q);
    if ((before < 0) == (after < 0)) return 0;
    sb_vec3 at = sb_madd(p, before / (before - after), sb_sub(q, p));
    double along = (at.x - gate->ax) * gate->tx + (at.y - gate->ay) * gate->ty;
    bool within = at.z >= gate->plane->z_min && at.z <= gate->plane->z_max &&
                  (gate->flat || (along >= 0 && along <= gate->length));
    return !within ? 0 : before < 0 ? 1 : -1;
}

sb_status sb_gate_step(sb_gate *gate, const sb_sight *sight, double *volume, sb_error *error)
{
    size_t count;
    sb_status status = look(gate, sight, &count, error);
    if (status != SB_OK) return status;
    long net = 0;
    for (size_t i = 0, j = 0; i < count; i++) {
        while (j < gate->count && gate->seen[j].id < gate->next[i].id) j++;
        for (size_t k = j; k < gate->count && gate->seen[k].id == gate->next[i].id; k++)
            if (sb_norm(sb_sub(gate->seen[k].position, gate->next[i].position)) < gate->stride)
                net += passage(gate, gate->seen[k].position, gate->next[i].position);
    }
    keep(gate, count);
    *volume += (double)net * gate->particle_volume;
    return SB_OK;
}

size_t sb_gate_bytes(const sb_gate *gate)
{
    return sizeof *gate + (gate->capacity + gate->next_capacity) * sizeof *gate->seen;
}

void sb_gate_save(const sb_gate *gate, sb_archive_out *out)
{
    sb_put_count(out, gate->count);
    for (size_t i = 0; i < gate->count; i++) {
        sb_put_count(out, gate->seen[i].id);
        sb_put_vector(out, gate->seen[i].position);
    }
}

sb_status sb_gate_load(sb_gate *gate, sb_archive_in *in, sb_error *error)
{
    const uint64_t count = sb_take_count(in, UINT32_MAX);
    gate->count = 0;
    /* Grown as they come: a count made up by someone else ends with its section. */
    for (uint64_t i = 0; i < count && in->error.status == SB_OK; i++) {
        if (sb_grow((void **)&gate->seen, &gate->capacity, gate->count + 1, sizeof *gate->seen) != 0)
            return sb_fail_memory(error, gate->plane->name);
        sighting *seen = &gate->seen[gate->count++];
        seen->id = (uint32_t)sb_take_count(in, UINT32_MAX);
        seen->position = sb_take_vector(in);
    }
    return SB_OK;
}
