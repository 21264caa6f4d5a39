/* Sends the commands of the keys p, r and s to the run that is watched, and reports losses of its stream. */
#ifndef SB_MONITOR_STEER_H
#define SB_MONITOR_STEER_H

#include "options.h"
#include "view.h"

#include "control/message.h"
#include "control/target.h"
#include "stream/listen.h"
#include "stream/live.h"

typedef struct sb_steer {
    const char *run, *token_file; /* of the options; both NULL: no commands are sent */
    bool waiting;                 /* for the reply to the last command */
    int64_t run_id, counter;
    double sent, next, pause; /* s, sb_clock(): the first time; when it is sent again; and so long after that */
    unsigned char message[SB_COMMAND_MESSAGE_MAX];
    size_t size;
    sb_target target;       /* of the reports of losses; run_id 0: not read yet */
    double reported;        /* s, sb_clock(), of the last report */
    sb_live_counts counted; /* at that time */
} sb_steer;

/* Signs a command and sends it. followed: id of the run that is watched, negative if none is: that of a command with
   token_file; with `run`, the folder names the run. SB_BAD_INPUT, with what is missing, if it cannot be signed. */
sb_status sb_steer_send(sb_steer *steer, sb_listener *listener, sb_action action, int64_t followed, double now,
                        sb_error *error);

/* Sends a command again whose reply does not come. SB_FAILED if it has been given up. */
sb_status sb_steer_serve(sb_steer *steer, sb_listener *listener, double now, sb_error *error);

/* Reports to the run that is watched, every two seconds, which share of its messages was lost here: the run adapts the
   speed of its stream. Does nothing without the token. */
void sb_steer_report(sb_steer *steer, sb_listener *listener, int64_t followed, const sb_live_counts *count, double now);

/* Whether this is the reply that is waited for. */
bool sb_steer_reply(sb_steer *steer, const sb_reply_message *reply);

#endif
