/* Reads and writes particles.pvd: the list of a run's particle files with their simulated times. */
#ifndef SB_OUTPUT_PVD_H
#define SB_OUTPUT_PVD_H

#include "base/status.h"

#include <stddef.h>

typedef struct sb_pvd_entry {
    double time;
    char file[256];
} sb_pvd_entry; /* s; path relative to the pvd's folder */

/* A zero-initialised list is empty. */
typedef struct sb_pvd {
    size_t count, capacity;
    sb_pvd_entry *entries;
} sb_pvd;

/* Adds one file and rewrites the list at `path`. On an error neither is done. */
sb_status sb_pvd_add(sb_pvd *pvd, const char *path, double time, const char *file, sb_error *error);

/* The two parts of sb_pvd_add: adds to the list only; writes the list. */
sb_status sb_pvd_note(sb_pvd *pvd, double time, const char *file, sb_error *error);
sb_status sb_pvd_write(const sb_pvd *pvd, const char *path, sb_error *error);

/* Reads a list that sb_pvd_write wrote; SB_BAD_INPUT if it is damaged. *pvd must be empty. */
sb_status sb_pvd_read(const char *path, sb_pvd *pvd, sb_error *error);

void sb_pvd_free(sb_pvd *pvd);

#endif
