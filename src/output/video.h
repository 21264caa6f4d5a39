/* Joins a camera's pictures to a video, if ffmpeg is installed. */
#ifndef SB_OUTPUT_VIDEO_H
#define SB_OUTPUT_VIDEO_H

#include "output/runlog.h"

/* Writes <camera>.mp4 in `directory` from frames/<camera>/%06d.png, 1 to `count`, at `rate` pictures per second. False,
   and a line in the log, if ffmpeg is missing or fails, or if a picture is missing: an incomplete video could be
   mistaken for a complete one. */
bool sb_video_write(const char *directory, const char *camera, uint64_t count, int rate, sb_runlog *log);

#endif
