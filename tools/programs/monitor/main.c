/* Receives a run's stream over LCM and shows it: on a terminal as a live screen, else as lines. */
#include "layout.h"
#include "options.h"
#include "screen.h"
#include "steer.h"

#include "base/clock.h"
#include "base/memory.h"
#include "stream/guard.h"
#include "stream/listen.h"

#include <langinfo.h>
#include <locale.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#define REDRAW_SECONDS 0.2
#define KEY_SECONDS 0.05
#define LINE_SECONDS 1.0
/* The status comes every half second; forces and parts of a frame come with the next interval. */
#define ONCE_SECONDS 0.25

typedef struct monitor {
    sb_monitor_options options;
    sb_monitor_state state;
    sb_live *live;
    sb_view view;
    sb_cells cells;
    sb_steer steer;
    sb_target target; /* of --run */
    bool screen;      /* the program has the whole terminal */
    bool quit;
    double begun;           /* sb_clock() at the start, for --duration */
    double drawn;           /* at the last drawing */
    double line_time;       /* at the last plain line */
    uint64_t line_statuses; /* number of statuses at that time */
    uint64_t line_restarts; /* number of restarts at that time */
    bool silence_reported;
    double first_status; /* sb_clock(), 0: none yet */
    bool once_complete;  /* --once: the second status arrived; it and all later messages are ignored */
} monitor;

static volatile sig_atomic_t stopped;
static unsigned crashes; /* of earlier child processes */

static void stop(int signal_number)
{
    (void)signal_number;
    stopped = 1;
}

static void on_status(void *user, const sb_status_message *message)
{
    monitor *self = user;
    self->once_complete |= self->options.once && self->first_status > 0;
    if (self->once_complete) return;
    if (!(self->first_status > 0)) self->first_status = sb_clock();
    sb_monitor_on_status(&self->state, message);
}

/* A callback of sb_live that passes its argument to the state. */
#define PASS(NAME, TYPE)                                                                                               \
    static void on_##NAME(void *user, TYPE message)                                                                    \
    {                                                                                                                  \
        monitor *self = user;                                                                                          \
        if (!self->once_complete) sb_monitor_on_##NAME(&self->state, message);                                         \
    }
PASS(forces, const sb_forces_message *)
PASS(gauges, const sb_gauges_message *)
PASS(part, const sb_frame_message *)
PASS(frame, const sb_live_frame *)
PASS(scene, const sb_live_scene *)
PASS(restart, int64_t)

static void on_reply(void *user, const sb_reply_message *reply)
{
    monitor *self = user;
    if (sb_steer_reply(&self->steer, reply))
        sb_view_note(&self->view, sb_clock(), "%sstep %lld: %s", reply->refused ? "refused: " : "",
                     (long long)reply->step, reply->text);
}

static void on_message(void *user, sb_channel_kind kind, const void *data, size_t size, double time)
{
    const monitor *self = user;
    if (!self->once_complete) sb_live_take(self->live, kind, data, size, time);
}

/* With --run, the folder of the run names URL and prefix. */
static sb_status find_run(monitor *self, sb_error *error)
{
    sb_monitor_options *options = &self->options;
    self->steer.run = options->run;
    self->steer.token_file = options->token_file;
    if (!options->run) return SB_OK;
    const sb_status status = sb_target_read(options->run, &self->target, error);
    if (!options->url) options->url = self->target.url;
    if (!options->prefix) options->prefix = self->target.prefix;
    return status;
}

static sb_status connect(monitor *self, sb_listener **listener, sb_error *error)
{
    const sb_live_calls calls = {.user = self,
                                 .restarted = on_restart,
                                 .scene = on_scene,
                                 .status = on_status,
                                 .forces = on_forces,
                                 .gauges = on_gauges,
                                 .part = on_part,
                                 .frame = on_frame,
                                 .reply = on_reply};
    self->live = sb_live_create(&calls);
    if (!self->live) return sb_fail_memory(error, "the monitor");
    const sb_status status = find_run(self, error);
    if (status != SB_OK) return status;
    const sb_listener_calls messages = {.user = self, .message = on_message};
    return sb_listener_create(self->options.url, self->options.prefix, &messages, listener, error);
}

/* ---- the live screen ---- */

static void draw(monitor *self, double now)
{
    int width, height;
    sb_screen_size(&width, &height);
    if (width != self->cells.width || height != self->cells.height)
        if (sb_cells_resize(&self->cells, width, height) != SB_OK) return;
    sb_layout_draw(&self->cells, &self->state, &self->view, now);
    sb_screen_show(&self->cells);
    self->drawn = now;
}

/* The id of the run that is watched, -1: none. */
static int64_t followed(const monitor *self)
{
    return self->state.has_status ? self->state.status.head.run_id : -1;
}

static void steer(monitor *self, sb_listener *listener, sb_action action, double now)
{
    sb_error error = {0};
    if (sb_steer_send(&self->steer, listener, action, followed(self), now, &error) == SB_OK)
        sb_view_note(&self->view, now, "sent; the run replies after its present step");
    else
        sb_view_note(&self->view, now, "%s", error.text);
}

static void take_keys(monitor *self, sb_listener *listener, double now)
{
    bool pressed = false;
    for (int key = sb_screen_key(); key >= 0; key = sb_screen_key()) {
        pressed = true;
        const sb_action action = sb_view_key(&self->view, key);
        if (action == SB_ACTION_QUIT)
            self->quit = true;
        else if (action != SB_ACTION_NONE)
            steer(self, listener, action, now);
    }
    sb_error error = {0};
    if (sb_steer_serve(&self->steer, listener, now, &error) != SB_OK) sb_view_note(&self->view, now, "%s", error.text);
    if (pressed) draw(self, now);
}

/* ---- plain lines ---- */

static void print_lines(monitor *self, double now)
{
    sb_monitor_state *state = &self->state;
    const double silent = now - state->last_data;
    if (silent < SB_MONITOR_SILENCE)
        self->silence_reported = false;
    else if (!self->silence_reported) {
        printf("no data for %.0f s\n", silent);
        self->silence_reported = true;
    }
    if (state->has_status && state->statuses != self->line_statuses && now - self->line_time >= LINE_SECONDS) {
        if (state->count.restarts != self->line_restarts)
            printf("messages of another process follow: the run was resumed, or another one began\n");
        sb_layout_line(stdout, state);
        self->line_restarts = state->count.restarts;
        self->line_statuses = state->statuses;
        self->line_time = now;
    }
    fflush(stdout);
}

/* ---- */

static bool finished(const monitor *self, double now)
{
    const sb_monitor_options *options = &self->options;
    return stopped || self->quit || self->once_complete ||
           (options->duration > 0 && now - self->begun >= options->duration) ||
           (options->once && self->first_status > 0 && now - self->first_status >= ONCE_SECONDS);
}

static void watch(monitor *self, sb_listener *listener)
{
    const bool quick = self->options.once || self->screen;
    bool ended = false;
    for (double now = sb_clock(); !ended && !finished(self, now); now = sb_clock()) {
        ended = sb_listener_poll(listener, quick ? KEY_SECONDS : REDRAW_SECONDS) != SB_OK;
        now = sb_clock();
        sb_monitor_state_sample(&self->state, sb_live_count(self->live), now);
        sb_steer_report(&self->steer, listener, followed(self), &self->state.count, now);
        if (!self->screen) {
            if (!self->options.once) print_lines(self, now);
            continue;
        }
        take_keys(self, listener, now);
        if (now >= self->drawn + REDRAW_SECONDS) draw(self, now);
    }
}

static bool wants_screen(const sb_monitor_options *options)
{
    const char *terminal = getenv("TERM");
    return !options->plain && !options->once && isatty(STDOUT_FILENO) && terminal && strcmp(terminal, "dumb") != 0;
}

static void open_screen(monitor *self)
{
    const char *no_colour = getenv("NO_COLOR");
    self->cells.utf8 = strcmp(nl_langinfo(CODESET), "UTF-8") == 0;
    self->screen = wants_screen(&self->options) && sb_screen_open(!(no_colour && *no_colour));
}

static int terminal_width(void)
{
    struct winsize size;
    return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 100;
}

static int run(void *argument)
{
    monitor *self = argument;
    sb_error error = {0};
    sb_listener *listener = NULL;
    if (connect(self, &listener, &error) != SB_OK) {
        fprintf(stderr, "shorebreak-monitor: %s\n", error.text);
        sb_live_destroy(self->live);
        return 1;
    }
    struct sigaction action = {.sa_handler = stop};
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    sigaction(SIGHUP, &action, NULL);
    sb_monitor_state_start(&self->state, sb_clock());
    self->state.receiver_restarts = crashes;
    open_screen(self);
    watch(self, listener);
    if (self->screen) sb_screen_close();
    /* Print what was seen last so that it remains visible. */
    if (self->state.has_status)
        sb_layout_print(stdout, &self->state, terminal_width(), self->screen && self->cells.utf8, sb_clock());
    sb_listener_destroy(listener);
    sb_live_destroy(self->live);
    sb_cells_free(&self->cells);
    if (self->options.once && !(self->first_status > 0)) {
        fprintf(stderr, "shorebreak-monitor: no status message received\n");
        return 1;
    }
    return 0;
}

/* Restores the terminal, which the crashed child could not do. */
static void report_crash(void)
{
    crashes++;
    sb_screen_restore();
    fputs("shorebreak-monitor: a message from the network crashed LCM's receiver; restarting it\n", stderr);
}

int main(int count, char **arguments)
{
    setlocale(LC_CTYPE, "");
    char problem[256];
    sb_monitor_options options;
    if (!sb_monitor_options_read(count, arguments, &options, problem)) {
        fprintf(stderr, "shorebreak-monitor: %s\n", problem);
        return 1;
    }
    if (options.help || options.version) {
        if (options.help)
            fputs(sb_monitor_help, stdout);
        else
            puts("shorebreak-monitor " SB_VERSION);
        return fflush(stdout) == 0 ? 0 : 1;
    }
    monitor *self = sb_alloc(1, sizeof *self);
    if (!self) {
        fprintf(stderr, "shorebreak-monitor: out of memory\n");
        return 1;
    }
    self->options = options;
    self->begun = sb_clock();
    if (wants_screen(&options)) sb_screen_remember();
    const int code = sb_guard(run, self, report_crash);
    sb_screen_restore(); /* the child was killed, or has ended in LCM */
    sb_free(self);
    return fflush(stdout) == 0 ? code : 1;
}
