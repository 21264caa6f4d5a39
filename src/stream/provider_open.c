/* Opens a provider. Over TCP, LCM waits without a limit for the greeting of the other end, so the provider is opened in
   a thread of its own: a run does not wait for a peer that is stopped. */
#include "stream/provider.h"

#include "base/clock.h"
#include "base/memory.h"

#include <pthread.h>
#include <signal.h>
#include <stdbool.h>
#include <string.h>
#include <unistd.h>

#define ROUTE_REMEDY "a multicast route is needed: ip link set lo multicast on; ip route add 224.0.0.0/4 dev lo"

/* s; a provider that is available opens within milliseconds. */
static const double TIMEOUT = 5;

/* Shared by the caller and the thread that opens the provider; the one that finishes last frees it. */
typedef struct opening {
    pthread_mutex_t lock;
    bool done, abandoned;
    char *url;
    lcm_t *lcm;
} opening;

static void free_opening(opening *o)
{
    pthread_mutex_destroy(&o->lock);
    sb_free(o->url);
    sb_free(o);
}

static void *open_provider(void *argument)
{
    opening *o = argument;
    lcm_t *lcm = lcm_create(o->url);
    pthread_mutex_lock(&o->lock);
    o->lcm = lcm;
    o->done = true;
    const bool abandoned = o->abandoned;
    pthread_mutex_unlock(&o->lock);
    if (!abandoned) return NULL;
    if (lcm) lcm_destroy(lcm);
    free_opening(o);
    return NULL;
}

/* Starts the thread with all signals blocked: the main thread handles them. */
static bool start(opening *o, pthread_t *thread)
{
    sigset_t all, old;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &old);
    const int refused = pthread_create(thread, NULL, open_provider, o);
    pthread_sigmask(SIG_SETMASK, &old, NULL);
    return !refused;
}

/* Waits for the thread and returns whether it ended in time. If not, the thread itself closes what it opens later. */
static bool wait_for(opening *o, pthread_t thread)
{
    enum { POLL = 1000 }; /* us */
    bool done = false;
    for (const double end = sb_clock() + TIMEOUT; !done;) {
        const bool late = sb_clock() > end;
        pthread_mutex_lock(&o->lock);
        done = o->done;
        o->abandoned = !done && late;
        pthread_mutex_unlock(&o->lock);
        if (!done && late) {
            pthread_detach(thread);
            return false;
        }
        if (!done) usleep(POLL);
    }
    pthread_join(thread, NULL);
    return true;
}

static sb_status explain(const char *url, const char *reason, sb_error *error)
{
    const bool multicast = strncmp(url, "udpm://", 7) == 0;
    return sb_fail(error, SB_FAILED, "LCM cannot open \"%.200s\" (%s); %s", url, *reason ? reason : "no reason given",
                   multicast
                       ? ROUTE_REMEDY
                       : "expected udpm://239.255.76.67:7667?ttl=0, tcpq://127.0.0.1:7700 or another network provider");
}

sb_status sb_provider_open(const char *url, lcm_t **lcm, sb_error *error)
{
    const char *named = sb_provider_url(url);
    opening *o = sb_alloc(1, sizeof *o);
    if (!o) return sb_fail_memory(error, "opening LCM");
    pthread_mutex_init(&o->lock, NULL);
    o->url = sb_strdup(named);
    if (!o->url) {
        free_opening(o);
        return sb_fail_memory(error, "opening LCM");
    }
    char reason[160];
    pthread_t thread;
    sb_stderr_catch hold = sb_stderr_hold();
    const bool started = start(o, &thread), ended = started && wait_for(o, thread);
    sb_stderr_release(&hold, reason, sizeof reason);
    if (started && !ended)
        return sb_fail(error, SB_FAILED,
                       "LCM cannot open \"%.200s\": no answer within %g s, expected the greeting of an LCM server",
                       named, TIMEOUT);
    lcm_t *opened = o->lcm;
    free_opening(o);
    if (!started)
        return sb_fail(error, SB_FAILED, "LCM cannot open \"%.200s\": the system cannot start a thread", named);
    if (!opened) return explain(named, reason, error);
    *lcm = opened;
    return SB_OK;
}
