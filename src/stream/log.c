#include "stream/log.h"

#include "base/file.h"
#include "base/memory.h"
#include "stream/decode.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/* A message: the mark, its number and time (64 bits), the lengths of channel and data (32 bits), channel, data. All
   numbers have their high byte first. */
static const unsigned char mark[4] = {0xed, 0xa1, 0xda, 0x01};
enum { HEAD = 28, TIME = 12, CHANNEL_LENGTH = 20, DATA_LENGTH = 24 };

struct sb_log {
    FILE *file;
    uint64_t left_out;
    size_t used; /* bytes in the window */
    size_t at;   /* the next message begins here */
    bool ended;  /* the window holds the rest of the file */
    unsigned char window[2 * (SB_STREAM_MESSAGE_MAX + HEAD + 64)];
};

static uint64_t number_at(const unsigned char *at, int bytes)
{
    uint64_t value = 0;
    for (int i = 0; i < bytes; i++) value = value << 8 | at[i];
    return value;
}

/* Moves the rest of the window to its start and fills it. */
static void fill(sb_log *log)
{
    memmove(log->window, log->window + log->at, log->used - log->at);
    log->used -= log->at;
    log->at = 0;
    const size_t got = fread(log->window + log->used, 1, sizeof log->window - log->used, log->file);
    log->used += got;
    log->ended = got == 0;
}

/* Whether the message at this place can be one of a run. Only its head is read. */
static bool is_plausible(const unsigned char *at)
{
    const uint64_t channel = number_at(at + CHANNEL_LENGTH, 4), data = number_at(at + DATA_LENGTH, 4);
    return memcmp(at, mark, sizeof mark) == 0 && channel >= 1 && channel < sizeof(sb_channel) &&
           data <= SB_STREAM_MESSAGE_MAX;
}

sb_status sb_log_open(const char *path, sb_log **log, sb_error *error)
{
    struct stat info;
    if (stat(path, &info) != 0) return sb_fail(error, SB_BAD_INPUT, "%.500s: cannot read: %s", path, strerror(errno));
    if (sb_file_kind(info.st_mode)) /* not opened: a FIFO would block */
        return sb_fail(error, SB_BAD_INPUT, "%.500s: is %s, expected a log of lcm-logger", path,
                       sb_file_kind(info.st_mode));
    sb_log *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "a log");
    made->file = fopen(path, "rb");
    if (!made->file) {
        sb_free(made);
        return sb_fail(error, SB_BAD_INPUT, "%.500s: cannot read: %s", path, strerror(errno));
    }
    fill(made);
    if (made->used < sizeof mark || memcmp(made->window, mark, sizeof mark) != 0) {
        sb_log_close(made);
        return sb_fail(error, SB_BAD_INPUT, "%.500s: does not begin as a log of lcm-logger", path);
    }
    *log = made;
    return SB_OK;
}

void sb_log_close(sb_log *log)
{
    if (!log) return;
    fclose(log->file);
    sb_free(log);
}

void sb_log_rewind(sb_log *log)
{
    rewind(log->file);
    log->used = log->at = 0;
    log->left_out = 0;
    log->ended = false;
}

static void set_event(const unsigned char *at, sb_log_event *event)
{
    const size_t channel = number_at(at + CHANNEL_LENGTH, 4);
    event->time = 1e-6 * (double)(int64_t)number_at(at + TIME, 8);
    memcpy(event->channel, at + HEAD, channel);
    event->channel[channel] = '\0';
    event->data = at + HEAD + channel;
    event->size = number_at(at + DATA_LENGTH, 4);
}

bool sb_log_next(sb_log *log, sb_log_event *event)
{
    for (;;) {
        /* The longest message fits into half of the window. */
        if (log->used - log->at < sizeof log->window / 2 && !log->ended) fill(log);
        const unsigned char *at = log->window + log->at;
        const size_t left = log->used - log->at;
        if (left < HEAD) {
            if (!log->ended) continue;
            log->left_out += left;
            log->at = log->used;
            return false;
        }
        if (is_plausible(at)) {
            const size_t length = HEAD + number_at(at + CHANNEL_LENGTH, 4) + number_at(at + DATA_LENGTH, 4);
            if (length <= left) {
                set_event(at, event);
                log->at += length;
                return true;
            }
        }
        log->at++;
        log->left_out++;
    }
}

uint64_t sb_log_left_out(const sb_log *log)
{
    return log->left_out;
}
