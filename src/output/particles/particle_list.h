/* The particle files of a run with their simulated times. */
#ifndef SB_OUTPUT_PARTICLE_LIST_H
#define SB_OUTPUT_PARTICLE_LIST_H

#include "base/status.h"

#include <stddef.h>

typedef struct sb_particle_entry {
    double time;    /* s */
    char file[256]; /* path relative to the run folder */
} sb_particle_entry;

/* A zero-initialised list is empty. */
typedef struct sb_particle_list {
    size_t count, capacity;
    sb_particle_entry *entries;
} sb_particle_list;

/* Adds one file. `file` need not end after `length` bytes. SB_BAD_INPUT for a name that has no place in an XML file. */
sb_status sb_particle_list_add(sb_particle_list *list, double time, const char *file, size_t length, sb_error *error);

void sb_particle_list_free(sb_particle_list *list);

#endif
