/* The files that the child opens for assimp: those of the mesh's folder, and no others. Private to
   src/geometry/mesh*.c. */
#ifndef SB_GEOMETRY_MESH_FILES_H
#define SB_GEOMETRY_MESH_FILES_H

#include "base/file.h"

#include <assimp/cfileio.h>

typedef struct sb_mesh_files {
    struct aiFileIO io;       /* for aiImportFileEx; first, since assimp hands back its address */
    const char *path;         /* of the mesh, as assimp is given it */
    int mesh;                 /* open descriptor of it */
    char folder[SB_PATH_MAX]; /* of the mesh, as its path begins */
    char root[SB_PATH_MAX];   /* the same without links */
    char refusal[400];        /* why the first file that was not opened is refused, or "" */
} sb_mesh_files;

/* SB_BAD_INPUT when the mesh's folder cannot be found. `path` stays the caller's. */
sb_status sb_mesh_files_begin(sb_mesh_files *files, const char *path, int mesh, sb_error *error);

#endif
