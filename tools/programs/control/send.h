/* Sends one command to a run and waits for its reply. */
#ifndef SB_CONTROL_SEND_H
#define SB_CONTROL_SEND_H

#include "control/target.h"
#include "stream/decode.h"

/* words: of the command, such as "step 10". Waits for the reply for at most so many seconds. SB_BAD_INPUT for a wrong
   command; SB_FAILED without a reply. */
sb_status sb_control_send(const sb_target *target, int count, char *const words[], double seconds,
                          sb_reply_message *reply, sb_error *error);

#endif
