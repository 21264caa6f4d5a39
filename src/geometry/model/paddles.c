/* Paddles of wave trains: their water must be ahead, and the domain and its sponges must leave them room. */
#include "geometry/model/parts.h"
#include "physics/wavemakers/paddle_way.h"

#include <math.h>
#include <stdio.h>

/* In spacings: distance from a face within which its water is looked for. */
static const double NEAR = 3;

/* Share of its face that an undivided absorbing paddle needs in water: reflected is (1 - WIDE)/(1 + WIDE), 2.5 %. */
static const double WIDE = 0.95;

/* Where a paddle, or the water ahead of it, begins and ends along a direction, m. */
typedef struct extent {
    double back, front;
} extent;

static extent extent_of(const sb_model *model, size_t maker, sb_vec3 along)
{
    extent found = {(double)INFINITY, -(double)INFINITY};
    for (size_t b = 0; b < model->body_count; b++) {
        const sb_mesh *mesh = &model->bodies[b].mesh;
        if (model->bodies[b].wavemaker != (int)maker) continue;
        found.back = fmin(found.back, -sb_mesh_front(mesh, sb_scale(along, -1)));
        found.front = fmax(found.front, sb_mesh_front(mesh, along));
    }
    return found;
}

/* ---- water ahead ---- */

typedef struct sides {
    sb_vec3 along, across;
    extent paddle;
    double near;
    bool ahead, behind;
    extent water;      /* of the water ahead, along `across` */
    extent face;       /* of the paddle, along `across` */
    bool below, above; /* whether water ahead is just below and above the ends of the face, along `across` */
} sides;

static void find_sides(void *context, const sb_water_piece *piece)
{
    sides *s = context;
    for (size_t i = 0; i < piece->count; i++) {
        const double at = sb_dot(piece->position[i], s->along), place = sb_dot(piece->position[i], s->across);
        s->behind = s->behind || (at <= s->paddle.back && at >= s->paddle.back - s->near);
        if (!(at >= s->paddle.front && at <= s->paddle.front + s->near)) continue;
        s->ahead = true;
        s->water = (extent){fmin(s->water.back, place), fmax(s->water.front, place)};
        s->below = s->below || (place < s->face.back - s->near / NEAR && place > s->face.back - s->near);
        s->above = s->above || (place > s->face.front + s->near / NEAR && place < s->face.front + s->near);
    }
}

static sb_status check_facing(const sb_scene *scene, size_t maker, const sides *s, sb_error *error)
{
    const sb_vec3 way = s->along;
    char towards[80];
    if (s->ahead || !s->behind) return SB_OK;
    if (scene->dimensions == 2)
        snprintf(towards, sizeof towards, "[%g, %g]", 0 - way.x, 0 - way.z);
    else
        snprintf(towards, sizeof towards, "[%g, %g, %g]", 0 - way.x, 0 - way.y, 0 - way.z);
    return sb_fail(error, SB_BAD_INPUT,
                   "%.300s: wavemakers[%zu].direction: the water of %s is on the other side of its body, expected the "
                   "direction into the water, such as %s",
                   scene->path ? scene->path : "the scene", maker, scene->wavemakers[maker].name, towards);
}

/* Whether a neighbouring paddle of the same direction moves the water at this place across. */
static bool has_neighbour(const sb_scene *scene, const sb_model *model, size_t maker, sb_vec3 across, double place)
{
    for (size_t w = 0; w < scene->wavemaker_count; w++) {
        const extent other = extent_of(model, w, across);
        if (w == maker || sb_dot(scene->wavemakers[w].direction, scene->wavemakers[maker].direction) < 0.9) continue;
        if (place > other.back && place < other.front) return true;
    }
    return false;
}

/* Water beside a face does not go with it. */
static sb_status check_ends(const sb_scene *scene, size_t maker, const sides *s, sb_model *model, sb_error *error)
{
    const bool below = s->below && !has_neighbour(scene, model, maker, s->across, s->face.back - 0.5 * s->near);
    const bool above = s->above && !has_neighbour(scene, model, maker, s->across, s->face.front + 0.5 * s->near);
    if (scene->dimensions == 2 || (!below && !above)) return SB_OK;
    return sb_model_warn(
        model, error,
        "wave maker \"%s\": there is water beside its face, which is %.3g m wide: it passes beside the "
        "paddle, and the waves spread and come out lower; expected a body as wide as the water",
        scene->wavemakers[maker].name, s->face.front - s->face.back);
}

/* An undivided paddle absorbs by the mean surface over its face, where it is within the domain; push-plates without
   water do not absorb. */
static sb_status check_width(const sb_scene *scene, size_t maker, const sides *s, sb_model *model, sb_error *error)
{
    const sb_wavemaker_use *use = &scene->wavemakers[maker];
    const double half = 0.5 * model->spacing;
    const double from = fmax(s->face.back, -sb_domain_end(&scene->domain, sb_scale(s->across, -1)));
    const double to = fmin(s->face.front, sb_domain_end(&scene->domain, s->across));
    const double water = fmin(to, s->water.front + half) - fmax(from, s->water.back - half);
    if (scene->dimensions == 2 || !use->law.absorb || !s->ahead || water > WIDE * (to - from)) return SB_OK;
    if (use->plates.width > 0)
        return sb_model_warn(model, error,
                             "wave maker \"%s\": of its face of %.3g m, %.3g m have water ahead: push-plates without "
                             "water do not absorb; expected a body as wide as the water",
                             use->name, to - from, water);
    return sb_model_warn(
        model, error,
        "wave maker \"%s\": it absorbs by the mean surface over its face of %.3g m, and %.3g m of that "
        "have water ahead: it absorbs less than predicted; expected a body as wide as the water",
        use->name, to - from, water);
}

/* ---- room ---- */

/* An absorbing paddle moves from its law about as far as that moves, if waves of the same height come back; one without
   a law may need all of its reach. */
static sb_status check_reach(const sb_wavemaker_use *use, const sb_paddle_way *way, double behind, double ahead,
                             sb_model *model, sb_error *error)
{
    const double swing = fmax(way->most, -way->least);
    const double need = swing > 0 ? fmin(use->law.reach, swing) : use->law.reach;
    const double least = fmin(behind + way->least, ahead - way->most);
    if (!use->law.absorb || least >= need * (1 - 1e-9)) return SB_OK;
    return sb_model_warn(
        model, error,
        "wave maker \"%s\": to absorb waves it may have to move %.3g m from its law, and the sides of the domain leave "
        "%.3g m: it stops there, and reflects; expected a longer domain, or a reach of at most that",
        use->name, need, fmax(least, 0));
}

static sb_status check_travel(const sb_scene *scene, const sb_wavemaker_use *use, extent paddle, sb_model *model,
                              sb_error *error)
{
    sb_paddle law;
    if (sb_paddle_create(&use->law, &law, NULL) != SB_OK) return SB_OK;
    const sb_paddle_way way = sb_paddle_way_of(&law, scene->duration);
    sb_paddle_destroy(&law);
    const double ahead = sb_domain_end(&scene->domain, use->direction) - paddle.front;
    const double behind = sb_domain_room(&scene->domain, use->direction, paddle.front, paddle.back);
    if (way.most <= ahead && -way.least <= behind) return check_reach(use, &way, behind, ahead, model, error);
    return sb_model_warn(
        model, error,
        "wave maker \"%s\": it moves %.3g m back and %.3g m ahead, and the domain has %.3g m behind it "
        "and %.3g m ahead: expected lower or shorter waves, or a longer domain",
        use->name, 0 - way.least, way.most, behind, ahead);
}

/* A signal and a focus have a place ahead of the paddle. */
static sb_status check_distance(const sb_scene *scene, const sb_wavemaker_use *use, extent paddle, sb_model *model,
                                sb_error *error)
{
    const double ahead = sb_domain_end(&scene->domain, use->direction) - paddle.front;
    if (!(use->law.kind->needs & SB_WM_DISTANCE)) return SB_OK;
    for (size_t s = 0; s < scene->sponge_count; s++) {
        const sb_sponge *sponge = &scene->sponges[s];
        const double along = sb_component(use->direction, sponge->side / 2), sign = sponge->side % 2 ? 1 : -1;
        const double begins = sign * sponge->end - paddle.front - sponge->length;
        if (along * sign < 0.99 || use->law.distance <= begins || use->law.distance > ahead) continue;
        return sb_model_warn(
            model, error,
            "wave maker \"%s\": its distance of %g m is in the sponge \"%s\", which begins %.4g m ahead "
            "of it and takes the waves there; expected a shorter distance or a shorter sponge",
            use->name, use->law.distance, sponge->name, begins);
    }
    if (use->law.distance <= ahead) return SB_OK;
    return sb_model_warn(model, error,
                         "wave maker \"%s\": its distance of %g m is outside of the domain, which ends %.4g m ahead of "
                         "it: the waves never come there; expected a shorter distance or a longer domain",
                         use->name, use->law.distance, ahead);
}

/* ---- sponges ---- */

static sb_status check_sponges(const sb_scene *scene, const sb_wavemaker_use *use, extent paddle, sb_model *model,
                               sb_error *error)
{
    for (size_t s = 0; s < scene->sponge_count; s++) {
        const sb_sponge *sponge = &scene->sponges[s];
        const double along = sb_component(use->direction, sponge->side / 2), sign = sponge->side % 2 ? 1 : -1;
        const double face = paddle.front * along, room = (sponge->end - face) * sign;
        if (fabs(along) < 0.99 || room >= sponge->length * (1 - 1e-9)) continue;
        char length[64] = "a sponge at another side, or a longer domain";
        if (room > 0) snprintf(length, sizeof length, "a length below %.4g m", room);
        return sb_model_warn(model, error,
                             "sponge \"%s\": it covers the face of wave maker \"%s\" at %c = %.4g m, and takes its "
                             "waves where they are made; expected %s",
                             sponge->name, use->name, "xy"[sponge->side / 2], face, length);
    }
    return SB_OK;
}

sb_status sb_model_check_paddles(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t w = 0; w < scene->wavemaker_count && status == SB_OK; w++) {
        const sb_wavemaker_use *use = &scene->wavemakers[w];
        const extent paddle = extent_of(model, w, use->direction);
        if (!(use->law.kind->needs & SB_WM_TRAIN) || !isfinite(paddle.front)) continue;
        sides s = {.along = use->direction,
                   .across = sb_vec(-use->direction.y, use->direction.x, 0),
                   .paddle = paddle,
                   .near = NEAR * model->spacing,
                   .water = {(double)INFINITY, -(double)INFINITY}};
        s.face = extent_of(model, w, s.across);
        status = sb_model_visit_water(space, model, find_sides, &s, error);
        if (status == SB_OK) status = check_facing(scene, w, &s, error);
        if (status == SB_OK) status = check_ends(scene, w, &s, model, error);
        if (status == SB_OK) status = check_width(scene, w, &s, model, error);
        if (status == SB_OK) status = check_travel(scene, use, paddle, model, error);
        if (status == SB_OK) status = check_distance(scene, use, paddle, model, error);
        if (status == SB_OK) status = check_sponges(scene, use, paddle, model, error);
    }
    return status;
}
