/* The transport of sb_ranks by messages of MPI. */
#include "base/memory.h"
#include "mpi/parts.h"

#include <string.h>

enum { PIECE = 1 << 30 }; /* bytes: the length of a message is an int */

static MPI_Request *add_request(world *w, int partner)
{
    const size_t n = w->request_count + 1;
    if (sb_grow((void **)&w->requests, &w->request_capacity, n, sizeof *w->requests) != 0 ||
        sb_grow((void **)&w->partners, &w->partner_capacity, n, sizeof *w->partners) != 0 ||
        sb_grow((void **)&w->done, &w->done_capacity, n, sizeof *w->done) != 0)
        sb_world_end(w, "rank %d: out of memory for messages", w->ranks.rank);
    w->partners[w->request_count] = partner;
    return &w->requests[w->request_count++];
}

/* Begins the messages of a parcel. Those between two ranks arrive in the order in which they were begun. */
static void begin(world *w, const sb_parcel *parcel, bool sends)
{
    char *bytes = parcel->bytes;
    for (size_t at = 0; at < parcel->size; at += PIECE) {
        const int length = (int)(parcel->size - at < PIECE ? parcel->size - at : PIECE);
        MPI_Request *request = add_request(w, parcel->rank);
        sb_world_check(w,
                       sends ? MPI_Isend(bytes + at, length, MPI_BYTE, parcel->rank, 0, w->data, request)
                             : MPI_Irecv(bytes + at, length, MPI_BYTE, parcel->rank, 0, w->data, request),
                       sends ? "sending" : "receiving");
    }
}

static void start(sb_ranks *ranks, const sb_parcel *send, size_t sends, const sb_parcel *receive, size_t receives)
{
    world *w = ranks->context;
    w->request_count = 0;
    for (size_t k = 0; k < receives; k++) begin(w, &receive[k], false);
    for (size_t k = 0; k < sends; k++) begin(w, &send[k], true);
    w->left = w->request_count;
}

/* Returns the number of requests that are complete now and were not before. */
static int look(world *w)
{
    int count = 0;
    sb_world_check(w, MPI_Testsome((int)w->request_count, w->requests, &count, w->done, MPI_STATUSES_IGNORE),
                   "exchange");
    if (count == MPI_UNDEFINED) count = (int)w->left; /* none is active */
    w->left -= (size_t)count;
    return count;
}

static void progress(sb_ranks *ranks)
{
    world *w = ranks->context;
    if (w->left > 0) look(w);
}

static bool arrived(sb_ranks *ranks)
{
    const world *w = ranks->context;
    progress(ranks);
    return w->left == 0;
}

/* A rank whose message is not complete. */
static int find_late(const world *w)
{
    for (size_t k = 0; k < w->request_count; k++)
        if (w->requests[k] != MPI_REQUEST_NULL) return w->partners[k];
    return -1;
}

static void finish(sb_ranks *ranks)
{
    world *w = ranks->context;
    wait state = {0};
    while (w->left > 0) {
        if (look(w) > 0)
            state = (wait){0}; /* the deadline counts from the last message that came */
        else
            sb_world_idle(w, &state, find_late(w));
    }
    w->request_count = 0;
}

static void gather(sb_ranks *ranks, const void *own, size_t size, void *all)
{
    world *w = ranks->context;
    MPI_Request request;
    wait state = {0};
    int done = 0;
    if (size > PIECE) sb_world_end(w, "rank %d: gathers %zu bytes, expected at most %d", ranks->rank, size, PIECE);
    sb_world_check(w, MPI_Iallgather(own, (int)size, MPI_BYTE, all, (int)size, MPI_BYTE, w->data, &request), "gather");
    for (;;) {
        sb_world_check(w, MPI_Test(&request, &done, MPI_STATUS_IGNORE), "gather");
        if (done) return;
        sb_world_idle(w, &state, -1);
    }
}

const sb_transport sb_world_transport = {.name = "mpi",
                                         .start = start,
                                         .finish = finish,
                                         .progress = progress,
                                         .arrived = arrived,
                                         .gather = gather,
                                         .open = sb_world_open,
                                         .write_at = sb_world_write_at,
                                         .close = sb_world_close};
