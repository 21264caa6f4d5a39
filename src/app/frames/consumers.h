/* The three consumers that a run can have. Their states are part of the run and outlive the threads. */
#ifndef SB_APP_CONSUMERS_H
#define SB_APP_CONSUMERS_H

#include "app/checkpoint/written.h"
#include "app/frames/consumer.h"
#include "app/frames/insets.h"
#include "base/archive.h"
#include "base/file.h"
#include "geometry/model/model.h"
#include "output/log/runlog.h"
#include "output/particles/particle_format.h"
#include "render/camera/cameras.h"
#include "render/image/image.h"
#include "render/renderer.h"
#include "render/water/reached.h"
#include "scene/scene.h"
#include "stream/stream.h"

/* Particle files and the list of them. */
typedef struct sb_recorder {
    const char *directory;
    const sb_particle_format *format;
    bool foam;    /* files of foam are written beside the particle files */
    int ranks;    /* above 1: that many write a piece each, and the frame has the particles of rank 0 */
    bool cleared; /* pieces beyond the count have been removed */
    sb_error
        failure; /* of the pieces of the other ranks, of the frame that is given next; set while the thread idles */
    sb_particle_list list;
    uint64_t count, synced; /* files written; of these, synced to disk */
} sb_recorder;
sb_consumer_work sb_recorder_work(sb_recorder *recorder);
/* Call these while the thread is idle or not started. sync syncs the written files to disk and counts those that were
   removed. save and load write and read the list of files within a section of an archive. Load the list before the
   thread starts: the thread then removes files that are not in the list. */
sb_status sb_recorder_sync(sb_recorder *recorder, sb_gone *gone, sb_error *error);
void sb_recorder_save(const sb_recorder *recorder, sb_archive_out *out);
sb_status sb_recorder_load(sb_recorder *recorder, sb_archive_in *in, sb_error *error);
/* Removes the pieces of files that the list does not name, once. On several ranks call it before they write pieces. */
sb_status sb_recorder_clear_pieces(sb_recorder *recorder, sb_error *error);
/* The number of the next file. */
uint64_t sb_recorder_next(const sb_recorder *recorder);

/* A folder of numbered pictures of each camera: <folder>/<camera>/NNNNNN.png. */
typedef struct sb_picture_set {
    const char *folder;
    uint64_t count, synced; /* pictures of each camera; of these, synced to disk */
    bool cleared;           /* pictures beyond the count have been removed */
} sb_picture_set;

/* Pictures of the film and stills. */
typedef struct sb_pictures {
    const sb_scene *scene;
    const sb_model *model;
    const char *directory;     /* the folder that contains those of the pictures */
    const bool *only;          /* by camera: whether it is drawn; not owned; NULL: all are */
    bool beside_simulation;    /* the thread that draws takes a low priority */
    sb_camera_motion *motions; /* by camera, owned */
    sb_poses poses;            /* for the renderers */
    sb_insets insets;
    sb_reached reached; /* the highest water of all pictures so far, of film and stills */
    sb_renderer *renderer;
    sb_image image;
    sb_picture_set film, stills;
} sb_pictures;
/* Allocates what pictures of this scene need, and checks the names of bodies in cameras and insets. SB_BAD_INPUT names
   a body that the model does not have. Free *pictures with sb_pictures_free, also after a failure. */
sb_status sb_pictures_begin(sb_pictures *pictures, const sb_scene *scene, const sb_model *model, const char *directory,
                            sb_error *error);
void sb_pictures_free(sb_pictures *pictures);
sb_consumer_work sb_pictures_work(sb_pictures *pictures);
/* Call these while the thread is idle or not started: they write and read the motions of cameras, the counts, the rows
   of insets, and the highest water if the scene shows it, within a section of an archive. */
void sb_pictures_save(sb_pictures *pictures, sb_archive_out *out);
sb_status sb_pictures_load(sb_pictures *pictures, sb_archive_in *in, sb_error *error);
/* Call this while the thread is idle or not started: syncs the pictures to disk and counts those that were removed. The
   thread removes pictures beyond its count: at its start when the run was resumed, else with its first picture. */
sb_status sb_pictures_sync(sb_pictures *pictures, sb_gone *gone, sb_error *error);

/* LCM */
typedef struct sb_streamer {
    sb_stream *stream; /* NULL: the run does not stream */
    sb_runlog *log;
    double time;      /* s, simulated; of the last frame */
    bool had_trouble; /* the first error is logged once */
} sb_streamer;
sb_consumer_work sb_streamer_work(sb_streamer *streamer);

#endif
