/* Receives a run's stream over LCM and shows it as a live table. */
#include "options.h"
#include "state.h"
#include "table.h"

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
#define LINE_SECONDS 1.0
#define SILENCE_SECONDS 5.0
/* The status comes every half second; forces and parts of a frame come with the next interval. */
#define ONCE_SECONDS 0.25

#define ENTER_SCREEN "\x1b[?1049h\x1b[?25l\x1b[2J"
#define LEAVE_SCREEN "\x1b[0m\x1b[?25h\x1b[?1049l"

typedef struct monitor {
    sb_monitor_options options;
    sb_monitor_state state;
    sb_live *live;
    sb_table_style style;
    bool screen;            /* the table takes the whole terminal */
    double begun;           /* sb_clock() at the start, for --duration */
    double line_time;       /* sb_clock() at the last plain line */
    uint64_t line_statuses; /* number of statuses at that time */
    bool silence_reported;
    double first_status; /* sb_clock(), 0: none yet */
    bool once_complete;  /* --once: the second status arrived; it and all later messages are ignored */
} monitor;

static volatile sig_atomic_t stopped;

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

static void on_forces(void *user, const sb_forces_message *message)
{
    monitor *self = user;
    if (!self->once_complete) sb_monitor_on_forces(&self->state, message);
}

static void on_part(void *user, const sb_frame_message *message)
{
    monitor *self = user;
    if (!self->once_complete) sb_monitor_on_part(&self->state, message);
}

static void on_frame(void *user, const sb_live_frame *frame)
{
    monitor *self = user;
    if (!self->once_complete) sb_monitor_on_frame(&self->state, frame);
}

static void on_restart(void *user, int64_t run_id)
{
    monitor *self = user;
    if (!self->once_complete) sb_monitor_on_restart(&self->state, run_id);
}

static void on_message(void *user, sb_channel_kind kind, const void *data, size_t size, double time)
{
    const monitor *self = user;
    if (!self->once_complete) sb_live_take(self->live, kind, data, size, time);
}

static void measure_terminal(sb_table_style *style)
{
    struct winsize size;
    bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    style->width = known ? size.ws_col : 100;
    style->height = known ? size.ws_row : 0;
}

/* Writes the whole screen at once, so that the terminal never shows a partial table. */
static void redraw(monitor *self, double now)
{
    char *text = NULL;
    size_t length = 0;
    FILE *page = open_memstream(&text, &length);
    if (!page) return;
    measure_terminal(&self->style);
    fputs("\x1b[?7l\x1b[H", page); /* long lines are cut, not wrapped */
    sb_table_draw(page, &self->state, &self->style, now);
    fputs("\x1b[J\x1b[?7h", page);
    if (fclose(page) == 0) {
        fwrite(text, 1, length, stdout);
        fflush(stdout);
    }
    free(text);
}

static void print_lines(monitor *self, double now)
{
    sb_monitor_state *state = &self->state;
    double silent = now - state->last_data;
    if (silent < SILENCE_SECONDS)
        self->silence_reported = false;
    else if (!self->silence_reported) {
        printf("no data for %.0f s\n", silent);
        self->silence_reported = true;
    }
    if (state->has_status && state->statuses != self->line_statuses && now - self->line_time >= LINE_SECONDS) {
        sb_table_line(stdout, state);
        self->line_statuses = state->statuses;
        self->line_time = now;
    }
    fflush(stdout);
}

static bool finished(const monitor *self, double now)
{
    const sb_monitor_options *options = &self->options;
    return stopped || self->once_complete || (options->duration > 0 && now - self->begun >= options->duration) ||
           (options->once && self->first_status > 0 && now - self->first_status >= ONCE_SECONDS);
}

static void watch(monitor *self, sb_listener *listener)
{
    bool ended = false;
    for (double now = sb_clock(); !ended && !finished(self, now); now = sb_clock()) {
        ended = sb_listener_poll(listener, self->options.once ? 0.05 : REDRAW_SECONDS) != SB_OK;
        now = sb_clock();
        sb_monitor_state_sample(&self->state, sb_live_count(self->live), now);
        if (self->screen)
            redraw(self, now);
        else if (!self->options.once)
            print_lines(self, now);
    }
}

static void choose_style(monitor *self)
{
    const char *terminal = getenv("TERM");
    bool live = !self->options.plain && isatty(STDOUT_FILENO) && terminal && strcmp(terminal, "dumb") != 0;
    const char *no_colour = getenv("NO_COLOR");
    self->screen = live && !self->options.once;
    self->style.colour = live && !(no_colour && *no_colour);
    self->style.utf8 = live && strcmp(nl_langinfo(CODESET), "UTF-8") == 0;
    self->style.line_end = self->screen ? "\x1b[K" : "";
    measure_terminal(&self->style);
}

static sb_status connect(monitor *self, sb_listener **listener, sb_error *error)
{
    const sb_live_calls calls = {.user = self,
                                 .restarted = on_restart,
                                 .status = on_status,
                                 .forces = on_forces,
                                 .part = on_part,
                                 .frame = on_frame};
    self->live = sb_live_create(&calls);
    if (!self->live) return sb_fail_memory(error, "the monitor");
    const sb_listener_calls messages = {.user = self, .message = on_message};
    return sb_listener_create(self->options.url, self->options.prefix, &messages, listener, error);
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
    choose_style(self);
    if (self->screen) fputs(ENTER_SCREEN, stdout);
    watch(self, listener);
    if (self->screen) fputs(LEAVE_SCREEN, stdout);
    /* Print the last table so that it remains visible. */
    self->style.line_end = "";
    self->style.height = 0;
    if (self->state.has_status) sb_table_draw(stdout, &self->state, &self->style, sb_clock());
    sb_listener_destroy(listener);
    sb_live_destroy(self->live);
    if (self->options.once && !(self->first_status > 0)) {
        fprintf(stderr, "shorebreak-monitor: no status message received\n");
        return 1;
    }
    return 0;
}

/* Restores the terminal, which the crashed child could not do. */
static void report_crash(void)
{
    if (isatty(STDOUT_FILENO)) fputs(LEAVE_SCREEN, stdout);
    fflush(stdout);
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
    int code = sb_guard(run, self, report_crash);
    sb_free(self);
    return fflush(stdout) == 0 ? code : 1;
}
