/* Commands to a run: they are read between steps from the pipe of the helper process, and obeyed in the run's thread.
   Private to src/app. */
#ifndef SB_APP_STEERING_H
#define SB_APP_STEERING_H

#include "app/run/state.h"

/* Starts the helper, if there is a stream and the scene allows commands, for which it makes the token, or the run is
   shown to browsers. A failure gives a warning, and the run goes on. */
void sb_steering_start(run *r);

/* Obeys the commands that have arrived. While the run is paused, it waits here, until it is resumed, may make a step or
   is stopped. Call it before each step, and during settling. */
void sb_steering_take(run *r);

/* steering_acts.c: obeys one command and replies. */
void sb_steering_obey(run *r, const sb_command *command);
/* steering_acts.c: pauses or resumes the run, also in its status. */
void sb_steering_set_paused(run *r, bool paused);

/* Removes the token: no more commands are obeyed. Call it before the stream ends. */
void sb_steering_end(run *r);

/* Ends the helper and logs how many commands were refused. A run that is shown to browsers calls it last, so that they
   see its end. May be called twice. */
void sb_steering_close(run *r);

#endif
