/* Draws the film and the stills of a run from its particle files. */
#ifndef SB_APP_RENDER_FILES_H
#define SB_APP_RENDER_FILES_H

#include "app/frames/consumers.h"
#include "output/particles/particle_format.h"

/* A warning of one line, without its end. */
typedef void (*sb_render_warning)(const char *text);

/* Draws a picture of each file, unless the scene has stills and no interval, and the scene's stills. A still shows the
   water at its time if a file has the step that passed it, else that of the nearest file, with a warning. quiet: no
   progress is printed. */
sb_status sb_render_files(const char *run, const sb_particle_format *format, const sb_particle_list *list,
                          sb_pictures *pictures, bool quiet, sb_render_warning warn, sb_error *error);

#endif
