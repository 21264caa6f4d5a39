#include "base/ranks_threads.h"

#include "base/clock.h"
#include "base/memory.h"
#include "base/random.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double DEADLINE = 60; /* s, of one wait */
enum { LONGEST_DELAY = 200 };      /* microseconds */

/* What one rank has for another; the bytes are the sender's. */
typedef struct slot {
    const void *bytes; /* NULL: nothing */
    size_t size;
} slot;

typedef struct team {
    int count;
    uint64_t disturb;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    bool released;    /* the threads may begin */
    slot *slots;      /* count * count: [to * count + from] */
    const void **own; /* count: of the present gather */
    size_t *own_size; /* count */
    int arrived;      /* ranks at the present barrier */
    uint64_t round;   /* barriers passed */
    sb_rank_work *work;
    void *context;
} team;

/* One rank's part of the team, and its parcels under way. */
typedef struct member {
    team *team;
    sb_ranks ranks;
    pthread_t thread;
    uint64_t drawn; /* random numbers so far */
    sb_parcel send[SB_RANKS_MAX], receive[SB_RANKS_MAX];
    size_t sends, posted, receives;
} member;

/* A random integer below n. */
static size_t draw(member *m, size_t n)
{
    const uint64_t seed = m->team->disturb + (uint64_t)m->ranks.rank * 0x9e3779b97f4a7c15u;
    return (size_t)(sb_random(seed, m->drawn++) * (double)n);
}

/* Lets other threads go first now and then, and rarely for long: sleeping takes most of a test's time. */
static void delay(member *m)
{
    if (!m->team->disturb) return;
    if (draw(m, 4) == 0) sched_yield();
    if (draw(m, 128) == 0) usleep((useconds_t)draw(m, LONGEST_DELAY));
}

static void shuffle(member *m, sb_parcel *parcel, size_t count)
{
    for (size_t k = count; m->team->disturb && k > 1; k--) {
        const size_t other = draw(m, k);
        const sb_parcel last = parcel[k - 1];
        parcel[k - 1] = parcel[other], parcel[other] = last;
    }
}

/* Waits for a change; the lock is held. */
static void wait_for_change(team *t)
{
    const struct timespec end = sb_clock_after(DEADLINE);
    if (pthread_cond_timedwait(&t->changed, &t->lock, &end) != 0) abort();
}

static slot *slot_of(const team *t, int from, int to)
{
    return &t->slots[to * t->count + from];
}

/* Posts the parcels up to `end`. Their slots are empty: the last `finish` has waited for it. */
static void post(member *m, size_t end)
{
    team *t = m->team;
    for (; m->posted < end; m->posted++) {
        const sb_parcel *p = &m->send[m->posted];
        delay(m);
        pthread_mutex_lock(&t->lock);
        *slot_of(t, m->ranks.rank, p->rank) = (slot){p->bytes, p->size};
        pthread_cond_broadcast(&t->changed);
        pthread_mutex_unlock(&t->lock);
    }
}

static void start(sb_ranks *ranks, const sb_parcel *send, size_t sends, const sb_parcel *receive, size_t receives)
{
    member *m = ranks->context;
    if (sends > 0) memcpy(m->send, send, sends * sizeof *send);
    if (receives > 0) memcpy(m->receive, receive, receives * sizeof *receive);
    m->sends = sends, m->receives = receives, m->posted = 0;
    shuffle(m, m->send, sends);
    shuffle(m, m->receive, receives);
    post(m, m->team->disturb ? draw(m, sends + 1) : sends);
}

static void take(member *m, const sb_parcel *parcel)
{
    team *t = m->team;
    slot *from = slot_of(t, parcel->rank, m->ranks.rank);
    pthread_mutex_lock(&t->lock);
    while (!from->bytes) wait_for_change(t);
    const slot found = *from;
    pthread_mutex_unlock(&t->lock);
    if (found.size != parcel->size) abort();
    memcpy(parcel->bytes, found.bytes, found.size);
    pthread_mutex_lock(&t->lock);
    from->bytes = NULL;
    pthread_cond_broadcast(&t->changed);
    pthread_mutex_unlock(&t->lock);
}

static bool arrived(sb_ranks *ranks)
{
    member *m = ranks->context;
    bool all = true;
    post(m, m->team->disturb ? m->posted + draw(m, m->sends - m->posted + 1) : m->sends);
    if (m->team->disturb && draw(m, 2) == 0) return false;
    pthread_mutex_lock(&m->team->lock);
    for (size_t k = 0; k < m->receives; k++)
        all = all && slot_of(m->team, m->receive[k].rank, ranks->rank)->bytes != NULL;
    pthread_mutex_unlock(&m->team->lock);
    return all;
}

static void finish(sb_ranks *ranks)
{
    member *m = ranks->context;
    team *t = m->team;
    post(m, m->sends);
    for (size_t k = 0; k < m->receives; k++) {
        delay(m);
        take(m, &m->receive[k]);
    }
    pthread_mutex_lock(&t->lock);
    for (size_t k = 0; k < m->sends; k++)
        while (slot_of(t, ranks->rank, m->send[k].rank)->bytes) wait_for_change(t);
    pthread_mutex_unlock(&t->lock);
    m->sends = m->receives = m->posted = 0;
}

static void barrier(team *t)
{
    pthread_mutex_lock(&t->lock);
    const uint64_t round = t->round;
    if (++t->arrived == t->count) {
        t->arrived = 0;
        t->round++;
        pthread_cond_broadcast(&t->changed);
    }
    while (t->round == round) wait_for_change(t);
    pthread_mutex_unlock(&t->lock);
}

static void gather(sb_ranks *ranks, const void *own, size_t size, void *all)
{
    member *m = ranks->context;
    team *t = m->team;
    delay(m);
    t->own[ranks->rank] = own;
    t->own_size[ranks->rank] = size;
    barrier(t);
    for (int r = 0; r < t->count; r++) {
        if (t->own_size[r] != size) abort();
        memcpy((char *)all + (size_t)r * size, t->own[r], size);
    }
    barrier(t);
}

/* ---- files: the handle is the descriptor + 1 ---- */

static int open_file(sb_ranks *ranks, const char *path, void **file)
{
    const int descriptor = open(path, O_WRONLY | O_NOFOLLOW | O_CLOEXEC);
    (void)ranks;
    if (descriptor < 0) return errno;
    *file = (void *)(intptr_t)(descriptor + 1);
    return 0;
}

static int descriptor_of(const void *file)
{
    return (int)((intptr_t)file - 1);
}

static int write_at(void *file, uint64_t at, const void *bytes, size_t size)
{
    for (size_t done = 0; done < size;) {
        const ssize_t some = pwrite(descriptor_of(file), (const char *)bytes + done, size - done, (off_t)(at + done));
        if (some < 0 && errno != EINTR) return errno;
        if (some == 0) return EIO;
        if (some > 0) done += (size_t)some;
    }
    return 0;
}

static int close_file(void *file)
{
    const int reason = fsync(descriptor_of(file)) != 0 ? errno : 0;
    if (close(descriptor_of(file)) != 0 && reason == 0) return errno;
    return reason;
}

static const sb_transport transport = {.name = "threads",
                                       .start = start,
                                       .finish = finish,
                                       .arrived = arrived,
                                       .gather = gather,
                                       .open = open_file,
                                       .write_at = write_at,
                                       .close = close_file};

/* The thread of a rank: waits until all threads exist. A team of count 0 was given up. */
static void *run_member(void *context)
{
    member *m = context;
    team *t = m->team;
    pthread_mutex_lock(&t->lock);
    while (!t->released) wait_for_change(t);
    const bool given_up = t->count == 0;
    pthread_mutex_unlock(&t->lock);
    if (!given_up) t->work(&m->ranks, t->context);
    return NULL;
}

/* Returns 0, or -1 if a thread cannot be started. */
static int run_members(team *t, member *members)
{
    const int count = t->count;
    int started = 0;
    for (; started < count; started++) {
        member *m = &members[started];
        m->team = t;
        m->ranks = (sb_ranks){.rank = started, .count = count, .transport = &transport, .context = m};
        if (pthread_create(&m->thread, NULL, run_member, m) != 0) break;
    }
    pthread_mutex_lock(&t->lock);
    t->released = true;
    if (started < count) t->count = 0;
    pthread_cond_broadcast(&t->changed);
    pthread_mutex_unlock(&t->lock);
    for (int r = 0; r < started; r++) pthread_join(members[r].thread, NULL);
    return started < count ? -1 : 0;
}

sb_status sb_ranks_threads_run(int count, uint64_t disturb, sb_rank_work *work, void *context, sb_error *error)
{
    const size_t n = (size_t)count;
    team t = {.count = count, .disturb = disturb, .work = work, .context = context};
    member *members = sb_alloc(n, sizeof *members);
    t.slots = sb_alloc(n * n, sizeof *t.slots);
    t.own = sb_alloc(n, sizeof *t.own);
    t.own_size = sb_alloc(n, sizeof *t.own_size);
    sb_status status = SB_OK;
    if (!members || !t.slots || !t.own || !t.own_size) {
        status = sb_fail_memory(error, "ranks");
        goto done;
    }
    pthread_mutex_init(&t.lock, NULL);
    sb_clock_init_condition(&t.changed);
    if (run_members(&t, members) != 0) status = sb_fail(error, SB_FAILED, "cannot start %d threads for ranks", count);
    pthread_cond_destroy(&t.changed);
    pthread_mutex_destroy(&t.lock);
done:
    sb_free(members);
    sb_free(t.slots);
    sb_free(t.own);
    sb_free(t.own_size);
    return status;
}
