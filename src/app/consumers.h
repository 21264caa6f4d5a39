/* The three consumers a run can have. Their states live in the run and outlive the threads. */
#ifndef SB_APP_CONSUMERS_H
#define SB_APP_CONSUMERS_H

#include "app/consumer.h"
#include "app/written.h"
#include "base/archive.h"
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
    uint64_t count, synced; /* files written; of these, on disk for certain */
} sb_recorder;
sb_consumer_work sb_recorder_work(sb_recorder *recorder);
/* While its thread is idle or not there: puts what was written on disk, all but what is gone; the list, within a
   section of an archive, and back, before the thread begins, which then removes files that the list does not know. */
sb_status sb_recorder_sync(sb_recorder *recorder, sb_gone *gone, sb_error *error);
void sb_recorder_save(const sb_recorder *recorder, sb_archive_out *out);
sb_status sb_recorder_load(sb_recorder *recorder, sb_archive_in *in, sb_error *error);

/* frames/<camera>/NNNNNN.png; camera < 0: all of them */
typedef struct sb_pictures {
    const sb_scene *scene;
    const sb_model *model;
    const char *directory; /* frames/ is made in it */
    int camera;
    sb_renderer *renderer;
    sb_image image;
    uint64_t count, synced; /* by camera: pictures drawn; of these, on disk for certain */
    bool cleared;           /* pictures beyond the count are gone */
} sb_pictures;
sb_consumer_work sb_pictures_work(sb_pictures *pictures);
/* While its thread is idle or not there: puts what was drawn on disk, all but what is gone. The thread
   removes pictures beyond its count: one that goes on when it begins, a new one when its first picture is there. */
sb_status sb_pictures_sync(sb_pictures *pictures, sb_gone *gone, sb_error *error);

/* LCM */
typedef struct sb_streamer {
    sb_stream *stream;
    sb_runlog *log;
    sb_stream_counters counters; /* up to the last frame; the first trouble is logged, once */
} sb_streamer;
sb_consumer_work sb_streamer_work(sb_streamer *streamer);

#endif
