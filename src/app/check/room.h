/* An estimate of the memory that a run needs, and whether that much is available. */
#ifndef SB_APP_ROOM_H
#define SB_APP_ROOM_H

#include "geometry/model/model.h"

/* Estimated number of ghost particles: evenly spread water within a support radius of periodic sides. */
double sb_room_ghosts(const sb_scene *scene, const sb_model *model);

/* Number of frames that may wait for a consumer: three, or fewer if frames are large. Beyond it the simulation waits,
   or the stream drops its oldest frame. */
size_t sb_room_waiting(size_t fluid_count);

/* Bytes that the graphics library uses before the first picture. */
size_t sb_room_graphics(void);

/* So many ranks of the run share this host's memory; 1 until it is called. */
void sb_room_share(int ranks);

/* Approximate peak memory of a run with the scene's outputs, bytes: of all ranks of this host. */
double sb_room_needed(const sb_scene *scene, const sb_model *model);

/* SB_FAILED, with both figures, when a run of this model needs more memory than is available. The model itself is in
   memory already, in each rank of this host. SB_OK when the system does not report how much is available. */
sb_status sb_room_check(const sb_scene *scene, const sb_model *model, sb_error *error);

#endif
