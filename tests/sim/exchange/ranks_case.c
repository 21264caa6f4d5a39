#include "sim/exchange/ranks_case.h"

#include "check.h"
#include "scene/scene.h"
#include "sim/simulation.h"

#include <omp.h>
#include <stdio.h>
#include <string.h>

void ranks_make(const ranks_case *c, ranks_made *made)
{
    char path[RANKS_KEYS_MAX][64];
    char file[512];
    sb_override set[RANKS_KEYS_MAX];
    size_t count = 0;
    for (; count < RANKS_KEYS_MAX && c->set[count]; count++) {
        const char *value = strchr(c->set[count], '=');
        snprintf(path[count], sizeof path[count], "%.*s", (int)(value - c->set[count]), c->set[count]);
        set[count] = (sb_override){path[count], value + 1};
    }
    *made = (ranks_made){0};
    sb_error error = {0};
    snprintf(file, sizeof file, SB_SOURCE_DIR "/%s", c->file);
    if (sb_scene_read(file, NULL, set, count, &made->scene, &error) != SB_OK ||
        sb_model_build(&made->scene, &made->model, &error) != SB_OK)
        fail_msg("%s: %s", c->name, error.text);
}

void ranks_free(ranks_made *made)
{
    sb_model_free(&made->model);
    sb_scene_free(&made->scene);
}

typedef struct job {
    const ranks_case *what;
    const ranks_made *made;
    int threads;
    ranks_end end[RANKS_TEST_MAX];
} job;

static void run(sb_ranks *ranks, void *context)
{
    job *j = context;
    const int rank = sb_ranks_own(ranks);
    ranks_end *end = &j->end[rank];
    sb_sim *sim = NULL;
    omp_set_num_threads(j->threads);
    sb_status status = sb_sim_create(&j->made->scene, &j->made->model, ranks, &sim, &end->error);
    if (status == SB_OK) status = sb_sim_settle(sim, &end->error);
    for (int step = 0; step < j->what->steps && status == SB_OK; step++) status = sb_sim_step(sim, &end->error);
    if (status == SB_OK) {
        sb_sim_find_virial_pressures(sim);
        end->hash = sb_sim_hash(sim);
        end->time = sb_sim_report(sim)->time;
        end->energy = sb_sim_energy(sim);
        end->particles[0] = sim->state.n;
    }
    sb_sim_destroy(sim);
}

ranks_end ranks_run(const ranks_case *c, const ranks_made *made, int ranks, int threads, uint64_t disturb)
{
    job j = {.what = c, .made = made, .threads = threads};
    sb_error error = {0};
    if (ranks == 1)
        run(NULL, &j);
    else if (sb_ranks_threads_run(ranks, disturb, run, &j, &error) != SB_OK)
        fail_msg("%s", error.text);
    ranks_end end = j.end[0];
    for (int r = 0; r < ranks; r++) {
        const ranks_end *other = &j.end[r];
        end.particles[r] = other->particles[0];
        end.differs |= other->hash != end.hash || other->time != end.time || other->error.status != end.error.status ||
                       strcmp(other->error.text, end.error.text) != 0 ||
                       memcmp(&other->energy, &end.energy, sizeof end.energy) != 0;
    }
    return end;
}
