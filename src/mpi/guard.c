/* A limit for the calls of MPI that wait within the library, where no deadline of ours counts: its begin, its end, and
   the end of all ranks. An alarm ends this process, and the starter then ends the others. */
#include "mpi/parts.h"

#include "base/status.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

static char last_words[SB_WORLD_TEXT + 32]; /* for the handler, which may only write and end; empty: none */
static struct sigaction before;

static void end_late(int signal)
{
    (void)signal;
    const ssize_t ignored = write(STDERR_FILENO, last_words, strlen(last_words));
    (void)ignored;
    _exit(SB_FAILED);
}

static void set_alarm(double seconds)
{
    const struct itimerval timer = {
        .it_value = {.tv_sec = (time_t)seconds, .tv_usec = (suseconds_t)((seconds - floor(seconds)) * 1e6)}};
    setitimer(ITIMER_REAL, &timer, NULL);
}

void sb_world_guard(double seconds, const char *line)
{
    const struct sigaction action = {.sa_handler = end_late};
    last_words[0] = '\0';
    if (line) snprintf(last_words, sizeof last_words, "shorebreak: %s\n", line);
    sigaction(SIGALRM, &action, &before);
    set_alarm(seconds);
}

void sb_world_unguard(void)
{
    set_alarm(0);
    sigaction(SIGALRM, &before, NULL);
}
