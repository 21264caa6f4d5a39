#include "web/server_state.h"

#include "base/clock.h"
#include "base/memory.h"
#include "web/allow.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { DEFAULT_CLIENTS = 40, DEFAULT_STALLED = 30 };
#define DEFAULT_REQUEST 10.0
#define LOG_SECONDS 10.0

/* No URL has escapes: "/%00" is not "/". */
static size_t keep_escapes(void *user, struct MHD_Connection *connection, char *text)
{
    (void)user;
    (void)connection;
    return strlen(text);
}

/* ---- the server ---- */

uint64_t sb_web_server_refused(const sb_web_server *server)
{
    const sb_web_counts *c = &server->counts;
    return c->foreign + c->no_token + c->unknown + c->malformed + c->wrong + c->late + c->unavailable;
}

static sb_status check(const sb_web_server *server, sb_error *error)
{
    const size_t length = server->token ? strlen(server->token) : 0;
    if (server->token && (length < SB_WEB_TOKEN_MIN || length > SB_WEB_TOKEN_MAX))
        return sb_fail(error, SB_BAD_INPUT, "the token has %zu characters; expected %d to %d", length, SB_WEB_TOKEN_MIN,
                       SB_WEB_TOKEN_MAX);
    if (server->readers_need_token && !server->token)
        return sb_fail(error, SB_BAD_INPUT,
                       "%.100s is not a loopback address, and beyond loopback every reader needs a token; give one "
                       "with --token-file",
                       server->address);
    if (server->settings.port < 0 || server->settings.port > UINT16_MAX)
        return sb_fail(error, SB_BAD_INPUT, "port %d: expected 1 to 65535, or 0 for any", server->settings.port);
    return SB_OK;
}

static sb_status copy_settings(sb_web_server *server, const sb_web_settings *settings, sb_error *error)
{
    server->settings = *settings;
    sb_web_settings *s = &server->settings;
    if (s->clients == 0) s->clients = DEFAULT_CLIENTS;
    if (!(s->request_seconds > 0)) s->request_seconds = DEFAULT_REQUEST;
    if (s->stalled_seconds == 0) s->stalled_seconds = DEFAULT_STALLED;
    server->address = sb_strdup(s->address ? s->address : "127.0.0.1");
    server->name = sb_strdup(s->name);
    server->token = sb_strdup(s->token && *s->token ? s->token : NULL);
    if (!server->address || (s->name && !server->name) || (s->token && *s->token && !server->token))
        return sb_fail_memory(error, "the web server");
    server->readers_need_token = !sb_web_is_loopback(server->address);
    sb_web_plots_load(&server->plots, s->plot_folder);
    return check(server, error);
}

static sb_status begin(sb_web_server *server, sb_error *error)
{
    const int listener = sb_web_listen(server, error);
    if (listener < 0) return error->status;
    server->daemon = MHD_start_daemon(
        MHD_USE_EPOLL | MHD_ALLOW_SUSPEND_RESUME, (uint16_t)server->port, NULL, NULL, sb_web_on_request, server,
        MHD_OPTION_LISTEN_SOCKET, listener, MHD_OPTION_CONNECTION_LIMIT, (unsigned)server->settings.clients,
        MHD_OPTION_CONNECTION_MEMORY_LIMIT, (size_t)SB_WEB_HEAD_MAX, MHD_OPTION_CONNECTION_TIMEOUT,
        server->settings.stalled_seconds, MHD_OPTION_NOTIFY_CONNECTION, sb_web_on_connection, server,
        MHD_OPTION_UNESCAPE_CALLBACK, keep_escapes, NULL, MHD_OPTION_END);
    const union MHD_DaemonInfo *info =
        server->daemon ? MHD_get_daemon_info(server->daemon, MHD_DAEMON_INFO_EPOLL_FD) : NULL;
    if (!info) {
        if (!server->daemon) close(listener);
        return sb_fail(error, SB_FAILED, "libmicrohttpd cannot start the web server");
    }
    server->descriptor = info->epoll_fd;
    return SB_OK;
}

sb_status sb_web_server_create(const sb_web_settings *settings, const sb_web_view *view, sb_web_server **server,
                               sb_error *error)
{
    sb_error unused;
    if (!error) error = &unused;
    sb_web_server *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "the web server");
    made->view = view;
    sb_status status = copy_settings(made, settings, error);
    if (status == SB_OK) status = begin(made, error);
    if (status != SB_OK) {
        sb_web_server_destroy(made);
        return status;
    }
    *server = made;
    return SB_OK;
}

void sb_web_server_destroy(sb_web_server *server)
{
    if (!server) return;
    server->closing = true;
    if (server->daemon) {
        sb_web_resume_streams(server, sb_clock()); /* libmicrohttpd cannot end suspended connections */
        MHD_run(server->daemon);
        MHD_stop_daemon(server->daemon);
    }
    sb_web_plots_free(&server->plots);
    sb_free(server->address);
    sb_free(server->name);
    sb_free(server->token);
    sb_free(server);
}

int sb_web_server_port(const sb_web_server *server)
{
    return server->port;
}

int sb_web_server_descriptor(const sb_web_server *server)
{
    return server->descriptor;
}

static void report(sb_web_server *server, double now)
{
    const uint64_t refused = sb_web_server_refused(server);
    if (refused == server->reported || !server->settings.log ||
        (server->logged > 0 && now < server->logged + LOG_SECONDS))
        return;
    const sb_web_counts *c = &server->counts;
    char line[400];
    snprintf(line, sizeof line,
             "refused %llu requests so far: %llu of another host or site, %llu without token, %llu for no resource, "
             "%llu malformed, %llu of wrong commands, %llu too slow, %llu above the limit of clients",
             (unsigned long long)refused, (unsigned long long)c->foreign, (unsigned long long)c->no_token,
             (unsigned long long)c->unknown, (unsigned long long)c->malformed, (unsigned long long)c->wrong,
             (unsigned long long)c->late, (unsigned long long)c->unavailable);
    server->settings.log(server->settings.user, line);
    server->reported = refused;
    server->logged = now;
}

double sb_web_server_run(sb_web_server *server)
{
    const double now = sb_clock();
    sb_web_resume_streams(server, now);
    MHD_run(server->daemon);
    if (now >= server->checked + SB_WEB_TICK) {
        server->checked = now;
        sb_web_check_deadlines(server, now);
        report(server, now);
    }
    MHD_UNSIGNED_LONG_LONG wait = 0;
    if (MHD_get_timeout(server->daemon, &wait) != MHD_YES) return SB_WEB_TICK;
    return (double)wait < 1e3 * SB_WEB_TICK ? 1e-3 * (double)wait : SB_WEB_TICK;
}

sb_web_counts sb_web_server_count(const sb_web_server *server)
{
    return server->counts;
}
