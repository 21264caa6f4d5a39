/* The rows of the plots in pictures (render.insets): the run adds them while it measures, and the thread that draws
   reads those up to a picture's time. */
#ifndef SB_APP_INSETS_H
#define SB_APP_INSETS_H

#include "base/archive.h"
#include "frame/records.h"
#include "geometry/model/model.h"
#include "render/image/image.h"
#include "scene/scene.h"

#include <pthread.h>

/* One plot. The rows have two numbers, time (s) and value. */
typedef struct sb_inset_rows {
    size_t index; /* of the body in the model, or of the gauge in the scene */
    size_t count, capacity;
    double (*rows)[2];
} sb_inset_rows;

typedef struct sb_insets {
    const sb_scene *scene;
    size_t count;
    sb_inset_rows *plots;
    pthread_mutex_t lock; /* protects the rows */
} sb_insets;

/* Finds the bodies in the model. SB_BAD_INPUT: a body is not there, or has no rows in forces.csv. A scene without
   insets needs no memory. The scene must stay valid. Free *insets with sb_insets_free, also after a failure. */
sb_status sb_insets_begin(sb_insets *insets, const sb_scene *scene, const sb_model *model, sb_error *error);
void sb_insets_free(sb_insets *insets);

/* Adds the rows of a step. */
sb_status sb_insets_add(sb_insets *insets, const sb_measure_records *records, sb_error *error);

/* Reads the rows of a run from its tables. SB_BAD_INPUT: a table is missing or damaged. */
sb_status sb_insets_read(sb_insets *insets, const char *run, sb_error *error);

/* Write and read the rows within a section of an archive. */
void sb_insets_save(sb_insets *insets, sb_archive_out *out);
sb_status sb_insets_load(sb_insets *insets, sb_archive_in *in, sb_error *error);

/* Draws the plots into a picture with the rows up to `time`. Any thread may call it. */
sb_status sb_insets_draw(sb_insets *insets, double time, sb_image *image, sb_error *error);

#endif
