/* Boundary particles [A12]. The search table of the static ones is built once; that of the moving ones is rebuilt only
   while they move. */
#include "sim/walls/walls.h"
#include "base/hash.h"
#include "base/memory.h"
#include "sim/search/sort.h"
#include "sim/simulation.h"
#include "sim/step/stages.h"
#include "sim/walls/absorber.h"
#include "sim/walls/mirrors.h"
#include "sim/walls/normals.h"
#include "sim/wcsph/boundary.h"

#include <math.h>
#include <string.h>

/* ---- Z-order blocks near walls: one look-up recognises a cell without walls ---- */

enum { NEAR_SHIFT = 6 }; /* 4 x 4 x 4 cells */

static bool near_insert(sb_wall_set *set, uint64_t block)
{
    uint64_t at = sb_hash_mix(block) & set->near_mask;
    for (;; at = (at + 1) & set->near_mask) {
        if (set->near[at] == block + 1) return false;
        if (set->near[at] == 0) {
            set->near[at] = block + 1;
            return true;
        }
    }
}

bool sb_walls_near(const sb_wall_set *set, const sb_space *space, sb_record record)
{
    if (set->count == 0) return false;
    uint64_t block = sb_space_key(space, record) >> NEAR_SHIFT;
    for (uint64_t at = sb_hash_mix(block) & set->near_mask;; at = (at + 1) & set->near_mask) {
        if (set->near[at] == block + 1) return true;
        if (set->near[at] == 0) return false;
    }
}

static uint64_t block_beside(const sb_space *space, sb_record record, int dx, int dy, int dz)
{
    uint32_t cell = (uint32_t)1 << space->shift;
    sb_record beside = record + (sb_record){(uint32_t)dx * cell, (uint32_t)dy * cell, (uint32_t)dz * cell, 0};
    return sb_space_key(space, beside) >> NEAR_SHIFT;
}

int sb_walls_near_build(sb_wall_set *set, const sb_space *space)
{
    size_t slots = 64, used = 0;
    for (;;) {
        sb_free(set->near);
        set->near = sb_alloc(slots, sizeof *set->near);
        set->near_mask = slots - 1;
        if (!set->near) return -1;
        used = 0;
        for (size_t c = 0; c < set->cells.count && 2 * used < slots; c++)
            for (int d = 0; d < 27 && 2 * used < slots; d++)
                used += near_insert(
                    set, block_beside(space, set->record[set->cells.begin[c]], d % 3 - 1, d / 3 % 3 - 1, d / 9 - 1));
        if (2 * used < slots) return 0;
        slots *= 4;
    }
}

/* ---- tables ---- */

int sb_walls_table(sb_wall_set *set, const sb_space *space)
{
    size_t n = set->count;
    uint64_t *words = sb_alloc_untouched(n, sizeof *words), *other = sb_alloc_untouched(n, sizeof *words);
    sb_record *record = sb_alloc_untouched(n, sizeof *record);
    uint32_t *body = sb_alloc_untouched(n, sizeof *body);
    uint32_t *facing = sb_alloc_untouched(n, sizeof *facing);
    int status = -1;
    if (!words || !other || !record || !body || !facing) goto done;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) words[i] = sb_sort_word(sb_space_key(space, set->record[i]), i);
    const uint64_t *sorted = sb_sort(words, other, n, SB_INDEX_BITS, SB_INDEX_BITS + space->key_bits);
    if (!sorted) goto done;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        size_t from = sb_word_index(sorted[i]);
        record[i] = set->record[from];
        body[i] = set->body[from];
        facing[i] = set->facing[from];
    }
    memcpy(set->record, record, n * sizeof *record);
    memcpy(set->body, body, n * sizeof *body);
    memcpy(set->facing, facing, n * sizeof *facing);
    for (size_t i = 0; i < n && set->number; i++) body[i] = set->number[sb_word_index(sorted[i])];
    if (set->number) memcpy(set->number, body, n * sizeof *body);
    status = sb_cells_build(&set->cells, set->record, n, space->shift);
done:
    sb_free(words);
    sb_free(other);
    sb_free(record);
    sb_free(body);
    sb_free(facing);
    return status;
}

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

sb_status sb_paddles_create(sb_sim *sim, sb_error *error)
{
    const sb_model *model = sim->model;
    sim->walls.moving_of_body = sb_alloc(model->body_count, sizeof *sim->walls.moving_of_body);
    sim->walls.moving = sb_alloc(model->body_count, sizeof *sim->walls.moving);
    if (!sim->walls.moving_of_body || !sim->walls.moving) return sb_fail_memory(error, "moving bodies");
    for (size_t b = 0; b < model->body_count; b++) {
        sim->walls.moving_of_body[b] = UINT32_MAX;
        if (model->bodies[b].wavemaker < 0) continue;
        const sb_wavemaker_use *use = &sim->scene->wavemakers[model->bodies[b].wavemaker];
        sb_moving_body *moving = &sim->walls.moving[sim->walls.moving_count];
        moving->direction = use->direction;
        moving->share = 1 - model->bodies[b].held;
        moving->commanded = isinf(use->law.start);
        const sb_status status = sb_paddle_create(&use->law, &moving->paddle, error);
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
    const sb_wall_set *set = &sim->walls.set[SB_MOVING];
    sim->walls.rest.count = set->count;
    sim->walls.rest.record = sb_alloc_untouched(set->count, sizeof *sim->walls.rest.record);
    sim->walls.rest.body = sb_alloc_untouched(set->count, sizeof *sim->walls.rest.body);
    sim->walls.rest.facing = sb_alloc_untouched(set->count, sizeof *sim->walls.rest.facing);
    sim->walls.rest.number = set->number ? sb_alloc_untouched(set->count, sizeof *set->number) : NULL;
    if (set->number && !sim->walls.rest.number) return sb_fail_memory(error, "moving boundary particles");
    if (!sim->walls.rest.record || !sim->walls.rest.body || !sim->walls.rest.facing)
        return sb_fail_memory(error, "moving boundary particles");
    for (size_t i = 0; i < set->count; i++) {
        sim->walls.rest.record[i] = set->record[i];
        sim->walls.rest.body[i] = set->body[i];
        sim->walls.rest.facing[i] = set->facing[i];
        if (set->number) sim->walls.rest.number[i] = set->number[i];
    }
    return SB_OK;
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
    for (size_t m = 0; m < sim->walls.moving_count; m++) {
        sb_paddle_destroy(&sim->walls.moving[m].paddle);
        sb_free(sim->walls.moving[m].absorber);
    }
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

/* ---- moving ---- */

/* Places the moving set at the bodies' present displacements. Boundary particles that have left the grid of cells (a
   gate pulled out of the domain) meet no water and are left out. */
static void place(sb_sim *sim)
{
    sb_wall_set *set = &sim->walls.set[SB_MOVING];
    set->count = 0;
    for (size_t i = 0; i < sim->walls.rest.count; i++) {
        const sb_moving_body *moving = &sim->walls.moving[sim->walls.moving_of_body[sim->walls.rest.body[i]]];
        sb_vec3 shift = sb_scale(moving->direction, moving->displacement / sim->space.quantum);
        if (!(sb_norm(shift) < SB_POSITION_END)) continue;
        sb_record step = {(uint32_t)(int32_t)nearbyint(shift.x), (uint32_t)(int32_t)nearbyint(shift.y),
                          (uint32_t)(int32_t)nearbyint(shift.z), 0};
        sb_record placed = sim->walls.rest.record[i] + step;
        if (!sb_space_inside(&sim->space, placed)) continue;
        sb_carry(&placed, sb_carried_value(sim->walls.rest.record[i]));
        set->record[set->count] = placed;
        set->facing[set->count] = sim->walls.rest.facing[i];
        if (set->number) set->number[set->count] = sim->walls.rest.number[i];
        set->body[set->count++] = sim->walls.rest.body[i];
    }
}

sb_status sb_stage_walls(sb_sim *sim, sb_error *error)
{
    double time = sim->state.time, dt = sim->state.time_step;
    bool moved = false;
    for (size_t m = 0; m < sim->walls.moving_count; m++) {
        sb_moving_body *moving = &sim->walls.moving[m];
        double here = sim->policy->runs ? moving->share * sb_paddle_displacement(&moving->paddle, time) : 0;
        double there = sim->policy->runs ? moving->share * sb_paddle_displacement(&moving->paddle, time + dt) : 0;
        if (moving->absorber) here += moving->absorber->state.offset;
        moved |= here != moving->displacement;
        moving->displacement = here;
        moving->next_displacement = there;
    }
    if (sim->policy->runs && sb_absorbers_measure(sim) != 0) return sb_fail_memory(error, "absorbing paddles");
    for (size_t m = 0; m < sim->walls.moving_count; m++) {
        sb_moving_body *moving = &sim->walls.moving[m];
        if (moving->absorber && sim->policy->runs) moving->next_displacement += sb_absorber_advance(sim, moving);
        moving->velocity = sb_scale(moving->direction, (moving->next_displacement - moving->displacement) / dt);
    }
    return moved ? sb_walls_restore(sim, error) : SB_OK;
}

sb_status sb_sim_trigger(sb_sim *sim, size_t wavemaker, sb_error *error)
{
    const char *name = sim->scene->wavemakers[wavemaker].name;
    if (sim->state.settle.under_way)
        return sb_fail(error, SB_BAD_INPUT, "wave maker \"%s\": the water settles, expected a command after that",
                       name);
    bool found = false;
    for (size_t b = 0; b < sim->model->body_count; b++) {
        if (sim->model->bodies[b].wavemaker != (int)wavemaker) continue;
        sb_paddle *paddle = &sim->walls.moving[sim->walls.moving_of_body[b]].paddle;
        if (isfinite(paddle->start))
            return sb_fail(error, SB_BAD_INPUT, "wave maker \"%s\": its motion began or begins at t = %.17g s", name,
                           paddle->start);
        paddle->start = sim->state.time;
        found = true;
    }
    return found ? SB_OK : sb_fail(error, SB_BAD_INPUT, "wave maker \"%s\": moves no body", name);
}

sb_status sb_walls_restore(sb_sim *sim, sb_error *error)
{
    if (sim->walls.moving_count == 0) return SB_OK;
    place(sim);
    if (sb_walls_table(&sim->walls.set[SB_MOVING], &sim->space) != 0 ||
        sb_walls_near_build(&sim->walls.set[SB_MOVING], &sim->space) != 0)
        return sb_fail_memory(error, "moving boundary particles");
    return SB_OK;
}
