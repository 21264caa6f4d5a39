/* Notes the signals that request a stop. */
#include "base/stop.h"

#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

/* Atomic: a signal handler needs a lock-free variable, and all threads read it. */
static atomic_int noted, waiting;
static atomic_bool requested, deferred;

static void note(int number)
{
    atomic_int *where = atomic_load_explicit(&deferred, memory_order_relaxed) ? &waiting : &noted;
    atomic_store_explicit(where, number, memory_order_relaxed);
}

/* When a terminal closes, both its shell and the kernel may send SIGHUP, so a second one must not end the process. */
static void watch_terminal(void)
{
    struct sigaction before, action = {.sa_handler = note, .sa_flags = SA_RESTART};
    sigemptyset(&action.sa_mask);
    if (sigaction(SIGHUP, NULL, &before) == 0 && before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, NULL);
}

void sb_stop_watch(void)
{
    struct sigaction action = {.sa_handler = note, .sa_flags = (int)(SA_RESTART | SA_RESETHAND)};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    watch_terminal();
    /* A file that exceeds the size limit is treated like a full disk: the write fails, and the failure is reported. */
    signal(SIGXFSZ, SIG_IGN);
    /* The end of the process that reads the progress output is no reason to stop the run. */
    signal(SIGPIPE, SIG_IGN);
}

void sb_stop_watch_forwarded(void)
{
    struct sigaction action = {.sa_handler = note, .sa_flags = SA_RESTART};
    sigemptyset(&action.sa_mask);
    sigaction(SIGUSR1, &action, NULL);
}

void sb_stop_defer(bool on)
{
    atomic_store(&deferred, on);
    const int number = atomic_exchange(on ? &noted : &waiting, 0);
    if (number) note(number); /* to where it belongs now */
}

int sb_stop_waiting(void)
{
    return atomic_load_explicit(&waiting, memory_order_relaxed);
}

void sb_stop_accept(int number, bool by_command)
{
    atomic_store(&requested, by_command);
    atomic_store(&noted, number);
}

bool sb_stop_by_command(void)
{
    return atomic_load(&requested);
}

void sb_stop_request(void)
{
    if (sb_stop_signal() || sb_stop_waiting()) return;
    atomic_store(&requested, true);
    note(SIGINT);
}

const char *sb_stop_cause(void)
{
    return atomic_load(&requested) ? "command" : "signal";
}

int sb_stop_signal(void)
{
    return atomic_load_explicit(&noted, memory_order_relaxed);
}

sb_status(sb_stop_fail)(sb_error *error, const char *during)
{
    return sb_fail(error, SB_INTERRUPTED, "stopped by a %s %s", sb_stop_cause(), during);
}
