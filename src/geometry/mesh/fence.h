/* Restricts the system calls of the child process that reads a mesh. Private to src/geometry/mesh*.c. */
#ifndef SB_GEOMETRY_MESH_FENCE_H
#define SB_GEOMETRY_MESH_FENCE_H

/* From this call on, the process can open files of `folder` for reading only (Landlock), and it cannot create
   sockets or processes or open files for writing (seccomp). A mechanism that the kernel does not have is left out.
   The limits of child.c and the names that files.c refuses apply in any case. */
void sb_mesh_fence(const char *folder);

#endif
