/* Joins a camera's pictures to a film, where ffmpeg is there. */
#ifndef SB_OUTPUT_VIDEO_H
#define SB_OUTPUT_VIDEO_H

#include "output/runlog.h"

/* frames/<camera>/%06d.png in `directory`, from 1 to `count`, becomes <camera>.mp4 at `rate` pictures per
   second. False, and a line in the log, when ffmpeg is absent or fails, or a picture is gone: a film that ends before
   it would pass for the whole. */
bool sb_video_write(const char *directory, const char *camera, uint64_t count, int rate, sb_runlog *log);

#endif
