/* Boundary particles that all ranks have, whichever has sampled them: those near places where measurements read them,
   and near moving bodies, with which static walls are compared. */
#include "base/memory.h"
#include "geometry/model/walls.h"

#include <string.h>

/* A boundary particle near a place, on its way to the other ranks. */
typedef struct guest {
    sb_vec3 position, normal;
    uint32_t body, slab;
} guest;

/* Boxes around moving bodies: the lowest and the highest corner of each. */
typedef struct boxes {
    size_t count;
    sb_vec3 *corner; /* 2 count */
} boxes;

/* The difference of two coordinates, or of one and the nearest image of the other. */
static double nearest_image(const sb_walls_part *p, int axis, double difference)
{
    const sb_vec3 size = sb_sub(p->model->max, p->model->min);
    return sb_scene_repeats(p->scene, axis) ? remainder(difference, sb_component(size, axis)) : difference;
}

/* Distance in plan, or in space, of a point from the line between two others. */
static double distance_to(const sb_walls_part *p, const sb_model_place *place, sb_vec3 at)
{
    sb_vec3 way = sb_sub(place->to, place->at), from = sb_sub(at, place->at);
    if (place->column)
        way.z = from.z = 0;
    else
        from = sb_vec(nearest_image(p, 0, from.x), nearest_image(p, 1, from.y), from.z);
    const double length2 = sb_dot(way, way);
    const double along = length2 > 0 ? fmin(fmax(sb_dot(from, way) / length2, 0), 1) : 0;
    return sb_norm(sb_madd(from, -along, way));
}

static bool is_wanted(const sb_walls_part *p, const boxes *around, sb_vec3 at)
{
    for (size_t k = 0; k < p->team->place_count; ++k)
        if (distance_to(p, &p->team->places[k], at) <= p->team->places[k].range) return true;
    for (size_t k = 0; k < around->count; ++k)
        if (sb_box_contains(around->corner[2 * k], around->corner[2 * k + 1], at)) return true;
    return false;
}

/* Returns 0, or -1 without memory. */
static int find_boxes(const sb_walls_part *p, boxes *around)
{
    const sb_model *model = p->model;
    around->corner = sb_alloc(2 * model->body_count, sizeof *around->corner);
    if (!around->corner) return -1;
    for (size_t b = 0; b < model->body_count; ++b) {
        const sb_model_body *body = &model->bodies[b];
        if (sb_body_is_static(body) || body->count == 0) continue;
        sb_vec3 *corner = around->corner + 2 * around->count++;
        sb_model_shared_box(p->scene, model, body, &corner[0], &corner[1]);
    }
    return 0;
}

/* Lists the own boundary particles that the other ranks need. Returns 0, or -1 without memory. */
static int invite(const sb_walls_part *p, const boxes *around, guest **list, size_t *count)
{
    const sb_model *model = p->model;
    size_t capacity = 0;
    unsigned char *wanted = sb_alloc(model->walls.here, sizeof *wanted);
    int failed = wanted ? 0 : -1;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < (wanted ? model->walls.here : 0); ++i)
        wanted[i] = model->walls.of[i] == SB_WALL_OWN && is_wanted(p, around, model->wall_position[i]);
    for (size_t b = 0; b < model->body_count && !failed; ++b) {
        const sb_model_body *body = &model->bodies[b];
        for (size_t i = body->begin; i < body->begin + body->count && sb_body_is_static(body) && !failed; ++i) {
            if (!wanted[i]) continue;
            failed = sb_grow((void **)list, &capacity, *count + 1, sizeof **list);
            if (!failed)
                (*list)[(*count)++] = (guest){model->wall_position[i], model->wall_normal[i], (uint32_t)b, p->slab[i]};
        }
    }
    sb_free(wanted);
    return failed;
}

/* Whether a guest comes before the body's particles here, or after them; neither if it is one of them. */
static bool comes_before(const sb_walls_part *p, const guest *one)
{
    return one->slab < p->first;
}

static bool comes_after(const sb_walls_part *p, const guest *one)
{
    return one->slab >= p->last;
}

/* Puts the guests into the order of all: body after body, and slab after slab. */
static sb_status seat(const sb_walls_part *p, const guest *guests, size_t count, sb_error *error)
{
    sb_model *model = p->model;
    const size_t bodies = model->body_count;
    size_t *next = sb_alloc(2 * bodies, sizeof *next), all = model->walls.here; /* before and after each body's own */
    for (size_t k = 0; next && k < count; ++k) {
        next[2 * guests[k].body] += comes_before(p, &guests[k]);
        next[2 * guests[k].body + 1] += comes_after(p, &guests[k]);
    }
    for (size_t k = 0; next && k < 2 * bodies; ++k) all += next[k];
    sb_vec3 *position = sb_alloc_untouched(all, sizeof *position), *normal = sb_alloc_untouched(all, sizeof *normal);
    unsigned char *of = sb_alloc_untouched(all, sizeof *of);
    if (!next || !position || !normal || !of) {
        sb_free(next);
        sb_free(position);
        sb_free(normal);
        sb_free(of);
        return sb_fail_memory(error, "boundary particles");
    }
    size_t at = 0;
    for (size_t b = 0; b < bodies; ++b) {
        sb_model_body *body = &model->bodies[b];
        const size_t begin = at, before = next[2 * b], own = body->count, after = next[2 * b + 1];
        next[2 * b] = begin;
        next[2 * b + 1] = begin + before + own;
        memcpy(position + begin + before, model->wall_position + body->begin, own * sizeof *position);
        memcpy(normal + begin + before, model->wall_normal + body->begin, own * sizeof *normal);
        memcpy(of + begin + before, model->walls.of + body->begin, own * sizeof *of);
        body->begin = begin;
        body->count = before + own + after;
        at += body->count;
    }
    for (size_t k = 0; k < count; ++k) {
        const guest *one = &guests[k];
        if (!comes_before(p, one) && !comes_after(p, one)) continue;
        const size_t i = next[2 * one->body + !comes_before(p, one)]++;
        position[i] = one->position;
        normal[i] = one->normal;
        of[i] = SB_WALL_GUEST;
    }
    sb_free(next);
    sb_free(model->wall_position);
    sb_free(model->wall_normal);
    sb_free(model->walls.of);
    model->wall_position = position;
    model->wall_normal = normal;
    model->walls.of = of;
    model->walls.here = all;
    return SB_OK;
}

sb_status sb_walls_exchange_guests(const sb_walls_part *p, sb_error *error)
{
    guest *own = NULL;
    boxes around = {.count = 0};
    void *all = NULL;
    size_t count = 0, all_count = 0;
    const bool failed = find_boxes(p, &around) != 0 || invite(p, &around, &own, &count) != 0;
    sb_free(around.corner);
    sb_status status = failed ? sb_fail_memory(error, "boundary particles") : SB_OK;
    status = sb_team_collect(p->team, status, own, count, sizeof *own, &all, &all_count, error);
    sb_free(own);
    if (status == SB_OK) status = sb_team_agree(p->team, seat(p, all, all_count, error), error);
    sb_free(all);
    return status;
}
