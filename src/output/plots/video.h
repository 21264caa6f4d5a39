/* Joins a camera's pictures to a video, if ffmpeg is installed. */
#ifndef SB_OUTPUT_VIDEO_H
#define SB_OUTPUT_VIDEO_H

#include "output/log/runlog.h"

/* Writes <camera>.mp4 in `directory` from frames/<camera>/%06d.png, 1 to `count`, at `rate` pictures per second. False,
   and a line in the log, if ffmpeg is missing or fails, or if a picture is missing: an incomplete video could be
   mistaken for a complete one. */
bool sb_video_write(const char *directory, const char *camera, uint64_t count, int rate, sb_runlog *log);

/* One of the runs that are shown side by side. */
typedef struct sb_video_part {
    const char *directory; /* absolute */
    double rate;           /* pictures of it per second */
} sb_video_part;

/* Writes directory/name from frames/<camera>/%06d.png of each part, from picture 1 to the end of the shortest, each
   scaled into width x height px, which are even. SB_FAILED: ffmpeg is missing or fails. */
sb_status sb_video_beside(const sb_video_part *parts, size_t count, const char *camera, int width, int height,
                          const char *directory, const char *name, sb_error *error);
enum { SB_VIDEO_PARTS_MAX = 4 };

#endif
