/* Opens LCM providers and names the channels. Internal to src/stream and its tests. */
#ifndef SB_STREAM_PROVIDER_H
#define SB_STREAM_PROVIDER_H

#include "base/status.h"
#include "stream/channel.h"

#include <lcm/lcm.h>

typedef struct sb_stream sb_stream;

/* The URL that the name stands for. NULL or empty: LCM_DEFAULT_URL if it is set, else LCM's default. */
const char *sb_provider_url(const char *url);

/* Calls lcm_create and puts the reason of a failure into *error instead of on stderr. SB_FAILED names the URL, LCM's
   message and the remedy, or states that there was no answer within five seconds. url as for sb_provider_url. The
   caller destroys the provider with lcm_destroy. */
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
