/* The receiving end: hands a run's messages, checked and decoded, to callbacks. */
#ifndef SB_STREAM_LISTEN_H
#define SB_STREAM_LISTEN_H

#include "base/status.h"
#include "stream/decode.h"

typedef struct sb_listener sb_listener;

/* Called from sb_listener_poll; the message lives until the callback returns. Any may be NULL. */
typedef struct sb_listener_calls {
    void *user;
    void (*status)(void *user, const sb_status_message *message);
    void (*forces)(void *user, const sb_forces_message *message);
    void (*particles)(void *user, const sb_particles_message *message);
} sb_listener_calls;

/* url NULL or empty: LCM_DEFAULT_URL, else multicast as the publisher's default with a large
   receive buffer; "file://LOG" replays what lcm-logger wrote. prefix NULL or empty: "shorebreak".
   SB_FAILED with the remedy when there is no provider. */
sb_status sb_listener_create(const char *url, const char *prefix, const sb_listener_calls *calls,
                             sb_listener **listener, sb_error *error);
void sb_listener_destroy(sb_listener *listener);

/* Handles what arrives for `seconds`, less when a signal comes. SB_INTERRUPTED when the source has
   ended (a log at its end, a server gone), SB_OK otherwise, also when nothing came. */
sb_status sb_listener_poll(sb_listener *listener, double seconds);

/* messages and bytes arrived, and of these the messages that were refused. */
typedef struct sb_listener_counters {
    uint64_t messages, bytes, refused;
} sb_listener_counters;
sb_listener_counters sb_listener_count(const sb_listener *listener);

#endif
