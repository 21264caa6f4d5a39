#include "sim/sleep.h"

#include "base/memory.h"
#include "sim/impulse.h"
#include "sim/stages.h"

#include <string.h>

/* LOOK: steps between two looks at the water awake; a wave comes half a spacing nearer in each. LISTEN: steps of
   settling over which pressures are averaged; those of one step are off by up to a hundredth, of the whole sea
   together. */
enum { LOOK = 8, LISTEN = 20 };

bool sb_sleep_wanted(const sb_scene *scene)
{
    return scene->numerics.sleep && sb_sim_settles(scene) && scene->sea.present &&
           scene->wave.kind != SB_INITIAL_STANDING && scene->domain.side[SB_Z_MIN] != SB_SIDE_OPEN;
}

void sb_sleep_destroy(sb_sim *sim)
{
    sb_sleep *sleep = sim->sleep;
    if (!sleep) return;
    sb_tiles_free(&sleep->tiles);
    void *fields[] = {sleep->first,           sleep->position,  sleep->pressure,       sleep->density,      sleep->id,
                      sleep->fringe_position, sleep->fringe_q,  sleep->fringe_density, sleep->block_beside, sleep->held,
                      sleep->held_sum,        sleep->settled_q, sleep->settled_push};
    for (size_t f = 0; f < sizeof fields / sizeof fields[0]; f++) sb_free(fields[f]);
    sb_cells_free(&sleep->cells);
    sb_cells_free(&sleep->fringe_cells);
    sb_free(sleep);
    sim->sleep = NULL;
}

int sb_sleep_make(sb_sim *sim)
{
    sb_sleep *sleep = sim->sleep = sb_alloc(1, sizeof *sleep);
    if (!sleep || sb_tiles_create(sim, &sleep->tiles) != 0) return -1;
    sleep->first = sb_alloc(sleep->tiles.count + 1, sizeof *sleep->first);
    sleep->block_beside = sb_alloc(sim->model->fluid_count / SB_BLOCK + 1, 1);
    sleep->held_sum = sb_alloc(sim->model->body_count * SB_IMPULSE_VALUES, sizeof *sleep->held_sum);
    sleep->woken = -1;
    return sleep->first && sleep->block_beside && sleep->held_sum ? 0 : -1;
}

/* Densities by id: the sort leaves a step's fields where they were. */
static float *densities(const sb_sim *sim)
{
    float *density = sb_alloc(sim->model->fluid_count, sizeof *density);
    for (size_t i = 0; density && i < sim->n; i++) density[sim->id[i]] = sim->density[i];
    return density;
}

/* Lists are of the order before the sort, so none are left. What the sort drops was never there for the run, whose
   energy is counted from after it. */
static sb_status lay_down(sb_sim *sim, sb_error *error)
{
    sb_sleep *sleep = sim->sleep;
    const double left = sim->ledger.left;
    sim->listed = sim->told = false;
    float *density = densities(sim);
    for (size_t i = 0; i < sim->n; i++) sim->unknown[i] = sleep->settled_q[sim->id[i]];
    sb_status status = SB_OK;
    if (!density || sb_held_take(sim) != 0) status = sb_fail_memory(error, "still water");
    if (status == SB_OK) status = sb_stage_sort(sim, error);
    sim->ledger.left = left;
    if (status == SB_OK && sb_sleepers_take(sim, density) != 0) status = sb_fail_memory(error, "still water");
    sb_free(density);
    sb_free(sleep->settled_q);
    sb_free(sleep->settled_push);
    sleep->settled_q = NULL;
    sleep->settled_push = NULL;
    if (status != SB_OK) return status;
    sb_tiles_fringe(&sleep->tiles);
    return sb_sleepers_fringe(sim) == 0 ? SB_OK : sb_fail_memory(error, "still water");
}

sb_status sb_sleep_expect(sb_sim *sim, sb_error *error)
{
    if (!sb_sleep_wanted(sim->scene)) return SB_OK;
    sb_sleep_destroy(sim);
    if (sb_sleep_make(sim) != 0) return sb_fail_memory(error, "still water");
    sb_sleep *sleep = sim->sleep;
    sleep->settled_q = sb_alloc(sim->model->fluid_count, sizeof *sleep->settled_q);
    sleep->settled_push = sb_alloc(sim->model->fluid_count, sizeof *sleep->settled_push);
    sleep->share = 1;
    return sleep->settled_q && sleep->settled_push ? SB_OK : sb_fail_memory(error, "still water");
}

void sb_sleep_feel(const sb_sim *sim, size_t i, uint32_t wall, sb_vec3 push)
{
    const sb_sleep *sleep = sim->sleep;
    if (!sleep) return;
    sb_settled_push *mean = &sleep->settled_push[sim->id[i]];
    mean->wall = wall;
    mean->push[0] += sleep->share * (float)push.x;
    mean->push[1] += sleep->share * (float)push.y;
    mean->push[2] += sleep->share * (float)push.z;
}

/* Makes room in the mean of pushes for the next step's share, whether it brings one or not. */
void sb_sleep_listen(sb_sim *sim, int step)
{
    sb_sleep *sleep = sim->sleep;
    if (!sleep) return;
    const float share = sleep->share, next = 1.0f / (float)(step + 1 < LISTEN ? step + 2 : LISTEN);
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < sim->n; i++) {
        const uint32_t id = sim->id[i];
        sleep->settled_q[id] += share * (sim->unknown[i] - sleep->settled_q[id]);
        for (int axis = 0; axis < 3; axis++) sleep->settled_push[id].push[axis] *= 1 - next;
    }
    sleep->share = next;
}

static bool any_may_sleep(const sb_tiles *tiles)
{
    for (size_t t = 0; t < tiles->count; t++)
        if (!tiles->awake[t] && tiles->water[t] > 0) return true;
    return false;
}

sb_status sb_sleep_begin(sb_sim *sim, sb_error *error)
{
    sb_sleep *sleep = sim->sleep;
    if (!sleep) return SB_OK;
    sb_tiles_look(sim, &sleep->tiles);
    sb_tiles_wake(sim, &sleep->tiles);
    sb_status status = any_may_sleep(&sleep->tiles) ? lay_down(sim, error) : SB_OK;
    if (sleep->count == 0) /* nothing to do, ever */
        sb_sleep_destroy(sim);
    return status;
}

/* Sleepers that a disturbance has come near go back to where particles are moved. */
static sb_status wake(sb_sim *sim, sb_error *error)
{
    sb_sleep *sleep = sim->sleep;
    sb_held_wake(sim);
    if (sb_sleepers_wake(sim) != 0) return sb_fail_memory(error, "still water");
    if (sleep->count == 0) sleep->woken = sim->report.time;
    return SB_OK;
}

sb_status sb_stage_wake(sb_sim *sim, sb_error *error)
{
    sb_sleep *sleep = sim->sleep;
    if (!sleep || sim->settling) return SB_OK;
    sb_status status = SB_OK;
    if (sleep->count > 0 && sim->report.step % LOOK == 0) {
        sb_tiles_look(sim, &sleep->tiles);
        const bool woken = sb_tiles_wake(sim, &sleep->tiles);
        if (woken) status = wake(sim, error);
        const bool moved = sb_tiles_fringe(&sleep->tiles);
        if (status == SB_OK && (woken || moved) && sb_sleepers_fringe(sim) != 0)
            status = sb_fail_memory(error, "still water");
    }
    sleep->particle_steps += sim->n + sleep->count;
    sleep->asleep_steps += sleep->count;
    return status;
}

sb_status sb_stage_fringe(sb_sim *sim, sb_error *error)
{
    sb_sleep *sleep = sim->sleep;
    if (sb_fringe_count(sim) == 0) return SB_OK;
    const size_t first = sb_fringe_first(sim), count = sleep->fringe, blocks = sb_blocks(sim);
    if (sb_ghosts_room(sim, sim->ghosts.count + count) != 0) return sb_fail_memory(error, "still water");
    memcpy(sim->position + first, sleep->fringe_position, count * sizeof *sim->position);
    memset(sim->velocity + first, 0, count * sizeof *sim->velocity);
    memset(sim->acceleration + first, 0, count * sizeof *sim->acceleration);
#pragma omp parallel for schedule(static)
    for (size_t b = 0; b < blocks; b++) {
        bool beside = false;
        for (size_t i = b * SB_BLOCK; i < sb_block_end(sim, b) && !beside; i++)
            beside = sleep->tiles.beside[sb_tile_of(sim, &sleep->tiles, sim->position[i])];
        sleep->block_beside[b] = beside;
    }
    return SB_OK;
}

sb_sleep_report sb_sim_sleep(const sb_sim *sim)
{
    const sb_sleep *sleep = sim->sleep;
    if (!sleep) return (sb_sleep_report){0};
    return (sb_sleep_report){.asleep = sleep->count,
                             .particle_steps = sleep->particle_steps,
                             .asleep_steps = sleep->asleep_steps,
                             .woken = sleep->woken};
}

size_t sb_sleep_bytes(const sb_sim *sim)
{
    const sb_sleep *sleep = sim->sleep;
    if (!sleep) return 0;
    const size_t each = sizeof *sleep->position + 2 * sizeof(float) + sizeof *sleep->id;
    return sizeof *sleep + sb_tiles_bytes(&sleep->tiles) + (sleep->tiles.count + 1) * sizeof *sleep->first +
           sleep->capacity * each + sleep->fringe * (sizeof *sleep->fringe_position + 2 * sizeof(float)) +
           sleep->held_count * sizeof *sleep->held + sb_cells_bytes(&sleep->cells) +
           sb_cells_bytes(&sleep->fringe_cells);
}
