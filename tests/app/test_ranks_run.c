/* Runs on several ranks: the same files as on one, whatever happens to the ranks. */
#include "pair.h"

#include "base/clock.h"
#include "base/memory.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static const double CHECKPOINT_SECONDS = 30; /* a tank of few particles */

static void tables_and_state_do_not_depend_on_the_ranks(void **state)
{
    (void)state;
    NEEDS_MPI();
    RUN_ON("1", 0, "measured.yaml", "--out", "one", "--quiet", "--set", EVERY_THREE);
    RUN_ON("2", 0, "measured.yaml", "--out", "two", "--quiet", "--set", EVERY_THREE);
    RUN_ON("3", 0, "measured.yaml", "--out", "three", "--quiet", "--set", EVERY_THREE);
    assert_same_run("whole", "one", pair_tables);
    assert_same_run("whole", "two", pair_tables);
    assert_same_run("whole", "three", pair_tables);
    assert_near(json_number_of("one/summary.json", "ranks"), 1, 0);
    assert_near(json_number_of("three/summary.json", "ranks"), 3, 0);
    char *log = text_of("three/run.jsonl");
    assert_contains(log, "\"event\":\"ranks\"");
    assert_contains(log, "\"event\":\"load\"");
    sb_free(log);
}

static void a_checkpoint_resumes_with_another_number_of_ranks(void **state)
{
    (void)state;
    NEEDS_MPI();
    RUN_ON("3", 0, "measured.yaml", "--out", "parts", "--quiet", "--set", EVERY_THREE, "--until", "0.2");
    RUN_ON("2", 0, "measured.yaml", "--out", "parts", "--quiet", "--set", EVERY_THREE, "--until", "0.41", "--resume");
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "parts", "--quiet", "--set", EVERY_THREE, "--resume");
    assert_same_run("whole", "parts", pair_tables);
}

/* Waits until the run has written a checkpoint of a step. */
static void wait_for_checkpoint(const char *run, pid_t process)
{
    char names[16][64], folder[64];
    snprintf(folder, sizeof folder, "%s/checkpoints", run);
    const double begun = sb_clock();
    siginfo_t ended = {0};
    for (int count = 0; sb_clock() < begun + CHECKPOINT_SECONDS; usleep(5000)) {
        if (waitid(P_PID, (id_t)process, &ended, WEXITED | WNOHANG | WNOWAIT) != 0 || ended.si_pid == process) break;
        count = exists(folder) ? list_checkpoints(run, names) : 0;
        if (count > 0 && names[0][0] == '0') return;
    }
    fail_msg("%s: no checkpoint", run);
}

/* The process of a rank: of the processes below mpirun the one with this number in its environment; 0: not found. */
static pid_t process_of(pid_t mpirun, int rank)
{
    char path[64], text[1 << 16], wanted[64];
    int child;
    snprintf(path, sizeof path, "/proc/%d/task/%d/children", (int)mpirun, (int)mpirun);
    snprintf(wanted, sizeof wanted, "OMPI_COMM_WORLD_RANK=%d", rank);
    FILE *children = fopen(path, "r");
    pid_t found = 0;
    while (children && !found && fscanf(children, "%d", &child) == 1) {
        snprintf(path, sizeof path, "/proc/%d/environ", child);
        FILE *environment = fopen(path, "r");
        const size_t length = environment ? fread(text, 1, sizeof text - 1, environment) : 0;
        if (environment) fclose(environment);
        text[length] = '\0';
        for (const char *at = text; at < text + length; at += strlen(at) + 1)
            if (strcmp(at, wanted) == 0) found = child;
    }
    if (children) fclose(children);
    return found;
}

static void a_killed_rank_ends_all_and_the_run_resumes(void **state)
{
    (void)state;
    NEEDS_MPI();
    setenv("OMPI_MCA_odls_base_sigkill_timeout", "3", 1); /* s until mpirun kills the others, who may have to wait for a
                                                             core to say what has happened */
    program_on_ranks("3");
    pid_t process = program_start((const char *const[]){"run", "measured.yaml", "--out", "killed", "--quiet", "--set",
                                                        EVERY_THREE, "--until", "60", NULL});
    wait_for_checkpoint("killed", process);
    const pid_t victim = process_of(process, 1);
    assert_true(victim > 0 && kill(victim, SIGKILL) == 0);
    outcome o = program_finish(process);
    program_on_ranks(NULL);
    unsetenv("OMPI_MCA_odls_base_sigkill_timeout");
    assert_int_equal(o.status, 137); /* mpirun's, for a rank that a signal killed */
    assert_one_reason(o.err, "rank 1 on ");
    outcome_free(&o);
    RUN_ON("2", 0, "measured.yaml", "--out", "killed", "--quiet", "--set", EVERY_THREE, "--resume");
    assert_same_run("whole", "killed", pair_tables);
}

static void a_silent_rank_ends_all_with_status_2(void **state)
{
    (void)state;
    NEEDS_MPI();
    program_on_ranks("2");
    pid_t process = program_start((const char *const[]){"run", "measured.yaml", "--out", "silent", "--quiet", "--set",
                                                        EVERY_THREE, "--rank-deadline", "2", "--until", "60", NULL});
    wait_for_checkpoint("silent", process);
    const pid_t victim = process_of(process, 1);
    assert_true(victim > 0 && kill(victim, SIGSTOP) == 0);
    outcome o = program_finish(process);
    program_on_ranks(NULL);
    assert_int_equal(o.status, 2);
    assert_one_reason(o.err, "expected less than --rank-deadline 2");
    outcome_free(&o);
}

/* As a queue of jobs does that makes room for another one: the deadline does not count for a rank that is stopped. */
static void stopped_together_they_go_on(void **state)
{
    (void)state;
    NEEDS_MPI();
    program_on_ranks("2");
    pid_t process = program_start((const char *const[]){"run", "measured.yaml", "--out", "together", "--quiet", "--set",
                                                        EVERY_THREE, "--rank-deadline", "2", NULL});
    wait_for_checkpoint("together", process);
    const pid_t both[] = {process_of(process, 0), process_of(process, 1)};
    for (int k = 0; k < 2; k++) assert_true(both[k] > 0 && kill(both[k], SIGSTOP) == 0);
    usleep(5000000);
    for (int k = 0; k < 2; k++) assert_int_equal(kill(both[k], SIGCONT), 0);
    outcome o = program_finish(process);
    program_on_ranks(NULL);
    assert_int_equal(o.status, 0);
    outcome_free(&o);
    assert_same_run("whole", "together", pair_tables);
}

/* Rank 1 stops at a call of MPI in which the others wait: the deadline counts there as well. */
static void expect_end(const char *place, const char *reason)
{
    setenv("STOPPED", place, 1);
    setenv("LD_PRELOAD", SB_BINARY_DIR "/libstopping_end.so", 1);
    program_on_ranks("2");
    outcome o = RUN(2, "run", "measured.yaml", "--out", place, "--quiet", "--rank-deadline", "2");
    program_on_ranks(NULL);
    unsetenv("LD_PRELOAD");
    unsetenv("STOPPED");
    assert_one_reason(o.err, reason);
    outcome_free(&o);
}

static void a_rank_that_never_begins_ends_all_with_status_2(void **state)
{
    (void)state;
    NEEDS_MPI();
    expect_end("begin", "rank 0 has waited for the begin of MPI, expected less than --rank-deadline 2 s");
    assert_false(exists("begin"));
}

static void a_rank_that_never_ends_ends_all_with_status_2(void **state)
{
    (void)state;
    NEEDS_MPI();
    expect_end("finalize", "rank 0 has waited for the end of MPI in the others, expected less than --rank-deadline 2");
    assert_same_run("whole", "finalize", pair_tables);
}

static void a_signal_stops_all_ranks_at_one_step(void **state)
{
    (void)state;
    NEEDS_MPI();
    program_on_ranks("3");
    pid_t process = program_start((const char *const[]){"run", "measured.yaml", "--out", "stopped", "--quiet", "--set",
                                                        EVERY_THREE, "--until", "60", NULL});
    wait_for_checkpoint("stopped", process);
    const pid_t one = process_of(process, 2);
    assert_true(one > 0 && kill(one, SIGTERM) == 0);
    outcome o = program_finish(process);
    program_on_ranks(NULL);
    assert_int_equal(o.status, 128 + SIGTERM);
    assert_one_reason(o.err, "stopped by a signal at t = ");
    outcome_free(&o);
    RUN_ON("2", 0, "measured.yaml", "--out", "stopped", "--quiet", "--set", EVERY_THREE, "--resume");
    assert_same_run("whole", "stopped", pair_tables);
}

/* mpirun passes SIGUSR1 on, and may have started one process only. */
static void a_forwarded_signal_stops_one_rank_as_well(void **state)
{
    (void)state;
    NEEDS_MPI();
    program_on_ranks("1");
    pid_t process = program_start((const char *const[]){"run", "measured.yaml", "--out", "forwarded", "--quiet",
                                                        "--set", EVERY_THREE, "--until", "60", NULL});
    wait_for_checkpoint("forwarded", process);
    assert_int_equal(kill(process, SIGUSR1), 0);
    outcome o = program_finish(process);
    program_on_ranks(NULL);
    assert_int_equal(o.status, 128 + SIGUSR1);
    assert_one_reason(o.err, "stopped by a signal at t = ");
    outcome_free(&o);
}

/* Rank 1 is started in another folder, as on a host that has other files. */
static outcome run_in_two_folders(const char *scene)
{
    program_on_ranks("1");
    outcome o = program_run((const char *const[]){"run", scene, "--out", in_folder("never"), ":", "-n", "1", "-wdir",
                                                  in_folder("other"), SB_BINARY_DIR "/shorebreak", "run", scene,
                                                  "--out", in_folder("never"), NULL});
    program_on_ranks(NULL);
    return o;
}

static void unequal_ranks_are_refused(void **state)
{
    (void)state;
    NEEDS_MPI();
    assert_int_equal(mkdir(in_folder("other"), 0777), 0);
    outcome o = run_in_two_folders("tank2.yaml");
    assert_int_equal(o.status, 1);
    assert_one_reason(o.err, "rank 1 on ");
    assert_contains(o.err, "tank2.yaml: cannot read");
    outcome_free(&o);
    write_text("other/tank2.yaml", tank_3d);
    o = run_in_two_folders("tank2.yaml");
    assert_int_equal(o.status, 1);
    assert_one_reason(o.err, "tank2.yaml: rank 1 on ");
    assert_contains(o.err, "reads another text than rank 0");
    outcome_free(&o);
    assert_false(exists("never"));
}

static void a_mistake_gives_one_line(void **state)
{
    (void)state;
    NEEDS_MPI();
    program_on_ranks("3");
    outcome o = RUN(1, "run", "measured.yaml", "--out", "whole");
    assert_one_reason(o.err, "holds a finished run");
    outcome_free(&o);
    o = RUN(1, "run", "measured.yaml", "--untill", "3");
    assert_one_reason(o.err, "did you mean --until?");
    outcome_free(&o);
    o = RUN(1, "run", "measured.yaml", "--rank-deadline", "0");
    assert_one_reason(o.err, "--rank-deadline 0: expected seconds");
    outcome_free(&o);
    program_on_ranks(NULL);
}

/* Rank 0's command line is good, that of rank 1 is not. */
static void a_mistake_of_another_rank_gives_one_line(void **state)
{
    (void)state;
    NEEDS_MPI();
    program_on_ranks("1");
    outcome o = RUN(1, "run", "measured.yaml", "--out", in_folder("never"), ":", "-n", "1", SB_BINARY_DIR "/shorebreak",
                    "run", "measured.yaml", "--untill", "3");
    program_on_ranks(NULL);
    assert_one_reason(o.err, "rank 1 on ");
    assert_contains(o.err, "did you mean --until?");
    outcome_free(&o);
    assert_false(exists("never"));
}

/* A starter whose processes do not find each other, as the mpirun of another MPI: no copy of the run, and no silence.
 */
static void a_foreign_starter_is_refused(void **state)
{
    (void)state;
    NEEDS_MPI();
    setenv("PMI_SIZE", "2", 1);
    setenv("PMI_RANK", "1", 1);
    outcome o = RUN(2, "run", "measured.yaml", "--out", "never");
    unsetenv("PMI_SIZE");
    unsetenv("PMI_RANK");
    assert_one_reason(o.err, "started as one of 2 processes, but MPI finds only this one");
    outcome_free(&o);
    assert_false(exists("never"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables_and_state_do_not_depend_on_the_ranks),
        cmocka_unit_test(a_checkpoint_resumes_with_another_number_of_ranks),
        cmocka_unit_test(a_killed_rank_ends_all_and_the_run_resumes),
        cmocka_unit_test(a_silent_rank_ends_all_with_status_2),
        cmocka_unit_test(stopped_together_they_go_on),
        cmocka_unit_test(a_rank_that_never_begins_ends_all_with_status_2),
        cmocka_unit_test(a_rank_that_never_ends_ends_all_with_status_2),
        cmocka_unit_test(a_signal_stops_all_ranks_at_one_step),
        cmocka_unit_test(a_forwarded_signal_stops_one_rank_as_well),
        cmocka_unit_test(unequal_ranks_are_refused),
        cmocka_unit_test(a_mistake_gives_one_line),
        cmocka_unit_test(a_mistake_of_another_rank_gives_one_line),
        cmocka_unit_test(a_foreign_starter_is_refused),
    };
    return cmocka_run_group_tests(tests, pair_setup_whole, program_teardown);
}
