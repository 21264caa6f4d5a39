#include "stream/live.h"

#include "base/memory.h"
#include "stream/pieces.h"

#include <string.h>

struct sb_live {
    sb_live_calls calls;
    sb_live_counts counts;
    bool has_run, has_status, ended; /* ended: the run's last status was "done" */
    int64_t run_id;
    double heard;         /* time of the run's last message */
    int64_t first, last;  /* sequence numbers of the run's messages */
    uint64_t received;    /* of the run, since `first` */
    uint64_t lost_before; /* in earlier runs */
    sb_status_message status;
    sb_assembly assembly;
    sb_pieces pieces;
    union { /* only one message is in use at a time */
        sb_status_message status;
        sb_forces_message forces;
        sb_gauges_message gauges;
        sb_frame_message part;
        sb_parity_message parity;
        sb_scene_piece_message piece;
        sb_reply_message reply;
    } message;
};

sb_live *sb_live_create(const sb_live_calls *calls)
{
    sb_live *live = sb_alloc(1, sizeof *live);
    if (live) live->calls = *calls;
    return live;
}

void sb_live_destroy(sb_live *live)
{
    if (!live) return;
    sb_assembly_free(&live->assembly);
    sb_pieces_free(&live->pieces);
    sb_free(live);
}

/* Sent since the first message and not received. Duplicates may make up for losses, never for more. */
static uint64_t lost_now(const sb_live *live)
{
    const uint64_t sent = live->has_run ? (uint64_t)(live->last - live->first) + 1 : 0;
    return sent > live->received ? sent - live->received : 0;
}

static void follow(sb_live *live, sb_message_head head)
{
    const bool restarted = live->has_run;
    live->lost_before += lost_now(live);
    live->has_run = true;
    live->ended = live->has_status = false;
    live->run_id = head.run_id;
    live->first = live->last = head.sequence;
    live->received = 0;
    sb_assembly_restart(&live->assembly);
    if (!restarted) return;
    live->counts.restarts++;
    if (live->calls.restarted) live->calls.restarted(live->calls.user, head.run_id);
}

/* Numbers that go back by so many begin again: a recorded run is replayed. Fewer are messages in another order. */
enum { BACK = 1000 };

/* Whether a valid message belongs to the run that is followed; begins to follow another run where that is due. */
static bool belongs(sb_live *live, sb_message_head head, double time)
{
    const bool same = live->has_run && head.run_id == live->run_id;
    const bool silent = live->has_run && time > live->heard + SB_LIVE_SILENCE;
    const bool again = same && (head.sequence < live->last - BACK ||
                                (head.sequence < live->last && (silent || (live->ended && head.sequence == 0))));
    if (live->has_run && !same && !live->ended && !silent) {
        live->counts.foreign++;
        return false;
    }
    if (!same || again) follow(live, head);
    live->heard = time;
    if (head.sequence < live->first) live->first = head.sequence;
    if (head.sequence > live->last) live->last = head.sequence;
    live->received++;
    return true;
}

static void take_status(sb_live *live)
{
    live->status = live->message.status;
    live->has_status = true;
    live->ended = live->status.state == SB_RUN_DONE;
    if (live->calls.status) live->calls.status(live->calls.user, &live->status);
}

static sb_status take_part(sb_live *live)
{
    bool complete = false;
    if (live->calls.part) live->calls.part(live->calls.user, &live->message.part);
    const sb_status status = sb_assembly_add(&live->assembly, &live->message.part, &complete);
    if (complete && live->calls.frame) live->calls.frame(live->calls.user, &live->assembly.newest);
    return status;
}

static void take_parity(sb_live *live)
{
    bool complete = false;
    sb_assembly_repair(&live->assembly, &live->message.parity, &complete);
    if (complete && live->calls.frame) live->calls.frame(live->calls.user, &live->assembly.newest);
}

static sb_status take_piece(sb_live *live)
{
    bool complete = false;
    const sb_status status = sb_pieces_add(&live->pieces, &live->message.piece, &complete);
    if (complete && live->calls.scene) live->calls.scene(live->calls.user, &live->pieces.scene);
    return status;
}

static sb_status decode(sb_live *live, sb_channel_kind kind, const void *data, size_t size)
{
    switch (kind) {
    case SB_CHANNEL_STATUS:
        return sb_stream_decode_status(data, size, &live->message.status, NULL);
    case SB_CHANNEL_FORCES:
        return sb_stream_decode_forces(data, size, &live->message.forces, NULL);
    case SB_CHANNEL_GAUGES:
        return sb_stream_decode_gauges(data, size, &live->message.gauges, NULL);
    case SB_CHANNEL_FRAME:
        return sb_stream_decode_frame(data, size, &live->message.part, NULL);
    case SB_CHANNEL_PARITY:
        return sb_stream_decode_parity(data, size, &live->message.parity, NULL);
    case SB_CHANNEL_SCENE:
        return sb_stream_decode_piece(data, size, &live->message.piece, NULL);
    case SB_CHANNEL_REPLY:
        return sb_stream_decode_reply(data, size, &live->message.reply, NULL);
    case SB_CHANNELS:
    case SB_CHANNEL_COMMAND:
        break;
    }
    return SB_BAD_INPUT;
}

static sb_status use(sb_live *live, sb_channel_kind kind)
{
    switch (kind) {
    case SB_CHANNEL_STATUS:
        take_status(live);
        break;
    case SB_CHANNEL_FORCES:
        if (live->calls.forces) live->calls.forces(live->calls.user, &live->message.forces);
        break;
    case SB_CHANNEL_GAUGES:
        if (live->calls.gauges) live->calls.gauges(live->calls.user, &live->message.gauges);
        break;
    case SB_CHANNEL_FRAME:
        return take_part(live);
    case SB_CHANNEL_PARITY:
        take_parity(live);
        break;
    case SB_CHANNEL_SCENE:
        return take_piece(live);
    case SB_CHANNEL_REPLY:
        if (live->calls.reply) live->calls.reply(live->calls.user, &live->message.reply);
        break;
    case SB_CHANNELS:
    case SB_CHANNEL_COMMAND:
        break;
    }
    return SB_OK;
}

sb_status sb_live_take(sb_live *live, sb_channel_kind kind, const void *data, size_t size, double time)
{
    live->counts.messages++;
    live->counts.bytes += size;
    sb_status status = decode(live, kind, data, size);
    /* Every message begins with its head, so that the member of the union does not matter. */
    if (status == SB_OK && belongs(live, live->message.status.head, time)) status = use(live, kind);
    live->counts.refused += status != SB_OK;
    return status;
}

const sb_live_scene *sb_live_get_scene(const sb_live *live)
{
    return live->pieces.has_scene ? &live->pieces.scene : NULL;
}

const sb_live_frame *sb_live_get_frame(const sb_live *live)
{
    return live->assembly.newest.part_count > 0 ? &live->assembly.newest : NULL;
}

const sb_status_message *sb_live_get_status(const sb_live *live)
{
    return live->has_status ? &live->status : NULL;
}

sb_live_counts sb_live_count(const sb_live *live)
{
    sb_live_counts counts = live->counts;
    counts.lost = live->lost_before + lost_now(live);
    counts.frames_complete = live->assembly.frames_complete;
    counts.frames_partial = live->assembly.frames_partial;
    counts.parts = live->assembly.parts;
    counts.parts_lost = live->assembly.parts_lost;
    counts.parts_repaired = live->assembly.parts_repaired;
    return counts;
}
