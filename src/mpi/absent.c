/* A build without MPI. */
#include "mpi/starter.h"
#include "mpi/world.h"

sb_status sb_world_join(double deadline, sb_world_fatal *fatal, sb_ranks **ranks, sb_error *error)
{
    (void)deadline;
    (void)fatal;
    *ranks = NULL;
    if (sb_world_started_count() <= 1) return SB_OK;
    return sb_fail(error, SB_FAILED,
                   "started as one of %d ranks, but this program was built without MPI: expected a build on a system "
                   "with libopenmpi-dev, or one process",
                   sb_world_started_count());
}

void sb_world_leave(sb_ranks *ranks)
{
    (void)ranks;
}

void sb_world_abort(sb_ranks *ranks)
{
    (void)ranks;
}

const char *sb_world_host(const sb_ranks *ranks, int rank)
{
    (void)ranks;
    (void)rank;
    return "this machine";
}

int sb_world_hosts(const sb_ranks *ranks)
{
    (void)ranks;
    return 1;
}

int sb_world_sharing(const sb_ranks *ranks)
{
    (void)ranks;
    return 1;
}

void sb_world_order(sb_ranks *ranks, const void *order, size_t size)
{
    (void)ranks;
    (void)order;
    (void)size;
}

void sb_world_await(sb_ranks *ranks, void *order, size_t size)
{
    (void)ranks;
    (void)order;
    (void)size;
}

sb_status sb_world_agree(sb_ranks *ranks, sb_status own, sb_error *error)
{
    (void)ranks;
    (void)error;
    return own;
}

void sb_world_failed(sb_ranks *ranks, const sb_error *reason)
{
    (void)ranks;
    (void)reason;
}

void sb_world_tell_signal(sb_ranks *ranks, int signal)
{
    (void)ranks;
    (void)signal;
}

int sb_world_signal_told(sb_ranks *ranks)
{
    (void)ranks;
    return 0;
}
