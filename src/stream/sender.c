#include "stream/sender.h"

#include "base/clock.h"

#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <string.h>

sb_status sb_sender_open(const char *url, const char *prefix, sb_sender *sender, sb_error *error)
{
    sb_status status = sb_channels_name(prefix, sender->channels, error);
    if (status == SB_OK) status = sb_provider_open(url, &sender->lcm, error);
    if (status == SB_OK) sender->paced = strncmp(sb_provider_url(url), "udp", 3) == 0;
    return status;
}

void sb_sender_close(sb_sender *sender)
{
    if (sender->lcm) lcm_destroy(sender->lcm);
    sender->lcm = NULL;
}

static void number(unsigned char *buffer, uint64_t sequence)
{
    const uint64_t word = __builtin_bswap64(sequence);
    memcpy(buffer + SB_SEQUENCE_OFFSET, &word, sizeof word);
}

void sb_sender_send(sb_sender *sender, sb_channel_kind channel, unsigned char *buffer, int size)
{
    /* A provider over TCP raises SIGPIPE when its peer has closed the connection. This must not end the run. */
    sigset_t pipe_signal, before;
    sigemptyset(&pipe_signal);
    sigaddset(&pipe_signal, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe_signal, &before);
    const bool whole = size >= SB_SEQUENCE_OFFSET + 8;
    if (whole) number(buffer, sender->sequence++);
    int state;
    pthread_setcancelstate(PTHREAD_CANCEL_ENABLE, &state);
    const bool sent = whole && lcm_publish(sender->lcm, sender->channels[channel], buffer, (unsigned)size) == 0;
    pthread_setcancelstate(state, NULL);
    if (!sent && !sigismember(&before, SIGPIPE)) sigtimedwait(&pipe_signal, NULL, &(struct timespec){0});
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (sent) {
        sender->messages++;
        sender->bytes += (uint64_t)size;
    } else {
        sender->errors++;
    }
}

static void wait_until(double time)
{
    const struct timespec end = {(time_t)time, (long)(1e9 * (time - floor(time)))};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &end, NULL) == EINTR) {
    }
}

void sb_sender_send_paced(sb_sender *sender, sb_channel_kind channel, unsigned char *buffer, int size,
                          double bytes_per_second)
{
    if (sender->paced && bytes_per_second > 0 && size > 0) {
        const double gap = size / bytes_per_second, now = sb_clock();
        if (sender->next > now) wait_until(sender->next);
        /* A wait that ended late is hardly made up for: receivers have room for a few messages only. */
        sender->next = fmax(sender->next, now - gap / 2) + gap;
    }
    sb_sender_send(sender, channel, buffer, size);
}

sb_stream_counters sb_sender_count(const sb_sender *sender)
{
    return (sb_stream_counters){.messages = sender->messages, .bytes = sender->bytes, .errors = sender->errors};
}
