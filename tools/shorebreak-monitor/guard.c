#include "guard.h"

#include <errno.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

/* s between one crash and the next start: who sends without end is not answered by forking without end. */
enum { PAUSE = 1 };

static volatile sig_atomic_t child, asked;

static void pass_on(int number)
{
    asked = 1;
    if (child > 0) kill((pid_t)child, number);
}

static bool is_crash(int status)
{
    if (!WIFSIGNALED(status)) return false;
    const int number = WTERMSIG(status);
    return number == SIGSEGV || number == SIGBUS || number == SIGABRT || number == SIGILL || number == SIGFPE;
}

/* Waits for the child, however often a signal comes between. */
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
    const struct sigaction action = {.sa_handler = pass_on};
    sigset_t ends, before;
    sigemptyset(&ends);
    sigaddset(&ends, SIGINT);
    sigaddset(&ends, SIGTERM);
    sigaddset(&ends, SIGHUP);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGHUP, &action, NULL);
    for (;;) {
        fflush(NULL);
        sigprocmask(SIG_BLOCK, &ends, &before); /* none is lost before the child is known */
        const pid_t made = fork();
        if (made == 0) start(work, argument, &before, own);
        child = made;
        sigprocmask(SIG_SETMASK, &before, NULL);
        if (made < 0) return work(argument);
        const int status = await_child();
        if (!is_crash(status)) return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        after_crash();
        if (asked) return 1;
        sleep(PAUSE);
        if (asked) return 0;
    }
}
