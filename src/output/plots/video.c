#include "output/plots/video.h"

#include "output/plots/tool.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

/* <folder>frames/<camera>/%06d.png with every % of the names doubled, as ffmpeg's pattern requires. */
static bool pattern_of(char out[SB_PATH_MAX], const char *folder, const char *camera)
{
    const char *const texts[] = {folder, "frames/", camera};
    size_t n = 0;
    for (size_t t = 0; t < sizeof texts / sizeof *texts; t++)
        for (const char *at = texts[t]; *at; at++) {
            if (n > SB_PATH_MAX - 16) return false;
            out[n++] = *at;
            if (*at == '%') out[n++] = '%';
        }
    snprintf(out + n, SB_PATH_MAX - n, "/%%06d.png");
    return true;
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

/* Runs ffmpeg, which writes `part`, "file:" and a name in the directory, and renames the result. */
static sb_status encode(const char *program, char *const *arguments, const char *directory, const char *part,
                        const char *name, sb_error *error)
{
    char from[SB_PATH_MAX], to[SB_PATH_MAX];
    sb_status status = sb_path_join(from, directory, part + strlen("file:"), error);
    if (status == SB_OK) status = sb_path_join(to, directory, name, error);
    if (status == SB_OK) status = sb_file_replaceable(to, error);
    if (status != SB_OK) return status;
    unlink(from); /* an ffmpeg left by a killed run may still be writing to it */
    status = sb_tool_run(program, arguments, directory, error);
    if (status == SB_OK && rename(from, to) != 0) status = sb_fail(error, SB_FAILED, "%.500s: %s", to, strerror(errno));
    if (status != SB_OK) unlink(from);
    return status;
}

bool sb_video_write(const char *directory, const char *camera, uint64_t count, int rate, sb_runlog *log)
{
    char program[SB_PATH_MAX], pattern[SB_PATH_MAX], speed[16], part[SB_PATH_MAX];
    char name[SB_PATH_MAX];
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
    if (!pattern_of(pattern, "", camera)) status = sb_fail(&error, SB_FAILED, "%.64s...: name too long", camera);
    if (status == SB_OK) status = check_pictures(directory, camera, count, &error);
    if (status == SB_OK) status = encode(program, arguments, directory, part, name, &error);
    if (status != SB_OK) {
        sb_runlog_warning(log, "%s.mp4: %s", camera, error.text);
        return false;
    }
    sb_runlog_event(log, "video", "%s.mp4", camera);
    return true;
}

/* [0:v]scale=...[v0];[1:v]scale=...[v1];[v0][v1]hstack=inputs=2:shortest=1 */
static void filter_of(char *out, size_t room, size_t count, int width, int height)
{
    size_t n = 0;
    for (size_t p = 0; p < count; p++)
        n += (size_t)snprintf(out + n, room - n,
                              "[%zu:v]scale=%d:%d:force_original_aspect_ratio=decrease,pad=%d:%d:(ow-iw)/2:(oh-ih)/2,"
                              "setsar=1[v%zu];",
                              p, width, height, width, height, p);
    for (size_t p = 0; p < count; p++) n += (size_t)snprintf(out + n, room - n, "[v%zu]", p);
    snprintf(out + n, room - n, "hstack=inputs=%zu:shortest=1", count);
}

sb_status sb_video_beside(const sb_video_part *parts, size_t count, const char *camera, int width, int height,
                          const char *directory, const char *name, sb_error *error)
{
    enum { ROOM = 1024 };
    char program[SB_PATH_MAX], patterns[SB_VIDEO_PARTS_MAX][SB_PATH_MAX], rates[SB_VIDEO_PARTS_MAX][32], filter[ROOM];
    char folder[SB_PATH_MAX], part[SB_PATH_MAX];
    char *arguments[6 + 4 * SB_VIDEO_PARTS_MAX + 16] = {"ffmpeg", "-y", "-nostdin", "-loglevel", "error"};
    size_t n = 5;
    if (!sb_tool_find("ffmpeg", program)) return sb_fail(error, SB_FAILED, "no film: ffmpeg was not found");
    if (count < 2 || count > SB_VIDEO_PARTS_MAX)
        return sb_fail(error, SB_FAILED, "no film: %zu runs: expected 2 to %d", count, SB_VIDEO_PARTS_MAX);
    for (size_t p = 0; p < count; p++) {
        snprintf(folder, sizeof folder, "%.*s/", SB_PATH_MAX - 2, parts[p].directory);
        if (!pattern_of(patterns[p], folder, camera))
            return sb_fail(error, SB_FAILED, "no film: %.64s...: name too long", parts[p].directory);
        snprintf(rates[p], sizeof rates[p], "%.9g", parts[p].rate);
        char *const input[] = {"-framerate", rates[p], "-i", patterns[p]};
        memcpy(arguments + n, input, sizeof input);
        n += 4;
    }
    filter_of(filter, sizeof filter, count, width, height);
    snprintf(part, sizeof part, "file:.part-%.200s", name);
    char *const output[] = {"-filter_complex", filter,    "-c:v",      "libx264",    "-preset", "medium", "-crf", "28",
                            "-pix_fmt",        "yuv420p", "-movflags", "+faststart", part,      NULL};
    memcpy(arguments + n, output, sizeof output);
    return encode(program, arguments, directory, part, name, error);
}
