/* Models that ranks, which are threads, build together. */
#ifndef SB_TESTS_TEAM_H
#define SB_TESTS_TEAM_H

#include "base/agree.h"
#include "base/memory.h"
#include "base/ranks_threads.h"
#include "small_model.h"

enum { TEAM_MAX = 9 };

/* What the ranks build, and their results. other: a scene that rank 1 has instead; NULL: the same. */
typedef struct team {
    int ranks;
    const sb_scene *other;
    const sb_model_place *places;
    size_t place_count;
    sb_model_need *need; /* of rank 0 */
    long fail_at;        /* the allocation that fails, of all ranks, from the start of rank 1; 0: none */
    sb_status status[TEAM_MAX];
    sb_error error[TEAM_MAX];
    sb_model part[TEAM_MAX];
} team;

static void team_work(sb_ranks *ranks, void *context)
{
    team *t = context;
    const int rank = sb_ranks_own(ranks);
    const sb_model_team together = {
        .ranks = ranks, .agree = sb_ranks_agree, .places = t->places, .place_count = t->place_count};
    if (rank == 1 && t->fail_at) sb_memory_fail_at(t->fail_at);
    t->status[rank] = sb_model_build_part(rank == 1 && t->other ? t->other : &scene, rank == 0 ? t->need : NULL,
                                          &together, &t->part[rank], &t->error[rank]);
}

static void team_build(team *t)
{
    assert_in_range(t->ranks, 1, TEAM_MAX);
    assert_int_equal(sb_ranks_threads_run(t->ranks, 0, team_work, t, &error), SB_OK);
}

static void team_free(team *t)
{
    for (int r = 0; r < t->ranks; r++) sb_model_free(&t->part[r]);
}

#endif
