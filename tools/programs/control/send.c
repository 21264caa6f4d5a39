#include "send.h"

#include "base/clock.h"
#include "control/message.h"
#include "stream/listen.h"

#include <math.h>

/* A command that is lost on its way is sent again after the first time, then less often; the run obeys it once. */
static const double AGAIN_SECONDS = 0.5, AGAIN_MOST = 4;

typedef struct waiting {
    int64_t run_id, counter;
    bool replied;
    sb_reply_message reply;
} waiting;

static void on_message(void *user, sb_channel_kind kind, const void *data, size_t size, double time)
{
    waiting *w = user;
    sb_reply_message reply;
    (void)time;
    if (kind != SB_CHANNEL_REPLY || sb_stream_decode_reply(data, size, &reply, NULL) != SB_OK) return;
    if (reply.head.run_id != w->run_id || reply.counter != w->counter) return;
    w->reply = reply;
    w->replied = true;
}

sb_status sb_control_send(const sb_target *target, int count, char *const words[], double seconds,
                          sb_reply_message *reply, sb_error *error)
{
    char text[SB_COMMAND_JSON_MAX];
    unsigned char message[SB_COMMAND_MESSAGE_MAX];
    size_t size = 0;
    sb_listener *listener = NULL;
    waiting w = {.run_id = target->run_id, .counter = sb_target_counter()};
    const sb_listener_calls calls = {.user = &w, .message = on_message};
    sb_status status = sb_command_from_words(count, words, w.counter, text, error);
    if (status == SB_OK)
        status = sb_command_encode(&target->token, target->run_id, w.counter, text, message, &size, error);
    if (status == SB_OK) status = sb_listener_create(target->url, target->prefix, &calls, &listener, error);
    const double end = sb_clock() + seconds;
    double pause = AGAIN_SECONDS;
    for (double left = seconds; status == SB_OK && !w.replied && left > 0; left = end - sb_clock()) {
        status = sb_listener_send_command(listener, message, size, error);
        const double again = sb_clock() + fmin(left, pause);
        pause = fmin(2 * pause, AGAIN_MOST);
        while (status == SB_OK && !w.replied && sb_clock() < again)
            if (sb_listener_poll(listener, 0.02) != SB_OK)
                status = sb_fail(error, SB_FAILED, "%.200s: the stream has ended", target->url);
    }
    sb_listener_destroy(listener);
    if (status == SB_OK && !w.replied)
        return sb_fail(error, SB_FAILED, "no reply within %g s, expected one after the step that the run makes",
                       seconds);
    if (status == SB_OK) *reply = w.reply;
    return status;
}
