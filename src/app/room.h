/* What memory a run takes, and whether it is there. */
#ifndef SB_APP_ROOM_H
#define SB_APP_ROOM_H

#include "geometry/model.h"

/* Images of evenly spread water within a support radius of periodic sides. */
double sb_room_ghosts(const sb_scene *scene, const sb_model *model);

/* Frames that may wait for a consumer before the simulation does, or before the stream drops the oldest: three, fewer
   where they are large. */
size_t sb_room_waiting(size_t fluid_count);

/* Bytes that the graphics library takes before the first picture. */
size_t sb_room_graphics(void);

/* Bytes that a run takes at its peak, with the outputs that the scene asks for; about. */
double sb_room_needed(const sb_scene *scene, const sb_model *model);

/* SB_FAILED, with both figures, when a run of this model takes more memory than is free, the model itself being in
   memory already. SB_OK where nobody knows how much is free. */
sb_status sb_room_check(const sb_scene *scene, const sb_model *model, sb_error *error);

#endif
