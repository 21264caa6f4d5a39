/* Reads logs as lcm-logger writes them. LCM's own reader allocates and copies by sizes that it does not check. */
#ifndef SB_STREAM_LOG_H
#define SB_STREAM_LOG_H

#include "base/status.h"
#include "stream/channel.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct sb_log sb_log;

/* A message of the log. The data are valid until the next event is read. */
typedef struct sb_log_event {
    double time;        /* s since 1970, of the recording */
    sb_channel channel; /* any bytes but zero */
    const unsigned char *data;
    size_t size;
} sb_log_event;

/* Opens a log, a regular file. SB_BAD_INPUT names the path and the reason, also for a file that does not begin as a
   log. */
sb_status sb_log_open(const char *path, sb_log **log, sb_error *error);
void sb_log_close(sb_log *log);

/* Reads the next message. False: there is none. Messages that are larger than SB_STREAM_MESSAGE_MAX are left out, and
   so is damage: reading goes on at the next message that begins as one. A message that the end of the file cuts off, as
   lcm-logger leaves it while it runs, is left out. */
bool sb_log_next(sb_log *log, sb_log_event *event);
/* Goes back to the first message. */
void sb_log_rewind(sb_log *log);

/* Bytes that were left out since the log was opened or rewound. */
uint64_t sb_log_left_out(const sb_log *log);

#endif
