/* Orders of rank 0, agreement, and notes: messages that are sent when they are due, not in a fixed order. */
#include "base/clock.h"
#include "base/memory.h"
#include "mpi/parts.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

enum { NOTE_TAG = 1 };

/* An order with what the ranks need to know about the one before. */
typedef struct head {
    uint64_t number, failed_at; /* failed_at: the order that failed last in rank 0 */
} head;

static void complete(world *w, MPI_Request *request, int rank, wait state, const char *what)
{
    for (int done = 0;;) {
        sb_world_check(w, MPI_Test(request, &done, MPI_STATUS_IGNORE), what);
        if (done) return;
        sb_world_idle(w, &state, rank);
    }
}

static void spread(world *w, void *bytes, size_t size, int from, wait state)
{
    MPI_Request request;
    sb_world_check(w, MPI_Ibcast(bytes, (int)size, MPI_BYTE, from, w->control, &request), "order");
    complete(w, &request, from == w->ranks.rank ? -1 : from, state, "order");
}

void sb_world_gather_at_end(world *w)
{
    MPI_Request request;
    sb_world_check(w, MPI_Ibarrier(w->control, &request), "end");
    complete(w, &request, -1, (wait){.without_limit = w->ranks.rank > 0}, "end"); /* rank 0 may work alone for long */
}

/* ---- orders ---- */

void sb_world_order(sb_ranks *ranks, const void *order, size_t size)
{
    world *w = ranks->context;
    unsigned char bytes[sizeof(head) + 256] = {0};
    const head first = {++w->order, w->failed_at};
    w->heard_when = 0;
    memcpy(bytes, &first, sizeof first);
    memcpy(bytes + sizeof first, order, size);
    spread(w, bytes, sizeof first + size, 0, (wait){0});
}

void sb_world_await(sb_ranks *ranks, void *order, size_t size)
{
    world *w = ranks->context;
    unsigned char bytes[sizeof(head) + 256];
    head first;
    w->heard_when = 0;
    spread(w, bytes, sizeof first + size, 0, (wait){.without_limit = true}); /* rank 0 may work alone for long */
    memcpy(&first, bytes, sizeof first);
    memcpy(order, bytes + sizeof first, size);
    w->order = first.number;
    if (w->failed_at > 0 && w->failed_at + 1 == first.number && first.failed_at != w->failed_at)
        sb_world_end(w, "rank %d on %s: %s", ranks->rank, sb_world_host(ranks, ranks->rank), w->failure);
}

/* ---- agreement ---- */

sb_status sb_world_agree(sb_ranks *ranks, sb_status own, sb_error *error)
{
    world *w = ranks->context;
    int all[SB_RANKS_MAX], first = -1, failed = 0;
    const int mine = (int)own;
    MPI_Request request;
    sb_world_check(w, MPI_Iallgather(&mine, 1, MPI_INT, all, 1, MPI_INT, w->control, &request), "agreement");
    complete(w, &request, -1, (wait){0}, "agreement");
    for (int r = 0; r < ranks->count; r++) {
        failed += all[r] != SB_OK;
        if (first < 0 && all[r] != SB_OK) first = r;
    }
    if (first < 0) return SB_OK;
    sb_error shared = {0};
    if (first == ranks->rank && error) shared = *error;
    spread(w, shared.text, sizeof shared.text, first, (wait){0});
    const sb_status status = (sb_status)all[first];
    return failed == ranks->count
               ? sb_fail(error, status, "%s", shared.text)
               : sb_fail(error, status, "rank %d on %s: %.900s", first, sb_world_host(ranks, first), shared.text);
}

/* ---- notes ---- */

static void send_note(world *w, const note *one, int to)
{
    MPI_Request request;
    sb_world_check(w, MPI_Isend(one, sizeof *one, MPI_BYTE, to, NOTE_TAG, w->control, &request), "note");
    MPI_Request_free(&request); /* the note stays where it is; messages so short are copied at once */
}

/* In rank 0, after a failure: until all others have failed in the same order. Otherwise they still are within it, where
   the messages of the next order would meet those of this one. */
static void await_failures(world *w)
{
    static const struct timespec PAUSE = {.tv_nsec = 1000 * 1000}; /* ns */
    const double begun = sb_clock();
    for (sb_world_take_notes(w); w->told_at != w->order || w->told < w->ranks.count - 1; sb_world_take_notes(w)) {
        if (sb_clock() > begun + SB_WORLD_ALONE)
            sb_world_end(w, "rank 0 on %s: %s", sb_world_host(&w->ranks, 0), w->failure);
        nanosleep(&PAUSE, NULL);
    }
}

void sb_world_failed(sb_ranks *ranks, const sb_error *reason)
{
    world *w = ranks->context;
    snprintf(w->failure, sizeof w->failure, "%s", reason->text);
    w->failed_at = w->order;
    note *one = &w->sent[NOTE_FAILED];
    *one = (note){.kind = NOTE_FAILED, .rank = ranks->rank, .order = w->order};
    memcpy(one->text, w->failure, sizeof one->text);
    for (int r = 0; r < ranks->count; r++)
        if (r != ranks->rank && (ranks->rank == 0 || r == 0)) send_note(w, one, r);
    if (ranks->rank == 0) await_failures(w);
}

void sb_world_tell_signal(sb_ranks *ranks, int signal)
{
    world *w = ranks->context;
    note *one = &w->sent[NOTE_SIGNAL];
    *one = (note){.kind = NOTE_SIGNAL, .rank = ranks->rank, .signal = signal};
    send_note(w, one, 0);
}

void sb_world_tell_end(world *w)
{
    note *one = &w->sent[NOTE_ENDS];
    *one = (note){.kind = NOTE_ENDS, .rank = w->ranks.rank};
    for (int r = 0; r < w->ranks.count; r++)
        if (r != w->ranks.rank) send_note(w, one, r);
}

static void count_failure(world *w, uint64_t order)
{
    if (w->told_at != order) w->told = 0;
    w->told_at = order;
    w->told++;
}

static void take_note(world *w, int from)
{
    note one;
    sb_world_check(w, MPI_Recv(&one, sizeof one, MPI_BYTE, from, NOTE_TAG, w->control, MPI_STATUS_IGNORE), "note");
    w->ends |= one.kind == NOTE_ENDS;
    if (one.kind == NOTE_FAILED) count_failure(w, one.order);
    if (one.kind == NOTE_SIGNAL) {
        w->signal = one.signal;
    } else if (one.kind == NOTE_FAILED && one.order == w->order && w->failed_at != w->order) {
        w->heard = one;
        w->heard_when = sb_clock();
    }
}

void sb_world_take_notes(world *w)
{
    for (int there = 1; there;) {
        MPI_Status status;
        sb_world_check(w, MPI_Iprobe(MPI_ANY_SOURCE, NOTE_TAG, w->control, &there, &status), "notes");
        if (there) take_note(w, status.MPI_SOURCE);
    }
}

int sb_world_signal_told(sb_ranks *ranks)
{
    world *w = ranks->context;
    sb_world_take_notes(w);
    return w->signal;
}
