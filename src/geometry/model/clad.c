/* Warns of static bodies whose surface lies close behind that of another static body (cladding). Within the support
   radius of the water both surfaces carry its load, and neither force is that of the body alone. */
#include "base/memory.h"
#include "geometry/model/parts.h"
#include "geometry/sampling/set.h"

#include <stdio.h>
#include <string.h>

/* SAME_WAY: cosine between two normals that point the same way. In spacings: BESIDE, distance along the face;
   CLOSEST, distance behind it; FIRST, distance of the nearest water from a face. SHARE: fraction of a face that must
   be affected. */
static const double SAME_WAY = 0.9, BESIDE = 0.75, CLOSEST = 0.05, FIRST = 0.5, SHARE = 0.2;

/* A body's particles are counted in six faces, by the axis and sign nearest to their normal. */
enum { FACES = 6 };

typedef struct search {
    const sb_model *model;
    double depth;   /* m: a surface farther behind another one carries no load */
    size_t *totals; /* FACES per body: number of its particles */
    size_t *found;  /* FACES per body: particles of the front body behind which this body has a surface */
    size_t *behind; /* FACES per body: particles of this body that lie behind the front body */
    size_t *seen;   /* per boundary particle: number of the front body for which it was last counted in `behind` */
    sb_vec3 *min;   /* per body: extent of its particles, m */
    sb_vec3 *max;
    sb_vec3 *place; /* per body: place of the particle with the smallest distance, m */
    double *nearest;
    size_t pairs;
    char first[700];  /* text of the first pair: front, rear, place */
    char others[600]; /* further pairs, as many as fit */
    size_t named;
} search;

static bool is_checked(const sb_model_body *body)
{
    return body->wavemaker < 0 && body->count > 0;
}

static bool overlap(sb_vec3 min, sb_vec3 max, sb_vec3 other_min, sb_vec3 other_max)
{
    return min.x <= other_max.x && min.y <= other_max.y && min.z <= other_max.z && max.x >= other_min.x &&
           max.y >= other_min.y && max.z >= other_min.z;
}

/* Collects the other bodies' particles near the front body. Each has its own index as source. */
static int gather(const search *s, size_t front, sb_vec3 min, sb_vec3 max, sb_sample_set *near)
{
    const sb_model *model = s->model;
    for (size_t b = 0; b < model->body_count; b++) {
        const sb_model_body *body = &model->bodies[b];
        if (b == front || !is_checked(body) || !(body->report || model->bodies[front].report) ||
            !overlap(min, max, s->min[b], s->max[b]))
            continue;
        for (size_t i = body->begin; i < body->begin + body->count; i++) {
            const sb_vec3 at = model->wall_position[i];
            const sb_sample one = {.at = at, .normal = model->wall_normal[i], .source = (uint32_t)i};
            if (overlap(min, max, at, at) && sb_sample_set_add(near, &one) != 0) return -1;
        }
    }
    return 0;
}

static size_t body_of(const sb_model *model, size_t particle)
{
    size_t b = 0;
    while (particle < model->bodies[b].begin || particle >= model->bodies[b].begin + model->bodies[b].count) b++;
    return b;
}

/* Returns the particle behind this one whose normal points the same way, and its depth; SIZE_MAX: none. */
static size_t look_behind(const search *s, const sb_sample_set *near, sb_vec3 at, sb_vec3 normal, double *depth)
{
    const double spacing = s->model->spacing;
    for (double step = 0.25 * spacing; near->sample && step <= s->depth; step += 0.5 * spacing) {
        size_t index = 0;
        const sb_vec3 there = sb_madd(at, -step, normal);
        if (!(sb_sample_set_nearest(near, there, spacing, &index) < spacing)) continue;
        const sb_sample *wall = &near->sample[index];
        const sb_vec3 way = sb_sub(at, wall->at);
        *depth = sb_dot(way, normal);
        if (sb_dot(wall->normal, normal) > SAME_WAY && *depth > CLOSEST * spacing && *depth < s->depth &&
            sb_norm(sb_madd(way, -*depth, normal)) < BESIDE * spacing)
            return wall->source;
    }
    return SIZE_MAX;
}

static void count_behind(search *s, const sb_model_body *front, const sb_sample_set *near)
{
    const sb_model *model = s->model;
    for (size_t i = front->begin; i < front->begin + front->count; i++) {
        double depth = 0;
        const size_t rear = look_behind(s, near, model->wall_position[i], model->wall_normal[i], &depth);
        if (rear == SIZE_MAX) continue;
        const size_t b = body_of(model, rear);
        if (!(s->nearest[b] <= depth)) {
            s->nearest[b] = depth;
            s->place[b] = model->wall_position[i];
        }
        s->found[FACES * b + (size_t)sb_model_direction_of(model->wall_normal[i])]++;
        const size_t number = (size_t)(front - model->bodies) + 1;
        if (s->seen[rear] != number) s->behind[FACES * b + (size_t)sb_model_direction_of(model->wall_normal[rear])]++;
        s->seen[rear] = number;
    }
}

static bool is_affected(const search *s, size_t front, size_t rear)
{
    for (size_t f = 0; f < FACES; f++) {
        const size_t found = s->found[FACES * rear + f], behind = s->behind[FACES * rear + f];
        if ((double)found > SHARE * (double)s->totals[FACES * front + f] ||
            (double)behind > SHARE * (double)s->totals[FACES * rear + f])
            return true;
    }
    return false;
}

static void add_pair(search *s, const sb_model_body *front, const sb_model_body *rear, sb_vec3 place, double depth)
{
    const size_t length = strlen(s->others);
    if (s->pairs++ == 0) {
        snprintf(s->first, sizeof s->first,
                 "bodies \"%s\" and \"%s\": the surface of the second lies about %.2g m behind that of the first, near "
                 "(%.4g, "
                 "%.4g, %.4g)",
                 front->name, rear->name, depth, place.x, place.y, place.z);
        return;
    }
    if (length + strlen(front->name) + strlen(rear->name) + 32 > sizeof s->others) return;
    snprintf(s->others + length, sizeof s->others - length, "%s \"%s\" behind \"%s\"", length == 0 ? "; likewise" : ",",
             rear->name, front->name);
    s->named++;
}

static sb_status check_body(search *s, size_t front, sb_error *error)
{
    const sb_model *model = s->model;
    const sb_model_body *body = &model->bodies[front];
    const double margin = s->depth + model->spacing;
    const sb_vec3 more = sb_vec(margin, margin, margin);
    const sb_vec3 min = sb_sub(s->min[front], more), max = sb_add(s->max[front], more);
    sb_sample_set near = {.cell = model->spacing, .origin = min};
    if (gather(s, front, min, max, &near) != 0) {
        sb_sample_set_free(&near);
        return sb_fail_memory(error, "surfaces behind surfaces");
    }
    memset(s->found, 0, FACES * model->body_count * sizeof *s->found);
    memset(s->behind, 0, FACES * model->body_count * sizeof *s->behind);
    for (size_t b = 0; b < model->body_count; b++) s->nearest[b] = (double)NAN;
    count_behind(s, body, &near);
    sb_sample_set_free(&near);
    for (size_t b = 0; b < model->body_count; b++)
        if (is_affected(s, front, b)) add_pair(s, body, &model->bodies[b], s->place[b], s->nearest[b]);
    return SB_OK;
}

static void measure_bodies(search *s)
{
    const sb_model *model = s->model;
    for (size_t b = 0; b < model->body_count; b++) {
        const sb_model_body *body = &model->bodies[b];
        for (size_t i = body->begin; i < body->begin + body->count; i++) {
            s->totals[FACES * b + (size_t)sb_model_direction_of(model->wall_normal[i])]++;
            s->min[b] = i == body->begin ? model->wall_position[i] : sb_min(s->min[b], model->wall_position[i]);
            s->max[b] = i == body->begin ? model->wall_position[i] : sb_max(s->max[b], model->wall_position[i]);
        }
    }
}

static sb_status check_all(search *s, sb_error *error)
{
    sb_status status = SB_OK;
    measure_bodies(s);
    for (size_t b = 0; b < s->model->body_count && status == SB_OK; b++)
        if (is_checked(&s->model->bodies[b])) status = check_body(s, b, error);
    return status;
}

static int allocate(search *s)
{
    const size_t bodies = s->model->body_count;
    s->totals = sb_alloc(FACES * bodies, sizeof *s->totals);
    s->found = sb_alloc(FACES * bodies, sizeof *s->found);
    s->behind = sb_alloc(FACES * bodies, sizeof *s->behind);
    s->seen = sb_alloc(s->model->wall_count, sizeof *s->seen);
    s->min = sb_alloc(bodies, sizeof *s->min);
    s->max = sb_alloc(bodies, sizeof *s->max);
    s->place = sb_alloc(bodies, sizeof *s->place);
    s->nearest = sb_alloc(bodies, sizeof *s->nearest);
    return s->totals && s->found && s->behind && s->seen && s->min && s->max && s->place && s->nearest ? 0 : -1;
}

static void release(search *s)
{
    sb_free(s->totals);
    sb_free(s->found);
    sb_free(s->behind);
    sb_free(s->seen);
    sb_free(s->min);
    sb_free(s->max);
    sb_free(s->place);
    sb_free(s->nearest);
}

sb_status sb_model_warn_clad(const sb_scene *scene, sb_model *model, sb_error *error)
{
    const sb_numerics *n = &scene->numerics;
    search s = {.model = model, .depth = (n->support - n->wall_offset - FIRST) * model->spacing};
    char more[40] = "";
    sb_status status = allocate(&s) != 0 ? sb_fail_memory(error, "surfaces behind surfaces") : check_all(&s, error);
    if (s.pairs > s.named + 1) snprintf(more, sizeof more, " and %zu more", s.pairs - s.named - 1);
    if (status == SB_OK && s.pairs > 0)
        status =
            sb_model_warn(model, error,
                          "%s: both carry the load of the same water, so the force on each is wrong, but the sum "
                          "of their forces is right; expected one body, or %.3g m or more between the surfaces%s%s",
                          s.first, s.depth, s.others, more);
    release(&s);
    return status;
}
