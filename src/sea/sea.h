/* Given water: surface, velocity and acceleration at a place and time, from theory, a table, a record or a
   depth-averaged model. (The name
   sb_sea is that of the scene's still water.) */
#ifndef SB_SEA_SEA_H
#define SB_SEA_SEA_H

#include "base/status.h"
#include "offshore/maps.h"
#include "offshore/start.h"
#include "scene/scene.h"

/* Constant after its creation, unless it has a grid; safe for any number of threads. */
typedef struct sb_sea_source sb_sea_source;

/* Layers of particles in a column at the start from which on the given water must not leave it dry. */
enum { SB_SEA_DEEP = 4 };

typedef struct sb_sea_point {
    double surface;         /* m, z of the water's surface; at or below the bed: dry */
    double velocity[3];     /* m/s */
    double acceleration[3]; /* m/s^2, d velocity / dt at the place */
} sb_sea_point;

/* Creates the source that the scene's block `sea` describes; without one it is still water. SB_BAD_INPUT names the file
   and line, or the key, of what cannot be used. The scene must outlive it. grid: the start of the depth-averaged model,
   which the source `offshore` needs and copies; NULL with other sources. */
sb_status sb_sea_create(const sb_scene *scene, const sb_offshore_start *grid, sb_sea_source **out, sb_error *error);
void sb_sea_destroy(sb_sea_source *sea);

/* The water at (x, y), m, and time t, s. bed: z of the bed there, m. The velocity is that at the height z; above the
   surface it is as at the surface. */
void sb_sea_at(const sb_sea_source *sea, double t, double x, double y, double z, double bed, sb_sea_point *out);

/* The depth-averaged model that gives the water; NULL with other sources. It is valid as long as the source. The caller
   steps it: sb_sea_at is then linear in time through its last two levels. */
sb_offshore *sb_sea_grid(sb_sea_source *sea);

/* The maps of that model since its start; the caller advances them with it. NULL: none. */
sb_offshore_maps *sb_sea_maps(sb_sea_source *sea);

/* The highest surface, m, and the highest speed, m/s, at any time: upper bounds that are reached, or nearly; with a
   grid those at the start. */
double sb_sea_greatest_surface(const sb_sea_source *sea);
double sb_sea_greatest_speed(const sb_sea_source *sea);

/* One line that says what is given, for `check`; valid as long as the source. */
const char *sb_sea_about(const sb_sea_source *sea);
/* One line about what can run but is probably not meant; NULL: nothing. */
const char *sb_sea_warning(const sb_sea_source *sea);

#endif
