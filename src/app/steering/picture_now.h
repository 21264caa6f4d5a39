/* Pictures that a command requests: RUN_DIR/pictures/<camera>-<step>.png. A thread of their own draws them, which
   starts with the first one; the frames of the run do not change. Private to src/app. */
#ifndef SB_APP_PICTURE_NOW_H
#define SB_APP_PICTURE_NOW_H

#include "app/run/state.h"

/* Makes a frame of the present state and begins to draw it from the camera, or from the eye, that the command names.
   The thread replies when the picture is written. SB_BAD_INPUT without such a camera, or while the picture before is
   drawn. */
sb_status sb_picture_now(run *r, const sb_command *command, sb_error *error);

/* Waits for the last picture. */
void sb_picture_now_end(run *r);

/* Frees what the thread used, if it has ended. */
void sb_picture_now_free(run *r);

#endif
