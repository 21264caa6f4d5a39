/* ranks_probe WHAT: one rank of a test, which mpirun starts. It exits with 0 if all is as it should be, else with 3. */
#include "base/hash.h"
#include "base/memory.h"
#include "base/random.h"
#include "mpi/world.h"

#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static sb_ranks *ranks;

static void end(const char *line)
{
    fprintf(stderr, "probe: %s\n", line);
    sb_world_abort(ranks);
    _exit(2);
}

#define CHECK(condition)                                                                                               \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            fprintf(stderr, "probe: rank %d, line %d: %s\n", ranks->rank, __LINE__, #condition);                       \
            exit(3);                                                                                                   \
        }                                                                                                              \
    } while (0)

/* The length and the bytes of the parcel of a round between two ranks, as both ends know them. Some are empty, some
   above the limit up to which MPI sends without asking. */
static size_t length_of(int round, int from, int to)
{
    const uint64_t hash = sb_hash_mix((uint64_t)round * 1000003u + (uint64_t)from * 1009u + (uint64_t)to);
    return hash % 5 == 0 ? 0 : hash % 7 == 0 ? (size_t)(hash >> 8) % 300000 : (size_t)(hash >> 8) % 2000;
}

static unsigned char byte_of(int round, int from, int to, size_t at)
{
    return (unsigned char)(sb_hash_mix(at + 31u * (uint64_t)round + 17u * (uint64_t)from + 7u * (uint64_t)to) >> 20);
}

/* Rounds of parcels of all sizes, each with a gather while they are under way. */
static void exchange(void)
{
    enum { ROUNDS = 60, MOST = 16 };
    const int own = ranks->rank, count = ranks->count;
    for (int round = 0; round < ROUNDS; round++) {
        sb_parcel send[MOST], receive[MOST];
        size_t sends = 0, receives = 0;
        for (int r = 0; r < count; r++) {
            const size_t out = length_of(round, own, r), in = length_of(round, r, own);
            if (r != own && out > 0) send[sends++] = (sb_parcel){r, sb_alloc(out, 1), out};
            if (r != own && in > 0) receive[receives++] = (sb_parcel){r, sb_alloc(in, 1), in};
        }
        for (size_t k = 0; k < sends; k++)
            for (size_t at = 0; at < send[k].size; at++)
                ((unsigned char *)send[k].bytes)[at] = byte_of(round, own, send[k].rank, at);
        sb_ranks_start(ranks, send, sends, receive, receives);
        int all[MOST];
        const int mine = 100 * round + own;
        sb_ranks_gather(ranks, &mine, sizeof mine, all);
        for (int r = 0; r < count; r++) CHECK(all[r] == 100 * round + r);
        /* Some or all of the messages are complete before anyone waits for them. */
        for (int looks = 0; looks < round; looks++) sb_ranks_progress(ranks);
        sb_ranks_finish(ranks);
        for (size_t k = 0; k < receives; k++)
            for (size_t at = 0; at < receive[k].size; at++)
                CHECK(((unsigned char *)receive[k].bytes)[at] == byte_of(round, receive[k].rank, own, at));
        for (size_t k = 0; k < sends; k++) sb_free(send[k].bytes);
        for (size_t k = 0; k < receives; k++) sb_free(receive[k].bytes);
    }
}

/* Orders reach all ranks in their order. What fails in one rank fails in all, with the rank's name. */
static void orders(void)
{
    sb_error error = {0};
    for (int k = 1; k <= 50; k++) {
        int order = ranks->rank == 0 ? k : 0;
        if (ranks->rank == 0)
            sb_world_order(ranks, &order, sizeof order);
        else
            sb_world_await(ranks, &order, sizeof order);
        CHECK(order == k);
    }
    CHECK(sb_world_agree(ranks, SB_OK, &error) == SB_OK);
    const bool fails = ranks->rank == ranks->count - 1;
    const sb_status own = fails ? sb_fail(&error, SB_BAD_INPUT, "reason") : SB_OK;
    CHECK(sb_world_agree(ranks, own, &error) == SB_BAD_INPUT);
    char expected[200];
    snprintf(expected, sizeof expected, "rank %d on %s: reason", ranks->count - 1,
             sb_world_host(ranks, ranks->count - 1));
    CHECK(strcmp(error.text, expected) == 0);
    sb_fail(&error, SB_FAILED, "of all");
    CHECK(sb_world_agree(ranks, SB_FAILED, &error) == SB_FAILED && strcmp(error.text, "of all") == 0);
    CHECK(sb_world_hosts(ranks) == 1 && sb_world_sharing(ranks) == ranks->count);
}

/* Rank 0 learns of a signal that the last rank has received. */
static void signals(void)
{
    char done = 0;
    if (ranks->rank == ranks->count - 1) sb_world_tell_signal(ranks, SIGTERM);
    while (ranks->rank == 0 && sb_world_signal_told(ranks) != SIGTERM) usleep(1000);
    if (ranks->rank == 0)
        sb_world_order(ranks, &done, 1);
    else
        sb_world_await(ranks, &done, 1);
}

static void next_order(void)
{
    char order = 1;
    if (ranks->rank == 0)
        sb_world_order(ranks, &order, 1);
    else
        sb_world_await(ranks, &order, 1);
}

/* A rank that has failed alone, in the order before or in the middle of one. */
static void fail_alone(int rank, bool within)
{
    sb_error error = {0};
    char own = 1, all[16];
    next_order();
    sb_fail(&error, SB_FAILED, "no memory here");
    if (ranks->rank == rank)
        sb_world_failed(ranks, &error);
    else if (within)
        sb_ranks_gather(ranks, &own, 1, all);
    next_order();
    sb_ranks_gather(ranks, &own, 1, all);
}

/* What fails in all ranks, in any order of time, does not end them. */
static void fail_together(void)
{
    sb_error error = {0};
    int all[16];
    sb_fail(&error, SB_FAILED, "in all");
    for (int k = 0; k < 6; k++) {
        next_order();
        usleep((useconds_t)(30000 * ((ranks->rank + k) % ranks->count)));
        sb_world_failed(ranks, &error);
        next_order();
        const int own = 10 * k + ranks->rank;
        sb_ranks_gather(ranks, &own, sizeof own, all);
        for (int r = 0; r < ranks->count; r++) CHECK(all[r] == 10 * k + r);
    }
}

/* Rank 0 works alone for longer than the deadline. */
static void lead_slowly(void)
{
    if (ranks->rank == 0) usleep(4500000);
    next_order();
}

int main(int count, char **arguments)
{
    const char *what = count > 1 ? arguments[1] : "";
    sb_error error = {0};
    int all[16];
    const bool soon = strcmp(what, "silent") == 0 || strcmp(what, "slow") == 0;
    if (sb_world_join(soon ? 1 : 60, end, &ranks, &error) != SB_OK) {
        fprintf(stderr, "probe: %s\n", error.text);
        return 1;
    }
    if (!ranks) {
        printf("alone\n");
        return 0;
    }
    signal(SIGTERM,
           SIG_IGN); /* which mpirun sends, before it kills, when a rank has ended: as in a run, it is only noted */
    if (strcmp(what, "works") == 0) {
        exchange();
        orders();
        signals();
        fail_together();
    }
    if (strcmp(what, "slow") == 0) lead_slowly();
    if (strcmp(what, "alone-before") == 0) fail_alone(1, false);
    if (strcmp(what, "alone-within") == 0) fail_alone(1, true);
    if (strcmp(what, "leader-alone") == 0) fail_alone(0, true);
    if (strcmp(what, "dies") == 0 && ranks->rank == ranks->count - 1) raise(SIGKILL);
    if (strcmp(what, "silent") == 0 && ranks->rank == ranks->count - 1) sleep(60);
    sb_ranks_gather(ranks, &count, sizeof count, all);
    sb_world_leave(ranks);
    return 0;
}
