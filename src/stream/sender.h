/* Sends encoded messages over LCM: numbers, counts and paces them. Internal to src/stream. All functions but
   sb_sender_count are for one thread. */
#ifndef SB_STREAM_SENDER_H
#define SB_STREAM_SENDER_H

#include "stream/provider.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Messages and bytes that LCM accepted, and messages that failed. */
typedef struct sb_stream_counters {
    uint64_t messages, bytes, errors;
} sb_stream_counters;

/* Bytes of a message at which its run id and its sequence number are, after fingerprint and version. */
enum { SB_RUN_ID_OFFSET = 12, SB_SEQUENCE_OFFSET = 20 };

typedef struct sb_sender {
    lcm_t *lcm;
    sb_channel channels[SB_CHANNELS];
    bool paced;  /* the provider loses messages that are sent faster than they are received */
    double next; /* sb_clock() before which the next paced message waits */
    _Atomic uint64_t messages, bytes, errors, sequence;
} sb_sender;

/* Opens the provider (sb_provider_open). */
sb_status sb_sender_open(const char *url, const char *prefix, sb_sender *sender, sb_error *error);
void sb_sender_close(sb_sender *sender);

/* Sends an encoded message of `size` bytes, with the next sequence number written into it; a negative size means that
   the encoder failed. The thread may be cancelled in the call, and only there: a TCP peer that has stopped reading
   blocks it without a limit. */
void sb_sender_send(sb_sender *sender, sb_channel_kind channel, unsigned char *buffer, int size);

/* Sends a message of a large set. Waits first, so that the set takes at least bytes / bytes_per_second; 0: no limit. */
void sb_sender_send_paced(sb_sender *sender, sb_channel_kind channel, unsigned char *buffer, int size,
                          double bytes_per_second);

/* May be called from any thread. */
sb_stream_counters sb_sender_count(const sb_sender *sender);

#endif
