/* A paused run sleeps, sends its status, and ends on a command and on a signal. */
#include "commander.h"

#include "base/clock.h"
#include "base/memory.h"
#include "control/message.h"
#include "control/target.h"
#include "stream/listen.h"
#include "stream/live.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

typedef struct view {
    sb_live *live;
    int paused; /* statuses */
} view;

static void on_status(void *user, const sb_status_message *message)
{
    ((view *)user)->paused += message->state == SB_RUN_PAUSED;
}

static void on_message(void *user, sb_channel_kind kind, const void *data, size_t size, double time)
{
    sb_live_take(((view *)user)->live, kind, data, size, time);
}

static double processor_of(pid_t process)
{
    char path[64];
    unsigned long user = 0, system = 0;
    snprintf(path, sizeof path, "/proc/%ld/stat", (long)process);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    assert_int_equal(fscanf(file, "%*d %*[^)]) %*c %*d %*d %*d %*d %*d %*u %*u %*u %*u %*u %lu %lu", &user, &system),
                     2);
    fclose(file);
    return (double)(user + system) / (double)sysconf(_SC_CLK_TCK);
}

static void a_paused_run_sends_its_status_and_sleeps(void **state)
{
    (void)state;
    view v = {0};
    sb_target target;
    sb_error error = {0};
    const pid_t run =
        commander_start("tank2.yaml", "paused",
                        (const char *const[]){"--set", "duration=100", "--set", "numerics.settle_steps=0", NULL});
    if (sb_target_read(in_folder("paused"), &target, &error) != SB_OK) fail_msg("%s", error.text);
    const sb_live_calls calls = {.user = &v, .status = on_status};
    const sb_listener_calls messages = {.user = &v, .message = on_message};
    sb_listener *listener = NULL;
    v.live = sb_live_create(&calls);
    assert_int_equal(sb_listener_create(target.url, target.prefix, &messages, &listener, &error), SB_OK);
    const double before = processor_of(run), begin = sb_clock();
    sb_listener_poll(listener, 2);
    const double seconds = sb_clock() - begin, used = processor_of(run) - before;
    assert_in_range(v.paused, (int)seconds, 10);
    if (used > 0.05 * seconds) fail_msg("a paused run used %g s of processor time in %g s", used, seconds);
    const double time = sb_live_get_status(v.live)->time;
    sb_listener_poll(listener, 0.6);
    assert_near(sb_live_get_status(v.live)->time, time, 0);

    /* Forged messages are counted in the log. */
    unsigned char message[SB_COMMAND_MESSAGE_MAX];
    size_t size;
    sb_token other = {{1}};
    assert_int_equal(
        sb_command_encode(&other, target.run_id, sb_target_counter(), "{\"do\":\"stop\"}", message, &size, &error),
        SB_OK);
    for (int i = 0; i < 3; i++) assert_int_equal(sb_listener_send_command(listener, message, size, &error), SB_OK);
    for (int i = 0; i < 2; i++) assert_int_equal(sb_listener_send_command(listener, message, size - 1, &error), SB_OK);
    sb_listener_destroy(listener);
    sb_live_destroy(v.live);

    assert_contains(commander_send(0, "paused", "stop"), "the run stops");
    outcome o = program_finish(run);
    assert_int_equal(o.status, 128 + SIGINT);
    assert_one_line(o.err, "stopped by a command at t = ");
    assert_contains(o.err, "to resume: shorebreak run");
    outcome_free(&o);
    size_t count;
    char *counts = event_of("paused", "commands", &count);
    assert_in_range(count, 1, 2); /* when they change, and at the end */
    assert_contains(counts, "2 malformed, 3 foreign, 0 replayed, 0 flooded");
    sb_free(counts);
}

static void a_signal_ends_a_paused_run(void **state)
{
    (void)state;
    const pid_t run =
        commander_start("tank2.yaml", "signal",
                        (const char *const[]){"--set", "duration=100", "--set", "numerics.settle_steps=0", NULL});
    const double begin = sb_clock();
    kill(run, SIGINT);
    outcome o = program_finish(run);
    assert_int_equal(o.status, 128 + SIGINT);
    assert_one_line(o.err, "stopped by a signal at t = ");
    assert_true(sb_clock() - begin < 5);
    outcome_free(&o);
}

static void without_permission_there_is_no_helper(void **state)
{
    (void)state;
    const pid_t run = program_start((const char *const[]){"run", "tank2.yaml", "--out", "none", "--set", "duration=100",
                                                          "--set", "stream.enabled=true", NULL});
    while (!exists("none/energy.csv")) usleep(10000);
    assert_int_equal(child_of(run), 0);
    assert_false(exists("none/control.token"));
    kill(run, SIGTERM);
    outcome o = program_finish(run);
    outcome_free(&o);
}

/* The helper would overwrite the log. */
static void a_stream_to_a_file_takes_no_commands(void **state)
{
    (void)state;
    char url[1024];
    snprintf(url, sizeof url, "file://%s?mode=w", in_folder("recorded.log"));
    setenv("LCM_DEFAULT_URL", url, 1);
    outcome o = RUN(0, "run", "tank2.yaml", "--out", "recorded", "--control", "--set", "control.paused=true");
    unsetenv("LCM_DEFAULT_URL");
    assert_contains(o.err, "the run takes no commands: its stream goes to a file");
    outcome_free(&o);
    assert_true(exists("recorded.log"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_paused_run_sends_its_status_and_sleeps),
                                       cmocka_unit_test(a_signal_ends_a_paused_run),
                                       cmocka_unit_test(without_permission_there_is_no_helper),
                                       cmocka_unit_test(a_stream_to_a_file_takes_no_commands)};
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
