/* Fuzzes a log of lcm-logger. The input is the file itself. Its messages are taken as a subscriber takes them, and a
   scene and frames that are accepted are turned into those of a renderer. */
#include "fuzz.h"

#include "app/frames/log_scene.h"
#include "scene/name.h"
#include "stream/log.h"

#include <math.h>
#include <string.h>

static void on_scene(void *user, const sb_live_scene *live)
{
    (void)user;
    sb_scene scene;
    sb_model model;
    sb_error error = {0};
    const sb_status status = sb_log_scene(live, &scene, &model, &error);
    if (status != SB_OK) {
        fuzz_check_refusal(status, &error);
        return;
    }
    FUZZ_CHECK(scene.render.camera_count > 0);
    for (size_t c = 0; c < scene.render.camera_count; c++) { /* it becomes the name of a folder */
        const char *name = scene.render.cameras[c].name;
        FUZZ_CHECK(*name && *name != '.' && name[strspn(name, sb_name_letters)] == '\0');
    }
    sb_scene_free(&scene);
    sb_model_free(&model);
}

static void on_frame(void *user, const sb_live_frame *live)
{
    const sb_live_scene *scene = sb_live_get_scene(*(sb_live **)user);
    sb_frame *frame = scene ? sb_log_frame(scene, live) : NULL;
    for (size_t i = 0; frame && i < frame->count; i++) FUZZ_CHECK(!isnan(frame->velocity[3 * i]));
    sb_frame_release(frame);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    sb_log *log;
    sb_log_event event;
    sb_live *live = NULL;
    sb_error error = {0};
    uint64_t taken = 0;
    const sb_live_calls calls = {.user = &live, .scene = on_scene, .frame = on_frame};
    const sb_status status = sb_log_open(fuzz_save("run.log", data, size), &log, &error);
    if (status != SB_OK) {
        fuzz_check_refusal(status, &error);
        return 0;
    }
    live = sb_live_create(&calls);
    FUZZ_CHECK(live);
    while (sb_log_next(log, &event)) {
        FUZZ_CHECK(memchr(event.channel, 0, sizeof event.channel) && event.size <= SB_STREAM_MESSAGE_MAX);
        taken += event.size + strlen(event.channel);
        sb_live_take(live, sb_channel_guess(event.channel), event.data, event.size, event.time);
    }
    FUZZ_CHECK(taken + sb_log_left_out(log) <= size);
    sb_live_destroy(live);
    sb_log_close(log);
    return 0;
}
