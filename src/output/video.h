/* Joins a camera's pictures to a film, where ffmpeg is there. */
#ifndef SB_OUTPUT_VIDEO_H
#define SB_OUTPUT_VIDEO_H

#include "output/runlog.h"

/* frames/<camera>/%06d.png in `directory`, from 1 on, becomes <camera>.mp4 at `rate` pictures per
   second. False, and a line in the log, when ffmpeg is absent or fails. */
bool sb_video_write(const char *directory, const char *camera, int rate, sb_runlog *log);

#endif
