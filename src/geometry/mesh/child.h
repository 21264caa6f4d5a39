/* The interface between the process that imports a mesh and the child process that reads the file. Private to
   src/geometry/mesh*.c.

   The child writes records to a pipe: a sb_mesh_record, then for MESH its vertices (three doubles each) and
   triangles (three uint32_t each), for FAILURE `vertices` bytes of text. END is the last record. */
#ifndef SB_GEOMETRY_MESH_CHILD_H
#define SB_GEOMETRY_MESH_CHILD_H

#include "geometry/mesh/mesh.h"

#include <sys/types.h>

enum { SB_MESH_RECORD_MAGIC = 0x53424d31 };
typedef enum sb_mesh_record_kind {
    SB_MESH_RECORD_MESH = 1,
    SB_MESH_RECORD_FAILURE,
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
    SB_MESH_LINK_STOPPED /* by a signal to the parent */
} sb_mesh_link_end;

/* The parent's view of the child and its pipe. */
typedef struct sb_mesh_link {
    const char *path; /* of the mesh file, used in messages */
    pid_t child;
    int pipe, watch; /* watch becomes readable when the child ends; -1 on old kernels */
    double deadline; /* s on sb_clock */
    uint64_t room;   /* number of bytes that the child may still send */
    sb_mesh_link_end end;
} sb_mesh_link;

/* Reads records up to END into *meshes, which are as those of sb_mesh_import. SB_BAD_INPUT for records that are
   invalid, exceed the room, or hold an invalid mesh. If from->end is not OK, the child ended early or timed out, and
   *error may have no text: the child's exit status then gives the reason. */
sb_status sb_mesh_receive(sb_mesh_link *from, sb_mesh **meshes, size_t *count, sb_error *error);

/* Limits of the child. */
typedef struct sb_mesh_limits {
    uint64_t memory;  /* bytes in addition to the parent's mapped memory */
    unsigned seconds; /* of processor time; the limit of elapsed time is five times as long */
} sb_mesh_limits;

/* sb_mesh_import with given limits, for tests. */
sb_status sb_mesh_import_within(const char *path, const sb_mesh_limits *limits, sb_mesh **meshes, size_t *count,
                                sb_error *error);

/* What a child reads, and how its bytes are received. */
typedef struct sb_mesh_task {
    const char *what; /* "mesh" or "grid", used in messages */
    /* Runs in the child: reads the open descriptor `file` and writes to the pipe. */
    void (*send)(const char *path, int file, int pipe, const void *wanted);
    /* Runs in the parent, under the rules of sb_mesh_receive. On failure it leaves nothing to free in *into. */
    sb_status (*receive)(sb_mesh_link *from, const void *wanted, void *into, sb_error *error);
    const void *wanted; /* passed to both */
    void *into;
} sb_mesh_task;

/* Runs the task on an open file in a child process with limits. SB_BAD_INPUT "file: what, expected" if the child
   crashes or takes too long, SB_INTERRUPTED by a signal, otherwise the status of task->receive. */
sb_status sb_mesh_child_run(const char *path, int file, const sb_mesh_limits *limits, const sb_mesh_task *task,
                            sb_error *error);

/* Receives exactly `size` bytes. Returns false if the child ended early or timed out: from->end says which. */
bool sb_mesh_link_receive(sb_mesh_link *from, void *bytes, size_t size);

/* Replaces invalid and control characters of a text that the child sent, so that it can be part of a message. */
void sb_mesh_link_clean(char *text);

/* Writes all bytes to the pipe. Returns false if the parent closed it. */
bool sb_mesh_link_send(int pipe, const void *bytes, size_t size);

/* Runs in the child: reads the file, open as descriptor `mesh`, and writes the records to the pipe. */
void sb_mesh_send_file(const char *path, int mesh, int pipe);

#endif
