/* What the child that reads a mesh may still ask the kernel for. Private to src/geometry/mesh*.c. */
#ifndef SB_GEOMETRY_MESH_FENCE_H
#define SB_GEOMETRY_MESH_FENCE_H

/* From now on this process opens files of `folder` to read them, and no others (Landlock); it makes no socket and no
   process, and opens nothing for writing (seccomp). What the kernel does not have is left out: the limits of
   mesh_child.c and the names that mesh_files.c refuses hold all the same. */
void sb_mesh_fence(const char *folder);

#endif
