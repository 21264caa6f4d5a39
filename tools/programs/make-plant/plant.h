/* A coastal nuclear plant after the pattern of Fukushima Daiichi, made from a few heights.
   Metres; x from the paddle (0) to the hills, y along the shore, z = 0 is still water. */
#ifndef SB_MAKE_PLANT_PLANT_H
#define SB_MAKE_PLANT_PLANT_H

#include "base/status.h"
#include "geometry/mesh/mesh.h"

#include <stddef.h>

/* Extent of the terrain, including the 20 m of the paddle behind x = 0. */
#define SB_PLANT_X_MIN (-20.0)
#define SB_PLANT_X_MAX 1300.0
#define SB_PLANT_Y_MAX 1150.0
#define SB_PLANT_SHORE 800.0

/* Heights in m above still water unless said otherwise. */
typedef struct sb_plant_options {
    double grade;      /* level that the plant stands on */
    double quay;       /* deck of the quay in the harbour */
    double breakwater; /* crest of the breakwaters */
    double hill;       /* highest ground behind the plant */
    double reactor;    /* height of a reactor building over the grade */
    double stack;      /* height of an exhaust stack over the grade */
    double harbour;    /* depth of the dredged harbour, positive downwards */
} sb_plant_options;

/* One option as the command line shows it. */
typedef struct sb_plant_option {
    const char *name, *summary;
    size_t offset; /* of the double in sb_plant_options */
    double value, least, most;
} sb_plant_option;

/* All options with default and range, ended by a row without a name. */
extern const sb_plant_option sb_plant_option_table[];

sb_plant_options sb_plant_defaults(void);

/* SB_BAD_INPUT: a height is out of its range, or two heights contradict each other. */
sb_status sb_plant_check(const sb_plant_options *options, sb_error *error);

/* Height of the ground at (x, y), before any building. */
double sb_plant_ground(const sb_plant_options *options, double x, double y);

/* The ground as an open surface named "terrain" with upward normals, sampled from sb_plant_ground on a grid. */
sb_status sb_plant_terrain(const sb_plant_options *options, sb_mesh *mesh, sb_error *error);

/* Builds the terrain, then each building as a closed mesh with its name and outward normals. The caller frees *meshes
   with sb_plant_free. On error there is nothing to free. */
sb_status sb_plant_build(const sb_plant_options *options, sb_mesh **meshes, size_t *count, sb_error *error);
void sb_plant_free(sb_mesh *meshes, size_t count);

/* Writes Wavefront OBJ with one object per mesh and the options in its head, whole or not at all. */
sb_status sb_plant_write(const sb_plant_options *options, const sb_mesh *meshes, size_t count, const char *path,
                         sb_error *error);

/* Writes the same bodies with one file per part of the plant into `folder` (made if missing): terrain, breakwaters,
   waterfront, reactors, turbines, stacks, tanks, annexes. */
sb_status sb_plant_write_parts(const sb_plant_options *options, const sb_mesh *meshes, size_t count, const char *folder,
                               sb_error *error);

#endif
