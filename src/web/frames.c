/* Streams of frames: GET /frames. A client whose record is sent gets the newest frame next, or waits for one. */
#include "web/server_state.h"

#include "base/clock.h"
#include "web/records.h"

#include <string.h>

/* The record to send next; NULL: none is due. */
static sb_web_blob *next_record(const sb_web_client *client, double now)
{
    const sb_web_view *view = client->server->view;
    sb_web_blob *frame = sb_web_view_frame(view);
    if (frame && sb_web_view_frame_number(view) != client->frame_number) return sb_web_blob_keep(frame);
    return now >= client->last + SB_WEB_ALIVE_SECONDS ? sb_web_record_alive(now) : NULL;
}

static bool take_record(sb_web_client *client)
{
    const double now = sb_clock();
    sb_web_blob *record = next_record(client, now);
    if (!record) return false;
    if (record == sb_web_view_frame(client->server->view)) {
        client->frame_number = sb_web_view_frame_number(client->server->view);
        client->server->counts.frames++;
    }
    client->record = record;
    client->sent = 0;
    client->last = now;
    return true;
}

static ssize_t read_frames(void *user, uint64_t position, char *buffer, size_t size)
{
    (void)position;
    sb_web_client *client = user;
    if (client->server->closing) return MHD_CONTENT_READER_END_OF_STREAM;
    if (!client->record && !take_record(client)) {
        client->suspended = true;
        MHD_suspend_connection(client->connection);
        return 0;
    }
    const size_t left = client->record->size - client->sent;
    if (size > left) size = left;
    memcpy(buffer, client->record->bytes + client->sent, size);
    client->sent += size;
    client->server->counts.bytes += size;
    if (client->sent == client->record->size) {
        sb_web_blob_release(client->record);
        client->record = NULL;
    }
    return (ssize_t)size;
}

enum MHD_Result sb_web_answer_frames(sb_web_client *client)
{
    sb_web_server *server = client->server;
    const size_t most = server->settings.clients - server->settings.clients / 4;
    if (server->counts.streams >= most)
        return sb_web_refuse(client, MHD_HTTP_SERVICE_UNAVAILABLE, &server->counts.unavailable,
                             "too many clients; try again later");
    client->streams = true;
    server->counts.streams++;
    return sb_web_queue(
        client, MHD_HTTP_OK, "application/octet-stream",
        MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, SB_WEB_HEAD_MAX / 2, read_frames, client, NULL));
}

void sb_web_resume_streams(sb_web_server *server, double now)
{
    const uint64_t newest = sb_web_view_frame_number(server->view);
    for (sb_web_client *client = server->clients; client; client = client->next) {
        const bool due = newest != client->frame_number || now >= client->last + SB_WEB_ALIVE_SECONDS;
        if (!client->suspended || !(due || server->closing)) continue;
        client->suspended = false;
        MHD_resume_connection(client->connection);
    }
}
