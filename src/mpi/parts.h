/* What the files of this folder share. */
#ifndef SB_MPI_PARTS_H
#define SB_MPI_PARTS_H

#include "mpi/world.h"

#include <mpi.h>

enum { SB_WORLD_HOST = 64, SB_WORLD_TEXT = 1024 };
enum { SB_WORLD_ALONE = 5 }; /* s for which the others may take to fail, too */

/* One rank as the others see it. */
typedef struct peer {
    char host[SB_WORLD_HOST];
    uint64_t processes, cores; /* the namespace of its process id; hash of the cores that it may use */
    int64_t process;
} peer;

/* A message outside of the orders. */
typedef struct note {
    enum { NOTE_FAILED, NOTE_SIGNAL, NOTE_ENDS } kind;
    int32_t rank, signal;
    uint64_t order; /* the number of the order that failed */
    char text[SB_WORLD_TEXT];
} note;

typedef struct world {
    sb_ranks ranks;
    MPI_Comm data, control; /* the transport's, and that of orders and notes: their messages never mix */
    double deadline;
    sb_world_fatal *fatal;
    peer *peers;
    bool crowded; /* more ranks than cores here */
    int place;    /* number of ranks before this one on its host */
    /* Of the exchange in progress: requests, and the rank of each. */
    MPI_Request *requests;
    int *partners, *done;
    size_t request_count, left, request_capacity, partner_capacity, done_capacity; /* left: not complete */
    /* Orders. */
    uint64_t order;     /* number of orders so far */
    uint64_t failed_at; /* the order that failed last in this rank; 0: none */
    char failure[SB_WORLD_TEXT];
    note sent[3];      /* the last of each kind */
    note heard;        /* of a failure in the present order */
    double heard_when; /* on the clock; 0: not heard */
    uint64_t told_at;  /* rank 0: the order in which other ranks failed last, and how many */
    int told;
    int signal; /* that another rank told */
    bool ends;  /* another rank has said why all end */
} world;

/* A wait in progress. A zero-initialised struct begins one. */
typedef struct wait {
    bool without_limit;   /* the deadline does not count */
    double begun, looked; /* on the clock */
    unsigned turns;
} wait;

/* Lets a moment pass between two looks at what is waited for, more of it the longer the wait is. `rank` is waited for;
   -1: all others. Ends the run when that rank or another one has ended, failed or passed the deadline. */
void sb_world_idle(world *w, wait *state, int rank);

/* Ends the run if MPI reports an error. */
void sb_world_check(world *w, int code, const char *what);
/* Ends the run with this line. */
_Noreturn void sb_world_end(const world *w, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* control.c: tells the others that this rank says why all end. */
void sb_world_tell_end(world *w);
/* control.c: waits until all ranks are at their end. */
void sb_world_gather_at_end(world *w);
/* control.c: receives the notes that have come. */
void sb_world_take_notes(world *w);

/* peers.c: lets all ranks know each other. SB_FAILED without memory. */
sb_status sb_world_meet(world *w, sb_error *error);
/* peers.c: a rank of this host whose process has ended, or -1. */
int sb_world_vanished(const world *w);

/* guard.c: ends this process with SB_FAILED, after it has printed the line if there is one, unless sb_world_unguard is
   called within so many seconds, rounded up, in which this process is not stopped. A guard replaces the one before. */
void sb_world_guard(double seconds, const char *line);
void sb_world_unguard(void);

extern const sb_transport sb_world_transport; /* transport.c */

/* file.c: the functions of files of the transport. */
int sb_world_open(sb_ranks *ranks, const char *path, void **file);
int sb_world_write_at(void *file, uint64_t at, const void *bytes, size_t size);
int sb_world_close(void *file);

#endif
