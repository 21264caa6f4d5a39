/* Restarts a child process when it crashes. */
#include "stream/guard.h"

#include <errno.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

/* s between a crash and the next start, so that a sender of endless bad packets does not cause endless forking. */
enum { PAUSE = 1 };

static volatile sig_atomic_t child, stop_requested;

static void forward_signal(int number)
{
    stop_requested = 1;
    if (child > 0) kill((pid_t)child, number);
}

static bool is_crash(int status)
{
    if (!WIFSIGNALED(status)) return false;
    const int number = WTERMSIG(status);
    return number == SIGSEGV || number == SIGBUS || number == SIGABRT || number == SIGILL || number == SIGFPE;
}

/* Waits for the child, also when signals interrupt the wait. */
static int await_child(void)
{
    int status = 0;
    while (waitpid((pid_t)child, &status, 0) < 0 && errno == EINTR) {
    }
    child = 0;
    return status;
}

static void start(int (*work)(void *), void *argument, const sigset_t *before, pid_t parent)
{
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    signal(SIGHUP, SIG_DFL);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) exit(1);
    sigprocmask(SIG_SETMASK, before, NULL);
    exit(work(argument));
}

int sb_guard(int (*work)(void *), void *argument, void (*after_crash)(void))
{
    const pid_t own = getpid();
    const struct sigaction action = {.sa_handler = forward_signal};
    sigset_t stop_signals, before;
    sigemptyset(&stop_signals);
    sigaddset(&stop_signals, SIGINT);
    sigaddset(&stop_signals, SIGTERM);
    sigaddset(&stop_signals, SIGHUP);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGHUP, &action, NULL);
    for (;;) {
        fflush(NULL);
        sigprocmask(SIG_BLOCK, &stop_signals, &before); /* no signal is lost before `child` is set */
        const pid_t made = fork();
        if (made == 0) start(work, argument, &before, own);
        child = made;
        sigprocmask(SIG_SETMASK, &before, NULL);
        if (made < 0) return work(argument);
        const int status = await_child();
        if (!is_crash(status)) return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        after_crash();
        if (stop_requested) return 1;
        sleep(PAUSE);
        if (stop_requested) return 0;
    }
}
