/* The helper process of a run that takes commands: the run goes on when it is killed, and it ends with the run. */
#include "commander.h"

#include "base/clock.h"
#include "base/memory.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const double TIMEOUT = 30; /* s */

#define LONG "--set", "duration=2", "--set", "numerics.settle_steps=0"

static bool is_there(pid_t process)
{
    char path[64], state = 'X';
    snprintf(path, sizeof path, "/proc/%ld/stat", (long)process);
    FILE *file = fopen(path, "r");
    if (!file) return false;
    if (fscanf(file, "%*d %*[^)]) %c", &state) != 1) state = 'X';
    fclose(file);
    return state != 'X' && state != 'Z';
}

/* Waits for a helper that is not this one; 0: the run has ended without one. */
static pid_t next_helper(pid_t run, pid_t before)
{
    const double end = sb_clock() + TIMEOUT;
    pid_t helper = child_of(run);
    while ((helper == 0 || helper == before) && is_there(run) && sb_clock() < end) {
        usleep(10000);
        helper = child_of(run);
    }
    return helper == before ? 0 : helper;
}

/* A killed helper is replaced by another one, which takes no command that the first one had taken. */
static void a_killed_helper_is_replaced(void **state)
{
    (void)state;
    const pid_t run = commander_start("tank2.yaml", "replaced", (const char *const[]){LONG, NULL});
    const pid_t helper = child_of(run), receiver = child_of(helper);
    assert_true(helper > 0 && receiver > 0);
    kill(receiver, SIGABRT); /* as a forged packet may do: the helper replaces it */
    commander_send(0, "replaced", "step 2");
    assert_int_equal(child_of(run), helper);
    assert_true(child_of(helper) != receiver);
    kill(helper, SIGKILL);
    assert_true(next_helper(run, helper) > 0);
    commander_send(0, "replaced", "step 2");
    commander_send(0, "replaced", "resume");
    outcome o = program_finish(run);
    if (o.status != 0) fail_msg("exit status %d: %s", o.status, o.err);
    assert_contains(o.err, "shorebreak-live has ended; it was started again");
    outcome_free(&o);
}

/* A paused run goes on when nobody can resume it. */
static void a_run_without_a_helper_goes_on(void **state)
{
    (void)state;
    const pid_t run = commander_start("tank2.yaml", "alone", (const char *const[]){LONG, NULL});
    for (pid_t helper = child_of(run); helper > 0; helper = next_helper(run, helper)) kill(helper, SIGKILL);
    outcome o = program_finish(run);
    if (o.status != 0) fail_msg("exit status %d: %s", o.status, o.err);
    assert_contains(o.err, "is not started again: the run takes no more commands, and is resumed");
    outcome_free(&o);
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "undisturbed", "--quiet", LONG);
    assert_same_hash("alone", "undisturbed");
}

static void the_helper_ends_with_a_killed_run(void **state)
{
    (void)state;
    const pid_t run = commander_start("tank2.yaml", "killed", (const char *const[]){LONG, NULL});
    const pid_t helper = child_of(run), receiver = child_of(helper);
    assert_true(helper > 0 && receiver > 0);
    kill(run, SIGKILL);
    outcome o = program_finish(run);
    assert_int_equal(o.status, 128 + SIGKILL);
    outcome_free(&o);
    const double end = sb_clock() + TIMEOUT;
    while ((is_there(helper) || is_there(receiver)) && sb_clock() < end) usleep(10000);
    assert_false(is_there(helper));
    assert_false(is_there(receiver));
    /* The directory is not locked by it, and a resumed run has a token of its own. */
    assert_true(exists("killed/control.token"));
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "killed", "--quiet", "--overwrite", LONG);
    assert_false(exists("killed/control.token"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_killed_helper_is_replaced),
                                       cmocka_unit_test(a_run_without_a_helper_goes_on),
                                       cmocka_unit_test(the_helper_ends_with_a_killed_run)};
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
