/* Runs with checkpoints: full disks, a directory that another run uses, and files that are removed during the run. */
#include "pair.h"

#include "base/clock.h"
#include "base/memory.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The checkpoint is the longest file, so only it cannot be written: the run continues, and earlier checkpoints stay. */
static void a_checkpoint_that_fails_is_a_warning(void **state)
{
    (void)state;
    char names[16][64], left[16][64], expected[128];
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "full", "--quiet", "--until", "0.05", "--set",
                   "output.particle_interval=0");
    assert_int_equal(list_checkpoints("full", names), 1);
    struct stat size;
    assert_int_equal(stat(in_folder("full/checkpoints/%s", names[0]), &size), 0);
    assert_true(size.st_size > 10000);
    outcome o = program_run_limited(
        (rlim_t)size.st_size - 500,
        (const char *const[]){"run", "measured.yaml", "--out", "full", "--quiet", "--resume", "--until", "0.1", "--set",
                              "output.particle_interval=0", "--set", "output.checkpoint.steps=1", NULL});
    assert_int_equal(o.status, 0);
    /* The first checkpoint is due one step after the step from which the run was resumed. */
    snprintf(expected, sizeof expected,
             "shorebreak: warning: no checkpoint at step %ld, the run continues: full/checkpoints/",
             strtol(names[0], NULL, 10) + 1);
    if (strncmp(o.err, expected, strlen(expected)) != 0) fail_msg("expected \"%s\" first in:\n%s", expected, o.err);
    assert_contains(o.err, "cannot write: File too large");
    outcome_free(&o);
    assert_int_equal(list_checkpoints("full", left), 1);
    assert_string_equal(left[0], names[0]);
}

static void assert_last_line_is_whole(const char *name)
{
    char *text = text_of(name);
    const size_t length = strlen(text);
    if (length == 0 || text[length - 1] != '\n') fail_msg("%s ends within a line", name);
    sb_free(text);
}

/* A table that cannot be written ends the run, and all tables end with a complete row. With space on the disk, the run
   resumes and ends as an uninterrupted one. */
static void a_full_disk_ends_the_run_and_it_resumes(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "roomy", "--quiet", "--set", "measure.interval=0.002");
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "tight", "--quiet", "--set", "measure.interval=0.002", "--until",
                   "0.1");
    outcome o = program_run_limited(25000, (const char *const[]){"run", "measured.yaml", "--out", "tight", "--quiet",
                                                                 "--set", "measure.interval=0.002", "--resume", NULL});
    assert_int_equal(o.status, 2);
    assert_contains(o.err, ".csv: cannot write: File too large");
    outcome_free(&o);
    for (size_t t = 0; pair_tables[t]; t++) {
        char name[96];
        snprintf(name, sizeof name, "tight/%s", pair_tables[t]);
        if (exists(name)) assert_last_line_is_whole(name);
    }
    assert_last_line_is_whole("tight/run.jsonl");
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "tight", "--quiet", "--set", "measure.interval=0.002",
                   "--resume");
    assert_same_run("roomy", "tight", pair_tables);
}

/* A second run in the same directory is refused before it changes anything. */
static void one_run_at_a_time(void **state)
{
    (void)state;
    pid_t process = program_start(
        (const char *const[]){"run", "measured.yaml", "--out", "one", "--quiet", "--until", "1000", NULL});
    for (double end = sb_clock() + 30; !exists("one/particles/000002.vtp") && sb_clock() < end;) usleep(2000);
    outcome o = RUN(1, "run", "measured.yaml", "--out", "one", "--quiet", "--resume");
    assert_one_line(o.err, "one: another run or render is writing there");
    outcome_free(&o);
    assert_int_equal(kill(process, SIGTERM), 0);
    o = program_finish(process);
    assert_int_equal(o.status, 143);
    outcome_free(&o);
    char *log = text_of("one/run.jsonl");
    assert_int_equal(count_of(log, "\"event\":\"end\""), 1);
    sb_free(log);
}

static const char *in_run(const char *run, const char *name)
{
    static char paths[2][96];
    static unsigned turn;
    char *path = paths[turn++ % 2];
    snprintf(path, sizeof paths[0], "%s/%s", run, name);
    return path;
}

static void removed_tables_end_the_run(void **state)
{
    (void)state;
    pid_t process = program_start(
        (const char *const[]){"run", "measured.yaml", "--out", "gone", "--quiet", "--until", "1000", NULL});
    for (double end = sb_clock() + 30; !exists("gone/particles/000002.vtp") && sb_clock() < end;) usleep(2000);
    unlink(in_folder("gone/probes.csv"));
    outcome o = program_finish(process);
    assert_int_equal(o.status, 2);
    assert_contains(o.err, "gone/probes.csv: was removed while the run wrote it");
    outcome_free(&o);
}

/* The folder of the checkpoints and the log: without them a run could not be resumed or recognised. */
static void removed_folders_and_logs_are_made_again(void **state)
{
    (void)state;
    char names[16][64];
    pid_t process = program_start((const char *const[]){"run", "measured.yaml", "--out", "swept", "--quiet", "--until",
                                                        "1000", "--set", "output.checkpoint.steps=5", NULL});
    for (double end = sb_clock() + 30; !exists("swept/particles/000002.vtp") && sb_clock() < end;) usleep(2000);
    assert_int_equal(rename(in_folder("swept/checkpoints"), in_folder("elsewhere")), 0);
    assert_int_equal(unlink(in_folder("swept/run.jsonl")), 0);
    for (double end = sb_clock() + 30; !exists("swept/run.jsonl") && sb_clock() < end;) usleep(2000);
    for (double end = sb_clock() + 30; !exists("swept/checkpoints") && sb_clock() < end;) usleep(2000);
    assert_int_equal(kill(process, SIGTERM), 0);
    outcome o = program_finish(process);
    assert_int_equal(o.status, 143);
    assert_int_equal(count_of(o.err, "warning: swept/checkpoints: was removed during the run; it has been made again"),
                     1);
    assert_int_equal(
        count_of(o.err, "warning: swept/run.jsonl: was removed during the run; its earlier lines are lost"), 1);
    outcome_free(&o);
    assert_true(list_checkpoints("swept", names) >= 1);
    char *log = text_of("swept/run.jsonl");
    assert_int_equal(strncmp(log, "{\"event\":", 9), 0);
    assert_int_equal(count_of(log, "\"event\":\"end\""), 1);
    sb_free(log);
}

/* A file that a user removes during the run is reported once. Checkpoints are still written, including the one on a
   signal. */
static void removed_files_are_reported_once(void **state)
{
    (void)state;
    static const struct {
        const char *scene, *removed, *later;
    } cases[] = {{"measured.yaml", "particles/000002.vtp", "particles/000003.vtp"},
                 {"tank3.yaml", "frames/side/000002.png", "frames/front/000003.png"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char names[16][64], expected[96], until[32];
        const char *run = k ? "thinned" : "picked";
        pid_t process = program_start((const char *const[]){"run", cases[k].scene, "--out", run, "--quiet", "--until",
                                                            "1000", "--set", "output.checkpoint.minutes=600", NULL});
        for (double end = sb_clock() + 30; !exists(in_run(run, cases[k].later)) && sb_clock() < end;) usleep(2000);
        assert_int_equal(unlink(in_folder("%s", in_run(run, cases[k].removed))), 0);
        assert_int_equal(kill(process, SIGTERM), 0);
        outcome o = program_finish(process);
        assert_int_equal(o.status, 143);
        snprintf(expected, sizeof expected, "warning: %s: was removed during the run; the run continues without it",
                 in_run(run, cases[k].removed));
        assert_int_equal(count_of(o.err, expected), 1);
        outcome_free(&o);
        assert_int_equal(list_checkpoints(run, names), 1);
        snprintf(until, sizeof until, "%.9g", json_number_of(in_run(run, "summary.json"), "simulated_s") * (1 - 1e-6));
        o = RUN(0, "run", cases[k].scene, "--out", run, "--resume", "--until", until);
        assert_contains(o.out, "resuming from step ");
        assert_string_equal(o.err, "");
        outcome_free(&o);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_checkpoint_that_fails_is_a_warning),
        cmocka_unit_test(a_full_disk_ends_the_run_and_it_resumes),
        cmocka_unit_test(one_run_at_a_time),
        cmocka_unit_test(removed_tables_end_the_run),
        cmocka_unit_test(removed_folders_and_logs_are_made_again),
        cmocka_unit_test(removed_files_are_reported_once),
    };
    return cmocka_run_group_tests(tests, pair_setup, program_teardown);
}
