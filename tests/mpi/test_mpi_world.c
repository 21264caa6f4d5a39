/* Messages, orders and ends of ranks that mpirun starts. */
#include "../check.h"
#include "mpirun.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static FILE *begin_probe(const char *ranks, const char *what)
{
    char command[1000];
    const char *const words[] = {MPIRUN_WORDS(ranks)};
    size_t at = 0;
    for (size_t k = 0; k < MPIRUN_WORD_COUNT; k++)
        at += (size_t)snprintf(command + at, sizeof command - at, "%s ", words[k]);
    snprintf(command + at, sizeof command - at, SB_BINARY_DIR "/ranks_probe %s 2>&1", what);
    FILE *output = popen(command, "r");
    assert_non_null(output);
    return output;
}

/* Returns the exit status of the probe and what it has printed, except for the lines of mpirun. */
static int end_probe(FILE *output, char text[4000])
{
    char line[1000];
    text[0] = '\0';
    while (fgets(line, sizeof line, output))
        if (strncmp(line, "probe: ", 7) == 0 || strcmp(line, "alone\n") == 0)
            strncat(text, line, 4000 - strlen(text) - 1);
    const int status = pclose(output);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

static int probe(const char *ranks, const char *what, char text[4000])
{
    return end_probe(begin_probe(ranks, what), text);
}

static void messages_orders_and_signals_arrive(void **state)
{
    static const char *const counts[] = {"2", "3"};
    char text[4000];
    (void)state;
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
        const int status = probe(counts[k], "works", text);
        if (status != 0 || *text) fail_msg("%s ranks: status %d: %s", counts[k], status, text);
    }
}

static void one_rank_is_alone(void **state)
{
    char text[4000];
    (void)state;
    assert_int_equal(probe("1", "works", text), 0);
    assert_string_equal(text, "alone\n");
}

/* The run must end with this status and one line, which has this part. */
static void check_end(FILE *output, const char *what, int expected, const char *part)
{
    char text[4000];
    const int status = end_probe(output, text);
    const char *first = strchr(text, '\n');
    if (status != expected || !strstr(text, part) || !first || first[1])
        fail_msg("%s: status %d, expected %d and one line with \"%s\": %s", what, status, expected, part, text);
}

static void ends(const char *what, int expected, const char *part)
{
    check_end(begin_probe("3", what), what, expected, part);
}

static void a_rank_that_dies_ends_all(void **state)
{
    (void)state;
    setenv("OMPI_MCA_odls_base_sigkill_timeout", "3", 1); /* s until mpirun kills the others, who wait for a core */
    ends("dies", 137, "rank 2 on ");                      /* mpirun's own status for SIGKILL */
    unsetenv("OMPI_MCA_odls_base_sigkill_timeout");
}

static void a_silent_rank_ends_all(void **state)
{
    (void)state;
    ends("silent", 2, "for the other ranks, expected less than --rank-deadline 1");
}

/* These wait for seconds, together. Rank 0 of "slow" works alone for longer than the deadline, while the others await
   an order. In "leader-alone" the others are within the order that has failed in rank 0: the messages of its next order
   must not meet theirs. */
static void a_rank_that_fails_alone_ends_all(void **state)
{
    char text[4000];
    (void)state;
    FILE *slow = begin_probe("3", "slow"), *before = begin_probe("3", "alone-before");
    FILE *within = begin_probe("3", "alone-within"), *leader = begin_probe("3", "leader-alone");
    check_end(before, "alone-before", 2, "rank 1 on ");
    check_end(within, "alone-within", 2, "no memory here");
    check_end(leader, "leader-alone", 2, "rank 0 on ");
    const int status = end_probe(slow, text);
    if (status != 0 || *text) fail_msg("slow: status %d: %s", status, text);
}

int main(void)
{
    mpirun_tell_sanitizers();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(messages_orders_and_signals_arrive), cmocka_unit_test(one_rank_is_alone),
        cmocka_unit_test(a_rank_that_dies_ends_all),          cmocka_unit_test(a_silent_rank_ends_all),
        cmocka_unit_test(a_rank_that_fails_alone_ends_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
