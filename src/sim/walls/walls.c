/* Creation of boundary particles [A12]: those of static and of moving bodies, with volumes, images and tables. */
#include "sim/walls/walls.h"
#include "base/memory.h"
#include "sim/search/sort.h"
#include "sim/simulation.h"
#include "sim/walls/absorber.h"
#include "sim/walls/mirrors.h"
#include "sim/walls/normals.h"
#include "sim/wcsph/boundary.h"

#include <math.h>
#include <string.h>

/* Whether a boundary particle lies on the grid of cells. One that was clamped to the lower edge does not. */
static bool on_grid(const sb_space *space, sb_record record)
{
    for (int axis = 0; axis < 3; axis++)
        if (record[axis] == 0 || record[axis] >> space->shift >> space->bits[axis] != 0) return false;
    return true;
}

/* Whether a set has a boundary particle of the model. Guests are near no particle of a rank's share. */
static bool takes(const sb_model *model, size_t particle, bool moving)
{
    return moving || !model->walls.divided || model->walls.of[particle] != SB_WALL_GUEST;
}

static bool is_marked(const sb_model *model, size_t particle, bool moving)
{
    return !moving && model->walls.divided && model->walls.of[particle] != SB_WALL_OWN;
}

/* Copies the boundary particles of the static or the moving bodies into a set. Boundary particles off the grid are left
   out: they are more than two cells outside of the domain and meet no water, and keys are unique only on the grid. */
static int copy_set(sb_sim *sim, bool moving, sb_wall_set *set)
{
    const sb_model *model = sim->model;
    for (size_t b = 0; b < model->body_count; b++)
        if ((model->bodies[b].wavemaker >= 0) == moving) set->count += model->bodies[b].count;
    set->record = sb_alloc_untouched(set->count, sizeof *set->record);
    set->body = sb_alloc_untouched(set->count, sizeof *set->body);
    set->facing = sb_alloc_untouched(set->count, sizeof *set->facing);
    if (!set->record || !set->body || !set->facing) return -1;
    size_t at = 0;
    for (size_t b = 0; b < model->body_count; b++) {
        const sb_model_body *body = &model->bodies[b];
        if ((body->wavemaker >= 0) != moving) continue;
        for (size_t i = body->begin; i < body->begin + body->count; i++) {
            sb_record record = sb_space_record(&sim->space, model->wall_position[i]);
            if (!on_grid(&sim->space, record) || !takes(model, i, moving)) continue;
            set->record[at] = record;
            const sb_vec3 normal = model->wall_normal ? model->wall_normal[i] : (sb_vec3){0};
            const sb_f4 rounded = {(float)normal.x, (float)normal.y, (float)normal.z, 0};
            if (sb_wall_normals_index(&sim->walls.normals, rounded, &set->facing[at]) != 0) return -1;
            set->body[at++] = (uint32_t)b | (is_marked(model, i, moving) ? SB_WALL_MARK : 0);
        }
    }
    set->count = at;
    return sim->needs.dynamic_walls ? sb_boundary_layers(sim, set) : 0;
}

static sb_status create_law(const sb_wavemaker_parameters *parameters, sb_moving_law *law, sb_error *error)
{
    sb_paddle paddle;
    const sb_status status = sb_paddle_create(parameters, &paddle, error);
    if (status == SB_OK) *law = (sb_moving_law){.paddle = paddle, .commanded = isinf(parameters->start)};
    return status;
}

sb_status sb_paddles_create(sb_sim *sim, sb_error *error)
{
    const sb_model *model = sim->model;
    sim->walls.laws = sb_alloc(sim->scene->wavemaker_count, sizeof *sim->walls.laws);
    sim->walls.moving_of_body = sb_alloc(model->body_count, sizeof *sim->walls.moving_of_body);
    sim->walls.moving = sb_alloc(model->body_count, sizeof *sim->walls.moving);
    if (!sim->walls.laws || !sim->walls.moving_of_body || !sim->walls.moving)
        return sb_fail_memory(error, "moving bodies");
    for (size_t b = 0; b < model->body_count; b++) {
        sim->walls.moving_of_body[b] = UINT32_MAX;
        if (model->bodies[b].wavemaker < 0) continue;
        const sb_wavemaker_use *use = &sim->scene->wavemakers[model->bodies[b].wavemaker];
        sb_moving_body *moving = &sim->walls.moving[sim->walls.moving_count];
        moving->law = &sim->walls.laws[model->bodies[b].wavemaker];
        moving->direction = use->direction;
        moving->share = 1 - model->bodies[b].held;
        const sb_status status = moving->law->paddle.kind ? SB_OK : create_law(&use->law, moving->law, error);
        if (status != SB_OK) return status;
        sim->walls.moving_of_body[b] = (uint32_t)sim->walls.moving_count++;
    }
    return SB_OK;
}

static sb_status create_absorbers(sb_sim *sim, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t b = 0; status == SB_OK && b < sim->model->body_count; b++) {
        const uint32_t m = sim->walls.moving_of_body[b];
        if (m != UINT32_MAX) status = sb_absorber_create(sim, b, &sim->walls.moving[m], error);
    }
    return status;
}

/* Keeps the moving set at displacement 0. Returns 0, or -1 without memory. */
static int keep_rest(const sb_wall_set *set, sb_moving_rest *rest)
{
    const size_t n = set->count;
    *rest = (sb_moving_rest){.count = n,
                             .record = sb_alloc_untouched(n, sizeof *rest->record),
                             .body = sb_alloc_untouched(n, sizeof *rest->body),
                             .facing = sb_alloc_untouched(n, sizeof *rest->facing),
                             .number = set->number ? sb_alloc_untouched(n, sizeof *rest->number) : NULL};
    if (!rest->record || !rest->body || !rest->facing || (set->number && !rest->number)) return -1;
    memcpy(rest->record, set->record, n * sizeof *rest->record);
    memcpy(rest->body, set->body, n * sizeof *rest->body);
    memcpy(rest->facing, set->facing, n * sizeof *rest->facing);
    if (set->number) memcpy(rest->number, set->number, n * sizeof *rest->number);
    return 0;
}

sb_status sb_walls_create(sb_sim *sim, sb_error *error)
{
    sb_status status = sb_paddles_create(sim, error);
    if (status == SB_OK) status = create_absorbers(sim, error);
    if (status != SB_OK) return status;
    if (sim->model->wall_count >= (size_t)1 << SB_INDEX_BITS)
        return sb_fail(error, SB_BAD_INPUT, "%zu boundary particles: expected fewer than %d", sim->model->wall_count,
                       1 << SB_INDEX_BITS);
    for (int s = 0; s < SB_WALL_SETS; s++) {
        sb_wall_set *set = &sim->walls.set[s];
        if (copy_set(sim, s == SB_MOVING, set) != 0 || sb_walls_table(set, &sim->space) != 0 ||
            sb_wall_volumes(sim, set, s == SB_MOVING) != 0)
            return sb_fail_memory(error, "boundary particles");
        const uint32_t mark = s == SB_STATIC && sim->model->walls.divided ? SB_WALL_IMAGE : 0;
        if (sim->space.repeats &&
            (sb_wall_images(set, &sim->space, mark) != 0 || sb_walls_table(set, &sim->space) != 0))
            return sb_fail_memory(error, "images of boundary particles");
        if (sb_walls_near_build(set, &sim->space) != 0) return sb_fail_memory(error, "boundary particles");
    }
    if (sim->needs.dynamic_walls && sb_boundary_create(sim) != 0)
        return sb_fail_memory(error, "dynamic boundary particles");
    if (sb_walls_share(sim) != 0) return sb_fail_memory(error, "boundary particles");
    if ((status = sb_mirrors_create(sim, error)) != SB_OK) return status;
    return keep_rest(&sim->walls.set[SB_MOVING], &sim->walls.rest) == 0
               ? SB_OK
               : sb_fail_memory(error, "moving boundary particles");
}

void sb_walls_destroy(sb_sim *sim)
{
    for (int s = 0; s < SB_WALL_SETS; s++) {
        sb_free(sim->walls.set[s].record);
        sb_free(sim->walls.set[s].body);
        sb_free(sim->walls.set[s].facing);
        sb_free(sim->walls.set[s].number);
        sb_free(sim->walls.set[s].near);
        sb_cells_free(&sim->walls.set[s].cells);
    }
    for (size_t m = 0; m < sim->walls.moving_count; m++) sb_free(sim->walls.moving[m].absorber);
    for (size_t w = 0; sim->walls.laws && w < sim->scene->wavemaker_count; w++)
        if (sim->walls.laws[w].paddle.kind) sb_paddle_destroy(&sim->walls.laws[w].paddle);
    sb_free(sim->walls.laws);
    sb_free(sim->walls.moving);
    sb_free(sim->walls.moving_of_body);
    sb_walls_share_free(&sim->walls.share);
    sb_wall_normals_free(&sim->walls.normals);
    sb_mirrors_destroy(sim);
    sb_free(sim->walls.rest.record);
    sb_free(sim->walls.rest.body);
    sb_free(sim->walls.rest.facing);
    sb_free(sim->walls.rest.number);
    sb_boundary_destroy(sim);
}
