/* Opens files for assimp in the child process: those of the mesh's folder only. Private to src/geometry/mesh*.c. */
#ifndef SB_GEOMETRY_MESH_FILES_H
#define SB_GEOMETRY_MESH_FILES_H

#include "base/file.h"

#include <assimp/cfileio.h>

typedef struct sb_mesh_files {
    struct aiFileIO io;       /* for aiImportFileEx; first member, since assimp passes its address back */
    const char *path;         /* of the mesh, as passed to assimp */
    int mesh;                 /* open descriptor of it */
    char folder[SB_PATH_MAX]; /* of the mesh, as in its path */
    char root[SB_PATH_MAX];   /* the same without links */
    char refusal[400];        /* why the first refused file was refused, or "" */
} sb_mesh_files;

/* Initialises *files. SB_BAD_INPUT if the mesh's folder cannot be found. `path` must outlive *files. */
sb_status sb_mesh_files_begin(sb_mesh_files *files, const char *path, int mesh, sb_error *error);

#endif
