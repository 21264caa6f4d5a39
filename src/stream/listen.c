/* Subscribes to a run's channels. */
#include "stream/listen.h"

#include "base/clock.h"
#include "base/memory.h"
#include "stream/provider.h"

#include <ctype.h>
#include <errno.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>

/* Enough for the parts of a frame of 5 M particles. LCM's default queue of 30 messages silently drops the rest. */
enum { QUEUE_MESSAGES = 1000 };

struct sb_listener {
    lcm_t *lcm;
    sb_listener_calls calls;
    sb_channel channels[SB_CHANNELS], command;
    bool ended;
};

static void on_message(const lcm_recv_buf_t *received, const char *channel, void *user)
{
    const sb_listener *listener = user;
    const sb_channel_kind kind =
        strcmp(channel, listener->command) == 0 ? SB_CHANNEL_COMMAND : sb_channel_find(channel, listener->channels);
    listener->calls.message(listener->calls.user, kind, received->data, received->data_size,
                            1e-6 * (double)received->recv_utime);
}

/* LCM interprets channel names as regular expressions. Escapes a name so that it matches literally. */
static void escape(const char *channel, char pattern[2 * sizeof(sb_channel)])
{
    for (; *channel; channel++) {
        if ((unsigned char)*channel < 0x80 && !isalnum((unsigned char)*channel) && *channel != '_') *pattern++ = '\\';
        *pattern++ = *channel;
    }
    *pattern = 0;
}

static sb_status subscribe(sb_listener *listener, sb_error *error)
{
    /* The first subscription starts LCM's receiver and its test of the route, which print to stderr. */
    char reason[160];
    sb_stderr_catch hold = sb_stderr_hold();
    const char *refused = NULL;
    const sb_listener_calls *calls = &listener->calls;
    const int first = calls->only_commands ? SB_CHANNELS : 0;
    const int end = SB_CHANNELS + (calls->commands || calls->only_commands);
    for (int k = first; !refused && k < end; k++) {
        char pattern[2 * sizeof(sb_channel)];
        const char *name = k < SB_CHANNELS ? listener->channels[k] : listener->command;
        escape(name, pattern);
        lcm_subscription_t *made = lcm_subscribe(listener->lcm, pattern, on_message, listener);
        if (made)
            lcm_subscription_set_queue_capacity(made, QUEUE_MESSAGES);
        else
            refused = name;
    }
    sb_stderr_release(&hold, reason, sizeof reason);
    if (!refused) return SB_OK;
    return sb_fail(error, SB_FAILED, "LCM cannot subscribe to %s (%s)", refused, *reason ? reason : "no reason given");
}

sb_status sb_listener_create(const char *url, const char *prefix, const sb_listener_calls *calls,
                             sb_listener **listener, sb_error *error)
{
    const char *from_environment = getenv("LCM_DEFAULT_URL");
    if ((!url || !*url) && (!from_environment || !*from_environment))
        url = "udpm://239.255.76.67:7667?recv_buf_size=4000000";
    sb_listener *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "the listener");
    made->calls = *calls;
    sb_status status = sb_channels_name(prefix, made->channels, error);
    if (status == SB_OK) status = sb_channel_name_command(prefix, made->command, error);
    if (status == SB_OK) status = sb_provider_open(url, &made->lcm, error);
    if (status == SB_OK) status = subscribe(made, error);
    if (status != SB_OK) {
        sb_listener_destroy(made);
        return status;
    }
    *listener = made;
    return SB_OK;
}

void sb_listener_destroy(sb_listener *listener)
{
    if (listener && listener->lcm) lcm_destroy(listener->lcm);
    sb_free(listener);
}

sb_status sb_listener_send_command(sb_listener *listener, const void *message, size_t size, sb_error *error)
{
    if (lcm_publish(listener->lcm, listener->command, message, (unsigned)size) == 0) return SB_OK;
    return sb_fail(error, SB_FAILED, "LCM cannot send on %s", listener->command);
}

sb_status sb_listener_poll(sb_listener *listener, double seconds)
{
    double end = sb_clock() + seconds;
    for (double left = seconds; left > 0 && !listener->ended; left = end - sb_clock()) {
        struct pollfd ready = {.fd = lcm_get_fileno(listener->lcm), .events = POLLIN};
        int count = poll(&ready, 1, left > 1e6 ? 1000000000 : 1 + (int)(left * 1e3));
        if (count < 0 && errno == EINTR) break;
        if (count > 0 && lcm_handle(listener->lcm) != 0) listener->ended = true;
    }
    return listener->ended ? SB_INTERRUPTED : SB_OK;
}
