/* The times at which a run draws: those of the film, and those of the stills. */
#ifndef SB_APP_PICTURE_TIMES_H
#define SB_APP_PICTURE_TIMES_H

#include "scene/scene.h"

typedef struct sb_picture_times {
    const sb_render_settings *render;
    double film;  /* s, of the next picture of the film */
    size_t still; /* the next one of render->stills */
} sb_picture_times;

/* The time of the next picture, s; infinite: there is none. */
double sb_picture_times_next(const sb_picture_times *times);

/* Returns what is drawn at the time that sb_picture_times_next returned, SB_FRAME_FILM and SB_FRAME_STILL, and goes on
   to the next one. */
unsigned sb_picture_times_take(sb_picture_times *times);

#endif
