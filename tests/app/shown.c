#include "shown.h"

#include "base/clock.h"
#include "base/memory.h"

#include <arpa/inet.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

int shown_port;
static char token[128];

pid_t shown_start(const char *directory, const char *spacing, const char *duration)
{
    char live[32], prefix[64];
    snprintf(live, sizeof live, "--live=%d", 20000 + (int)getpid() % 20000);
    snprintf(prefix, sizeof prefix, "stream.prefix=live-%ld", (long)getpid());
    (void)remove(in_folder("stdout.txt")); /* of an earlier run */
    const pid_t run = program_start((const char *const[]){"run", "tank3.yaml", live, "--control", "--out", directory,
                                                          "--quiet", "--set", prefix, "--set", "control.paused=true",
                                                          "--set", spacing, "--until", duration, SHOWN_LONGER, NULL});
    shown_port = 0;
    for (const double end = sb_clock() + 30; shown_port == 0 && sb_clock() < end; usleep(20000)) {
        char *out = exists("stdout.txt") ? text_of("stdout.txt") : NULL,
             *err = exists("stderr.txt") ? text_of("stderr.txt") : NULL;
        const char *at = out ? strstr(out, "live: http://127.0.0.1:") : NULL;
        const bool no_route = err && strstr(err, "multicast");
        if (at && strchr(at, '\n')) shown_port = atoi(at + strlen("live: http://127.0.0.1:"));
        sb_free(out);
        sb_free(err);
        if (!no_route) continue;
        kill(run, SIGTERM);
        outcome o = program_finish(run);
        outcome_free(&o);
        skip();
    }
    if (shown_port == 0) fail_msg("the run printed no address");
    char name[80];
    snprintf(name, sizeof name, "%s/control.token", directory);
    char *text = text_of(name);
    snprintf(token, sizeof token, "%.*s", (int)strcspn(text, "\n"), text);
    sb_free(text);
    return run;
}

int shown_connect(void)
{
    const int made = socket(AF_INET, SOCK_STREAM, 0);
    const struct timeval limit = {.tv_sec = 5};
    setsockopt(made, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    const struct sockaddr_in address = {
        .sin_family = AF_INET, .sin_port = htons((uint16_t)shown_port), .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    assert_int_equal(connect(made, (const struct sockaddr *)&address, sizeof address), 0);
    return made;
}

const char *shown_ask(const char *line, const char *headers, const char *body)
{
    static char answer[1 << 16];
    char request[1024];
    snprintf(request, sizeof request, "%s HTTP/1.1\r\nHost: localhost\r\n%sContent-Length: %zu\r\n\r\n%s", line,
             headers, strlen(body), body);
    const int page = shown_connect();
    assert_int_equal(write(page, request, strlen(request)), strlen(request));
    size_t size = 0;
    for (ssize_t got; size + 1 < sizeof answer && (got = read(page, answer + size, sizeof answer - 1 - size)) > 0;)
        size += (size_t)got;
    answer[size] = 0;
    close(page);
    return answer;
}

const char *shown_command(const char *body)
{
    char header[256];
    snprintf(header, sizeof header, "X-Token: %s\r\n", token);
    return shown_ask("POST /command", header, body);
}

void shown_await(const char *part)
{
    for (const double end = sb_clock() + 20; sb_clock() < end; usleep(20000))
        if (strstr(shown_ask("GET /status", "", ""), part)) return;
    fail_msg("not within 20 s: %s in %s", part, shown_ask("GET /status", "", ""));
}

const char *shown_token(void)
{
    return token;
}
