/* A run whose helper process ends again and again goes on without it. */
#include "commander.h"

#include <signal.h>

#define LONG "--set", "duration=2", "--set", "numerics.settle_steps=0"

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

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_run_without_a_helper_goes_on)};
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
