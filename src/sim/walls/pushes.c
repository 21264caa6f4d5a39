#include "sim/walls/pushes.h"

#include "base/memory.h"
#include "sim/exchange/exchange.h"

#include <math.h>

static double component_along(double way, double period)
{
    return period > 0 ? way - period * round(way / period) : way;
}

/* From a place to a position, the short way round a domain that repeats. */
static sb_vec3 way_from(const sb_pushes *pushes, const sb_push_place *place, sb_vec3 at)
{
    sb_vec3 way = sb_sub(at, place->at);
    way.x = component_along(way.x, pushes->period.x);
    way.y = component_along(way.y, pushes->period.y);
    return way;
}

bool sb_pushes_near(const sb_sim *sim, const sb_group *group)
{
    if (!sim->pushes) return false;
    const double half = 2 * sim->space.quantum * (double)((uint64_t)1 << sim->space.shift);
    const sb_vec3 middle = sb_add(sb_space_position(&sim->space, group->corner), sb_vec(half, half, half));
    for (size_t p = 0; p < sim->pushes->place_count; p++) {
        const sb_push_place *place = &sim->pushes->places[p];
        const sb_vec3 way = way_from(sim->pushes, place, middle);
        const double most = half + place->range;
        if (fabs(way.x) < most && fabs(way.y) < most && fabs(way.z) < most) return true;
    }
    return false;
}

static bool is_near(const sb_pushes *pushes, size_t body, sb_vec3 at)
{
    for (size_t p = 0; p < pushes->place_count; p++) {
        const sb_push_place *place = &pushes->places[p];
        const sb_vec3 way = way_from(pushes, place, at);
        if (place->body == body && sb_dot(way, way) < place->range * place->range) return true;
    }
    return false;
}

void sb_pushes_add(sb_pushes *pushes, const sb_wall_push *push)
{
    if (!pushes->wanted[push->body] || sb_dot(push->force, push->force) == 0) return;
    if (!pushes->whole[push->body] && !is_near(pushes, push->body, push->at)) return;
#pragma omp critical(sb_pushes)
    {
        if (sb_grow((void **)&pushes->list, &pushes->capacity, pushes->count + 1, sizeof *pushes->list) != 0)
            pushes->failed = true;
        else
            pushes->list[pushes->count++] = *push;
    }
}

void sb_pushes_clear(sb_pushes *pushes)
{
    if (!pushes) return;
    pushes->count = 0;
    pushes->failed = false;
}

int sb_pushes_share(sb_sim *sim)
{
    sb_ranks *ranks = sim->ranks;
    sb_pushes *p = sim->pushes;
    if (!p || !sb_ranks_several(ranks)) return p && p->failed ? -1 : 0;
    size_t sizes[SB_RANKS_MAX], all = 0;
    const size_t own = p->count * sizeof *p->list;
    sb_ranks_gather(ranks, &own, sizeof own, sizes);
    for (int r = 0; r < ranks->count; r++) all += sizes[r];
    sb_wall_push *list = sb_alloc_untouched(all, 1);
    if (sb_ranks_any(ranks, p->failed || !list)) {
        sb_free(list);
        return -1;
    }
    sb_ranks_spread(ranks, p->list, list, sizes);
    sb_free(p->list);
    p->list = list;
    p->count = p->capacity = all / sizeof *list;
    return 0;
}

void sb_pushes_destroy(sb_pushes *pushes)
{
    if (!pushes) return;
    sb_free(pushes->places);
    sb_free(pushes->wanted);
    sb_free(pushes->whole);
    sb_free(pushes->list);
    sb_free(pushes);
}

/* NULL without memory. */
static sb_pushes *create(const sb_sim *sim, const sb_push_place *places, size_t count)
{
    sb_pushes *made = sb_alloc(1, sizeof *made);
    if (!made) return NULL;
    made->places = sb_alloc(count, sizeof *made->places);
    made->wanted = sb_alloc(sim->model->body_count, sizeof *made->wanted);
    made->whole = sb_alloc(sim->model->body_count, sizeof *made->whole);
    if (!made->places || !made->wanted || !made->whole) {
        sb_pushes_destroy(made);
        return NULL;
    }
    made->place_count = count;
    for (size_t p = 0; p < count; p++) {
        made->places[p] = places[p];
        made->wanted[places[p].body] = true;
        made->whole[places[p].body] |= isinf(places[p].range);
    }
    made->period =
        sb_vec((double)sim->space.period[0] * sim->space.quantum, (double)sim->space.period[1] * sim->space.quantum, 0);
    return made;
}

sb_status sb_sim_record_pushes(sb_sim *sim, const sb_push_place *places, size_t count, sb_error *error)
{
    sb_pushes_destroy(sim->pushes);
    sim->pushes = NULL;
    if (count == 0) return SB_OK;
    sb_pushes *made = create(sim, places, count);
    const sb_status own = made ? SB_OK : sb_fail_memory(error, "forces on walls");
    const sb_status status = sim->exchange->agree(sim, own, error);
    if (status == SB_OK)
        sim->pushes = made;
    else
        sb_pushes_destroy(made);
    return status;
}

const sb_wall_push *sb_sim_pushes(const sb_sim *sim, size_t *count)
{
    *count = sim->pushes ? sim->pushes->count : 0;
    return sim->pushes ? sim->pushes->list : NULL;
}
