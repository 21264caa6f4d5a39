/* Receives LCM in a process of its own, which forged packets may crash, and passes the messages to this one. */
#ifndef SB_LIVE_INTAKE_H
#define SB_LIVE_INTAKE_H

#include "control/receiver.h"
#include "live/options.h"
#include "stream/channel.h"

#include <sys/types.h>

/* Receives until the source ends or a signal comes. Commands go to the receiver, if it is not NULL; the other messages
   to `socket`, if it is not -1. Returns the exit status of a process. */
int sb_intake_work(const sb_live_options *options, sb_receiver *receiver, int socket);

typedef struct sb_intake {
    pid_t process;
    int socket; /* readable when messages wait; -1: the source has ended */
} sb_intake;

/* Starts the process. SB_FAILED if the system refuses. */
sb_status sb_intake_start(const sb_live_options *options, sb_receiver *receiver, sb_intake *intake, sb_error *error);

/* Passes messages that wait to `take`, at most `most` of them. Returns false when the source has ended; *code is then
   the exit status of the process. */
typedef void sb_intake_take(void *user, sb_channel_kind kind, const void *data, size_t size);
bool sb_intake_read(sb_intake *intake, int most, sb_intake_take *take, void *user, int *code);

/* Ends the process. */
void sb_intake_stop(sb_intake *intake);

#endif
