/* The three consumers a run can have. Their states live in the run and outlive the threads. */
#ifndef SB_APP_CONSUMERS_H
#define SB_APP_CONSUMERS_H

#include "app/consumer.h"
#include "base/file.h"
#include "geometry/model.h"
#include "output/pvd.h"
#include "output/runlog.h"
#include "render/image.h"
#include "render/renderer.h"
#include "scene/scene.h"
#include "stream/stream.h"

/* particles/NNNNNN.vtp and particles.pvd */
typedef struct sb_recorder {
    const char *directory;
    sb_pvd pvd;
    uint64_t count;
} sb_recorder;
sb_consumer_work sb_recorder_work(sb_recorder *recorder);

/* frames/<camera>/NNNNNN.png; camera < 0: all of them */
typedef struct sb_pictures {
    const sb_scene *scene;
    const sb_model *model;
    const char *directory; /* frames/ is made in it */
    int camera;
    sb_renderer *renderer;
    sb_image image;
    uint64_t count;
} sb_pictures;
sb_consumer_work sb_pictures_work(sb_pictures *pictures);

/* LCM */
typedef struct sb_streamer {
    const sb_scene *scene;
    const char *run_name;
    sb_stream *stream;
    sb_runlog *log;
    sb_stream_counters counters; /* up to the last frame; the first trouble is logged, once */
} sb_streamer;
sb_consumer_work sb_streamer_work(sb_streamer *streamer);

#endif
