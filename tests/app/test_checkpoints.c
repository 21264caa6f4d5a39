/* Runs that are resumed from a checkpoint end as uninterrupted ones: same state, tables, pictures and particle files.
 */
#include "pair.h"

#include "base/clock.h"
#include "base/memory.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void each_solver_resumes(void **state)
{
    (void)state;
    static const char *const solvers[] = {"numerics.solver=jacobi", "numerics.solver=chebyshev", "numerics.solver=cg"};
    for (int s = 0; s < 3; s++) {
        RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "whole", "--quiet", "--overwrite", "--set", solvers[s]);
        RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "parts", "--quiet", "--overwrite", "--set", solvers[s],
                       "--until", "0.2");
        RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "parts", "--quiet", "--set", solvers[s], "--until", "0.41",
                       "--resume", "--threads", "2");
        RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "parts", "--quiet", "--set", solvers[s], "--resume");
        assert_same_run("whole", "parts", pair_tables);
        /* The counts of calls and steps continue, too. */
        static const char *const counts[] = {"calls", "settling_calls", "steps"};
        for (int c = 0; c < 3; c++)
            assert_near(json_number_of("parts/summary.json", counts[c]),
                        json_number_of("whole/summary.json", counts[c]), 0);
        assert_near(
            json_number_of("parts/summary.json", "calls"),
            json_number_of("parts/summary.json", "settling_calls") + json_number_of("parts/summary.json", "steps"), 0);
        char *log = text_of("parts/run.jsonl");
        assert_int_equal(count_of(log, "\"event\":\"resumed\""), 2);
        assert_int_equal(count_of(log, "\"event\":\"start\""), 1);
        sb_free(log);
        assert_false(any_ending("parts", ".tmp"));
    }
}

static void a_run_in_3d_with_pictures_resumes(void **state)
{
    (void)state;
    static const char *const files[] = {
        "forces.csv", "gauges.csv", "frames/side/000001.png", "frames/side/000004.png", "frames/front/000003.png",
        NULL};
    static const char sides[] = "domain.sides={y_min: periodic, y_max: periodic}";
    for (int periodic = 0; periodic < 2; periodic++) {
        const char *set = periodic ? sides : "numerics.turbulence=sps";
        RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "whole3", "--quiet", "--overwrite", "--set", set);
        RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "parts3", "--quiet", "--overwrite", "--set", set, "--until",
                       "0.17");
        /* The run's own scene.yaml can be used as well: it names the same files and contains the overrides. */
        RUN_AND_FORGET(0, "run", "parts3/scene.yaml", "--out", "parts3", "--quiet", "--resume", "--until", "0.3");
        assert_same_run("whole3", "parts3", files);
    }
}

/* A stream before the interruption does not matter either: particle files are counted separately. */
static void a_stream_changes_nothing(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "mute", "--quiet", "--until", "0.35");
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "heard", "--quiet", "--until", "0.17", "--set",
                   "stream={enabled: true, url: 'memq://', interval: 0.02}");
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "heard", "--quiet", "--until", "0.35", "--resume");
    assert_same_run("mute", "heard", pair_tables);
}

static void checkpoints_change_nothing(void **state)
{
    (void)state;
    char names[16][64];
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "with", "--quiet", "--set", EVERY_THREE);
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "without", "--quiet", "--set", "output.checkpoint.minutes=0");
    assert_same_run("with", "without", pair_tables);
    assert_int_equal(list_checkpoints("with", names), 2);
    assert_false(exists("without/checkpoints"));
    char *log = text_of("without/run.jsonl");
    assert_contains(log, "checkpoints: off");
    assert_null(strstr(log, "\"event\":\"checkpoint\""));
    sb_free(log);
    log = text_of("with/run.jsonl");
    assert_null(strstr(log, "checkpoints: off"));
    assert_true(count_of(log, "\"event\":\"checkpoint\"") > 5);
    sb_free(log);
}

static void the_newest_ones_are_kept(void **state)
{
    (void)state;
    char names[16][64], last[64];
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "kept", "--quiet", "--set",
                   "output.checkpoint={steps: 4, keep: 3}");
    assert_int_equal(list_checkpoints("kept", names), 3);
    const int steps = (int)json_number_of("kept/summary.json", "steps");
    snprintf(last, sizeof last, "%09d.state", steps);
    assert_string_equal(names[2], last);
    snprintf(last, sizeof last, "%09d.state", (steps - 1) / 4 * 4);
    assert_string_equal(names[1], last);
    /* A new run in the directory reports that it replaces the earlier one. */
    outcome o = RUN(0, "run", "measured.yaml", "--out", "kept", "--overwrite", "--until", "0.02", "--set",
                    "output.checkpoint={steps: 1000, minutes: 0}");
    assert_contains(o.out, "kept: the files of the earlier run are removed, and a new run starts");
    outcome_free(&o);
    assert_int_equal(list_checkpoints("kept", names), 1);
    assert_true(strcmp(names[0], last) < 0);
}

static void without_a_checkpoint_the_run_starts(void **state)
{
    (void)state;
    outcome o = RUN(0, "run", "measured.yaml", "--out", "nothing", "--until", "0.05", "--resume");
    assert_contains(o.out, "nothing: no checkpoint to resume from; the run starts from the beginning");
    outcome_free(&o);
    assert_true(exists("nothing/summary.json"));
}

/* A scene whose settling takes a second or more. */
static const char resting[] = "resolution: 0.06\n"
                              "duration: 0.1\n"
                              "domain: {min: [0, 0, 0], max: [4, 1, 1]}\n"
                              "water: {level: 0.8, seed: [1, 0.5, 0.4]}\n"
                              "bodies: [{name: block, shape: box, min: [2, 0.3, 0], max: [2.4, 0.7, 1]}]\n"
                              "measure: {interval: 0.02, gauges: [{name: g, x: 1, y: 0.5}]}\n"
                              "output: {plots: false, particle_interval: 0.05, checkpoint: {steps: 5, minutes: 0}}\n";
static const char *const resting_tables[] = {"forces.csv", "gauges.csv", "energy.csv", NULL};

/* Starts a run in `directory` and sends the signal once settling has been saved. Returns the exit status. */
static int cut_while_settling(const char *directory, int signal)
{
    char saved[64];
    snprintf(saved, sizeof saved, "%s/checkpoints/settling.state", directory);
    pid_t process = program_start((const char *const[]){"run", "resting.yaml", "--out", directory, "--quiet", NULL});
    for (double end = sb_clock() + 60; !exists(saved) && sb_clock() < end;) usleep(1000);
    assert_int_equal(kill(process, signal), 0);
    outcome o = program_finish(process);
    const int status = o.status;
    if (signal == SIGTERM) assert_contains(o.err, "while the water came to rest: nothing is computed yet; to resume:");
    outcome_free(&o);
    assert_true(exists(saved));
    return status;
}

static void a_run_resumes_settling(void **state)
{
    (void)state;
    char names[16][64];
    write_text("resting.yaml", resting);
    RUN_AND_FORGET(0, "run", "resting.yaml", "--out", "rested", "--quiet");
    assert_int_equal(cut_while_settling("resting", SIGTERM), 128 + SIGTERM);
    outcome o = RUN(0, "run", "resting.yaml", "--out", "resting", "--resume");
    assert_contains(o.out, "resuming from step ");
    assert_contains(o.out, " of settling, before t = 0");
    outcome_free(&o);
    assert_same_run("rested", "resting", resting_tables);
    assert_int_equal(list_checkpoints("resting", names), 2);
    assert_false(exists("resting/checkpoints/settling.state"));
    cut_while_settling("killed", SIGKILL);
    RUN_AND_FORGET(0, "run", "resting.yaml", "--out", "killed", "--quiet", "--resume");
    assert_same_run("rested", "killed", resting_tables);
    /* A file that is damaged or of another scene is refused, and nothing is changed. */
    cut_while_settling("damaged", SIGKILL);
    char *before = text_of("damaged/run.jsonl");
    o = RUN(1, "run", "measured.yaml", "--out", "damaged", "--quiet", "--resume");
    assert_contains(o.err, "no checkpoint to resume from: damaged/checkpoints/settling.state: of another scene");
    outcome_free(&o);
    write_text("damaged/checkpoints/settling.state", "SBSTATE, or so");
    o = RUN(1, "run", "resting.yaml", "--out", "damaged", "--quiet", "--resume");
    assert_contains(o.err, "no checkpoint to resume from: damaged/checkpoints/settling.state: ");
    outcome_free(&o);
    char *after = text_of("damaged/run.jsonl");
    assert_string_equal(before, after);
    sb_free(before);
    sb_free(after);
    /* A run with a longer duration can be resumed. */
    cut_while_settling("longer", SIGKILL);
    RUN_AND_FORGET(0, "run", "resting.yaml", "--out", "longer", "--quiet", "--resume", "--until", "0.15");
    char *scene = text_of("longer/scene.yaml");
    assert_contains(scene, "duration: 0.15");
    sb_free(scene);
    /* A new run removes the file. */
    cut_while_settling("anew", SIGKILL);
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "anew", "--quiet", "--overwrite", "--until", "0.02", "--set",
                   "output.checkpoint.minutes=0");
    assert_false(exists("anew/checkpoints/settling.state") || exists("anew/checkpoints/settling.state.tmp"));
}

static void a_finished_run_is_reported(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "done", "--quiet", "--until", "0.2");
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "again", "--quiet", "--until", "0.2");
    outcome o = RUN(0, "run", "measured.yaml", "--out", "again", "--until", "0.2", "--resume");
    assert_contains(o.out, "the run is finished; set a longer duration, e.g. with --until, to continue it");
    outcome_free(&o);
    assert_same_run("done", "again", pair_tables);
}

/* An end before the time that was simulated is refused, and no file is changed, in particular not scene.yaml. */
static void an_end_that_has_passed_is_refused(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "past", "--quiet", "--until", "0.2");
    char *scene = text_of("past/scene.yaml"), *summary = text_of("past/summary.json");
    outcome o = RUN(1, "run", "measured.yaml", "--out", "past", "--resume", "--until", "0.05");
    assert_one_line(o.err, "duration: 0.05 s, expected at least 0.20");
    assert_contains(o.err, " s, the time that the run in past has simulated");
    assert_null(strstr(o.out, "resuming"));
    outcome_free(&o);
    char *scene_now = text_of("past/scene.yaml"), *summary_now = text_of("past/summary.json");
    assert_string_equal(scene, scene_now);
    assert_string_equal(summary, summary_now);
    sb_free(scene);
    sb_free(scene_now);
    sb_free(summary);
    sb_free(summary_now);
    RUN_AND_FORGET(0, "run", "past/scene.yaml", "--out", "past", "--quiet", "--resume");
}

static void a_signal_leaves_a_checkpoint(void **state)
{
    (void)state;
    static const int signals[] = {SIGINT, SIGTERM};
    for (int s = 0; s < 2; s++) {
        char names[16][64];
        pid_t process =
            program_start((const char *const[]){"run", "measured.yaml", "--out", "cut", "--overwrite", "--until",
                                                "1000", "--set", "output.checkpoint.minutes=60", NULL});
        for (double end = sb_clock() + 30; !exists("cut/particles/000002.vtp") && sb_clock() < end;) usleep(2000);
        assert_int_equal(kill(process, signals[s]), 0);
        outcome o = program_finish(process);
        assert_int_equal(o.status, 128 + signals[s]);
        assert_one_line(o.err, "; to resume: shorebreak run cut/scene.yaml --out cut --resume");
        outcome_free(&o);
        assert_int_equal(list_checkpoints("cut", names), 1);
        const double steps = json_number_of("cut/summary.json", "steps");
        assert_near(strtod(names[0], NULL), steps, 0);
        const double until = json_number_of("cut/summary.json", "simulated_s") + 0.1;
        char text[32];
        snprintf(text, sizeof text, "%.6f", until);
        RUN_AND_FORGET(0, "run", "cut/scene.yaml", "--out", "cut", "--quiet", "--resume", "--until", text);
        RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "uncut", "--quiet", "--overwrite", "--until", text);
        assert_same_run("uncut", "cut", pair_tables);
        RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "cut", "--quiet", "--overwrite", "--until", "0.01");
        unlink(in_folder("cut/particles/000002.vtp"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_solver_resumes),
        cmocka_unit_test(a_run_in_3d_with_pictures_resumes),
        cmocka_unit_test(a_stream_changes_nothing),
        cmocka_unit_test(checkpoints_change_nothing),
        cmocka_unit_test(the_newest_ones_are_kept),
        cmocka_unit_test(without_a_checkpoint_the_run_starts),
        cmocka_unit_test(a_run_resumes_settling),
        cmocka_unit_test(a_finished_run_is_reported),
        cmocka_unit_test(an_end_that_has_passed_is_refused),
        cmocka_unit_test(a_signal_leaves_a_checkpoint),
    };
    return cmocka_run_group_tests(tests, pair_setup, program_teardown);
}
