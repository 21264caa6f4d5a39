/* The helper process of a run that takes commands: the run goes on when it is killed, and it ends with the run. */
#include "commander.h"

#include "base/clock.h"
#include "base/memory.h"
#include "stream/forged.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const double TIMEOUT = 30; /* s */

#define LONG "--set", "duration=2", "--set", "numerics.settle_steps=0"

/* The process that receives is replaced by the helper, which remains. */
static void a_forged_packet_costs_a_second(void **state)
{
    (void)state;
    const pid_t run = commander_start("tank2.yaml", "forged", (const char *const[]){LONG, NULL});
    const pid_t helper = child_of(run), receiver = child_of(helper);
    assert_true(helper > 0 && receiver > 0);
    char channel[64];
    snprintf(channel, sizeof channel, "test-%ld_command", (long)getpid());
    send_forged_packets("239.255.76.67", 7667, channel);
    for (int k = 0; k < 100 && is_there(receiver); k++) usleep(10000);
    if (is_there(receiver)) {
        print_message("this version of LCM does not crash on forged packets\n");
        kill(receiver, SIGABRT);
    }
    commander_send(0, "forged", "step 2");
    assert_int_equal(child_of(run), helper);
    assert_true(child_of(helper) != receiver);
    commander_send(0, "forged", "resume");
    outcome o = program_finish(run);
    if (o.status != 0) fail_msg("exit status %d: %s", o.status, o.err);
    outcome_free(&o);
}

/* A killed helper is replaced by another one, which takes no command that the first one had taken. */
static void a_killed_helper_is_replaced(void **state)
{
    (void)state;
    const pid_t run = commander_start("tank2.yaml", "replaced", (const char *const[]){LONG, NULL});
    const pid_t helper = child_of(run);
    assert_true(helper > 0);
    kill(helper, SIGKILL);
    assert_true(next_helper(run, helper) > 0);
    commander_send(0, "replaced", "step 2");
    commander_send(0, "replaced", "resume");
    outcome o = program_finish(run);
    if (o.status != 0) fail_msg("exit status %d: %s", o.status, o.err);
    assert_contains(o.err, "shorebreak-live has ended; it was started again");
    outcome_free(&o);
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
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_forged_packet_costs_a_second),
                                       cmocka_unit_test(a_killed_helper_is_replaced),
                                       cmocka_unit_test(the_helper_ends_with_a_killed_run)};
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
