/* particles.pvd: the particle files of a run with their real times. */
#ifndef SB_OUTPUT_PVD_H
#define SB_OUTPUT_PVD_H

#include "base/status.h"

#include <stddef.h>

typedef struct sb_pvd_entry {
    double time;
    char file[256];
} sb_pvd_entry; /* s; beside the pvd */

/* Zero-initialised is empty. */
typedef struct sb_pvd {
    size_t count, capacity;
    sb_pvd_entry *entries;
} sb_pvd;

/* Adds one file (path relative to the pvd's folder) and rewrites the whole list at `path`; both or neither. */
sb_status sb_pvd_add(sb_pvd *pvd, const char *path, double time, const char *file, sb_error *error);

/* The two halves of it: into the list only; the list as it is. */
sb_status sb_pvd_note(sb_pvd *pvd, double time, const char *file, sb_error *error);
sb_status sb_pvd_write(const sb_pvd *pvd, const char *path, sb_error *error);

/* Reads a list as written above; SB_BAD_INPUT when it is damaged. *pvd is empty before. */
sb_status sb_pvd_read(const char *path, sb_pvd *pvd, sb_error *error);

void sb_pvd_free(sb_pvd *pvd);

#endif
