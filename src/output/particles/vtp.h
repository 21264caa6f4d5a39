/* Reads and writes particle files for ParaView: VTK XML PolyData, raw appended data, one vertex per particle. Points
   are absolute and Float64, so that they are precise even 1000 km from the origin. */
#ifndef SB_OUTPUT_VTP_H
#define SB_OUTPUT_VTP_H

#include "base/status.h"
#include "frame/frame.h"

/* Point data: velocity (m/s), pressure (Pa), id. Field data: TimeValue (s), origin, spacing (m),
   status, and name, displacement, force, moment of every body. `index` is the number of the
   file among the run's particle files; 0: it is not one of them. It differs from the frame's number, because other
   consumers have frames too. The file is written completely or not at all. */
sb_status sb_vtp_write(const char *path, const sb_frame *frame, uint64_t index, sb_error *error);

/* Reads a file that sb_vtp_write wrote into a new frame with its index (one reference; call sb_frame_release). A file
   of another kind, or one that is cut off or damaged, is SB_BAD_INPUT with the reason. */
sb_status sb_vtp_read(const char *path, sb_frame **frame, sb_error *error);

/* Writes the foam of a frame: velocity (m/s), life, id, kind (as in frame/foam.h). Field data: TimeValue (s). Reads it
   into a frame that has an origin and no foam. Completely or not at all, and SB_BAD_INPUT, as above. */
sb_status sb_vtp_write_foam(const char *path, const sb_frame *frame, sb_error *error);
sb_status sb_vtp_read_foam(const char *path, sb_frame *frame, sb_error *error);

/* Writes points only, for `shorebreak sample`: positions in m, unit normals (may be NULL), and the body
   each point belongs to, -1 for water (may be NULL). */
sb_status sb_vtp_write_points(const char *path, size_t count, const sb_vec3 *positions, const sb_vec3 *normals,
                              const int32_t *bodies, sb_error *error);

#endif
