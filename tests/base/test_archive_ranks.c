/* Lists whose elements lie in several ranks: the archive has the bytes of one that a single process writes, on disk,
   where each rank writes its own blocks, and in memory, where rank 0 receives all. */
#include "base/archive_ranks.h"
#include "base/file.h"
#include "base/memory.h"
#include "base/random.h"
#include "base/ranks_threads.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { LISTS = 4, RANKS_MAX = 7, MOST = 60000 };

/* Bytes of an element of each list. */
static const size_t sizes[LISTS] = {16, 4, 1, 12};

typedef struct job {
    const char *path; /* NULL: in memory */
    uint64_t counts[LISTS][RANKS_MAX];
    sb_archive_out memory;
    sb_error error;
    uint64_t sent[RANKS_MAX]; /* bytes of messages */
} job;

static unsigned char byte_of(size_t list, size_t at)
{
    return (unsigned char)(256 * sb_random(list, at));
}

/* Elements of each rank: sometimes none, often more than a block's. */
static void draw_counts(job *j, int ranks, uint64_t seed)
{
    for (size_t list = 0; list < LISTS; list++)
        for (int r = 0; r < ranks; r++) {
            const double x = sb_random(seed, list * RANKS_MAX + (size_t)r);
            j->counts[list][r] = x < 0.2 ? 0 : (uint64_t)(x * MOST / (double)sizes[list]);
        }
}

static void begin_archive(sb_archive_out *out, const char *path, sb_error *error)
{
    if (path)
        (void)sb_archive_create(out, path, "test", 1, error);
    else
        sb_archive_begin(out, "test", 1);
    sb_archive_section(out, "lists");
    sb_put_real(out, 2.5);
}

/* The bytes of a rank's part of a list. */
static char *make_part(const job *j, size_t list, int rank)
{
    size_t from = 0, length = (size_t)j->counts[list][rank] * sizes[list];
    for (int r = 0; r < rank; r++) from += (size_t)j->counts[list][r] * sizes[list];
    char *part = sb_alloc(length + 1, 1);
    for (size_t k = 0; part && k < length; k++) part[k] = (char)byte_of(list, from + k);
    return part;
}

static void write_together(sb_ranks *ranks, void *context)
{
    job *j = context;
    sb_archive_out *out = ranks->rank == 0 ? &j->memory : NULL;
    sb_archive_ranks lists;
    if (out) begin_archive(out, j->path, &j->error);
    sb_archive_ranks_begin(&lists, ranks, out);
    for (size_t list = 0; list < LISTS; list++) {
        char *own = make_part(j, list, ranks->rank);
        sb_archive_ranks_list(&lists, out, j->counts[list], own, sizes[list]);
        if (out && list == 1) sb_put_count(out, 7); /* the lists need not follow one another */
        sb_free(own);
    }
    sb_archive_ranks_end(&lists, out);
    j->sent[ranks->rank] = ranks->bytes_sent;
    if (!out) return;
    sb_put_flag(out, true);
    sb_archive_section(out, "more");
    sb_put_count(out, 3);
    (void)sb_archive_close(out, &j->error);
}

/* The same by one process, in memory. */
static void write_alone(const job *j, int ranks, sb_archive_out *out)
{
    begin_archive(out, NULL, NULL);
    for (size_t list = 0; list < LISTS; list++) {
        uint64_t all = 0;
        for (int r = 0; r < ranks; r++) all += j->counts[list][r];
        sb_put_list_begin(out, (size_t)all, sizes[list]);
        for (int r = 0; r < ranks; r++) {
            char *part = make_part(j, list, r);
            sb_put_list_bytes(out, part, (size_t)j->counts[list][r] * sizes[list]);
            sb_free(part);
        }
        if (list == 1) sb_put_count(out, 7);
    }
    sb_put_flag(out, true);
    sb_archive_section(out, "more");
    sb_put_count(out, 3);
    assert_int_equal(sb_archive_close(out, NULL), SB_OK);
}

static uint64_t own_bytes(const job *j, int rank)
{
    uint64_t sum = 0;
    for (size_t list = 0; list < LISTS; list++) sum += j->counts[list][rank] * sizes[list];
    return sum;
}

static void check(const char *path, int ranks, uint64_t seed, uint64_t disturb)
{
    job *j = sb_alloc(1, sizeof *j);
    sb_archive_out alone = {0};
    sb_archive_in in = {0};
    sb_error error = {0};
    char *bytes = NULL;
    size_t length = 0;
    j->path = path;
    draw_counts(j, ranks, seed);
    assert_int_equal(sb_ranks_threads_run(ranks, disturb, write_together, j, &error), SB_OK);
    if (j->error.status != SB_OK) fail_msg("%s", j->error.text);
    write_alone(j, ranks, &alone);
    if (path) {
        assert_int_equal(sb_file_read(path, 1 << 26, &bytes, &length, &error), SB_OK);
        if (sb_archive_open(&in, path, "test", 1, &error) != SB_OK) fail_msg("%s", error.text);
        sb_archive_in_free(&in);
    }
    assert_int_equal(path ? length : j->memory.used, alone.used);
    assert_memory_equal(path ? (const void *)bytes : j->memory.bytes, alone.bytes, alone.used);
    for (int r = 1; r < ranks; r++) {
        /* On disk a rank sends less than two blocks of each list, the sums of the others, and the file's name. */
        const uint64_t most = LISTS * 2 * SB_ARCHIVE_BLOCK + own_bytes(j, r) / 1024 + (uint64_t)ranks * 8192;
        assert_true(path ? j->sent[r] <= most : j->sent[r] >= own_bytes(j, r));
    }
    sb_free(bytes);
    sb_archive_out_free(&j->memory);
    sb_archive_out_free(&alone);
    sb_free(j);
}

static void the_bytes_are_those_of_one_process(void **state)
{
    static const int counts[] = {2, 3, 5, RANKS_MAX};
    char path[64];
    (void)state;
    snprintf(path, sizeof path, "/tmp/shorebreak-archive-%d", (int)getpid());
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++)
        for (uint64_t seed = 0; seed < 6; seed++) {
            check(path, counts[k], 100 * seed + k, seed % 2 == 0 ? 0 : seed);
            check(NULL, counts[k], 100 * seed + k, 0);
        }
    unlink(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_bytes_are_those_of_one_process),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
