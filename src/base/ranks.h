/* The processes or threads that compute one run together, and what they send to each other. A transport moves bytes;
   all else (sums, counts, maxima, gathers of unequal sizes) is made of its start, finish and gather here. All ranks
   call these functions in the same order. `ranks` may be NULL, or have one rank: then nothing is sent. */
#ifndef SB_BASE_RANKS_H
#define SB_BASE_RANKS_H

#include "base/exact.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { SB_RANKS_MAX = 1024 };

/* Bytes to another rank, or room for bytes from it. */
typedef struct sb_parcel {
    int rank;
    void *bytes;
    size_t size; /* > 0 */
} sb_parcel;

typedef struct sb_ranks sb_ranks;

/* A transport that waits longer than its deadline, or finds a rank dead, does not return. */
typedef struct sb_transport {
    const char *name; /* "threads", "mpi" */
    /* Begins to send and to receive, at most one parcel to each other rank and one from each. Both ends know the sizes.
       The memory of the parcels, but not the arrays, stays in use until `finish`. One at a time; a gather may come
       between. */
    void (*start)(sb_ranks *ranks, const sb_parcel *send, size_t sends, const sb_parcel *receive, size_t receives);
    void (*finish)(sb_ranks *ranks);
    /* Moves the messages between `start` and `finish` on, without waiting. By the thread that calls the others. NULL:
       they move on their own. */
    void (*progress)(sb_ranks *ranks);
    /* Moves them on, and returns whether what is to come has come. NULL: not known before `finish`. */
    bool (*arrived)(sb_ranks *ranks);
    /* all: count * size bytes, by rank; the own ones as well. */
    void (*gather)(sb_ranks *ranks, const void *own, size_t size, void *all);
    /* Files into which all ranks write, each on its own; NULL: none. `open` opens one that exists, write_at writes at a
       byte of it, and `close` returns when the bytes are on disk, and frees *file. Each returns 0 or errno. */
    int (*open)(sb_ranks *ranks, const char *path, void **file);
    int (*write_at)(void *file, uint64_t at, const void *bytes, size_t size);
    int (*close)(void *file);
} sb_transport;

struct sb_ranks {
    int rank, count; /* count <= SB_RANKS_MAX */
    const sb_transport *transport;
    void *context; /* of the transport */
    /* What this rank has sent and how long it has waited, s: counted here, not by the transport. A gather counts as one
       message to each other rank. */
    uint64_t bytes_sent, messages;
    double waited;
};

/* Whether there is more than one rank. */
static inline bool sb_ranks_several(const sb_ranks *ranks)
{
    return ranks && ranks->count > 1;
}

static inline int sb_ranks_own(const sb_ranks *ranks)
{
    return ranks ? ranks->rank : 0;
}

static inline int sb_ranks_count(const sb_ranks *ranks)
{
    return ranks ? ranks->count : 1;
}

/* The transport's functions, counted. Parcels of size 0, and with one rank all parcels, must be left out by the caller
   of sb_ranks_start at both ends. */
void sb_ranks_start(sb_ranks *ranks, const sb_parcel *send, size_t sends, const sb_parcel *receive, size_t receives);
void sb_ranks_finish(sb_ranks *ranks);
void sb_ranks_progress(sb_ranks *ranks);
void sb_ranks_gather(sb_ranks *ranks, const void *own, size_t size, void *all);

/* Sums, counts and largest values are merged in log2(number of ranks) exchanges of pairs of ranks, so that a rank sends
   and receives no more than so many of them. They must not be between sb_ranks_start and sb_ranks_finish. */

/* Adds up over all ranks, in place. */
void sb_ranks_sum(sb_ranks *ranks, sb_exact *values, size_t count);
/* The same, and returns the largest value of all ranks; count <= SB_RANKS_SUMS. */
enum { SB_RANKS_SUMS = 8 };
double sb_ranks_sum_and_largest(sb_ranks *ranks, sb_exact *values, size_t count, double value);

/* Sums and a largest value that are on their way to all ranks. Zero-initialised, none is. */
typedef struct sb_flying_sums {
    bool under_way;
    int round; /* the present one of the exchanges of pairs of ranks */
    size_t count;
    struct {
        double largest;
        sb_exact sum[SB_RANKS_SUMS];
    } own, others;
} sb_flying_sums;
/* sb_ranks_sum_and_largest in two parts, of several ranks: in between, no other function here may be called. `flying`
   may not move. */
void sb_ranks_sum_begin(sb_ranks *ranks, sb_flying_sums *flying, const sb_exact *values, size_t count, double value);
double sb_ranks_sum_end(sb_ranks *ranks, sb_flying_sums *flying, sb_exact *values);
/* Moves them on, and returns whether the end will not wait for other ranks, as far as that is known. */
bool sb_ranks_sum_arrived(sb_ranks *ranks, sb_flying_sums *flying);
void sb_ranks_add(sb_ranks *ranks, uint64_t *values, size_t count);
/* The largest value of all ranks; no value is NaN. */
double sb_ranks_largest(sb_ranks *ranks, double value);
/* Whether the flag is set in any rank. */
bool sb_ranks_any(sb_ranks *ranks, bool flag);

/* Gives each rank a number: to[r] is for rank r, and from[r] is what rank r has for this one. log2(number of ranks)
   exchanges, of half as many numbers as ranks each (Bruck's algorithm). */
void sb_ranks_swap_numbers(sb_ranks *ranks, const uint64_t *to, uint64_t *from);

/* Copies rank `from`'s bytes to all ranks. */
void sb_ranks_share(sb_ranks *ranks, int from, void *bytes, size_t size);
/* Sends each rank's `size` bytes to rank `to`, which puts them one after another, by rank, into `all`; sizes: of each
   rank, known to rank `to`. all, sizes: NULL elsewhere. */
void sb_ranks_collect(sb_ranks *ranks, int to, void *own, size_t size, void *all, const size_t *sizes);

/* Sends `size` own bytes to all other ranks, and puts the bytes of all, one rank after another, into `all`, which
   does not overlap with `own`; sizes: of each rank. */
void sb_ranks_spread(sb_ranks *ranks, void *own, void *all, const size_t *sizes);

/* The ranks do something to the same bytes, one rank after another: a rank waits for those of the rank before it, and
   then passes them on. After the end of all turns all ranks have the bytes of the last one. */
void sb_ranks_take_turn(sb_ranks *ranks, void *bytes, size_t size);
void sb_ranks_end_turn(sb_ranks *ranks, void *bytes, size_t size);

#endif
