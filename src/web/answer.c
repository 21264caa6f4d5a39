/* Answers other than streams. */
#include "web/server_state.h"

#include "output/log/json.h"

#include <stdio.h>
#include <stdlib.h>

/* Only files of this server run, none of them is shown within another page, and no other page reads an answer. */
static const struct {
    const char *name, *value;
} headers[] = {
    {"Connection", "close"},
    {"Cache-Control", "no-store"},
    {"Content-Security-Policy", "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
                                "img-src 'self' data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
    {"X-Content-Type-Options", "nosniff"},
    {"X-Frame-Options", "DENY"},
    {"Referrer-Policy", "no-referrer"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
};

enum MHD_Result sb_web_queue(sb_web_client *client, unsigned status, const char *type, struct MHD_Response *response)
{
    if (!response) return MHD_NO;
    for (size_t h = 0; h < sizeof headers / sizeof *headers; h++)
        MHD_add_response_header(response, headers[h].name, headers[h].value);
    MHD_add_response_header(response, "Content-Type", type);
    if (status == MHD_HTTP_METHOD_NOT_ALLOWED) MHD_add_response_header(response, "Allow", "GET, HEAD, POST");
    if (status == MHD_HTTP_UNAUTHORIZED) MHD_add_response_header(response, "WWW-Authenticate", "X-Token");
    if (status == MHD_HTTP_SERVICE_UNAVAILABLE) MHD_add_response_header(response, "Retry-After", "1");
    client->answered = true;
    const enum MHD_Result result = MHD_queue_response(client->connection, status, response);
    MHD_destroy_response(response);
    return result;
}

enum MHD_Result sb_web_answer_json(sb_web_client *client, unsigned status, char *text, size_t size)
{
    if (!text) return MHD_NO;
    struct MHD_Response *response = MHD_create_response_from_buffer(size, text, MHD_RESPMEM_MUST_FREE);
    if (!response) free(text);
    return sb_web_queue(client, status, "application/json", response);
}

enum MHD_Result sb_web_refuse(sb_web_client *client, unsigned status, uint64_t *count, const char *reason)
{
    if (count) ++*count;
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    if (!stream) return MHD_NO;
    sb_json json;
    sb_json_begin(&json, stream, false);
    sb_json_open(&json, NULL, '{');
    sb_json_text(&json, "error", reason);
    sb_json_close(&json);
    if (fclose(stream) == 0) return sb_web_answer_json(client, status, text, size);
    free(text);
    return MHD_NO;
}

enum MHD_Result sb_web_answer_file(sb_web_client *client, const sb_web_file *file)
{
    /* libmicrohttpd takes the bytes as not constant but does not write to them. */
    const union {
        const unsigned char *constant;
        void *bytes;
    } content = {.constant = file->bytes};
    return sb_web_queue(client, MHD_HTTP_OK, file->type,
                        MHD_create_response_from_buffer(file->size, content.bytes, MHD_RESPMEM_PERSISTENT));
}

static ssize_t read_blob(void *user, uint64_t position, char *buffer, size_t size)
{
    const sb_web_blob *blob = user;
    const size_t left = blob->size - (size_t)position;
    if (left == 0) return MHD_CONTENT_READER_END_OF_STREAM;
    if (size > left) size = left;
    for (size_t i = 0; i < size; i++) buffer[i] = (char)blob->bytes[position + i];
    return (ssize_t)size;
}

static void release_blob(void *user)
{
    sb_web_blob_release(user);
}

enum MHD_Result sb_web_answer_blob(sb_web_client *client, sb_web_blob *blob)
{
    sb_web_blob_keep(blob);
    struct MHD_Response *response =
        MHD_create_response_from_callback(blob->size, SB_WEB_HEAD_MAX / 2, read_blob, blob, release_blob);
    if (!response) sb_web_blob_release(blob);
    return sb_web_queue(client, MHD_HTTP_OK, "application/octet-stream", response);
}
