/* Requests: which are refused, and what the others get. */
#include "web/server_state.h"

#include "base/clock.h"
#include "base/memory.h"
#include "web/allow.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef enum resource { PAGE_FILE, STATUS, SCENE, FRAMES, ROWS, COMMAND, UNKNOWN } resource;

static resource find(const sb_web_server *server, const char *url)
{
    static const char *const urls[] = {
        [STATUS] = "/status", [SCENE] = "/scene", [FRAMES] = "/frames", [ROWS] = "/rows", [COMMAND] = "/command"};
    if (sb_web_find(&server->plots, url)) return PAGE_FILE;
    for (resource r = STATUS; r < UNKNOWN; r++)
        if (strcmp(urls[r], url) == 0) return r;
    return UNKNOWN;
}

static const char *header_of(const sb_web_client *client, const char *name)
{
    return MHD_lookup_connection_value(client->connection, MHD_HEADER_KIND, name);
}

typedef struct header_count {
    const char *name;
    int count;
} header_count;

static enum MHD_Result count_header(void *user, enum MHD_ValueKind kind, const char *name, const char *value)
{
    (void)kind;
    (void)value;
    header_count *counted = user;
    counted->count += strcasecmp(name, counted->name) == 0;
    return MHD_YES;
}

/* The only value of a header; NULL: none, or several. */
static const char *single_header(const sb_web_client *client, const char *name)
{
    header_count counted = {name, 0};
    MHD_get_connection_values(client->connection, MHD_HEADER_KIND, count_header, &counted);
    return counted.count == 1 ? header_of(client, name) : NULL;
}

/* ---- refusals ---- */

/* Queues a refusal if the request is not allowed. Returns whether it did. */
static bool refuse(sb_web_client *client, resource which, const char *method, enum MHD_Result *result)
{
    sb_web_server *server = client->server;
    sb_web_counts *counts = &server->counts;
    const char *host = single_header(client, MHD_HTTP_HEADER_HOST), *reason = NULL;
    unsigned status = 0;
    uint64_t *count = NULL;
    const bool post = strcmp(method, MHD_HTTP_METHOD_POST) == 0;
    const bool get = strcmp(method, MHD_HTTP_METHOD_GET) == 0 || strcmp(method, MHD_HTTP_METHOD_HEAD) == 0;
    const bool accepts = server->settings.command && server->token;
    if (!sb_web_allow_host(host, client->address, server->name)) {
        status = MHD_HTTP_FORBIDDEN, count = &counts->foreign;
        reason = "the header Host does not name this server";
    } else if (!sb_web_allow_origin(header_of(client, MHD_HTTP_HEADER_ORIGIN), header_of(client, "Sec-Fetch-Site"),
                                    header_of(client, "Sec-Fetch-Mode"), host, which == PAGE_FILE)) {
        status = MHD_HTTP_FORBIDDEN, count = &counts->foreign, reason = "requests of another site are refused";
    } else if (which == UNKNOWN) {
        status = MHD_HTTP_NOT_FOUND, count = &counts->unknown, reason = "no such resource";
    } else if (which == COMMAND ? !post : !get) {
        status = MHD_HTTP_METHOD_NOT_ALLOWED, count = &counts->unknown;
        reason = "another method is expected: POST for /command, GET for all others";
    } else if (which == COMMAND && !accepts) {
        status = MHD_HTTP_FORBIDDEN, count = &counts->no_token;
        reason = "commands are off; start the run with --control";
    } else if ((which == COMMAND || (server->readers_need_token && which != PAGE_FILE)) &&
               !sb_web_allow_token(header_of(client, "X-Token"), server->token)) {
        status = MHD_HTTP_UNAUTHORIZED, count = &counts->no_token;
        reason = "the header X-Token must have the run's token";
    }
    if (!reason) return false;
    *result = sb_web_refuse(client, status, count, reason);
    return true;
}

/* The same for a body that is too large or not expected. */
static bool refuse_body(sb_web_client *client, resource which, enum MHD_Result *result)
{
    uint64_t *count = &client->server->counts.malformed;
    const char *length = header_of(client, MHD_HTTP_HEADER_CONTENT_LENGTH);
    const size_t most = which == COMMAND ? SB_WEB_COMMAND_MAX : 0;
    if (length && strtoull(length, NULL, 10) > most) {
        *result = sb_web_refuse(client, MHD_HTTP_CONTENT_TOO_LARGE, count, "the body is too large");
        return true;
    }
    if (which == COMMAND || !header_of(client, MHD_HTTP_HEADER_TRANSFER_ENCODING)) return false;
    *result = sb_web_refuse(client, MHD_HTTP_BAD_REQUEST, count, "no body is expected");
    return true;
}

/* ---- answers ---- */

static enum MHD_Result answer_status(sb_web_client *client)
{
    const sb_web_server *server = client->server;
    if (!sb_web_view_has_status(server->view))
        return sb_web_refuse(client, MHD_HTTP_SERVICE_UNAVAILABLE, NULL, "no run has sent its status yet");
    const sb_web_extra extra = {.commands = server->settings.command && server->token,
                                .plots = server->plots.texts[0],
                                .clients = server->counts.streams,
                                .refused = sb_web_server_refused(server)};
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    if (!stream) return MHD_NO;
    sb_web_view_write_status(server->view, &extra, sb_clock(), stream);
    if (fclose(stream) == 0) return sb_web_answer_json(client, MHD_HTTP_OK, text, size);
    free(text);
    return MHD_NO;
}

/* "GENERATION.ROW" in the URL: where a client continues. */
static void write_table(const sb_web_client *client, const char *key, const sb_history_table *table, FILE *stream)
{
    const char *text = MHD_lookup_connection_value(client->connection, MHD_GET_ARGUMENT_KIND, key);
    unsigned long long generation = 0, from = 0;
    char after = 0;
    const bool known = text && sscanf(text, "%19llu.%19llu%c", &generation, &from, &after) == 2;
    fprintf(stream, "\"%s\":", key);
    sb_history_write(table, known ? generation : 0, known ? (size_t)from : 0, SB_WEB_ROWS_MAX, stream);
}

static enum MHD_Result answer_rows(sb_web_client *client)
{
    const sb_web_view *view = client->server->view;
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    if (!stream) return MHD_NO;
    fputc('{', stream);
    write_table(client, "forces", sb_web_view_forces(view), stream);
    fputc(',', stream);
    write_table(client, "gauges", sb_web_view_gauges(view), stream);
    fputs("}\n", stream);
    if (fclose(stream) == 0) return sb_web_answer_json(client, MHD_HTTP_OK, text, size);
    free(text);
    return MHD_NO;
}

static enum MHD_Result answer_command(sb_web_client *client)
{
    sb_web_server *server = client->server;
    sb_error error = {0};
    const char *text = client->body ? client->body : "";
    int64_t id = 0;
    const sb_status status = server->settings.command(server->settings.user, text, client->body_size, &id, &error);
    if (status == SB_BAD_INPUT) return sb_web_refuse(client, MHD_HTTP_BAD_REQUEST, &server->counts.wrong, error.text);
    if (status != SB_OK) return sb_web_refuse(client, MHD_HTTP_SERVICE_UNAVAILABLE, NULL, error.text);
    server->counts.commands++;
    char *accepted = NULL;
    const int length = asprintf(&accepted, "{\"accepted\":true,\"id\":%" PRId64 "}\n", id);
    return length < 0 ? MHD_NO : sb_web_answer_json(client, MHD_HTTP_ACCEPTED, accepted, (size_t)length);
}

static enum MHD_Result answer(sb_web_client *client, resource which, const char *url)
{
    const sb_web_view *view = client->server->view;
    switch (which) {
    case PAGE_FILE:
        return sb_web_answer_file(client, sb_web_find(&client->server->plots, url));
    case STATUS:
        return answer_status(client);
    case SCENE:
        if (sb_web_view_scene(view)) return sb_web_answer_blob(client, sb_web_view_scene(view));
        return sb_web_refuse(client, MHD_HTTP_SERVICE_UNAVAILABLE, NULL, "the scene has not arrived yet");
    case FRAMES:
        return sb_web_answer_frames(client);
    case ROWS:
        return answer_rows(client);
    case COMMAND:
        return answer_command(client);
    case UNKNOWN:
        break;
    }
    return MHD_NO;
}

/* Adds a piece of a command's body; MHD_NO, which ends the connection, if it is too large. */
static enum MHD_Result take_body(sb_web_client *client, const char *bytes, size_t size)
{
    if (!client->body) client->body = sb_alloc(SB_WEB_COMMAND_MAX + 1, 1);
    if (!client->body || size > SB_WEB_COMMAND_MAX - client->body_size) {
        client->server->counts.malformed++;
        return MHD_NO;
    }
    memcpy(client->body + client->body_size, bytes, size);
    client->body_size += size;
    return MHD_YES;
}

enum MHD_Result sb_web_on_request(void *user, struct MHD_Connection *connection, const char *url, const char *method,
                                  const char *version, const char *body, size_t *body_size, void **request)
{
    (void)version;
    sb_web_server *server = user;
    sb_web_client *client = sb_web_client_of(connection);
    if (!client || client->answered) return MHD_NO;
    const resource which = find(server, url);
    if (!*request) {
        *request = client;
        client->understood = true;
        server->counts.requests++;
        enum MHD_Result result = MHD_YES;
        if (!refuse(client, which, method, &result)) refuse_body(client, which, &result);
        return result;
    }
    if (*body_size > 0) {
        const enum MHD_Result result = which == COMMAND ? take_body(client, body, *body_size) : MHD_NO;
        *body_size = 0;
        return result;
    }
    return answer(client, which, url);
}
