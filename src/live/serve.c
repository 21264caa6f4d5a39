#include "live/serve.h"

#include "base/clock.h"
#include "live/intake.h"
#include "web/server.h"

#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

enum { AT_ONCE = 64 }; /* messages between two turns of the web server */
#define REPORT_SECONDS 1.0
#define LEAVE_SECONDS 0.7

typedef struct site {
    const sb_live_options *options;
    sb_receiver *receiver;
    sb_intake intake;
    sb_web_view *view;
    sb_web_server *server;
    double reported; /* s, of sb_clock */
    sb_web_counts counts;
    sb_live_counts live;
} site;

static volatile sig_atomic_t stopped;

static void stop(int number)
{
    (void)number;
    stopped = 1;
}

static void on_message(void *user, sb_channel_kind kind, const void *data, size_t size)
{
    sb_web_view_take(user, kind, data, size, sb_clock());
}

static sb_status on_command(void *user, const char *json, size_t size, int64_t *id, sb_error *error)
{
    const site *s = user;
    return sb_receiver_take_json(s->receiver, json, size, id, error);
}

static void on_log(void *user, const char *line)
{
    (void)user;
    fprintf(stderr, "shorebreak-live: %s\n", line);
}

static sb_status open_site(site *s, const sb_token *token, sb_error *error)
{
    char digits[SB_TOKEN_DIGITS + 1] = "";
    for (int i = 0; token && i < SB_TOKEN_BYTES; i++) sprintf(digits + 2 * i, "%02x", token->bytes[i]);
    const bool commands = token && s->receiver;
    const sb_web_settings settings = {.address = s->options->bind,
                                      .port = (int)s->options->port,
                                      .next_port = true,
                                      .name = s->options->host,
                                      .token = digits,
                                      .user = s,
                                      .command = commands ? on_command : NULL,
                                      .log = on_log};
    s->view = sb_web_view_create();
    if (!s->view) return sb_fail_memory(error, "the page");
    /* The process of the intake is made before the web server, whose sockets it must not have. */
    sb_status status = sb_intake_start(s->options, s->receiver, &s->intake, error);
    if (status == SB_OK) status = sb_web_server_create(&settings, s->view, &s->server, error);
    return status;
}

static void announce(const site *s)
{
    const char *address = s->options->bind ? s->options->bind : "127.0.0.1";
    const char *name = s->options->host ? s->options->host : address;
    const bool brackets = strchr(name, ':');
    printf("live: http://%s%s%s:%d/\n", brackets ? "[" : "", name, brackets ? "]" : "", sb_web_server_port(s->server));
    fflush(stdout);
}

/* Informs the run, once in a second, of refused requests and of the losses of the stream. False: the run has ended. */
static bool report(site *s)
{
    const double now = sb_clock();
    if (!s->receiver || now < s->reported + REPORT_SECONDS) return true;
    const sb_web_counts counts = sb_web_server_count(s->server);
    const sb_live_counts live = sb_live_count(sb_web_view_live(s->view));
    for (uint64_t i = s->counts.foreign + s->counts.no_token; i < counts.foreign + counts.no_token; i++)
        sb_receiver_count_foreign(s->receiver);
    for (uint64_t i = s->counts.malformed; i < counts.malformed; i++) sb_receiver_count_malformed(s->receiver);
    const double lost = (double)(live.lost > s->live.lost ? live.lost - s->live.lost : 0);
    const double sent = lost + (double)(live.messages - s->live.messages);
    if (sent > 0) sb_receiver_report_loss(s->receiver, lost / sent);
    s->counts = counts;
    s->live = live;
    s->reported = now;
    return sb_receiver_serve(s->receiver, false);
}

/* Whether to go on: the run ends this process when it has ended itself, and pages look every half second for its state.
   The stream's last message may be on its way yet. */
static bool goes_on(const site *s, double *end)
{
    if (!stopped) return true;
    if (!s->receiver || sb_web_server_count(s->server).streams == 0) return false;
    if (!(*end > 0)) *end = sb_clock() + LEAVE_SECONDS;
    return sb_clock() < *end;
}

static int serve(site *s)
{
    int code = 0;
    double end = 0;
    while (goes_on(s, &end) && report(s)) {
        const double wait = sb_web_server_run(s->server);
        struct pollfd ready[2] = {{.fd = sb_web_server_descriptor(s->server), .events = POLLIN},
                                  {.fd = s->intake.socket, .events = POLLIN}};
        if (poll(ready, 2, (int)(1e3 * wait + 0.5)) <= 0 || !ready[1].revents) continue;
        if (!sb_intake_read(&s->intake, AT_ONCE, on_message, s->view, &code) && code != 0) break;
    }
    return code;
}

int sb_live_serve(const sb_live_options *options, const sb_token *token, sb_receiver *receiver)
{
    site s = {.options = options, .receiver = receiver, .intake = {.socket = -1}};
    sb_error error = {0};
    const struct sigaction action = {.sa_handler = stop};
    int code;
    if (open_site(&s, token, &error) != SB_OK) {
        fprintf(stderr, "shorebreak-live: %s\n", error.text);
        code = (int)error.status;
    } else {
        sigaction(SIGINT, &action, NULL);
        sigaction(SIGTERM, &action, NULL);
        sigaction(SIGHUP, &action, NULL);
        announce(&s);
        code = serve(&s);
    }
    sb_intake_stop(&s.intake);
    sb_web_server_destroy(s.server);
    sb_web_view_destroy(s.view);
    return code;
}
