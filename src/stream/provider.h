/* Opens LCM providers and names the channels. Internal to src/stream and its tests. */
#ifndef SB_STREAM_PROVIDER_H
#define SB_STREAM_PROVIDER_H

#include "base/status.h"

#include <lcm/lcm.h>

typedef struct sb_stream sb_stream;

enum { SB_CHANNEL_STATUS, SB_CHANNEL_FORCES, SB_CHANNEL_PARTICLES, SB_CHANNELS };

/* A channel name of at most 63 characters, which is LCM's limit, and the terminating zero. */
typedef char sb_channel[LCM_MAX_CHANNEL_NAME_LENGTH + 1];

/* Writes the names <prefix>_status, <prefix>_forces and <prefix>_particles; prefix NULL or empty: "shorebreak".
   SB_BAD_INPUT if a name is longer than LCM allows. */
sb_status sb_provider_channels(const char *prefix, sb_channel channels[SB_CHANNELS], sb_error *error);

/* Calls lcm_create and puts the reason of a failure into *error instead of on stderr. SB_FAILED names the URL, LCM's
   message and the remedy, or states that there was no answer within five seconds. url NULL or empty: LCM_DEFAULT_URL if
   it is set, else LCM's default. The caller destroys the provider with lcm_destroy. */
sb_status sb_provider_open(const char *url, lcm_t **lcm, sb_error *error);

/* Captures what the process writes to stderr between sb_stderr_hold and sb_stderr_release. sb_stderr_release returns it
   as one line, truncated to `size`. */
typedef struct sb_stderr_catch {
    int saved, caught; /* file descriptors, -1: nothing is captured */
} sb_stderr_catch;
sb_stderr_catch sb_stderr_hold(void);
void sb_stderr_release(sb_stderr_catch *hold, char *line, size_t size);

/* Returns the stream's LCM handle, for tests with providers that exist within one handle only (memq). */
lcm_t *sb_stream_provider(sb_stream *stream);

#endif
