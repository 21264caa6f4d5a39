/* Reads and writes particle files in pieces: each rank of a run writes the particles of its domain as one file
   particles/rank<R>/NNNNNN.vtp, and particles/NNNNNN.pvtp names the pieces for ParaView. The pieces one after another,
   by rank, have the order of a single file. */
#ifndef SB_OUTPUT_PVTP_H
#define SB_OUTPUT_PVTP_H

#include "base/file.h"
#include "frame/frame.h"

#define SB_PIECE_FOLDER "rank" /* followed by the number of the rank */

/* Whether a folder of this name has the pieces of a rank. */
bool sb_pvtp_is_piece_folder(const char *name);

/* Writes the path of a piece: folder is that of the particle files, number as in sb_particle_format.write.
   SB_BAD_INPUT if it is too long. */
sb_status sb_pvtp_piece_path(const char *folder, int rank, uint64_t number, char path[SB_PATH_MAX], sb_error *error);

/* Writes a rank's piece, and makes its folder below `folder`, which must exist. Completely or not at all. */
sb_status sb_pvtp_write_piece(const char *folder, int rank, const sb_frame *frame, uint64_t number, sb_error *error);

/* Writes the frame as the piece of rank 0, then the file at `path` that names the pieces of `ranks` ranks; the others
   have been written before. The file is written completely or not at all. */
sb_status sb_pvtp_write(const char *path, const sb_frame *frame, uint64_t number, int ranks, sb_error *error);

/* Reads all pieces into one new frame (one reference; call sb_frame_release), with the status and the bodies of the
   first one. SB_BAD_INPUT if the file or a piece is damaged, a piece lies elsewhere than in a folder of a rank beside
   the file, or is of another step than the first one. */
sb_status sb_pvtp_read(const char *path, sb_frame **frame, sb_error *error);

/* Removes the pieces of all ranks of files after `after`. A missing folder is not an error. */
sb_status sb_pvtp_remove_pieces(const char *folder, uint64_t after, sb_error *error);

#endif
