/* The formats in which meshes of the water are written; one row each. */
#ifndef SB_SURFACE_MESH_FORMAT_H
#define SB_SURFACE_MESH_FORMAT_H

#include "base/status.h"
#include "surface/water_mesh.h"

#include <stdio.h>

#define SB_MESH_MADE "shorebreak surface" /* how the text `made` begins, of meshes by any method */
/* Names the method, so that meshes of another one are not taken for those that a call would make. Whoever changes what
   sb_water_mesh_make finds changes it. */
#define SB_MESH_METHOD "method 2"

typedef struct sb_mesh_format {
    const char *name, *summary;
    const char *ending;         /* of the files' names, as ".ply" */
    const char *before, *after; /* what is around the text `made` at the start of a file */
    /* Writes everything behind these. time: s. Errors are those of the stream. */
    void (*write)(FILE *stream, const sb_water_mesh *mesh, double time);
} sb_mesh_format;

extern const sb_mesh_format sb_mesh_ply, sb_mesh_vtp;

/* All formats; the last entry is NULL. The first one is the default. */
extern const sb_mesh_format *const sb_mesh_formats[];

/* Writes the file completely or not at all. made: one line without "--" that says how the mesh was made. */
sb_status sb_mesh_write(const sb_mesh_format *format, const char *path, const sb_water_mesh *mesh, double time,
                        const char *made, sb_error *error);

typedef enum sb_mesh_there { SB_MESH_NONE, SB_MESH_SAME, SB_MESH_DIFFERENT, SB_MESH_FOREIGN } sb_mesh_there;

/* Whether there is a file at `path`, and whether it is a mesh that was made as `made` says, another mesh, or a file of
   other origin. */
sb_mesh_there sb_mesh_look(const sb_mesh_format *format, const char *path, const char *made);

#endif
