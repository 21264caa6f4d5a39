/* Runs with checkpoints whose disk is full, whose directory is another run's, whose tables are taken away. */
#include "pair.h"

#include "base/clock.h"
#include "base/memory.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The checkpoint is the longest of the files: it fails alone, the run goes on, and those before stay. */
static void a_checkpoint_that_fails_is_a_warning(void **state)
{
    (void)state;
    char names[16][64], left[16][64], words[128];
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
    /* The first one due is at the step after the one that the run went on from. */
    snprintf(words, sizeof words, "shorebreak: warning: no checkpoint at step %ld, the run goes on: full/checkpoints/",
             strtol(names[0], NULL, 10) + 1);
    if (strncmp(o.err, words, strlen(words)) != 0) fail_msg("expected \"%s\" first in:\n%s", words, o.err);
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

/* A table that cannot be written ends the run, and all of them end with a whole row; with room again it goes on as if
   nothing had been. */
static void a_full_disk_ends_the_run_and_it_goes_on(void **state)
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

/* A second run in the same directory is refused before it touches anything. */
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

/* The folder of the checkpoints, and the log: without them a run could not go on, or not be told for one. */
static void what_was_removed_is_made_again(void **state)
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
    assert_int_equal(count_of(o.err, "warning: swept/checkpoints: was removed during the run; it was made again"), 1);
    assert_int_equal(
        count_of(o.err, "warning: swept/run.jsonl: was removed during the run; its earlier lines are lost"), 1);
    outcome_free(&o);
    assert_true(list_checkpoints("swept", names) >= 1);
    char *log = text_of("swept/run.jsonl");
    assert_int_equal(strncmp(log, "{\"event\":", 9), 0);
    assert_int_equal(count_of(log, "\"event\":\"end\""), 1);
    sb_free(log);
}

/* What a user moves away while the run goes on is told once; checkpoints are written all the same, the one on a signal
   included. */
static void files_taken_away_are_told_once(void **state)
{
    (void)state;
    static const struct {
        const char *scene, *taken, *later;
    } cases[] = {{"measured.yaml", "particles/000002.vtp", "particles/000003.vtp"},
                 {"tank3.yaml", "frames/side/000002.png", "frames/front/000003.png"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char names[16][64], words[96], until[32];
        const char *run = k ? "thinned" : "picked";
        pid_t process = program_start((const char *const[]){"run", cases[k].scene, "--out", run, "--quiet", "--until",
                                                            "1000", "--set", "output.checkpoint.minutes=600", NULL});
        for (double end = sb_clock() + 30; !exists(in_run(run, cases[k].later)) && sb_clock() < end;) usleep(2000);
        assert_int_equal(unlink(in_folder("%s", in_run(run, cases[k].taken))), 0);
        assert_int_equal(kill(process, SIGTERM), 0);
        outcome o = program_finish(process);
        assert_int_equal(o.status, 143);
        snprintf(words, sizeof words, "warning: %s: is not there any more", in_run(run, cases[k].taken));
        assert_int_equal(count_of(o.err, words), 1);
        outcome_free(&o);
        assert_int_equal(list_checkpoints(run, names), 1);
        snprintf(until, sizeof until, "%.9g", json_number_of(in_run(run, "summary.json"), "simulated_s") * (1 - 1e-6));
        o = RUN(0, "run", cases[k].scene, "--out", run, "--resume", "--until", until);
        assert_contains(o.out, "going on from step ");
        assert_string_equal(o.err, "");
        outcome_free(&o);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_checkpoint_that_fails_is_a_warning),
        cmocka_unit_test(a_full_disk_ends_the_run_and_it_goes_on),
        cmocka_unit_test(one_run_at_a_time),
        cmocka_unit_test(removed_tables_end_the_run),
        cmocka_unit_test(what_was_removed_is_made_again),
        cmocka_unit_test(files_taken_away_are_told_once),
    };
    return cmocka_run_group_tests(tests, pair_setup, program_teardown);
}
