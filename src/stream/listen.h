/* Receives a run's messages, checks and decodes them, and passes them to callbacks. */
#ifndef SB_STREAM_LISTEN_H
#define SB_STREAM_LISTEN_H

#include "base/status.h"
#include "stream/decode.h"

typedef struct sb_listener sb_listener;

/* Callbacks, called from sb_listener_poll. A message is valid until the callback returns. Any callback may be NULL. */
typedef struct sb_listener_calls {
    void *user;
    void (*status)(void *user, const sb_status_message *message);
    void (*forces)(void *user, const sb_forces_message *message);
    void (*particles)(void *user, const sb_particles_message *message);
} sb_listener_calls;

/* Creates a listener. url NULL or empty: LCM_DEFAULT_URL if it is set, else the publisher's default multicast address
   with a large receive buffer; "file://LOG" replays a log of lcm-logger. prefix NULL or empty: "shorebreak". SB_FAILED,
   with the remedy, if the provider cannot be opened. */
sb_status sb_listener_create(const char *url, const char *prefix, const sb_listener_calls *calls,
                             sb_listener **listener, sb_error *error);
void sb_listener_destroy(sb_listener *listener);

/* Handles the messages that arrive within `seconds`; a signal ends the wait earlier. SB_INTERRUPTED if the source has
   ended (the end of a log, a lost server), SB_OK otherwise, also if no message arrived. */
sb_status sb_listener_poll(sb_listener *listener, double seconds);

/* Messages and bytes received, and the number of these messages that were refused as invalid. */
typedef struct sb_listener_counters {
    uint64_t messages, bytes, refused;
} sb_listener_counters;
sb_listener_counters sb_listener_count(const sb_listener *listener);

#endif
