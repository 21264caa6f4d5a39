/* Runs the monitor on a terminal: its screen, its keys, another size, and the terminal's settings after any end. */
#include "stream/stream_fixture.h"

#include "base/clock.h"

#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

/* What the terminal got so far; where the search for the next text begins. */
static char output[1 << 18];
static size_t length, searched;

/* A monitor on a terminal. */
typedef struct session {
    int terminal;
    pid_t process; /* the one that watches */
    struct termios before;
} session;

static session begin(const char *no_colour)
{
    session made = {0};
    length = searched = 0;
    *output = 0;
    struct winsize size = {.ws_row = 24, .ws_col = 80};
    made.process = forkpty(&made.terminal, NULL, NULL, &size);
    if (made.process == 0) {
        setenv("TERM", "xterm-256color", 1);
        setenv("LC_ALL", "C.UTF-8", 1);
        if (no_colour) setenv("NO_COLOR", no_colour, 1);
        usleep(100000); /* so that the settings are read before they change */
        execl(SB_BINARY_DIR "/shorebreak-monitor", "shorebreak-monitor", "--url", "memq://", (char *)NULL);
        _exit(127);
    }
    assert_true(made.process > 0);
    assert_int_equal(tcgetattr(made.terminal, &made.before), 0);
    return made;
}

/* Reads the terminal until `text` appears after the last text that was found, for at most 5 s. */
static bool await_text(const session *in, const char *text)
{
    for (double end = sb_clock() + 5; sb_clock() < end;) {
        const char *found = strstr(output + searched, text);
        if (found) {
            searched = (size_t)(found - output) + strlen(text);
            return true;
        }
        struct pollfd ready = {.fd = in->terminal, .events = POLLIN};
        if (poll(&ready, 1, 100) <= 0) continue;
        const ssize_t got = read(in->terminal, output + length, sizeof output - 1 - length);
        if (got <= 0) break;
        length += (size_t)got;
        output[length] = 0;
    }
    return false;
}

static void shows(const session *in, const char *text)
{
    if (await_text(in, text)) return;
    kill(in->process, SIGKILL);
    fail_msg("the terminal did not get \"%s\" but:\n%s", text, output);
}

static void type(const session *in, const char *keys)
{
    assert_int_equal(write(in->terminal, keys, strlen(keys)), (ssize_t)strlen(keys));
}

/* Waits for the end and checks the code and the settings of the terminal. */
static void ends(const session *in, int code)
{
    int status = 0;
    struct termios after;
    assert_int_equal(waitpid(in->process, &status, 0), in->process);
    assert_int_equal(tcgetattr(in->terminal, &after), 0);
    close(in->terminal);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), code);
    assert_int_equal(after.c_lflag, in->before.c_lflag);
    assert_int_equal(after.c_iflag, in->before.c_iflag);
    assert_int_equal(after.c_oflag, in->before.c_oflag);
}

/* The process that draws: the only child of the one that watches. */
static pid_t drawing_process(const session *in)
{
    char path[64];
    long child = 0;
    snprintf(path, sizeof path, "/proc/%d/task/%d/children", (int)in->process, (int)in->process);
    FILE *list = fopen(path, "r");
    if (!list) skip(); /* a system that does not list the children of a process */
    assert_int_equal(fscanf(list, "%ld", &child), 1);
    fclose(list);
    return (pid_t)child;
}

#define ENTER "\x1b[?1049h"
#define LEAVE "\x1b[?1049l"

static void keys_work_and_q_restores_the_terminal(void **unused)
{
    (void)unused;
    const session in = begin(NULL);
    shows(&in, "waiting for a run");
    assert_non_null(strstr(output, ENTER));
    struct termios live;
    assert_int_equal(tcgetattr(in.terminal, &live), 0);
    assert_true(live.c_lflag != in.before.c_lflag);
    shows(&in, "Up/Down/PgUp/PgDn scroll");
    type(&in, "?");
    shows(&in, "scroll by a page");
    type(&in, "?p");
    shows(&in, "a command needs the token");
    type(&in, "\t");
    shows(&in, "[Gauges]");
    struct winsize size = {.ws_row = 40, .ws_col = 160};
    assert_int_equal(ioctl(in.terminal, TIOCSWINSZ, &size), 0);
    shows(&in, "\x1b[40;"); /* it draws in the last row of the larger terminal */
    type(&in, "q");
    shows(&in, LEAVE);
    ends(&in, 0);
}

static void ctrl_c_restores_the_terminal(void **unused)
{
    (void)unused;
    const session in = begin(NULL);
    shows(&in, "waiting for a run");
    type(&in, "\x03");
    shows(&in, LEAVE);
    ends(&in, 0);
}

static void a_crash_restores_the_terminal_and_restarts(void **unused)
{
    (void)unused;
    const session in = begin(NULL);
    shows(&in, "scroll");
    const pid_t first = drawing_process(&in);
    kill(first, SIGABRT); /* no sanitizer handles it */
    shows(&in, LEAVE);
    shows(&in, "restarting it");
    shows(&in, ENTER);
    shows(&in, "receiver restarts 1");
    assert_true(drawing_process(&in) != first);
    type(&in, "q");
    shows(&in, LEAVE);
    ends(&in, 0);
}

static void a_killed_process_leaves_the_terminal_restored(void **unused)
{
    (void)unused;
    const session in = begin(NULL);
    shows(&in, "scroll");
    kill(drawing_process(&in), SIGKILL);
    shows(&in, LEAVE);
    ends(&in, 128 + SIGKILL);
}

/* "no data" is red where colours are allowed. */
static void no_colour_is_honoured(void **unused)
{
    (void)unused;
    const session both[] = {begin("1"), begin("")}; /* an empty value has no meaning */
    for (int allowed = 0; allowed < 2; allowed++) {
        const session in = both[allowed];
        length = searched = 0;
        *output = 0;
        shows(&in, "no data");
        assert_int_equal(strstr(output, "\x1b[31m") || strstr(output, "\x1b[1m\x1b[31m") ||
                             strstr(output, "\x1b[31m\x1b[1m"),
                         allowed);
        type(&in, "q");
        shows(&in, LEAVE);
        ends(&in, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keys_work_and_q_restores_the_terminal),
        cmocka_unit_test(ctrl_c_restores_the_terminal),
        cmocka_unit_test(a_crash_restores_the_terminal_and_restarts),
        cmocka_unit_test(a_killed_process_leaves_the_terminal_restored),
        cmocka_unit_test(no_colour_is_honoured),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
