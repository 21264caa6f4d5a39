/* The formats of particle files: particles/NNNNNN<ending>, one file per frame, and the list of them. A format is one
   row of a table, and what writes, reads, recognises and removes particle files uses the row. */
#ifndef SB_OUTPUT_PARTICLE_FORMAT_H
#define SB_OUTPUT_PARTICLE_FORMAT_H

#include "base/status.h"
#include "frame/frame.h"
#include "output/particles/particle_list.h"

#define SB_PARTICLE_FOLDER "particles"
#define SB_PARTICLE_LAST_GOOD "last-good" /* the state before a failure */
#define SB_PARTICLE_LIST "particles"

enum { SB_PARTICLE_NAME_MAX = 64 };

typedef struct sb_particle_format {
    const char *name, *summary;
    const char *ending; /* of the files' names, as ".vtp" */
    const char *start;  /* first bytes of every file, by which a run's file is recognised */
    /* Writes the file completely or not at all. number: of the file in the run, 1, 2, ...; 0: it is not one of them. */
    sb_status (*write)(const char *path, const sb_frame *frame, uint64_t number, sb_error *error);
    /* Reads a file into a new frame (one reference; call sb_frame_release). SB_BAD_INPUT if it is damaged. NULL: no
       reader; `shorebreak render` cannot draw such files. */
    sb_status (*read)(const char *path, sb_frame **frame, sb_error *error);
    /* The list of all files, particles<list_ending>, which is written again with each file. NULL: none. */
    const char *list_ending, *list_start;
    sb_status (*write_list)(const char *path, const sb_particle_list *list, sb_error *error);
    sb_status (*read_list)(const char *path, sb_particle_list *list, sb_error *error); /* NULL if read is */
} sb_particle_format;

/* All formats; the last entry is NULL. */
extern const sb_particle_format *const sb_particle_formats[];
/* Those that runs write: single files, and with output.particle_pieces pieces. */
extern const sb_particle_format sb_particles_vtp, sb_particles_pvtp;

/* The format of the particle files in a run folder: that whose list exists, or else the first one. */
const sb_particle_format *sb_particle_format_in(const char *folder);

/* The path of a file below the run folder; number as for `write`, 0: the last good state. */
void sb_particle_format_file(const sb_particle_format *format, uint64_t number, char name[SB_PARTICLE_NAME_MAX]);

/* The path of the list below the run folder; false if the format has none. */
bool sb_particle_format_list(const sb_particle_format *format, char name[SB_PARTICLE_NAME_MAX]);

/* Reads the list of the particle files in a run folder. SB_BAD_INPUT: the format cannot be read, or there are none. */
sb_status sb_particle_format_read_list(const sb_particle_format *format, const char *folder, sb_particle_list *list,
                                       sb_error *error);

#endif
