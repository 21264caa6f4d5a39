/* Receives the messages of a run's channels from LCM. At least versions up to 1.3.1 of LCM can be crashed by forged
   packets: a program that listens to a network does so in a child process (guard.h). */
#ifndef SB_STREAM_LISTEN_H
#define SB_STREAM_LISTEN_H

#include "base/status.h"
#include "stream/channel.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct sb_listener sb_listener;

/* message is called from sb_listener_poll with the bytes as they arrived, for example to pass them to sb_live_take.
   time: s since 1970, of the reception or of the recording. */
typedef struct sb_listener_calls {
    void *user;
    void (*message)(void *user, sb_channel_kind kind, const void *data, size_t size, double time);
    bool commands;      /* the channel of commands is received as well */
    bool only_commands; /* no other channel is received */
} sb_listener_calls;

/* Creates a listener. url NULL or empty: LCM_DEFAULT_URL if it is set, else the publisher's default multicast address
   with a large receive buffer; "file://LOG" replays a log of lcm-logger. prefix NULL or empty: "shorebreak". SB_FAILED,
   with the remedy, if the provider cannot be opened. */
sb_status sb_listener_create(const char *url, const char *prefix, const sb_listener_calls *calls,
                             sb_listener **listener, sb_error *error);
void sb_listener_destroy(sb_listener *listener);

/* Sends a message on the channel of commands. SB_FAILED if LCM refuses it. */
sb_status sb_listener_send_command(sb_listener *listener, const void *message, size_t size, sb_error *error);

/* Handles the messages that arrive within `seconds`; a signal ends the wait earlier. SB_INTERRUPTED if the source has
   ended (the end of a log, a lost server), SB_OK otherwise, also if no message arrived. */
sb_status sb_listener_poll(sb_listener *listener, double seconds);

#endif
