/* STL files as others write them, made into what assimp takes. Private to src/geometry/mesh*.c. */
#ifndef SB_GEOMETRY_MESH_STL_H
#define SB_GEOMETRY_MESH_STL_H

#include <stdbool.h>
#include <stddef.h>

bool sb_mesh_is_stl(const char *name);

/* What to give for the STL file in place of its own content: *bytes, owned by the caller (sb_free), or NULL for the
   file's own bytes, and their number in *size. Bytes after the triangles of a binary file are left out; in a text file
   words in capitals are made small, and solids without a facet blank. A file that cannot be one has the cause in
   `refusal`. */
void sb_mesh_stl_content(int file, char **bytes, size_t *size, char *refusal, size_t room);

#endif
