/* A run that is shown to browsers by --live: its HTTP interface, its bits, and its helper's
   processes. */
#include "commander.h"
#include "shown.h"

#include "base/clock.h"
#include "base/memory.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

static void finish(pid_t run)
{
    outcome o = program_finish(run);
    if (o.status != 0) fail_msg("exit status %d: %s%s", o.status, o.out, o.err);
    outcome_free(&o);
}

/* Commands over HTTP, with clients that read and one that does not: the same bits as alone. */
static void watched_and_commanded(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "plain", "--quiet", "--until", "12", SHOWN_LONGER);
    const pid_t run = shown_start("watched", "resolution=0.1", "12");
    shown_await("\"state\":\"paused\"");
    assert_contains(shown_ask("GET /status", "", ""),
                    "{\"run\":\"Tank in 3D\",\"time_s\":0,\"step\":0,\"state\":\"paused\"");
    const int stopped = shown_connect(), reader = shown_connect();
    static const char frames[] = "GET /frames HTTP/1.1\r\nHost: localhost\r\n\r\n";
    assert_int_equal(write(stopped, frames, sizeof frames - 1), sizeof frames - 1);
    assert_int_equal(write(reader, frames, sizeof frames - 1), sizeof frames - 1);
    assert_contains(shown_ask("POST /command", "X-Token: 0123456789abcdef\r\n", "{\"do\":\"resume\"}"), "HTTP/1.1 401");
    assert_contains(shown_command("{\"do\":\"jump\"}"), "HTTP/1.1 400");
    assert_contains(shown_command("{\"do\":\"step\",\"steps\":3}"), "{\"accepted\":true,\"id\":");
    shown_await("\"step\":3,\"state\":\"paused\"");
    assert_contains(shown_ask("GET /status", "", ""), "\"text\":\"3 steps, then paused\"");
    shown_await("\"scene\":1");
    assert_contains(shown_ask("GET /rows", "", ""), "\"names\":[");
    assert_contains(shown_command("{\"do\":\"resume\"}"), "HTTP/1.1 202");
    static char bytes[1 << 16];
    for (int i = 0; i < 20; i++) assert_true(read(reader, bytes, sizeof bytes) > 0);
    finish(run);
    close(stopped);
    close(reader);
    assert_same_hash("plain", "watched");
}

/* The process that receives LCM dies, as by a forged packet: clients stay connected, and frames go on. */
static void receiver_crashes(void **state)
{
    (void)state;
    const pid_t run = shown_start("crashed", "resolution=0.1", "1000");
    pid_t server = 0, guard = 0, receiver = 0;
    for (const double end = sb_clock() + 10; receiver == 0 && sb_clock() < end; usleep(20000)) {
        server = child_of(run);
        guard = server ? child_of(server) : 0;
        receiver = guard ? child_of(guard) : 0;
    }
    assert_true(server > 0 && guard > 0 && receiver > 0);
    const int reader = shown_connect();
    static const char frames[] = "GET /frames HTTP/1.1\r\nHost: localhost\r\n\r\n";
    assert_int_equal(write(reader, frames, sizeof frames - 1), sizeof frames - 1);
    shown_await("\"state\":\"paused\"");
    assert_int_equal(kill(receiver, SIGSEGV), 0);
    for (const double end = sb_clock() + 10; child_of(guard) == receiver || child_of(guard) == 0; usleep(20000))
        assert_true(sb_clock() < end);
    static char bytes[1 << 16];
    size_t size = 0;
    const struct timeval limit = {.tv_usec = 200000};
    setsockopt(reader, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    for (const double end = sb_clock() + 20; size < 3000 && sb_clock() < end;) { /* it needs a moment to subscribe */
        assert_contains(shown_command("{\"do\":\"step\",\"steps\":5}"), "HTTP/1.1 202");
        const ssize_t got = read(reader, bytes, sizeof bytes);
        assert_true(got != 0); /* still connected */
        if (got > 0) size += (size_t)got;
    }
    assert_true(size >= 3000); /* one frame of 384 particles, and more than signs of life */
    assert_contains(shown_command("{\"do\":\"stop\"}"), "HTTP/1.1 202");
    outcome o = program_finish(run);
    assert_true(o.status != 0);
    assert_contains(o.err, "crashed the receiver, which is started again");
    outcome_free(&o);
    close(reader);
}

static void wrong_options(void **state)
{
    (void)state;
    static const char *const wrong[] = {"--live=x", "--live=0", "--live=70000", "--live=1.2.3.4:", "--live=80:80:x"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        outcome o = RUN(1, "run", "tank3.yaml", wrong[i], "--out", "wrong");
        assert_one_line(o.err, "expected PORT from 1 to 65535, or ADDRESS:PORT");
        outcome_free(&o);
    }
    outcome o = RUN(1, "run", "tank3.yaml", "--live=0.0.0.0:8080", "--out", "wrong");
    assert_one_line(o.err, "expected together with --control");
    outcome_free(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_options),
        cmocka_unit_test(watched_and_commanded),
        cmocka_unit_test(receiver_crashes),
    };
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
