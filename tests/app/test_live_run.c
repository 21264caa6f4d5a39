/* A run that is shown to browsers by --live: its HTTP interface, its page in Chromium, its bits, and its helper's
   processes. */
#include "commander.h"

#include "base/clock.h"
#include "base/memory.h"
#include "web/chromium.h"

#include <arpa/inet.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#define LONGER                                                                                                         \
    "--set", "numerics.settle_steps=0", "--set", "stream.interval=0.02", "--set", "render.interval=4", "--set",        \
        "output.particle_interval=4"

static int port;
static char token[128];

/* Starts a run that is paused, and waits for the address of its page. Skips the test without a multicast route. */
static pid_t start(const char *directory, const char *spacing, const char *duration)
{
    char live[32], prefix[64];
    snprintf(live, sizeof live, "--live=%d", 20000 + (int)getpid() % 20000);
    snprintf(prefix, sizeof prefix, "stream.prefix=live-%ld", (long)getpid());
    (void)remove(in_folder("stdout.txt")); /* of an earlier run */
    const pid_t run = program_start((const char *const[]){"run", "tank3.yaml", live, "--control", "--out", directory,
                                                          "--quiet", "--set", prefix, "--set", "control.paused=true",
                                                          "--set", spacing, "--until", duration, LONGER, NULL});
    port = 0;
    for (const double end = sb_clock() + 30; port == 0 && sb_clock() < end; usleep(20000)) {
        char *out = exists("stdout.txt") ? text_of("stdout.txt") : NULL,
             *err = exists("stderr.txt") ? text_of("stderr.txt") : NULL;
        const char *at = out ? strstr(out, "live: http://127.0.0.1:") : NULL;
        const bool no_route = err && strstr(err, "multicast");
        if (at && strchr(at, '\n')) port = atoi(at + strlen("live: http://127.0.0.1:"));
        sb_free(out);
        sb_free(err);
        if (!no_route) continue;
        kill(run, SIGTERM);
        outcome o = program_finish(run);
        outcome_free(&o);
        skip();
    }
    if (port == 0) fail_msg("the run printed no address");
    char name[80];
    snprintf(name, sizeof name, "%s/control.token", directory);
    char *text = text_of(name);
    snprintf(token, sizeof token, "%.*s", (int)strcspn(text, "\n"), text);
    sb_free(text);
    return run;
}

static int connect_page(void)
{
    const int made = socket(AF_INET, SOCK_STREAM, 0);
    const struct timeval limit = {.tv_sec = 5};
    setsockopt(made, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    const struct sockaddr_in address = {
        .sin_family = AF_INET, .sin_port = htons((uint16_t)port), .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    assert_int_equal(connect(made, (const struct sockaddr *)&address, sizeof address), 0);
    return made;
}

/* The answer to a request; valid until the next one. */
static const char *ask(const char *line, const char *headers, const char *body)
{
    static char answer[1 << 16];
    char request[1024];
    snprintf(request, sizeof request, "%s HTTP/1.1\r\nHost: localhost\r\n%sContent-Length: %zu\r\n\r\n%s", line,
             headers, strlen(body), body);
    const int page = connect_page();
    assert_int_equal(write(page, request, strlen(request)), strlen(request));
    size_t size = 0;
    for (ssize_t got; size + 1 < sizeof answer && (got = read(page, answer + size, sizeof answer - 1 - size)) > 0;)
        size += (size_t)got;
    answer[size] = 0;
    close(page);
    return answer;
}

static const char *command(const char *body)
{
    char header[256];
    snprintf(header, sizeof header, "X-Token: %s\r\n", token);
    return ask("POST /command", header, body);
}

static void await_status(const char *part)
{
    for (const double end = sb_clock() + 20; sb_clock() < end; usleep(20000))
        if (strstr(ask("GET /status", "", ""), part)) return;
    fail_msg("not within 20 s: %s in %s", part, ask("GET /status", "", ""));
}

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
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "plain", "--quiet", "--until", "12", LONGER);
    const pid_t run = start("watched", "resolution=0.1", "12");
    await_status("\"state\":\"paused\"");
    assert_contains(ask("GET /status", "", ""), "{\"run\":\"Tank in 3D\",\"time_s\":0,\"step\":0,\"state\":\"paused\"");
    const int stopped = connect_page(), reader = connect_page();
    static const char frames[] = "GET /frames HTTP/1.1\r\nHost: localhost\r\n\r\n";
    assert_int_equal(write(stopped, frames, sizeof frames - 1), sizeof frames - 1);
    assert_int_equal(write(reader, frames, sizeof frames - 1), sizeof frames - 1);
    assert_contains(ask("POST /command", "X-Token: 0123456789abcdef\r\n", "{\"do\":\"resume\"}"), "HTTP/1.1 401");
    assert_contains(command("{\"do\":\"jump\"}"), "HTTP/1.1 400");
    assert_contains(command("{\"do\":\"step\",\"steps\":3}"), "{\"accepted\":true,\"id\":");
    await_status("\"step\":3,\"state\":\"paused\"");
    assert_contains(ask("GET /status", "", ""), "\"text\":\"3 steps, then paused\"");
    await_status("\"scene\":1");
    assert_contains(ask("GET /rows", "", ""), "\"names\":[");
    assert_contains(command("{\"do\":\"resume\"}"), "HTTP/1.1 202");
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
    const pid_t run = start("crashed", "resolution=0.1", "1000"), server = child_of(run), guard = child_of(server),
                receiver = child_of(guard);
    assert_true(server > 0 && guard > 0 && receiver > 0);
    const int reader = connect_page();
    static const char frames[] = "GET /frames HTTP/1.1\r\nHost: localhost\r\n\r\n";
    assert_int_equal(write(reader, frames, sizeof frames - 1), sizeof frames - 1);
    await_status("\"state\":\"paused\"");
    assert_int_equal(kill(receiver, SIGSEGV), 0);
    for (const double end = sb_clock() + 10; child_of(guard) == receiver || child_of(guard) == 0; usleep(20000))
        assert_true(sb_clock() < end);
    assert_contains(command("{\"do\":\"step\",\"steps\":40}"), "HTTP/1.1 202");
    await_status("\"step\":40,");
    static char bytes[1 << 16];
    size_t size = 0;
    for (const double end = sb_clock() + 10; size < 3000 && sb_clock() < end;) {
        const ssize_t got = read(reader, bytes, sizeof bytes);
        if (got > 0) size += (size_t)got;
    }
    assert_true(size >= 3000); /* one frame of 384 particles, and more than signs of life */
    assert_contains(command("{\"do\":\"stop\"}"), "HTTP/1.1 202");
    outcome o = program_finish(run);
    assert_true(o.status != 0);
    assert_contains(o.err, "crashed the receiver, which is started again");
    outcome_free(&o);
    close(reader);
}

static void page_of_a_run(void **state)
{
    (void)state;
    if (!chromium_is_there()) {
        print_message("skipped: /usr/bin/chromium is not there (Debian's package chromium)\n");
        skip();
    }
    const pid_t run = start("page", "resolution=0.05", "1000");
    chromium *browser = chromium_start(1280, 800);
    char text[256];
    snprintf(text, sizeof text, "http://127.0.0.1:%d/", port);
    chromium_open(browser, text);
    chromium_await(browser,
                   "window.shorebreak && document.getElementById('state').textContent === 'paused' &&"
                   " shorebreak.view.scene !== undefined",
                   20);
    snprintf(text, sizeof text,
             "(document.getElementById('token').value = '%s',"
             " document.querySelector('#login button').click())",
             token);
    chromium_true(browser, text);
    chromium_await(browser, "!document.getElementById('command-step').disabled", 5);
    chromium_true(browser, "document.getElementById('command-step').click()");
    chromium_await(browser, "document.getElementById('why').textContent === 'Step: 1 step, then paused'", 5);
    chromium_true(browser, "document.getElementById('command-resume').click()");
    chromium_await(browser, "shorebreak.times.time > 0.1", 10);
    chromium_await(browser, "document.getElementById('state').textContent === 'running'", 5);
    chromium_true(browser, "document.getElementById('command-pause').click()");
    chromium_await(browser, "document.getElementById('state').textContent === 'paused'", 5);
    usleep(300000);
    const double time = chromium_number(browser, "shorebreak.times.time");
    usleep(800000);
    assert_near(chromium_number(browser, "shorebreak.times.time"), time, 0);
    chromium_true(browser, "document.getElementById('command-resume').click()");
    snprintf(text, sizeof text, "shorebreak.times.time > %.9g", time);
    chromium_await(browser, text, 10);
    chromium_await(browser, "document.querySelectorAll('#forces canvas').length > 0", 5);
    /* A button that ends the run is pressed twice. */
    chromium_true(browser, "document.getElementById('command-stop').click()");
    chromium_true(browser, "document.getElementById('command-stop').click()");
    chromium_await(browser, "document.getElementById('notice').textContent.startsWith('The run has ended')", 10);
    outcome o = program_finish(run);
    assert_contains(o.err, "stopped by a command");
    outcome_free(&o);
    chromium_stop(browser);
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
        cmocka_unit_test(page_of_a_run),
    };
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
