/* Boundary particles of one of several ranks. A rank samples its slabs and those beside them; of all others it has what
   lies near places and moving bodies, which the ranks give each other. What it then knows of all boundary particles is
   that of one rank, bit for bit. */
#include "geometry/model/walls.h"
#include "base/hash.h"
#include "base/memory.h"

#include <inttypes.h>
#include <string.h>

bool sb_model_divides_walls(const sb_scene *scene)
{
    const sb_numerics *n = &scene->numerics;
    if (sb_scene_repeats(scene, sb_sample_axis(scene->domain.min, scene->domain.max, scene->dimensions))) return false;
    /* What depends on a particle is nearer than a slab: a surface behind it, and what that has before it. */
    const double reach = 2 * (n->support + 1) + 4 * n->wall_offset;
    return !scene->foam.enabled && n->walls != SB_WALLS_DYNAMIC && reach <= SB_SAMPLE_SLAB * n->wall_spacing;
}

/* ---- equal bodies ---- */

static uint64_t hash_bodies(const sb_model *model)
{
    uint64_t hash = sb_hash(0, &model->body_count, sizeof model->body_count);
    for (size_t b = 0; b < model->body_count; ++b) {
        const sb_mesh *mesh = &model->bodies[b].mesh;
        const uint64_t facts[] = {mesh->vertex_count, mesh->triangle_count, (uint64_t)model->bodies[b].wavemaker};
        hash = sb_hash(hash, facts, sizeof facts);
        hash = sb_hash(hash, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices);
        hash = sb_hash(hash, mesh->triangles, mesh->triangle_count * sizeof *mesh->triangles);
    }
    return hash;
}

/* Equal files give equal bodies, but a mesh on another host may be an older one. */
static sb_status compare(const sb_walls_part *p, sb_error *error)
{
    uint64_t all[SB_RANKS_MAX];
    const uint64_t own = hash_bodies(p->model);
    sb_ranks_gather(p->team->ranks, &own, sizeof own, all);
    if (own == all[0]) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT,
                   "another model than that of rank 0: its bodies hash to %016" PRIx64 ", expected %016" PRIx64
                   ": a mesh or grid file differs",
                   own, all[0]);
}

/* ---- sampling ---- */

/* Samples the own slabs and those beside them. */
static sb_status sample(sb_walls_part *p, const sb_model_surfaces *surfaces, sb_error *error)
{
    const size_t rank = (size_t)sb_ranks_own(p->team->ranks);
    const uint32_t from = p->bounds[rank], to = p->bounds[rank + 1], end = p->bounds[sb_ranks_count(p->team->ranks)];
    sb_model *model = p->model;
    sb_samples samples = {.count = 0};
    p->first = from < to && from > 0 ? from - 1 : from;
    p->last = from < to && to < end ? to + 1 : to;
    sb_status status =
        sb_sample_slabs(&surfaces->settings, surfaces->sources, surfaces->count, p->first, p->last, &samples, error);
    if (status == SB_OK) status = sb_model_take_samples(p->scene, p->space, &samples, model, error);
    p->slab = samples.slab;
    if (status != SB_OK) return status;
    model->walls = (sb_model_walls){.divided = true, .here = model->wall_count};
    model->walls.of = sb_alloc_untouched(model->walls.here, sizeof *model->walls.of);
    p->counts = sb_alloc(model->body_count + 1, sizeof *p->counts);
    if (!model->walls.of || !p->counts) return sb_fail_memory(error, "boundary particles");
    for (size_t b = 0; b < model->body_count; ++b) {
        const sb_model_body *body = &model->bodies[b];
        for (size_t i = body->begin; i < body->begin + body->count; ++i) {
            const bool own = !sb_body_is_static(body) || (p->slab[i] >= from && p->slab[i] < to);
            model->walls.of[i] = own ? SB_WALL_OWN : SB_WALL_BESIDE;
        }
    }
    return SB_OK;
}

/* Cuts the slabs as rank 0 does, so that ranks of unequal builds agree, and samples. */
static sb_status divide_and_sample(sb_walls_part *p, sb_error *error)
{
    const size_t ranks = (size_t)sb_ranks_count(p->team->ranks);
    sb_model_surfaces surfaces = {.count = 0};
    sb_status status = sb_model_surfaces_create(p->scene, p->space, p->model, &surfaces, error);
    p->bounds = sb_alloc(ranks + 1, sizeof *p->bounds);
    if (status == SB_OK && !p->bounds) status = sb_fail_memory(error, "slabs of surfaces");
    if (status == SB_OK)
        status = sb_sample_divide(&surfaces.settings, surfaces.sources, surfaces.count, ranks, p->bounds, error);
    status = sb_team_agree(p->team, status, error);
    if (status == SB_OK) {
        sb_ranks_share(p->team->ranks, 0, p->bounds, (ranks + 1) * sizeof *p->bounds);
        status = sb_team_agree(p->team, sample(p, &surfaces, error), error);
    }
    sb_model_surfaces_free(&surfaces);
    return status;
}

/* ---- what a rank knows of all ---- */

static uint64_t hash_body(const sb_model *model, size_t body)
{
    const sb_model_body *of = &model->bodies[body];
    uint64_t hash = 0;
    for (size_t i = of->begin; i < of->begin + of->count; ++i)
        if (model->walls.of[i] == SB_WALL_OWN) hash += sb_model_hash_wall(model, body, i);
    return hash;
}

/* Finds the extent of a body's boundary particles of all ranks. */
static void know_extent(const sb_walls_part *p, sb_model_body *body)
{
    typedef struct extent {
        sb_vec3 low, high;
    } extent;
    const sb_model *model = p->model;
    const sb_vec3 above = {(double)INFINITY, (double)INFINITY, (double)INFINITY};
    extent own = {above, sb_scale(above, -1)}, all[SB_RANKS_MAX];
    for (size_t i = body->begin; i < body->begin + body->count; ++i) {
        own.low = sb_min(own.low, model->wall_position[i]);
        own.high = sb_max(own.high, model->wall_position[i]);
    }
    body->low = own.low;
    body->high = own.high;
    if (!sb_body_is_static(body)) return;
    sb_ranks_gather(p->team->ranks, &own, sizeof own, all);
    for (int r = 0; r < sb_ranks_count(p->team->ranks); ++r) {
        body->low = sb_min(body->low, all[r].low);
        body->high = sb_max(body->high, all[r].high);
    }
}

/* Counts and hashes the boundary particles of all ranks, and finds their extent. Those of moving bodies are whole in
   each rank. */
static void know_all(sb_walls_part *p)
{
    sb_model *model = p->model;
    const size_t bodies = model->body_count;
    for (size_t b = 0; b < bodies; ++b) {
        const sb_model_body *body = &model->bodies[b];
        for (size_t i = body->begin; i < body->begin + body->count && sb_body_is_static(body); ++i)
            p->counts[b] += model->walls.of[i] == SB_WALL_OWN;
        if (sb_body_is_static(body)) p->counts[bodies] += hash_body(model, b);
    }
    sb_ranks_add(p->team->ranks, p->counts, bodies + 1);
    model->walls.hash = p->counts[bodies];
    model->wall_count = 0;
    for (size_t b = 0; b < bodies; ++b) {
        sb_model_body *body = &model->bodies[b];
        body->all = sb_body_is_static(body) ? p->counts[b] : body->count;
        model->wall_count += body->all;
        if (!sb_body_is_static(body)) model->walls.hash += hash_body(model, b);
        if (body->all > 0) know_extent(p, body);
    }
}

sb_status sb_model_sample_part(const sb_scene *scene, const sb_model_team *team, const sb_model_space *space,
                               sb_status before, sb_model *model, sb_error *error)
{
    sb_walls_part p = {.scene = scene, .team = team, .space = space, .model = model};
    sb_status status = sb_team_agree(team, before, error);
    if (status == SB_OK) status = sb_team_agree(team, compare(&p, error), error);
    if (status == SB_OK) status = divide_and_sample(&p, error);
    if (status == SB_OK) {
        know_all(&p);
        status = sb_walls_exchange_guests(&p, error);
    }
    sb_free(p.bounds);
    sb_free(p.slab);
    sb_free(p.counts);
    return status;
}

sb_status sb_team_agree(const sb_model_team *team, sb_status own, sb_error *error)
{
    return team->agree(team->ranks, sb_model_failure(own, error), error);
}

sb_status sb_team_collect(const sb_model_team *team, sb_status before, void *own, size_t count, size_t size, void **all,
                          size_t *all_count, sb_error *error)
{
    sb_status status = sb_team_agree(team, before, error);
    if (status != SB_OK) return status;
    const size_t ranks = (size_t)sb_ranks_count(team->ranks), bytes = count * size;
    size_t sizes[SB_RANKS_MAX], sum = 0;
    sb_ranks_gather(team->ranks, &bytes, sizeof bytes, sizes);
    for (size_t r = 0; r < ranks; ++r) sum += sizes[r];
    void *made = sb_alloc_untouched(sum, 1);
    status = sb_team_agree(team, made ? SB_OK : sb_fail_memory(error, "boundary particles"), error);
    if (status != SB_OK) {
        sb_free(made);
        return status;
    }
    sb_ranks_spread(team->ranks, own, made, sizes);
    *all = made;
    *all_count = sum / size;
    return SB_OK;
}
