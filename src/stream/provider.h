/* LCM itself, for the files of this folder: opening a provider, naming the channels. */
#ifndef SB_STREAM_PROVIDER_H
#define SB_STREAM_PROVIDER_H

#include "base/status.h"

#include <lcm/lcm.h>

typedef struct sb_stream sb_stream;

enum { SB_CHANNEL_STATUS, SB_CHANNEL_FORCES, SB_CHANNEL_PARTICLES, SB_CHANNELS };

/* A channel name, LCM's limit of 63 characters and the zero. */
typedef char sb_channel[LCM_MAX_CHANNEL_NAME_LENGTH + 1];

/* <prefix>_status, <prefix>_forces, <prefix>_particles; prefix NULL or empty: "shorebreak".
   SB_BAD_INPUT when that is longer than LCM allows. */
sb_status sb_provider_channels(const char *prefix, sb_channel channels[SB_CHANNELS], sb_error *error);

/* lcm_create with the reason in *error instead of on stderr: SB_FAILED names the URL, LCM's words
   and the remedy; or that there was no answer within five seconds. url NULL or empty: LCM_DEFAULT_URL,
   else LCM's default. Destroy with lcm_destroy. */
sb_status sb_provider_open(const char *url, lcm_t **lcm, sb_error *error);

/* Between these two, what is written to stderr is caught (process-wide). sb_stderr_release gives it
   back as one line, cut to `size`. */
typedef struct sb_stderr_catch {
    int saved, caught; /* file descriptors, -1: nothing is caught */
} sb_stderr_catch;
sb_stderr_catch sb_stderr_hold(void);
void sb_stderr_release(sb_stderr_catch *hold, char *line, size_t size);

/* The stream's LCM handle, for tests of providers that live within one handle (memq). */
lcm_t *sb_stream_provider(sb_stream *stream);

#endif
