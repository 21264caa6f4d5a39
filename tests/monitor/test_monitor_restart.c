/* A publisher is killed and resumed: a listener and the monitor say so and go on. */
#include "publisher_fixture.h"

#include "base/clock.h"
#include "stream/listen.h"

#include <fcntl.h>

#define URL "udpm://239.255.76.69:7673?ttl=0"

static char output[1 << 16];

static void on_message(void *user, sb_channel_kind kind, const void *data, size_t size, double time)
{
    sb_live_take(user, kind, data, size, time);
}

static void wait_for(sb_listener *listener, double seconds)
{
    for (double end = sb_clock() + seconds; sb_clock() < end;) sb_listener_poll(listener, 0.05);
}

/* Waits for so many more complete frames, for at most 5 s. */
static void wait_for_frames(sb_listener *listener, const sb_live *live, uint64_t frames)
{
    const uint64_t before = sb_live_count(live).frames_complete;
    for (double end = sb_clock() + 5; sb_live_count(live).frames_complete < before + frames; wait_for(listener, 0.05))
        if (sb_clock() > end) fail_msg("no frames within 5 s");
}

static pid_t start_monitor(int *out)
{
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    const pid_t made = fork();
    if (made == 0) {
        prctl(PR_SET_PDEATHSIG, SIGTERM);
        dup2(ends[1], STDOUT_FILENO);
        close(ends[0]);
        close(ends[1]);
        execl(SB_BINARY_DIR "/shorebreak-monitor", "shorebreak-monitor", "--prefix", "test", "--url", URL,
              (char *)NULL);
        _exit(127);
    }
    close(ends[1]);
    *out = ends[0];
    return made;
}

/* Ends the monitor as Ctrl-C does, and keeps its output. Returns its exit code. */
static int end_monitor(pid_t process, int out)
{
    size_t length = 0;
    int status = 0;
    kill(process, SIGINT);
    for (ssize_t got = 1; got > 0; length += got > 0 ? (size_t)got : 0)
        got = read(out, output + length, sizeof output - 1 - length);
    output[length] = 0;
    close(out);
    waitpid(process, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

/* The text after the first place of `text` in `from`. */
static const char *after(const char *from, const char *text)
{
    const char *found = strstr(from, text);
    if (!found) fail_msg("\"%s\" does not follow in:\n%s", text, output);
    return found + strlen(text);
}

static void a_killed_publisher_is_reported_and_the_resumed_one_followed(void **state)
{
    (void)state;
    static const sb_live_calls none;
    int start[2][2], out = -1;
    pid_t publishers[2];
    if (!fixture_has_route(URL)) skip();
    for (int i = 0; i < 2; i++) {
        assert_int_equal(pipe(start[i]), 0);
        publishers[i] = fixture_publisher(URL, 1 + 500 * (uint64_t)i, start[i][0]);
    }
    const pid_t monitor = start_monitor(&out);
    sb_live *live = sb_live_create(&none);
    const sb_listener_calls calls = {.user = live, .message = on_message};
    sb_listener *listener = NULL;
    assert_int_equal(sb_listener_create(URL, "test", &calls, &listener, NULL), SB_OK);

    assert_int_equal(write(start[0][1], "s", 1), 1);
    wait_for_frames(listener, live, 3);
    wait_for(listener, 0.5);
    const int64_t first_run = sb_live_get_status(live)->head.run_id;
    fixture_kill(publishers[0]);
    wait_for(listener, 3.5);
    assert_int_equal(sb_live_get_status(live)->head.run_id, first_run); /* the last values stay */
    assert_int_equal(sb_live_count(live).restarts, 0);

    assert_int_equal(write(start[1][1], "s", 1), 1);
    wait_for_frames(listener, live, 3);
    wait_for(listener, 0.5);
    assert_int_equal(sb_live_count(live).restarts, 1);
    assert_true(sb_live_get_status(live)->head.run_id != first_run);
    assert_true(sb_live_get_frame(live)->frame > 500);
    fixture_kill(publishers[1]);
    const int code = end_monitor(monitor, out);
    sb_listener_destroy(listener);
    sb_live_destroy(live);

    assert_int_equal(code, 0);
    const char *at = after(output, "a run  running");
    at = after(at, "no data for 3 s");
    at = after(at, "messages of another process follow: the run was resumed, or another one began");
    at = after(at, "a run  running");
    after(at, "run restarts 1");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_killed_publisher_is_reported_and_the_resumed_one_followed)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
