/* Between the process that wants a mesh and the child that reads it. Private to
   src/geometry/mesh*.c.

   The child writes records to a pipe: a sb_mesh_record, then for MESH its vertices (three doubles
   each) and triangles (three uint32_t each), for TROUBLE `vertices` bytes of text. END is the last.
 */
#ifndef SB_GEOMETRY_MESH_CHILD_H
#define SB_GEOMETRY_MESH_CHILD_H

#include "geometry/mesh.h"

#include <sys/types.h>

enum { SB_MESH_RECORD_MAGIC = 0x53424d31 };
typedef enum sb_mesh_record_kind {
    SB_MESH_RECORD_MESH = 1,
    SB_MESH_RECORD_TROUBLE,
    SB_MESH_RECORD_END
} sb_mesh_record_kind;

typedef struct sb_mesh_record {
    uint32_t magic, kind;
    uint64_t vertices, triangles;
    char name[SB_NAME_MAX];
} sb_mesh_record;

typedef enum sb_mesh_link_end {
    SB_MESH_LINK_OK,
    SB_MESH_LINK_CLOSED,
    SB_MESH_LINK_LATE,
    SB_MESH_LINK_STOPPED /* by a signal to this process */
} sb_mesh_link_end;

/* The parent's end of the pipe. */
typedef struct sb_mesh_link {
    const char *path; /* of the mesh file, for messages */
    pid_t child;
    int pipe, watch; /* watch becomes readable when the child ends; -1 on old kernels */
    double deadline; /* s on sb_clock */
    uint64_t room;   /* bytes that the child may still send */
    sb_mesh_link_end end;
} sb_mesh_link;

/* Reads records up to END: *meshes as from sb_mesh_import. SB_BAD_INPUT for records that make no
   sense, exceed the room, or hold no sound mesh. When from->end is not OK the child ended early or
   is late, and *error may be without a text: how the child ended tells the reason. */
sb_status sb_mesh_receive(sb_mesh_link *from, sb_mesh **meshes, size_t *count, sb_error *error);

/* What the child may take. */
typedef struct sb_mesh_limits {
    uint64_t memory;  /* bytes, beyond what the parent has mapped already */
    unsigned seconds; /* of processor time; five times as much on the clock */
} sb_mesh_limits;

/* sb_mesh_import with limits other than its own, for tests. */
sb_status sb_mesh_import_within(const char *path, const sb_mesh_limits *limits, sb_mesh **meshes, size_t *count,
                                sb_error *error);

/* The child's part: reads the file, open as `mesh`, and writes the records to the pipe. */
void sb_mesh_send_file(const char *path, int mesh, int pipe);

#endif
