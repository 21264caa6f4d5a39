#include "watch.h"

#include "base/clock.h"
#include "base/memory.h"
#include "process.h"
#include "stream/assembly.h"
#include "stream/listen.h"

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

struct sb_soak_watch {
    const sb_soak_run *run;
    char prefix[32];
    sb_listener *listener;
    sb_assembly assembly;
    sb_soak_life *life; /* the present one */
    uint64_t step;      /* the last one that was told */
    uint64_t frames;    /* that were whole when the present life began */
};

static const double grace = 120;     /* s that a run may take to stop when it is told */
static const double start_up = 1800; /* s that it may take to its first frame */

static volatile sig_atomic_t stopped;

static void stop(int number)
{
    (void)number;
    stopped = 1;
}

static void on_status(void *user, const sb_status_message *message)
{
    sb_soak_watch *w = user;
    w->step = (uint64_t)(message->step > 0 ? message->step : 0);
    if (w->life->first_step == 0) w->life->first_step = w->step;
    w->life->last_step = w->step;
}

/* A chunk without memory for its flags is one that is lost. */
static void on_particles(void *user, const sb_particles_message *message)
{
    sb_soak_watch *w = user;
    sb_assembly_add(&w->assembly, message);
}

sb_status sb_soak_watch_create(const sb_soak_run *run, sb_soak_watch **watch, sb_error *error)
{
    sb_soak_watch *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "the subscriber");
    made->run = run;
    snprintf(made->prefix, sizeof made->prefix, "soak-%ld", (long)getpid());
    const sb_listener_calls calls = {.user = made, .status = on_status, .particles = on_particles};
    const struct sigaction action = {.sa_handler = stop};
    sb_status status = sb_listener_create(NULL, made->prefix, &calls, &made->listener, error);
    if (status != SB_OK) {
        sb_free(made);
        return status;
    }
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    *watch = made;
    return SB_OK;
}

void sb_soak_watch_destroy(sb_soak_watch *watch)
{
    if (!watch) return;
    sb_listener_destroy(watch->listener);
    sb_assembly_free(&watch->assembly);
    sb_free(watch);
}

static sb_status start(const sb_soak_watch *w, bool resume, pid_t *process, sb_error *error)
{
    const sb_soak_run *run = w->run;
    char spacing[48], duration[48], prefix[64];
    snprintf(spacing, sizeof spacing, "resolution=%.9g", run->spacing);
    snprintf(duration, sizeof duration, "duration=%.9g", run->duration);
    snprintf(prefix, sizeof prefix, "stream.prefix=%s", w->prefix);
    const char *const arguments[] = {"shorebreak",
                                     "run",
                                     run->scene,
                                     "--quiet",
                                     "--out",
                                     run->out,
                                     "--set",
                                     spacing,
                                     "--set",
                                     duration,
                                     "--set",
                                     prefix,
                                     "--set",
                                     "stream.enabled=true",
                                     resume ? "--resume" : "--overwrite",
                                     NULL};
    return sb_process_start(run->program, arguments, run->said, SIGTERM, process, error);
}

/* One look, if the process is still there to be seen. */
static sb_status take_sample(sb_soak_watch *w, pid_t process, double seconds, sb_error *error)
{
    sb_soak_sample sample = {.seconds = seconds, .step = w->step};
    return sb_soak_look(process, &sample, NULL) == SB_OK ? sb_soak_keep(w->life, &sample, error) : SB_OK;
}

/* A run that was told to stop ends with 128 + SIGTERM, or well when it was just finished. */
static void note_end(sb_soak_watch *w, bool told, bool hung, int how)
{
    char ended[32], words[200];
    const int status = WIFEXITED(how) ? WEXITSTATUS(how) : -1;
    w->life->end = status == 0 ? SB_SOAK_FINISHED : told && status == 128 + SIGTERM ? SB_SOAK_STOPPED : SB_SOAK_BROKEN;
    if (w->life->end != SB_SOAK_BROKEN) return;
    sb_process_describe(how, ended);
    sb_process_last_words(w->run->said, "it said nothing", words, sizeof words);
    snprintf(w->life->words, sizeof w->life->words, "%sended with %s: %.200s", hung ? "did not stop, " : "", ended,
             words);
}

/* Whether a life has lasted long enough: from its first frame on, however long the start took. */
static bool is_time(const sb_soak_watch *w, double now, double patience, double *first)
{
    if (w->assembly.frames_complete > w->frames && *first < 0) *first = now;
    return *first < 0 ? now >= patience + start_up : now - *first >= patience;
}

/* Listens and looks until the process has ended. */
static sb_status follow(sb_soak_watch *w, pid_t process, double patience, sb_error *error)
{
    const double start = sb_clock(), pause = fmin(fmax(patience / 200, 0.02), 2);
    double first = -1; /* s: when a frame came */
    bool told = false, hung = false;
    int how = 0;
    sb_status status = SB_OK;
    for (;;) {
        const pid_t ended = waitpid(process, &how, WNOHANG);
        const double now = sb_clock() - start;
        if (ended == process) {
            w->life->seconds = told ? w->life->seconds : now;
            break;
        }
        if (ended < 0 && errno != EINTR) return sb_fail(error, SB_FAILED, "cannot wait for a run: %s", strerror(errno));
        if (!told && (stopped || is_time(w, now, patience, &first) || status != SB_OK)) {
            told = kill(process, SIGTERM) == 0;
            w->life->seconds = now;
        } else if (told && !hung && now > w->life->seconds + grace) {
            hung = kill(process, SIGKILL) == 0;
        } else if (!told) {
            status = take_sample(w, process, now, error);
        }
        sb_listener_poll(w->listener, pause);
    }
    note_end(w, told, hung, how);
    return status;
}

sb_status sb_soak_live(sb_soak_watch *w, bool resume, double seconds, sb_soak_life *life, sb_error *error)
{
    pid_t process;
    const uint64_t lost = w->assembly.chunks_lost;
    w->frames = w->assembly.frames_complete;
    w->life = life;
    w->step = 0;
    life->resumed = resume;
    sb_status status = start(w, resume, &process, error);
    if (status == SB_OK) status = follow(w, process, seconds, error);
    life->frames = w->assembly.frames_complete - w->frames;
    life->chunks_lost = w->assembly.chunks_lost - lost;
    if (status == SB_OK && stopped) status = sb_fail(error, SB_INTERRUPTED, "stopped by a signal");
    return status;
}
