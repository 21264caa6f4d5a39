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
static volatile sig_atomic_t seconds_left;
static struct sigaction before;

/* Once per second in which this process is not stopped. */
static void count_down(int signal)
{
    (void)signal;
    if (--seconds_left > 0) return;
    const ssize_t ignored = write(STDERR_FILENO, last_words, strlen(last_words));
    (void)ignored;
    _exit(SB_FAILED);
}

static void tick_each(time_t seconds)
{
    const struct itimerval timer = {.it_interval = {.tv_sec = seconds}, .it_value = {.tv_sec = seconds}};
    setitimer(ITIMER_REAL, &timer, NULL);
}

void sb_world_guard(double seconds, const char *line)
{
    const struct sigaction action = {.sa_handler = count_down, .sa_flags = SA_RESTART};
    last_words[0] = '\0';
    if (line) snprintf(last_words, sizeof last_words, "shorebreak: %s\n", line);
    seconds_left = (sig_atomic_t)ceil(seconds);
    sigaction(SIGALRM, &action, &before);
    tick_each(1);
}

void sb_world_unguard(void)
{
    tick_each(0);
    sigaction(SIGALRM, &before, NULL);
}
