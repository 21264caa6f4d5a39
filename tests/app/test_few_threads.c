/* Systems that allow few threads, and a thread that cannot be started and for which a library waits. */
#include "program.h"

#include "base/clock.h"
#include "base/memory.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static outcome run_crowded(rlim_t processes, const char *threads)
{
    return program_run_crowded(processes,
                               (const char *const[]){"run", "tank3.yaml", "--out", "crowded", "--quiet", "--until",
                                                     "0.1", "--overwrite", "--threads", threads, NULL});
}

/* The run ends with all its pictures, or with the reason. */
static void each_limit_of_processes(void **state)
{
    (void)state;
    if (!program_can_change_user()) {
        print_message("skipped: only root can become a user whose processes are limited\n");
        skip();
    }
    for (rlim_t most = 2; most <= 6; most++) {
        outcome o = run_crowded(most, "2");
        if (most == 2) {
            assert_int_equal(o.status, 2);
            assert_contains(o.err, "shorebreak: pictures: the system refuses a thread\n");
        } else {
            if (o.status != 0) fail_msg("with %d processes it ended by %d: %s", (int)most, o.status, o.err);
            assert_near(json_number_of("crowded/summary.json", "pictures"), 2, 0);
        }
        assert_int_equal(strstr(o.err, "the system allows 1 of 2") != NULL, most <= 3);
        outcome_free(&o);
    }
    outcome o = run_crowded(4, "1");
    assert_int_equal(o.status, 0);
    outcome_free(&o);
}

static void more_threads_than_cores_give_one_warning(void **state)
{
    (void)state;
    char threads[32], expected[64];
    snprintf(threads, sizeof threads, "%ld", sysconf(_SC_NPROCESSORS_CONF) + 1);
    snprintf(expected, sizeof expected, "threads: %s threads on ", threads);
    outcome o = RUN(0, "run", "tank2.yaml", "--out", "many", "--quiet", "--until", "0.01", "--threads", threads);
    const char *first = strstr(o.err, expected);
    assert_non_null(first);
    assert_null(strstr(first + 1, expected));
    outcome_free(&o);
    char *log = text_of("many/run.jsonl");
    assert_contains(log, expected);
    sb_free(log);
    o = RUN(0, "check", "tank2.yaml", "--threads", threads);
    assert_contains(o.out, expected);
    outcome_free(&o);
    o = RUN(0, "check", "tank2.yaml", "--threads", "1");
    assert_null(strstr(o.out, "threads: "));
    outcome_free(&o);
}

/* A run that is stopped by a signal does not wait for a picture that hangs, and still reports it after it was resumed.
 */
static void a_picture_that_hangs(void **state)
{
    (void)state;
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
    skip(); /* a sanitizer's library must be loaded first */
#endif
    static const char expected[] = "pictures: no progress for 5 s; ";
    assert_int_equal(setenv("LD_PRELOAD", SB_BINARY_DIR "/libhanging_pictures.so", 1), 0);
    const pid_t process = program_start((const char *const[]){"run", "tank3.yaml", "--out", "hung", "--quiet", NULL});
    unsetenv("LD_PRELOAD");
    for (double end = sb_clock() + 30; !exists("hung/particles/000004.vtp") && sb_clock() < end;) usleep(2000);
    const double start = sb_clock();
    assert_int_equal(kill(process, SIGTERM), 0);
    outcome o = program_finish(process);
    assert_true(sb_clock() - start < 20);
    assert_int_equal(o.status, 2);
    assert_contains(o.err, "shorebreak: warning: pictures: no progress for 5 s; the run continues without them\n");
    outcome_free(&o);
    assert_near(json_number_of("hung/summary.json", "pictures_missing"), 4, 0);
    assert_near(json_number_of("hung/summary.json", "pictures"), 0, 0);
    o = RUN(2, "run", "tank3.yaml", "--out", "hung", "--quiet", "--resume", "--until", "0.4");
    assert_one_line(o.err, expected);
    outcome_free(&o);
    assert_near(json_number_of("hung/summary.json", "pictures"), 1, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(more_threads_than_cores_give_one_warning),
        cmocka_unit_test(a_picture_that_hangs),
        cmocka_unit_test(each_limit_of_processes),
    };
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
