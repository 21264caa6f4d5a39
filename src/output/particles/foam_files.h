/* Files of foam beside the particle files: foam/NNNNNN.vtp with the numbers and times of particles/NNNNNN.vtp, and
   their list foam.pvd. */
#ifndef SB_OUTPUT_FOAM_FILES_H
#define SB_OUTPUT_FOAM_FILES_H

#include "frame/frame.h"
#include "output/particles/particle_list.h"

#define SB_FOAM_FOLDER "foam"
#define SB_FOAM_LIST "foam"
#define SB_FOAM_ENDING ".vtp"

enum { SB_FOAM_NAME_MAX = 64 };

/* The path of a file below the run folder. */
void sb_foam_file(uint64_t number, char name[SB_FOAM_NAME_MAX]);

/* Makes the folder, removes files beyond `count`, and writes the list of as many files, or removes it if that is 0.
   particles: the list of particle files. */
sb_status sb_foam_files_open(const char *directory, const sb_particle_list *particles, uint64_t count, sb_error *error);

/* Writes the file of a frame, and the list as long as that of the particle files, which this one is the last of. */
sb_status sb_foam_files_write(const char *directory, const sb_frame *frame, uint64_t number, sb_error *error);
sb_status sb_foam_files_list(const char *directory, const sb_particle_list *particles, sb_error *error);

/* Reads the file of a number into a frame without foam. SB_BAD_INPUT if there is none, or if it is damaged. */
sb_status sb_foam_files_read(const char *directory, uint64_t number, sb_frame *frame, sb_error *error);

#endif
