/* Measures whole pictures, from the frame to the PNG file. */
#include "base/clock.h"
#include "base/file.h"
#include "child.h"
#include "coast.h"
#include "process.h"
#include "render/image/image.h"
#include "render/renderer.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

/* A subject: the same picture with other numbers of particles, and without the dearest effects. */
typedef struct plan {
    const char *name;
    size_t particles;
    bool effects; /* shadows and occlusion */
} plan;

static const plan plans[] = {
    {SB_BENCH_PICTURE, 200000, true},
    {SB_BENCH_PICTURE_PLAIN, 200000, false},
    {SB_BENCH_PICTURE_LARGE, 2000000, true},
};

typedef struct times {
    sb_bench_samples first, next, processor;
} times;

/* Processor time of all threads, s. */
static double processor_time(void)
{
    struct timespec t;
    return clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t) == 0 ? (double)t.tv_sec + 1e-9 * (double)t.tv_nsec : 0;
}

static sb_status draw(sb_renderer *renderer, sb_frame *frame, const char *path, sb_image *image, sb_error *error)
{
    frame->status.time += 0.1; /* or what depends on earlier pictures would be left out */
    sb_status status = sb_renderer_draw(renderer, frame, 0, image, error);
    return status == SB_OK ? sb_png_write(path, image, error) : status;
}

/* The first picture contains the renderer's own preparations; one more that is not timed lets memory grow. */
static sb_status measure(const sb_scene *scene, const sb_model *model, sb_frame *frame, const char *path, int repeats,
                         times *t, sb_error *error)
{
    sb_renderer *renderer = NULL;
    sb_image image = {0};
    double start = sb_clock();
    sb_status status = sb_renderer_create(scene, model, &renderer, error);
    if (status == SB_OK) status = draw(renderer, frame, path, &image, error);
    sb_bench_sample(&t->first, sb_clock() - start);
    if (status == SB_OK) status = draw(renderer, frame, path, &image, error);
    for (int r = 0; r < repeats && status == SB_OK; r++) {
        const double processor = processor_time();
        start = sb_clock();
        status = draw(renderer, frame, path, &image, error);
        sb_bench_sample(&t->next, sb_clock() - start);
        sb_bench_sample(&t->processor, processor_time() - processor);
    }
    sb_image_free(&image);
    sb_renderer_destroy(renderer);
    return status;
}

static sb_status picture(const sb_bench_request *request, sb_bench_rows *rows, sb_error *error)
{
    const plan *p = request->of;
    const char *effects = p->effects ? "true" : "false";
    const sb_override overrides[] = {{"render.shadows", effects},
                                     {"render.occlusion", effects},
                                     {"render.width", request->quick ? "160" : "1280"},
                                     {"render.height", request->quick ? "90" : "720"}};
    char path[SB_PATH_MAX], threads[16], name[SB_BENCH_NAME], folder[] = "/tmp/shorebreak-bench-XXXXXX";
    sb_scene scene = {0};
    sb_model model = {0};
    sb_frame *frame = NULL;
    times t = {0};
    snprintf(threads, sizeof threads, "%d", request->threads);
    setenv("LP_NUM_THREADS", threads, 1);
    if (!mkdtemp(folder)) return sb_fail(error, SB_FAILED, "%s: cannot make a folder", folder);
    sb_status status = sb_path_join(path, request->assets, "benchmark/pictures.yaml", error);
    if (status == SB_OK) status = sb_scene_read(path, NULL, overrides, 4, &scene, error);
    if (status == SB_OK) status = sb_bench_coast_model(&scene, request->quick ? 2000 : 200000, &model, error);
    if (status == SB_OK)
        status = sb_bench_coast_frame(&scene, request->quick ? p->particles / 100 : p->particles, &frame, error);
    if (status == SB_OK) status = sb_path_join(path, folder, "picture.png", error);
    if (status == SB_OK) status = measure(&scene, &model, frame, path, request->repeats, &t, error);
    if (status == SB_OK) {
        snprintf(name, sizeof name, "%s%s", p->name, request->quick ? " but smaller" : "");
        sb_bench_add(rows, name, frame->count, request->threads, "first picture", "ms", &t.first, 1e3);
        sb_bench_add(rows, name, frame->count, request->threads, SB_BENCH_NEXT_PICTURE, "ms", &t.next, 1e3);
        sb_bench_add(rows, name, frame->count, request->threads, "processor time", "ms", &t.processor, 1e3);
    }
    sb_frame_release(frame);
    sb_model_free(&model);
    sb_scene_free(&scene);
    sb_folder_remove(folder, NULL);
    return status;
}

sb_status sb_bench_pictures(const sb_bench_request *request, sb_bench_rows *rows, sb_error *error)
{
    sb_bench_request one = *request;
    sb_status status = SB_OK;
    for (size_t p = 0; p < sizeof plans / sizeof plans[0] && status == SB_OK; p++) {
        one.of = &plans[p];
        status = sb_bench_in_child(picture, &one, rows, error);
    }
    return status;
}
