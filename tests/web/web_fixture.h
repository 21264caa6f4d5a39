/* Functions that the web server's tests share: a server with a view of a memq stream, and clients as plain sockets. The
   server works in the test's thread, whenever a client waits. */
#ifndef SB_TESTS_WEB_FIXTURE_H
#define SB_TESTS_WEB_FIXTURE_H

#include "check.h"
#include "stream/stream_fixture.h"

#include "base/clock.h"
#include "web/server.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>

#define TOKEN "0123456789abcdef0123456789abcdef"

typedef struct site {
    sb_stream *stream;
    sb_web_view *view;
    sb_web_server *server;
    char command[8192]; /* the last one */
    int commands;
} site;

static inline sb_status site_command(void *user, const char *json, size_t size, int64_t *id, sb_error *error)
{
    site *s = user;
    if (!strstr(json, "\"do\"")) return sb_fail(error, SB_BAD_INPUT, "\"do\": expected a command");
    memcpy(s->command, json, size + 1);
    s->commands++;
    *id = 17;
    return SB_OK;
}

static inline void site_take(const lcm_recv_buf_t *received, const char *channel, void *user)
{
    sb_web_view_take(user, sb_channel_guess(channel), received->data, received->data_size, sb_clock());
}

/* settings NULL: any port of 127.0.0.1, no commands. */
static inline void site_open(site *s, const sb_web_settings *settings)
{
    *s = (site){.stream = fixture_stream("memq://", 0, 1), .view = sb_web_view_create()};
    assert_non_null(s->view);
    lcm_subscription_t *made = lcm_subscribe(sb_stream_provider(s->stream), "test_.*", site_take, s->view);
    lcm_subscription_set_queue_capacity(made, 100000);
    sb_web_settings own = settings ? *settings : (sb_web_settings){0};
    own.user = s;
    sb_error error = {0};
    if (sb_web_server_create(&own, s->view, &s->server, &error) != SB_OK) fail_msg("%s", error.text);
}

static inline void site_close(site *s)
{
    sb_web_server_destroy(s->server);
    sb_web_view_destroy(s->view);
    sb_stream_destroy(s->stream);
}

static inline void site_publish(site *s, const sb_frame *frame)
{
    fixture_publish(s->stream, frame);
    fixture_drain(s->stream);
}

/* Lets the server work for so long. */
static inline void site_work(site *s, double seconds)
{
    const double end = sb_clock() + seconds;
    do {
        const double wait = sb_web_server_run(s->server), left = end - sb_clock();
        struct pollfd ready = {.fd = sb_web_server_descriptor(s->server), .events = POLLIN};
        if (left > 0) poll(&ready, 1, (int)(1e3 * (wait < left ? wait : left)));
    } while (sb_clock() < end);
}

static inline int site_connect(const site *s)
{
    const int made = socket(AF_INET, SOCK_STREAM, 0);
    struct sockaddr_in address = {.sin_family = AF_INET,
                                  .sin_port = htons((uint16_t)sb_web_server_port(s->server)),
                                  .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    assert_int_equal(connect(made, (const struct sockaddr *)&address, sizeof address), 0);
    fcntl(made, F_SETFL, O_NONBLOCK);
    return made;
}

/* Writes all bytes; the server reads meanwhile. */
static inline void site_send(site *s, int client, const char *bytes, size_t size)
{
    for (const double end = sb_clock() + 5; size > 0 && sb_clock() < end;) {
        const ssize_t sent = send(client, bytes, size, MSG_NOSIGNAL);
        if (sent > 0) {
            bytes += sent;
            size -= (size_t)sent;
        } else if (errno != EAGAIN)
            return; /* the server has closed the connection */
        sb_web_server_run(s->server);
    }
}

typedef struct reply {
    char *bytes; /* zero-terminated */
    size_t size;
    bool ended; /* the server has closed the connection */
} reply;

/* Reads until the server closes the connection, `most` bytes have come, or the time is over. */
static inline reply site_read(site *s, int client, size_t most, double seconds)
{
    reply r = {.bytes = malloc(most + 1)};
    assert_non_null(r.bytes);
    for (const double end = sb_clock() + seconds; r.size < most && !r.ended && sb_clock() < end;) {
        sb_web_server_run(s->server);
        const ssize_t got = recv(client, r.bytes + r.size, most - r.size, 0);
        if (got > 0)
            r.size += (size_t)got;
        else if (got == 0 || errno != EAGAIN)
            r.ended = true;
        else {
            struct pollfd ready[2] = {{.fd = sb_web_server_descriptor(s->server), .events = POLLIN},
                                      {.fd = client, .events = POLLIN}};
            poll(ready, 2, 10);
        }
    }
    r.bytes[r.size] = '\0';
    return r;
}

/* Sends a whole request and reads the whole answer. Free with free(). */
static inline char *site_ask(site *s, const char *request)
{
    const int client = site_connect(s);
    site_send(s, client, request, strlen(request));
    reply r = site_read(s, client, 1 << 22, 5);
    close(client);
    if (!r.ended) fail_msg("the server did not close the connection after %.200s", request);
    return r.bytes;
}

/* The status of an answer to "METHOD URL" with further headers, each ended by CR LF; 0: none. */
static inline int site_status(site *s, const char *line, const char *headers, const char *body)
{
    char request[8192];
    snprintf(request, sizeof request, "%s HTTP/1.1\r\n%s\r\n%s", line, headers, body);
    char *answer = site_ask(s, request);
    const int status = strncmp(answer, "HTTP/1.1 ", 9) == 0 ? atoi(answer + 9) : 0;
    free(answer);
    return status;
}

/* Removes the chunks of a body; returns its size. complete: whether the last chunk has come. */
static inline size_t site_unchunk(char *body, size_t size, bool *complete)
{
    size_t from = 0, to = 0;
    *complete = false;
    while (from < size) {
        char *end = NULL;
        const size_t length = strtoull(body + from, &end, 16);
        const size_t start = (size_t)(end - body) + 2;
        if (length == 0) {
            *complete = start <= size;
            break;
        }
        const size_t there = start >= size ? 0 : start + length > size ? size - start : length;
        memmove(body + to, body + start, there);
        to += there;
        from = start + length + 2;
    }
    return to;
}

static inline char *body_of(reply *r)
{
    char *body = strstr(r->bytes, "\r\n\r\n");
    assert_non_null(body);
    return body + 4;
}

#endif
