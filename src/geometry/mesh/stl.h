/* Converts STL files of other programs to the form that assimp accepts. Private to src/geometry/mesh*.c. */
#ifndef SB_GEOMETRY_MESH_STL_H
#define SB_GEOMETRY_MESH_STL_H

#include <stdbool.h>
#include <stddef.h>

bool sb_mesh_is_stl(const char *name);

/* Provides the content to read in place of the STL file's own: *bytes, owned by the caller (sb_free), or NULL for
   the file's own bytes. *size is their number. Bytes after the triangles of a binary file are left out. In a text
   file keywords are converted to lower case, and solids without a facet are overwritten with blanks. If the file
   cannot be an STL file, `refusal` gives the cause. */
void sb_mesh_stl_content(int file, char **bytes, size_t *size, char *refusal, size_t room);

#endif
