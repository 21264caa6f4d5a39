#include "base/threads.h"

#include "base/clock.h"

#include <pthread.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

/* The thread lives until the lock is free. */
static void *wait_for_end(void *lock)
{
    pthread_mutex_lock(lock);
    pthread_mutex_unlock(lock);
    return NULL;
}

/* Threads of this process as the kernel counts them; 0: unknown. */
static unsigned long count_threads(void)
{
    struct stat tasks;
    return stat("/proc/self/task", &tasks) == 0 ? (unsigned long)tasks.st_nlink : 0;
}

/* A thread that was joined counts against the limit for a moment longer. */
static void wait_until_gone(unsigned long before)
{
    static const double PATIENCE = 0.2; /* s */
    const double end = sb_clock() + PATIENCE;
    while (count_threads() > before && sb_clock() < end) usleep(100);
}

int sb_threads_allowed(int wanted)
{
    pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
    pthread_t threads[SB_THREADS_MOST];
    const unsigned long before = count_threads();
    int count = 0;
    sigset_t all, old;
    /* Signals are for the main thread. */
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &old);
    pthread_mutex_lock(&lock);
    while (count < wanted && count < SB_THREADS_MOST && pthread_create(&threads[count], NULL, wait_for_end, &lock) == 0)
        count++;
    pthread_mutex_unlock(&lock);
    for (int t = 0; t < count; t++) pthread_join(threads[t], NULL);
    pthread_sigmask(SIG_SETMASK, &old, NULL);
    pthread_mutex_destroy(&lock);
    wait_until_gone(before);
    return count;
}
