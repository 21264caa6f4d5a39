/* Volume that passes a vertical plane. The positions of all particles near the plane are stored at each step. A passage
   is a change of side between two stored positions of the same particle. Each passage is counted exactly once, with its
   sign, so that water which flows back is subtracted again. Near a periodic side a particle can appear more than once;
   each image is compared with the nearest earlier one. */
#include "base/memory.h"
#include "measure/parts.h"

#include <stdlib.h>

typedef struct near_particle {
    uint32_t id;
    sb_vec3 position;
} near_particle;

struct sb_plane_counter {
    const sb_flow_plane *plane;
    double ax, ay, tx, ty, nx, ny, length; /* start, unit tangent, unit normal to the right, m */
    double margin, particle_volume;
    double image_distance; /* m: two positions of one particle that are farther apart belong to two images */
    bool flat;
    size_t count, capacity, next_capacity;
    near_particle *last, *next; /* of the last step and of this one, sorted by id */
};

static int compare_ids(const void *left, const void *right)
{
    const near_particle *a = left, *b = right;
    return (a->id > b->id) - (a->id < b->id);
}

static double side_of(const sb_plane_counter *counter, sb_vec3 p)
{
    return (p.x - counter->ax) * counter->nx + (p.y - counter->ay) * counter->ny;
}

/* Stores all particles within the margin of the plane, sorted by id, in counter->next. */
static sb_status find_near(sb_plane_counter *counter, const sb_measure_view *view, size_t *count, sb_error *error)
{
    double pad = counter->margin;
    double bx = counter->ax + counter->tx * counter->length, by = counter->ay + counter->ty * counter->length;
    sb_vec3 min = sb_vec(fmin(counter->ax, bx) - pad, fmin(counter->ay, by) - pad,
                         fmax(counter->plane->z_min, view->min.z) - pad);
    sb_vec3 max = sb_vec(fmax(counter->ax, bx) + pad, fmax(counter->ay, by) + pad,
                         fmin(counter->plane->z_max, view->max.z) + pad);
    sb_status status = sb_cloud_query(view->cloud, view->sim, min, max, 0, error);
    if (status != SB_OK) return status;
    *count = 0;
    if (sb_grow((void **)&counter->next, &counter->next_capacity, view->cloud->count, sizeof *counter->next) != 0)
        return sb_fail_memory(error, counter->plane->name);
    for (size_t i = 0; i < view->cloud->count; i++) {
        const sb_fluid_sample *sample = &view->cloud->samples[i];
        if (fabs(side_of(counter, sample->position)) <= counter->margin)
            counter->next[(*count)++] = (near_particle){sample->id, sample->position};
    }
    if (*count > 1) qsort(counter->next, *count, sizeof *counter->next, compare_ids);
    return SB_OK;
}

/* Makes the particles of this step those of the last one. */
static void advance(sb_plane_counter *counter, size_t count)
{
    near_particle *last = counter->last;
    size_t capacity = counter->capacity;
    counter->last = counter->next;
    counter->capacity = counter->next_capacity;
    counter->count = count;
    counter->next = last;
    counter->next_capacity = capacity;
}

sb_status sb_plane_counter_create(const sb_measure_view *view, const sb_flow_plane *plane, sb_plane_counter **counter,
                                  sb_error *error)
{
    sb_plane_counter *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, plane->name);
    double spacing = view->scene->resolution;
    made->plane = plane;
    made->flat = view->scene->dimensions == 2;
    made->particle_volume = made->flat ? spacing * spacing : spacing * spacing * spacing;
    /* A step moves no particle as far as the margin, even one that is half as fast again as the speed from which the
       step's length is computed. A particle that passes was therefore stored before. */
    const sb_numerics *numerics = &view->scene->numerics;
    made->margin = fmax(2, 1.5 * numerics->cfl * numerics->support) * spacing;
    made->image_distance = HUGE_VAL;
    for (int axis = 0; axis < 2; axis++) {
        double length = sb_repeat_length(view->scene, view->min, view->max, axis);
        if (length > 0) made->image_distance = fmin(made->image_distance, 0.5 * length);
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
    sb_status status = find_near(made, view, &count, error);
    if (status != SB_OK) {
        sb_plane_counter_destroy(made);
        return status;
    }
    advance(made, count);
    *counter = made;
    return SB_OK;
}

void sb_plane_counter_destroy(sb_plane_counter *counter)
{
    if (!counter) return;
    sb_free(counter->last);
    sb_free(counter->next);
    sb_free(counter);
}

/* +1 or -1 if the line from p to q passes the rectangle, by its direction; otherwise 0. */
static int passage(const sb_plane_counter *counter, sb_vec3 p, sb_vec3 q)
{
    double before = side_of(counter, p), after = side_of(counter, q);
    if ((before < 0) == (after < 0)) return 0;
    sb_vec3 at = sb_madd(p, before / (before - after), sb_sub(q, p));
    double along = (at.x - counter->ax) * counter->tx + (at.y - counter->ay) * counter->ty;
    bool within = at.z >= counter->plane->z_min && at.z <= counter->plane->z_max &&
                  (counter->flat || (along >= 0 && along <= counter->length));
    return !within ? 0 : before < 0 ? 1 : -1;
}

sb_status sb_plane_counter_step(sb_plane_counter *counter, const sb_measure_view *view, double *volume, sb_error *error)
{
    size_t count;
    sb_status status = find_near(counter, view, &count, error);
    if (status != SB_OK) return status;
    long net = 0;
    for (size_t i = 0, j = 0; i < count; i++) {
        while (j < counter->count && counter->last[j].id < counter->next[i].id) j++;
        for (size_t k = j; k < counter->count && counter->last[k].id == counter->next[i].id; k++)
            if (sb_norm(sb_sub(counter->last[k].position, counter->next[i].position)) < counter->image_distance)
                net += passage(counter, counter->last[k].position, counter->next[i].position);
    }
    advance(counter, count);
    *volume += (double)net * counter->particle_volume;
    return SB_OK;
}

size_t sb_plane_counter_bytes(const sb_plane_counter *counter)
{
    return sizeof *counter + (counter->capacity + counter->next_capacity) * sizeof *counter->last;
}

void sb_plane_counter_save(const sb_plane_counter *counter, sb_archive_out *out)
{
    sb_put_count(out, counter->count);
    for (size_t i = 0; i < counter->count; i++) {
        sb_put_count(out, counter->last[i].id);
        sb_put_vector(out, counter->last[i].position);
    }
}

sb_status sb_plane_counter_load(sb_plane_counter *counter, sb_archive_in *in, sb_error *error)
{
    const uint64_t count = sb_take_count(in, UINT32_MAX);
    counter->count = 0;
    /* The list grows one by one: a false count in a damaged file ends with the section and allocates nothing. */
    for (uint64_t i = 0; i < count && in->error.status == SB_OK; i++) {
        if (sb_grow((void **)&counter->last, &counter->capacity, counter->count + 1, sizeof *counter->last) != 0)
            return sb_fail_memory(error, counter->plane->name);
        near_particle *particle = &counter->last[counter->count++];
        particle->id = (uint32_t)sb_take_count(in, UINT32_MAX);
        particle->position = sb_take_vector(in);
    }
    return SB_OK;
}
