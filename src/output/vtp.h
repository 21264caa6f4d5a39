/* Particle files for ParaView: VTK XML PolyData, raw appended, one vertex per particle. Points are
   Float64 and absolute: right in ParaView, and precise 1000 km from the origin. */
#ifndef SB_OUTPUT_VTP_H
#define SB_OUTPUT_VTP_H

#include "base/status.h"
#include "frame/frame.h"

/* Point data: velocity (m/s), pressure (Pa), id. Field data: TimeValue (s), origin, spacing (m),
   status, and name, displacement, force, moment of every body. `index` counts the run's particle files, 0: it is
   none of them; frames count those of other consumers, too. Written whole or not at all. */
sb_status sb_vtp_write(const char *path, const sb_frame *frame, uint64_t index, sb_error *error);

/* Reads what sb_vtp_write wrote into a new frame with its index (one reference, sb_frame_release it). A file that
   is not ours, cut off or damaged is SB_BAD_INPUT with what is wrong with it. */
sb_status sb_vtp_read(const char *path, sb_frame **frame, sb_error *error);

/* A bare cloud, for `shorebreak sample`: positions in m, unit normals (may be NULL), and the body
   each point belongs to, -1 for water (may be NULL). */
sb_status sb_vtp_write_points(const char *path, size_t count, const sb_vec3 *positions, const sb_vec3 *normals,
                              const int32_t *bodies, sb_error *error);

#endif
