/* Receives commands in the helper process: checks them and passes them to the run through a pipe. It reads no network
   itself: the caller gives it the bytes of messages and HTTP requests. */
#ifndef SB_CONTROL_RECEIVER_H
#define SB_CONTROL_RECEIVER_H

#include "control/command.h"
#include "control/token.h"

#include <stdbool.h>

typedef struct sb_receiver sb_receiver;

/* Messages and requests so far. */
typedef struct sb_received {
    uint64_t obeyed;    /* passed to the run */
    uint64_t malformed; /* not a command message, or a command with a fault */
    uint64_t foreign;   /* of another run, or not signed with this run's token */
    uint64_t replayed;  /* their counter is not above that of an earlier one */
    uint64_t flooded;   /* more than SB_RECEIVER_RATE per second, or the run does not read them */
} sb_received;

/* Commands that are passed per second, in the mean; at once, SB_RECEIVER_BURST. */
enum { SB_RECEIVER_RATE = 20, SB_RECEIVER_BURST = 40 };

/* Creates a receiver of the run with this id. token: NULL if commands are not allowed; no message is then obeyed, and
   the caller must not call sb_receiver_take_json. SIGPIPE must be ignored. pipe: the writing end, which is set to
   nonblocking and is not closed. counter: commands up to this counter are replayed ones. The receiver's state is shared
   with child processes that are made later by fork(): a child that replaces another one (stream/guard.h) continues with
   the same counters, and may be killed at any time. SB_FAILED without memory. */
sb_status sb_receiver_create(const sb_token *token, int64_t run_id, int64_t counter, int pipe, sb_receiver **receiver,
                             sb_error *error);
void sb_receiver_destroy(sb_receiver *receiver);

/* Takes a message of the channel <prefix>_command: checks its type, run id, signature and counter, then its JSON. What
   is refused is counted. SB_BAD_INPUT for a refused message. */
sb_status sb_receiver_take_message(sb_receiver *receiver, const void *message, size_t size, sb_error *error);

/* Takes a command from an HTTP request whose token the caller has checked (sb_token_matches). *id: that of the reply;
   one is drawn if the request has none. SB_BAD_INPUT with the fault, for the response; SB_FAILED if commands arrive too
   fast or the run does not take them. */
sb_status sb_receiver_take_json(sb_receiver *receiver, const char *text, size_t size, int64_t *id, sb_error *error);

/* Counts a request that was refused before it reached the receiver: without or with a wrong token, or from a foreign
   page. */
void sb_receiver_count_foreign(sb_receiver *receiver);
/* Counts a request that is malformed. */
void sb_receiver_count_malformed(sb_receiver *receiver);

/* Informs the run of the share of the stream that subscribers lost during the last second or so, 0 to 1. */
void sb_receiver_report_loss(sb_receiver *receiver, double lost);

/* Sends the counts to the run if they have changed, at most once per second, or at once if `last`. Call it every second
   or so, and at the end. False: the run has ended, or has closed the pipe. */
bool sb_receiver_serve(sb_receiver *receiver, bool last);

sb_received sb_receiver_count(const sb_receiver *receiver);

#endif
