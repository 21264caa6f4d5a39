/* Shows a run to browsers: the web server, and the messages of the run that come from the intake. */
#ifndef SB_LIVE_SERVE_H
#define SB_LIVE_SERVE_H

#include "control/receiver.h"
#include "live/options.h"

/* Serves until a signal comes or the run that started this process has ended. token NULL: none. receiver NULL: no run
   has started this process. Prints the address of the page. Returns the exit status. */
int sb_live_serve(const sb_live_options *options, const sb_token *token, sb_receiver *receiver);

#endif
