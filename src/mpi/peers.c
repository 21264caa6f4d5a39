/* Which processes the ranks are, and on which hosts and cores. */
#include "base/hash.h"
#include "base/memory.h"
#include "mpi/parts.h"

#include <errno.h>
#include <sched.h>
#include <signal.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static peer describe(void)
{
    peer own = {.process = getpid()};
    struct stat names = {0};
    cpu_set_t cores;
    CPU_ZERO(&cores);
    gethostname(own.host, sizeof own.host - 1);
    if (stat("/proc/self/ns/pid", &names) == 0) own.processes = (uint64_t)names.st_ino;
    if (sched_getaffinity(0, sizeof cores, &cores) == 0) own.cores = sb_hash(0, &cores, sizeof cores);
    return own;
}

static int cores_of_this(void)
{
    cpu_set_t cores;
    CPU_ZERO(&cores);
    return sched_getaffinity(0, sizeof cores, &cores) == 0 ? CPU_COUNT(&cores) : 1;
}

static bool share_host(const peer *a, const peer *b)
{
    return strcmp(a->host, b->host) == 0 && a->processes == b->processes;
}

sb_status sb_world_meet(world *w, sb_error *error)
{
    const peer own = describe();
    w->peers = sb_alloc((size_t)w->ranks.count, sizeof *w->peers);
    if (!w->peers) return sb_fail_memory(error, "the ranks");
    w->peers[w->ranks.rank] = own; /* messages of the wait below name this rank */
    w->ranks.transport->gather(&w->ranks, &own, sizeof own, w->peers);
    w->place = 0;
    for (int r = 0; r < w->ranks.rank; r++) w->place += share_host(&own, &w->peers[r]);
    w->crowded = sb_world_sharing(&w->ranks) > cores_of_this();
    return SB_OK;
}

int sb_world_vanished(const world *w)
{
    const peer *own = &w->peers[w->ranks.rank];
    for (int r = 0; r < w->ranks.count; r++)
        if (r != w->ranks.rank && w->peers[r].process > 0 && share_host(own, &w->peers[r]) &&
            kill((pid_t)w->peers[r].process, 0) != 0 && errno == ESRCH)
            return r;
    return -1;
}

const char *sb_world_host(const sb_ranks *ranks, int rank)
{
    const world *w = ranks->context;
    return w->peers[rank].host;
}

int sb_world_hosts(const sb_ranks *ranks)
{
    const world *w = ranks->context;
    int hosts = 0;
    for (int r = 0; r < ranks->count; r++) {
        int before = 0;
        while (before < r && strcmp(w->peers[before].host, w->peers[r].host) != 0) before++;
        hosts += before == r;
    }
    return hosts;
}

int sb_world_sharing(const sb_ranks *ranks)
{
    const world *w = ranks->context;
    const peer *own = &w->peers[ranks->rank];
    int sharing = 0;
    for (int r = 0; r < ranks->count; r++)
        sharing += strcmp(own->host, w->peers[r].host) == 0 && own->cores == w->peers[r].cores;
    return sharing;
}
