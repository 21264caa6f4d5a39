/* Reads and writes particles.pvd, ParaView's list of a run's particle files. */
#ifndef SB_OUTPUT_PVD_H
#define SB_OUTPUT_PVD_H

#include "output/particles/particle_list.h"

/* Writes the file completely or not at all. */
sb_status sb_pvd_write(const char *path, const sb_particle_list *list, sb_error *error);

/* Reads a list that sb_pvd_write wrote; SB_BAD_INPUT if it is damaged. *list must be empty. */
sb_status sb_pvd_read(const char *path, sb_particle_list *list, sb_error *error);

#endif
