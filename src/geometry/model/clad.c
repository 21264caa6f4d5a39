/* Warns of static bodies whose surface lies close behind that of another static body (cladding). Within the support
   radius of the water both surfaces carry its load, and neither force is that of the body alone. */
#include "base/memory.h"
#include "geometry/model/walls.h"
#include "geometry/sampling/set.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* SAME_WAY: cosine between two normals that point the same way. In spacings: BESIDE, distance along the face;
   CLOSEST, distance behind it; FIRST, distance of the nearest water from a face. SHARE: fraction of a face that must
   be affected. */
static const double SAME_WAY = 0.9, BESIDE = 0.75, CLOSEST = 0.05, FIRST = 0.5, SHARE = 0.2;

/* A body's particles are counted in six faces, by the axis and sign nearest to their normal. */
enum { FACES = 6 };

/* What was found of two bodies, by this rank or by all. */
typedef struct pair {
    uint32_t front, rear, order; /* order: in the list of all ranks */
    uint64_t found[FACES];       /* particles of the front body behind which the rear body has a surface */
    uint64_t behind[FACES];      /* particles of the rear body that lie behind the front body */
    double nearest;              /* m, NaN: none was found */
    sb_vec3 place;               /* of the particle with that distance, m */
} pair;

typedef struct search {
    const sb_model *model;
    double depth;     /* m: a surface farther behind another one carries no load */
    uint64_t *totals; /* FACES per body: number of its particles */
    pair *present;    /* per body: what was found of the present front body and this one */
    size_t *seen;     /* per boundary particle: number of the front body for which it was last counted in `behind` */
    sb_vec3 *min;     /* per body: extent of its particles, m */
    sb_vec3 *max;
    pair *list; /* by front, then by rear */
    size_t count, capacity;
    size_t pairs;
    char first[700];  /* text of the first pair: front, rear, place */
    char others[600]; /* further pairs, as many as fit */
    size_t named;
} search;

static bool is_checked(const sb_model *model, size_t body)
{
    return model->bodies[body].wavemaker < 0 && sb_model_body_walls(model, body) > 0;
}

/* Whether this rank counts a particle, or has it only because others depend on it. */
static bool is_own(const sb_model *model, size_t particle)
{
    return !model->walls.divided || model->walls.of[particle] == SB_WALL_OWN;
}

/* Whether all that is near a particle is here. */
static bool is_inner(const sb_model *model, size_t particle)
{
    return !model->walls.divided || model->walls.of[particle] != SB_WALL_GUEST;
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
        if (b == front || !is_checked(model, b) || !(body->report || model->bodies[front].report) ||
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

/* Notes a distance unless a smaller one is known. Of equal ones the first counts. */
static void note_nearest(pair *p, double depth, sb_vec3 place)
{
    if (isnan(depth) || p->nearest <= depth) return;
    p->nearest = depth;
    p->place = place;
}

static void count_behind(search *s, const sb_model_body *front, const sb_sample_set *near)
{
    const sb_model *model = s->model;
    const size_t number = (size_t)(front - model->bodies) + 1;
    for (size_t i = front->begin; i < front->begin + front->count; i++) {
        double depth = 0;
        if (!is_inner(model, i)) continue;
        const size_t rear = look_behind(s, near, model->wall_position[i], model->wall_normal[i], &depth);
        if (rear == SIZE_MAX) continue;
        pair *p = &s->present[body_of(model, rear)];
        if (is_own(model, i)) {
            note_nearest(p, depth, model->wall_position[i]);
            p->found[sb_model_direction_of(model->wall_normal[i])]++;
        }
        if (s->seen[rear] != number && is_own(model, rear))
            p->behind[sb_model_direction_of(model->wall_normal[rear])]++;
        s->seen[rear] = number;
    }
}

static bool is_affected(const search *s, const pair *p)
{
    for (size_t f = 0; f < FACES; f++)
        if ((double)p->found[f] > SHARE * (double)s->totals[FACES * p->front + f] ||
            (double)p->behind[f] > SHARE * (double)s->totals[FACES * p->rear + f])
            return true;
    return false;
}

/* Adds what was found of the present front body to the list. Returns 0, or -1 without memory. */
static int list_pairs(search *s)
{
    for (size_t b = 0; b < s->model->body_count; b++) {
        const pair *p = &s->present[b];
        uint64_t any = 0;
        for (int f = 0; f < FACES; f++) any += p->found[f] + p->behind[f];
        if (any == 0) continue;
        if (sb_grow((void **)&s->list, &s->capacity, s->count + 1, sizeof *s->list) != 0) return -1;
        s->list[s->count++] = *p;
    }
    return 0;
}

static void add_pair(search *s, const pair *p)
{
    const sb_model_body *front = &s->model->bodies[p->front], *rear = &s->model->bodies[p->rear];
    const size_t length = strlen(s->others);
    if (s->pairs++ == 0) {
        snprintf(s->first, sizeof s->first,
                 "bodies \"%s\" and \"%s\": the surface of the second lies about %.2g m behind that of the first, near "
                 "(%.4g, "
                 "%.4g, %.4g)",
                 front->name, rear->name, p->nearest, p->place.x, p->place.y, p->place.z);
        return;
    }
    if (length + strlen(front->name) + strlen(rear->name) + 32 > sizeof s->others) return;
    snprintf(s->others + length, sizeof s->others - length, "%s \"%s\" behind \"%s\"", length == 0 ? "; likewise" : ",",
             rear->name, front->name);
    s->named++;
}

static int find_behind(search *s, size_t front)
{
    const sb_model *model = s->model;
    const sb_model_body *body = &model->bodies[front];
    const double margin = s->depth + model->spacing;
    const sb_vec3 more = sb_vec(margin, margin, margin);
    const sb_vec3 min = sb_sub(s->min[front], more), max = sb_add(s->max[front], more);
    sb_sample_set near = {.cell = model->spacing, .origin = min};
    if (gather(s, front, min, max, &near) != 0) {
        sb_sample_set_free(&near);
        return -1;
    }
    for (size_t b = 0; b < model->body_count; b++)
        s->present[b] = (pair){.front = (uint32_t)front, .rear = (uint32_t)b, .nearest = (double)NAN};
    count_behind(s, body, &near);
    sb_sample_set_free(&near);
    return list_pairs(s);
}

static void measure_bodies(search *s)
{
    const sb_model *model = s->model;
    for (size_t b = 0; b < model->body_count; b++) {
        const sb_model_body *body = &model->bodies[b];
        for (size_t i = body->begin; i < body->begin + body->count; i++) {
            if (!is_own(model, i)) continue;
            s->totals[FACES * b + (size_t)sb_model_direction_of(model->wall_normal[i])]++;
            if (model->walls.divided) continue;
            s->min[b] = i == body->begin ? model->wall_position[i] : sb_min(s->min[b], model->wall_position[i]);
            s->max[b] = i == body->begin ? model->wall_position[i] : sb_max(s->max[b], model->wall_position[i]);
        }
        if (!model->walls.divided) continue;
        s->min[b] = body->low;
        s->max[b] = body->high;
    }
}

static int find_all(search *s)
{
    measure_bodies(s);
    for (size_t b = 0; b < s->model->body_count; b++)
        if (is_checked(s->model, b) && find_behind(s, b) != 0) return -1;
    return 0;
}

/* ---- several ranks ---- */

static int by_bodies(const void *left, const void *right)
{
    const pair *a = left, *b = right;
    if (a->front != b->front) return a->front < b->front ? -1 : 1;
    if (a->rear != b->rear) return a->rear < b->rear ? -1 : 1;
    return (a->order > b->order) - (a->order < b->order);
}

/* Adds up what all ranks have found of the same bodies. The ranks are in the order of the particles. */
static void merge(pair *list, size_t *count)
{
    size_t kept = 0;
    for (size_t k = 0; k < *count; k++) list[k].order = (uint32_t)k;
    if (*count > 0) qsort(list, *count, sizeof *list, by_bodies);
    for (size_t k = 0; k < *count; k++) {
        pair *last = kept > 0 ? &list[kept - 1] : NULL;
        if (!last || last->front != list[k].front || last->rear != list[k].rear) {
            list[kept++] = list[k];
            continue;
        }
        note_nearest(last, list[k].nearest, list[k].place);
        for (int f = 0; f < FACES; f++) {
            last->found[f] += list[k].found[f];
            last->behind[f] += list[k].behind[f];
        }
    }
    *count = kept;
}

/* Makes the search of this rank that of all. */
static sb_status join(search *s, const sb_model_team *team, sb_status before, sb_error *error)
{
    void *all = NULL;
    size_t count = 0;
    const sb_status status = sb_team_collect(team, before, s->list, s->count, sizeof *s->list, &all, &count, error);
    if (status != SB_OK) return status;
    sb_ranks_add(team->ranks, s->totals, FACES * s->model->body_count);
    sb_free(s->list);
    s->list = all;
    s->count = count;
    merge(s->list, &s->count);
    return SB_OK;
}

static int allocate(search *s)
{
    const size_t bodies = s->model->body_count;
    s->totals = sb_alloc(FACES * bodies, sizeof *s->totals);
    s->present = sb_alloc(bodies, sizeof *s->present);
    s->seen = sb_alloc(s->model->walls.divided ? s->model->walls.here : s->model->wall_count, sizeof *s->seen);
    s->min = sb_alloc(bodies, sizeof *s->min);
    s->max = sb_alloc(bodies, sizeof *s->max);
    return s->totals && s->present && s->seen && s->min && s->max ? 0 : -1;
}

static void release(search *s)
{
    sb_free(s->totals);
    sb_free(s->present);
    sb_free(s->seen);
    sb_free(s->min);
    sb_free(s->max);
    sb_free(s->list);
}

sb_status sb_model_warn_clad(const sb_scene *scene, const sb_model_team *team, sb_status before, sb_model *model,
                             sb_error *error)
{
    const sb_numerics *n = &scene->numerics;
    search s = {.model = model, .depth = (n->support - n->wall_offset - FIRST) * model->spacing};
    char more[40] = "";
    sb_status status = before;
    if (status == SB_OK && (allocate(&s) != 0 || find_all(&s) != 0))
        status = sb_fail_memory(error, "surfaces behind surfaces");
    if (team) status = join(&s, team, status, error);
    for (size_t k = 0; k < s.count && status == SB_OK; k++)
        if (is_affected(&s, &s.list[k])) add_pair(&s, &s.list[k]);
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
