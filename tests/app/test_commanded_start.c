/* A wave maker that a command starts: log and checkpoint have the time, and a resumed run and a run with this time in
   its scene repeat the bits. */
#include "commander.h"

#include "base/memory.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char scene[] = "dimensions: 2\n"
                            "resolution: 0.05\n"
                            "duration: 1.5\n"
                            "domain: {min: [0, 0], max: [3, 1]}\n"
                            "water: {level: 0.5, seed: [1, 0.2]}\n"
                            "bodies: [{name: paddle, shape: box, min: [0, 0], max: [0.3, 1]}]\n"
                            "wavemakers: [{name: piston, body: paddle, kind: stroke, stroke: 0.3, speed: 0.5,\n"
                            "  start: command}]\n"
                            "measure: {interval: 0.05, gauges: [{name: near, x: 0.8}]}\n"
                            "numerics: {settle_steps: 0}\n"
                            "output: {plots: false, checkpoint: {keep: 10}}\n";

enum { TEXT = 64 };

/* The setting that gives the logged time. */
static void start_of(const char *directory, char setting[TEXT])
{
    size_t count;
    char *event = event_of(directory, "trigger", &count);
    assert_int_equal(count, 1);
    const char *at = strstr(event, "start: ");
    assert_non_null(at);
    snprintf(setting, TEXT, "wavemakers.piston.start=%.*s", (int)strspn(at + 7, "0123456789.e-+"), at + 7);
    sb_free(event);
}

static void same_table(const char *one, const char *other)
{
    char *texts[2] = {text_of(one), text_of(other)};
    assert_string_equal(texts[0], texts[1]);
    sb_free(texts[0]);
    sb_free(texts[1]);
}

static void a_commanded_start_can_be_repeated(void **state)
{
    (void)state;
    char start[TEXT];
    const pid_t run = commander_start("wave.yaml", "wave", (const char *const[]){NULL});
    commander_send(0, "wave", "step 7");
    commander_send(0, "wave", "pause"); /* the steps may not be made yet: in either case the time is logged */
    assert_contains(commander_send(0, "wave", "trigger piston"), "wave maker \"piston\" begins at t = ");
    assert_contains(commander_send(1, "wave", "trigger piston"), "its motion began or begins at t = ");
    assert_contains(commander_send(0, "wave", "checkpoint"), "checkpoint of step ");
    commander_send(0, "wave", "step 10");
    commander_send(0, "wave", "stop");
    outcome o = program_finish(run);
    assert_int_equal(o.status, 128 + SIGINT);
    outcome_free(&o);
    start_of("wave", start);
    RUN_AND_FORGET(0, "run", "wave/scene.yaml", "--out", "wave", "--resume", "--quiet", "--set",
                   "control.paused=false");

    RUN_AND_FORGET(0, "run", "wave.yaml", "--out", "again", "--quiet", "--set", start);
    assert_same_hash("wave", "again");
    same_table("wave/gauges.csv", "again/gauges.csv");
    same_table("wave/forces.csv", "again/forces.csv");

    o = RUN(0, "run", "wave.yaml", "--out", "still", "--quiet");
    assert_contains(o.err,
                    "wave maker \"piston\": its start waits for a command, and commands are off: it makes no waves");
    outcome_free(&o);
    char *moved = text_of("wave/gauges.csv"), *still = text_of("still/gauges.csv");
    assert_string_not_equal(moved, still);
    sb_free(moved);
    sb_free(still);
}

/* A run that is killed right after the command has it in its checkpoint, although that step had one before. */
static void a_commanded_start_survives_a_kill(void **state)
{
    (void)state;
    char start[TEXT];
    const pid_t run = commander_start("wave.yaml", "killed", (const char *const[]){NULL});
    commander_send(0, "killed", "step 5");
    commander_send(0, "killed", "pause");
    commander_send(0, "killed", "checkpoint");
    commander_send(0, "killed", "trigger piston");
    kill(run, SIGKILL);
    outcome o = program_finish(run);
    outcome_free(&o);
    start_of("killed", start);
    RUN_AND_FORGET(0, "run", "killed/scene.yaml", "--out", "killed", "--resume", "--quiet", "--set",
                   "control.paused=false");
    RUN_AND_FORGET(0, "run", "wave.yaml", "--out", "same", "--quiet", "--set", start);
    assert_same_hash("killed", "same");
    same_table("killed/forces.csv", "same/forces.csv");
}

static int setup(void **state)
{
    if (program_setup(state) != 0) return -1;
    write_text("wave.yaml", scene);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_commanded_start_can_be_repeated),
                                       cmocka_unit_test(a_commanded_start_survives_a_kill)};
    return cmocka_run_group_tests(tests, setup, program_teardown);
}
