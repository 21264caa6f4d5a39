#include "output/video.h"

#include "output/tool.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

/* frames/<camera>/%06d.png with every % of the name doubled, as ffmpeg's pattern requires. */
static bool pattern_of(char out[SB_PATH_MAX], const char *camera)
{
    size_t n = (size_t)snprintf(out, SB_PATH_MAX, "frames/");
    for (; *camera && n < SB_PATH_MAX - 16; camera++) {
        out[n++] = *camera;
        if (*camera == '%') out[n++] = '%';
    }
    snprintf(out + n, SB_PATH_MAX - n, "/%%06d.png");
    return *camera == '\0';
}

static sb_status check_pictures(const char *directory, const char *camera, uint64_t count, sb_error *error)
{
    char path[SB_PATH_MAX], name[128];
    sb_status status = SB_OK;
    for (uint64_t number = 1; status == SB_OK && number <= count; number++) {
        snprintf(name, sizeof name, "frames/%.90s/%06llu.png", camera, (unsigned long long)number);
        status = sb_path_join(path, directory, name, error);
        if (status == SB_OK && access(path, F_OK) != 0)
            status = sb_fail(error, SB_FAILED, "not made: picture %llu of %llu is missing, expected %s",
                             (unsigned long long)number, (unsigned long long)count, name);
    }
    return status;
}

bool sb_video_write(const char *directory, const char *camera, uint64_t count, int rate, sb_runlog *log)
{
    char program[SB_PATH_MAX], pattern[SB_PATH_MAX], speed[16], part[SB_PATH_MAX];
    char from[SB_PATH_MAX], to[SB_PATH_MAX], name[SB_PATH_MAX];
    sb_error error = {0};
    if (!sb_tool_find("ffmpeg", program)) {
        sb_runlog_event(log, "skipped", "%s.mp4: ffmpeg was not found", camera);
        return false;
    }
    snprintf(speed, sizeof speed, "%d", rate);
    /* "file:" prevents that ffmpeg takes a name with a colon for a protocol. No camera's name begins with a dot. */
    snprintf(part, sizeof part, "file:.%s.part.mp4", camera);
    snprintf(name, sizeof name, "%s.mp4", camera);
    char *const arguments[] = {"ffmpeg", "-y", "-nostdin", "-loglevel", "error", "-framerate", speed, "-i", pattern,
                               "-c:v", "libx264", "-preset", "veryfast", "-crf", "20", "-pix_fmt", "yuv420p",
                               /* yuv420p requires even sides */
                               "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-movflags", "+faststart", part, NULL};
    sb_status status = SB_OK;
    if (!pattern_of(pattern, camera)) status = sb_fail(&error, SB_FAILED, "%.64s...: name too long", camera);
    if (status == SB_OK) status = check_pictures(directory, camera, count, &error);
    if (status == SB_OK) status = sb_path_join(from, directory, part + strlen("file:"), &error);
    if (status == SB_OK) status = sb_path_join(to, directory, name, &error);
    if (status == SB_OK) status = sb_file_replaceable(to, &error);
    if (status == SB_OK) unlink(from); /* an ffmpeg left by a killed run may still be writing to it */
    if (status == SB_OK) status = sb_tool_run(program, arguments, directory, &error);
    if (status == SB_OK && rename(from, to) != 0)
        status = sb_fail(&error, SB_FAILED, "%.500s: %s", to, strerror(errno));
    if (status != SB_OK) {
        unlink(from);
        sb_runlog_warning(log, "%s.mp4: %s", camera, error.text);
        return false;
    }
    sb_runlog_event(log, "video", "%s.mp4", camera);
    return true;
}
