#include "../check.h"
#include "base/stop.h"

#include <signal.h>

/* A process of several that must stop at the same step: what it receives waits until all accept it. */
static void a_deferred_signal_waits_until_it_is_accepted(void **state)
{
    (void)state;
    sb_stop_watch();
    sb_stop_watch_forwarded();
    sb_stop_defer(true);
    raise(SIGTERM);
    assert_int_equal(sb_stop_signal(), 0);
    assert_int_equal(sb_stop_waiting(), SIGTERM);
    raise(SIGUSR1); /* which mpirun passes on */
    assert_int_equal(sb_stop_waiting(), SIGUSR1);
    sb_stop_accept(SIGTERM, false);
    assert_int_equal(sb_stop_signal(), SIGTERM);
    assert_string_equal(sb_stop_cause(), "signal");
}

/* The process that leads goes on alone after the others have ended. */
static void what_waits_is_noted_when_deferring_ends(void **state)
{
    (void)state;
    sb_stop_accept(0, false);
    sb_stop_defer(false);
    assert_int_equal(sb_stop_waiting(), 0);
    assert_int_equal(sb_stop_signal(), SIGUSR1); /* of the test before */
}

/* A signal that comes before the process is one of several: the others must learn of it. */
static void what_was_noted_waits_when_deferring_begins(void **state)
{
    (void)state;
    sb_stop_defer(false);
    sb_stop_watch(); /* a second SIGTERM would end the process */
    raise(SIGTERM);
    assert_int_equal(sb_stop_signal(), SIGTERM);
    sb_stop_defer(true);
    assert_int_equal(sb_stop_signal(), 0);
    assert_int_equal(sb_stop_waiting(), SIGTERM);
    sb_stop_defer(true); /* what waits stays */
    assert_int_equal(sb_stop_waiting(), SIGTERM);
    sb_stop_accept(sb_stop_waiting(), sb_stop_by_command());
    assert_int_equal(sb_stop_signal(), SIGTERM);
    assert_string_equal(sb_stop_cause(), "signal");
}

/* mpirun sends SIGUSR1 to a process at any time. */
static void a_forwarded_signal_is_noted_without_deferring(void **state)
{
    (void)state;
    sb_stop_defer(false);
    sb_stop_watch_forwarded();
    sb_stop_accept(0, false);
    raise(SIGUSR1);
    assert_int_equal(sb_stop_signal(), SIGUSR1);
}

static void a_request_of_a_command_waits_as_well(void **state)
{
    (void)state;
    sb_stop_accept(0, false);
    sb_stop_defer(true);
    sb_stop_request();
    assert_int_equal(sb_stop_signal(), 0);
    assert_int_equal(sb_stop_waiting(), SIGINT);
    assert_true(sb_stop_by_command());
    sb_stop_accept(sb_stop_waiting(), true);
    assert_int_equal(sb_stop_signal(), SIGINT);
    assert_string_equal(sb_stop_cause(), "command");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_deferred_signal_waits_until_it_is_accepted),
        cmocka_unit_test(what_waits_is_noted_when_deferring_ends),
        cmocka_unit_test(what_was_noted_waits_when_deferring_begins),
        cmocka_unit_test(a_forwarded_signal_is_noted_without_deferring),
        cmocka_unit_test(a_request_of_a_command_waits_as_well),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
