#include "sim/exchange/ranks_case.h"

#include "base/agree.h"
#include "base/memory.h"
#include "check.h"
#include "scene/scene.h"
#include "sim/simulation.h"

#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
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

size_t ranks_places(const ranks_made *made, sb_push_place places[RANKS_BODIES_MAX])
{
    const size_t bodies = made->model.body_count;
    assert_true(bodies <= RANKS_BODIES_MAX);
    for (size_t b = 0; b < bodies; b++) places[b] = (sb_push_place){b, made->model.min, 0.5};
    return bodies;
}

void ranks_free(ranks_made *made)
{
    sb_model_free(&made->model);
    sb_scene_free(&made->scene);
}

typedef struct job {
    const ranks_case *what;
    const ranks_made *made;
    const ranks_way *way;
    ranks_end end[RANKS_TEST_MAX];
} job;

/* The lower water of a middle part of the domain, with images across y. */
static void query(const sb_sim *sim, ranks_end *end)
{
    const sb_vec3 low = sim->model->min, size = sb_sub(sim->model->max, low);
    const sb_vec3 min = sb_vec(low.x + 0.05 * size.x, low.y - size.y, low.z);
    const sb_vec3 max = sb_vec(low.x + 0.6 * size.x, low.y + 2 * size.y, low.z + 0.5 * size.z);
    end->samples = sb_alloc(RANKS_SAMPLES_MAX, sizeof *end->samples);
    end->few = sb_sim_query(sim, min, max, end->samples, 3);
    end->found = sb_sim_query(sim, min, max, end->samples, RANKS_SAMPLES_MAX);
}

static void sum_pushes(const sb_sim *sim, ranks_end *end)
{
    sb_exact sum[3] = {0};
    const sb_wall_push *push = sb_sim_pushes(sim, &end->push_count);
    for (size_t k = 0; k < end->push_count; k++) {
        sb_exact_add(&sum[0], push[k].force.x);
        sb_exact_add(&sum[1], push[k].force.y);
        sb_exact_add(&sum[2], push[k].force.z);
    }
    end->push = sb_vec(sb_exact_value(&sum[0]), sb_exact_value(&sum[1]), sb_exact_value(&sum[2]));
}

static sb_status begin(const job *j, sb_sim *sim, sb_error *error)
{
    if (!j->way->from) return sb_sim_settle(sim, error);
    sb_archive_in in = {0};
    sb_status status = sb_archive_parse(&in, "saved", j->way->from->bytes, j->way->from->used, "ranks", 1, error);
    if (status == SB_OK) status = sb_sim_load(sim, &in, error);
    sb_archive_in_free(&in);
    return status;
}

static void show(sb_sim *sim, ranks_end *end, bool first)
{
    sb_sim_find_virial_pressures(sim);
    end->hash = sb_sim_hash(sim);
    end->time = sb_sim_report(sim)->time;
    end->energy = sb_sim_energy(sim);
    end->departures = *sb_sim_departures(sim);
    end->crossing = *sb_sim_crossing(sim);
    end->fluid = sb_sim_report(sim)->fluid_count;
    end->particles[0] = sb_sim_owned(sim);
    end->frame = sb_sim_snapshot(sim);
    query(sim, end);
    sum_pushes(sim, end);
    if (first) sb_archive_begin(&end->saved, "ranks", 1);
    sb_sim_save(sim, first ? &end->saved : NULL);
    if (first) sb_archive_close(&end->saved, &end->error);
}

static void run(sb_ranks *ranks, void *context)
{
    job *j = context;
    ranks_end *end = &j->end[sb_ranks_own(ranks)];
    sb_sim *sim = NULL;
    omp_set_num_threads(j->way->threads);
    sb_push_place places[RANKS_BODIES_MAX];
    const size_t place_count = ranks_places(j->made, places);
    const int steps = j->way->steps > 0 ? j->way->steps : j->what->steps;
    sb_model part = {.dimensions = 0};
    const bool divided = j->way->divided;
    const sb_model_team team = {.ranks = ranks, .agree = sb_ranks_agree};
    if (divided && sb_model_build_part(&j->made->scene, NULL, &team, &part, &end->error) != SB_OK)
        abort(); /* the others would wait */
    if (divided && ranks->count > 1 && !(part.walls.divided && (part.part.divided || !j->way->water)))
        abort(); /* the case would show nothing */
    sb_status status = sb_sim_create(&j->made->scene, divided ? &part : &j->made->model, ranks, &sim, &end->error);
    sb_model_free_start(&part);
    if (status == SB_OK) status = begin(j, sim, &end->error);
    if (status == SB_OK) status = sb_sim_record_pushes(sim, places, place_count, &end->error);
    for (int step = 0; step < steps && status == SB_OK; step++) status = sb_sim_step(sim, &end->error);
    if (status == SB_OK) show(sim, end, sb_ranks_own(ranks) == 0);
    sb_sim_destroy(sim);
    sb_model_free(&part);
}

bool ranks_same_samples(const ranks_end *a, const ranks_end *b)
{
    if (a->found != b->found || a->few != b->few || !a->samples != !b->samples) return false;
    for (size_t k = 0; k < a->found && a->samples; k++) {
        const sb_fluid_sample *x = &a->samples[k], *y = &b->samples[k];
        if (x->id != y->id || x->pressure != y->pressure || x->density != y->density ||
            memcmp(&x->position, &y->position, sizeof x->position) != 0 ||
            memcmp(&x->velocity, &y->velocity, sizeof x->velocity) != 0)
            return false;
    }
    return true;
}

static bool same_in_all(const ranks_end *a, const ranks_end *b)
{
    return a->hash == b->hash && a->time == b->time && a->error.status == b->error.status && ranks_same_samples(a, b) &&
           a->fluid == b->fluid && strcmp(a->error.text, b->error.text) == 0 &&
           memcmp(&a->energy, &b->energy, sizeof a->energy) == 0 && memcmp(&a->push, &b->push, sizeof a->push) == 0 &&
           a->push_count == b->push_count;
}

ranks_end ranks_run(const ranks_case *c, const ranks_made *made, const ranks_way *way)
{
    job j = {.what = c, .made = made, .way = way};
    sb_error error = {0};
    if (way->ranks == 1)
        run(NULL, &j);
    else if (sb_ranks_threads_run(way->ranks, way->disturb, run, &j, &error) != SB_OK)
        fail_msg("%s", error.text);
    ranks_end end = j.end[0];
    for (int r = 0; r < way->ranks; r++) {
        end.particles[r] = j.end[r].particles[0];
        end.differs |= !same_in_all(&j.end[r], &j.end[0]);
        if (r > 0) ranks_end_free(&j.end[r]);
    }
    return end;
}

void ranks_end_free(ranks_end *end)
{
    sb_frame_release(end->frame);
    sb_archive_out_free(&end->saved);
    sb_free(end->samples);
}
