/* Reads the particle files of a run in order. */
#ifndef SB_VALIDATE_FRAMES_H
#define SB_VALIDATE_FRAMES_H

#include "case.h"
#include "frame/frame.h"

/* Calls visit for each frame with first <= time <= last. The run fails (case.h) if there is none, or one cannot be
   read. */
void sb_run_frames(const sb_case_run *run, double first, double last,
                   void (*visit)(void *context, const sb_frame *frame), void *context);

#endif
