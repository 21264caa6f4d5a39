/* Files of the depth-averaged model's water for ParaView: grid/NNNNNN.vti and their list grid.pvd. */
#ifndef SB_APP_GRID_FRAME_H
#define SB_APP_GRID_FRAME_H

#include "app/run/state.h"

/* Writes the next file, adds it to the list, and writes the list. */
sb_status sb_grid_frame_write(const char *directory, const sb_offshore *water, sb_particle_list *frames,
                              sb_error *error);

/* For a run with particles whose sea has a grid: writes a file if one is due. Does nothing for other runs. */
sb_status sb_grid_frame_of_run(run *r, sb_error *error);

/* The list in checkpoints of such a run. */
void sb_grid_frames_save(const run *r, sb_archive_out *out);
sb_status sb_grid_frames_load(run *r, sb_archive_in *in, sb_error *error);

#endif
