/* Ranks as threads: every parcel arrives at its place, gathers and sums are complete, with and without disturbance. */
#include "base/random.h"
#include "base/ranks_threads.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { ROUNDS = 8, WORDS = 64 };

/* A fact that a rank has found to be wrong; cmocka's asserts are for the main thread only. */
typedef struct outcome {
    int wrong[16];
    uint64_t bytes[16], messages[16];
} outcome;

/* Word w of the parcel that rank a sends to rank b in a round. */
static uint32_t word(int a, int b, int round, int w)
{
    return (uint32_t)(((a * 16 + b) * ROUNDS + round) * WORDS + w);
}

/* Words from a to b: 0 for some pairs. */
static size_t length(int a, int b, int round)
{
    return (size_t)(a * 7 + b * 3 + round) % WORDS;
}

static int exchange_round(sb_ranks *ranks, int round)
{
    uint32_t out[16][WORDS], in[16][WORDS];
    sb_parcel send[16], receive[16];
    size_t sends = 0, receives = 0;
    const int me = ranks->rank;
    int wrong = 0;
    for (int r = 0; r < ranks->count; r++) {
        for (int w = 0; w < WORDS; w++) out[r][w] = word(me, r, round, w), in[r][w] = 0;
        if (r == me) continue;
        if (length(me, r, round) > 0) send[sends++] = (sb_parcel){r, out[r], 4 * length(me, r, round)};
        if (length(r, me, round) > 0) receive[receives++] = (sb_parcel){r, in[r], 4 * length(r, me, round)};
    }
    sb_ranks_start(ranks, send, sends, receive, receives);
    /* A gather between start and finish. */
    int own = me + round, all[16];
    sb_ranks_gather(ranks, &own, sizeof own, all);
    sb_ranks_finish(ranks);
    for (int r = 0; r < ranks->count; r++) {
        wrong += all[r] != r + round;
        for (int w = 0; r != me && w < WORDS; w++)
            wrong += in[r][w] != ((size_t)w < length(r, me, round) ? word(r, me, round, w) : 0);
    }
    return wrong;
}

static int sums(sb_ranks *ranks, int round)
{
    enum { VALUES = 3 };
    sb_exact sum[VALUES] = {0};
    uint64_t counts[2] = {(uint64_t)ranks->rank, 1};
    int wrong = 0;
    for (int k = 0; k < VALUES; k++) sb_exact_add(&sum[k], ldexp(1 + ranks->rank, -10 * k));
    sb_ranks_sum(ranks, sum, VALUES);
    sb_ranks_add(ranks, counts, 2);
    const int n = ranks->count;
    for (int k = 0; k < VALUES; k++) wrong += sb_exact_value(&sum[k]) != ldexp(n * (n + 1) / 2, -10 * k);
    wrong += counts[0] != (uint64_t)(n * (n - 1) / 2) || counts[1] != (uint64_t)n;
    wrong += sb_ranks_largest(ranks, -ranks->rank - 3.0) != -3;
    for (int k = 0; k < VALUES; k++) sum[k] = (sb_exact){0}, sb_exact_add(&sum[k], k + ranks->rank);
    wrong += sb_ranks_sum_and_largest(ranks, sum, VALUES, ranks->rank == 0 ? 9.5 : -1) != 9.5;
    for (int k = 0; k < VALUES; k++) wrong += sb_exact_value(&sum[k]) != k * n + n * (n - 1) / 2;
    sb_flying_sums flying = {.under_way = false};
    for (int k = 0; k < VALUES; k++) sum[k] = (sb_exact){0}, sb_exact_add(&sum[k], k - ranks->rank);
    if (n > 1) sb_ranks_sum_begin(ranks, &flying, sum, VALUES, ranks->rank == n - 1 ? 7.25 : -2);
    for (int look = 0; n > 1 && look < round % 4 && !sb_ranks_sum_arrived(ranks, &flying); look++) continue;
    wrong += n > 1 && (sb_ranks_sum_end(ranks, &flying, sum) != 7.25 || flying.under_way);
    for (int k = 0; n > 1 && k < VALUES; k++) wrong += sb_exact_value(&sum[k]) != k * n - n * (n - 1) / 2;
    wrong += sb_ranks_any(ranks, false) || !sb_ranks_any(ranks, ranks->rank == round % n);
    return wrong;
}

/* Rank a has 1000 a + b + round for rank b. */
static int numbers(sb_ranks *ranks, int round)
{
    uint64_t to[16], from[16];
    int wrong = 0;
    for (int r = 0; r < ranks->count; r++) to[r] = (uint64_t)(1000 * ranks->rank + r + round);
    sb_ranks_swap_numbers(ranks, to, from);
    for (int r = 0; r < ranks->count; r++) wrong += from[r] != (uint64_t)(1000 * r + ranks->rank + round);
    return wrong;
}

/* More values than one message has, of ranks beyond a power of two as well. */
static int many_counts(sb_ranks *ranks, int round)
{
    enum { MANY = 5000 };
    static _Thread_local uint64_t counts[MANY];
    const uint64_t n = (uint64_t)ranks->count;
    int wrong = 0;
    for (uint64_t k = 0; k < MANY; k++) counts[k] = k * (uint64_t)(ranks->rank + round);
    sb_ranks_add(ranks, counts, MANY);
    for (uint64_t k = 0; k < MANY; k++) wrong += counts[k] != k * (n * (n - 1) / 2 + n * (uint64_t)round);
    wrong += sb_ranks_any(ranks, false) || !sb_ranks_any(ranks, ranks->rank == round % ranks->count);
    return wrong;
}

static int collections(sb_ranks *ranks, int round)
{
    const int n = ranks->count, root = round % n, me = ranks->rank;
    int own[16], all[16 * 16], wrong = 0;
    size_t sizes[16] = {0};
    for (int r = 0; r < n; r++) sizes[r] = (size_t)((r + round) % 3) * sizeof *own;
    for (int k = 0; k < 16; k++) own[k] = 100 * me + k;
    sb_ranks_collect(ranks, root, own, sizes[me], me == root ? all : NULL, me == root ? sizes : NULL);
    const int *at = all;
    for (int r = 0; r < n && me == root; r++)
        for (int k = 0; k < (r + round) % 3; k++) wrong += *at++ != 100 * r + k;
    uint64_t word_of_all = 1;
    sb_ranks_take_turn(ranks, &word_of_all, sizeof word_of_all);
    word_of_all = 10 * word_of_all + (uint64_t)me;
    sb_ranks_end_turn(ranks, &word_of_all, sizeof word_of_all);
    uint64_t expected_word = 1;
    for (int r = 0; r < n; r++) expected_word = 10 * expected_word + (uint64_t)r;
    wrong += word_of_all != expected_word;
    double shared = me == root ? 7.5 + round : 0;
    sb_ranks_share(ranks, root, &shared, sizeof shared);
    return wrong + (shared != 7.5 + round);
}

static void work(sb_ranks *ranks, void *context)
{
    outcome *o = context;
    for (int round = 0; round < ROUNDS; round++)
        o->wrong[ranks->rank] += exchange_round(ranks, round) + sums(ranks, round) + collections(ranks, round) +
                                 numbers(ranks, round) + (round == 1 ? many_counts(ranks, round) : 0);
    o->bytes[ranks->rank] = ranks->bytes_sent;
    o->messages[ranks->rank] = ranks->messages;
}

static void everything_arrives(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 3; seed++)
        for (int count = 1; count <= 11; count += count < 4 ? 1 : count < 7 ? 3 : 4) {
            outcome o = {0};
            sb_error error = {0};
            assert_int_equal(sb_ranks_threads_run(count, seed, work, &o, &error), SB_OK);
            for (int r = 0; r < count; r++) {
                assert_int_equal(o.wrong[r], 0);
                assert_true(count == 1 ? o.messages[r] == 0 && o.bytes[r] == 0 : o.messages[r] > ROUNDS);
            }
        }
}

static void one_rank_needs_no_transport(void **state)
{
    (void)state;
    sb_exact sum = {0};
    sb_exact_add(&sum, 2.5);
    uint64_t count = 4;
    double value = 3, copy = 0;
    sb_ranks_sum(NULL, &sum, 1);
    sb_ranks_add(NULL, &count, 1);
    sb_ranks_share(NULL, 0, &value, sizeof value);
    sb_ranks_collect(NULL, 0, &value, sizeof value, &copy, NULL);
    assert_true(sb_exact_value(&sum) == 2.5 && count == 4 && copy == 3);
    sb_ranks_gather(NULL, &count, sizeof count, &copy);
    assert_memory_equal(&copy, &count, sizeof count);
    assert_true(sb_ranks_largest(NULL, -1) == -1 && sb_ranks_any(NULL, true) && !sb_ranks_any(NULL, false));
    assert_true(!sb_ranks_several(NULL) && sb_ranks_own(NULL) == 0 && sb_ranks_count(NULL) == 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everything_arrives),
        cmocka_unit_test(one_rank_needs_no_transport),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
