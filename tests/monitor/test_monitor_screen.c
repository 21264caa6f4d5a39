/* What a terminal shows of a recorded run: a real one, tmux, is read back at several sizes. Skipped without tmux. */
#include "stream/stream_fixture.h"

#include "base/clock.h"
#include "base/file.h"

#include <math.h>
#include <stdlib.h>
#include <unistd.h>

static char folder[] = "/tmp/sb-screen-XXXXXX";
static char screen[1 << 16];

/* Runs a command of tmux, with a server of this test, and keeps its output in `screen`. */
static int tmux(const char *arguments)
{
    char command[1024];
    snprintf(command, sizeof command, "tmux -S %s/socket -f /dev/null %s 2>/dev/null", folder, arguments);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    const size_t length = fread(screen, 1, sizeof screen - 1, pipe);
    screen[length] = 0;
    return pclose(pipe);
}

/* Repeats the last message of the log, recorded 1000 s later, so that a player of the log does not end. */
static void extend_log(const char *path)
{
    enum { HEAD = 28, TIME = 12 };
    char *log;
    size_t size, last = 0;
    assert_int_equal(sb_file_read(path, 1 << 24, &log, &size, NULL), SB_OK);
    for (size_t at = 0; at + HEAD <= size;) {
        uint32_t lengths[2];
        memcpy(lengths, log + at + 20, sizeof lengths);
        last = at;
        at += HEAD + __builtin_bswap32(lengths[0]) + __builtin_bswap32(lengths[1]);
    }
    uint64_t time;
    memcpy(&time, log + last + TIME, sizeof time);
    time = __builtin_bswap64(__builtin_bswap64(time) + 1000000000);
    memcpy(log + last + TIME, &time, sizeof time);
    FILE *file = fopen(path, "ab");
    assert_non_null(file);
    assert_int_equal(fwrite(log + last, 1, size - last, file), size - last);
    assert_int_equal(fclose(file), 0);
    sb_free(log);
}

static int record_log(void **unused)
{
    (void)unused;
    if (!mkdtemp(folder)) return -1;
    char url[128], path[64];
    snprintf(path, sizeof path, "%s/log", folder);
    snprintf(url, sizeof url, "file://%s?mode=w", path);
    sb_stream *stream = fixture_stream(url, 0, 1);
    fixture_scene f;
    fixture_scene_make(&f, 30, 2);
    if (sb_stream_set_scene(stream, &f.scene, &f.model, NULL) != SB_OK) return -1;
    sb_frame *frame = fixture_frame(1, 45, 5000, 30);
    sb_force_record forces[30] = {0};
    for (size_t i = 0; i < 30; i++)
        forces[i] = (sb_force_record){.body = i, .time = 45, .force = sb_vec(3e6 * (double)(i + 1), 0, 0)};
    const sb_measure_records rows = {.force_count = 30, .forces = forces};
    sb_stream_measure(stream, &rows);
    fixture_publish(stream, frame);
    sb_frame_release(frame);
    sb_stream_destroy(stream);
    fixture_scene_free(&f);
    extend_log(path);
    return 0;
}

static int end(void **unused)
{
    (void)unused;
    tmux("kill-server");
    char command[128];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

/* Reads the terminal until it shows the text, for at most 5 s. */
static void shows(const char *text)
{
    const double until = sb_clock() + 5;
    do {
        usleep(50000);
        tmux("capture-pane -p -t monitor");
        if (strstr(screen, text)) return;
    } while (sb_clock() < until);
    fail_msg("\"%s\" is not on the screen:\n%s", text, screen);
}

/* The row (from 0) of the screen that begins with the text, or -1. */
static int row_of(const char *text)
{
    int row = 0;
    for (const char *at = screen; *at; row++) {
        if (strncmp(at, text, strlen(text)) == 0) return row;
        const char *newline = strchr(at, '\n');
        if (!newline) break;
        at = newline + 1;
    }
    return -1;
}

static void begin(const char *locale)
{
    char command[512];
    if (system("command -v tmux >/dev/null 2>&1") != 0) {
        print_message("tmux is not installed\n");
        skip();
    }
    tmux("kill-server");
    snprintf(command, sizeof command,
             "-u new-session -d -s monitor -x 80 -y 24 \"LC_ALL=%s '%s/shorebreak-monitor' --prefix test --url "
             "'file://%s/log?speed=1'; echo it ended with $?; sleep 20\"",
             locale, SB_BINARY_DIR, folder);
    int failed = 1;
    for (const double until = sb_clock() + 5; failed && sb_clock() < until; usleep(100000))
        failed = tmux(command); /* the server before may not have ended yet */
    assert_int_equal(failed, 0);
}

static void a_resized_terminal_shows_a_fitting_screen(void **unused)
{
    (void)unused;
    begin("C.UTF-8");
    shows("building-13");
    assert_int_equal(row_of("shorebreak  a run  "), 0);
    assert_int_equal(row_of("█████████████·············  50.0 %  45.00 of 90.00 s  ETA 33 s"), 1);
    assert_int_equal(row_of("[Forces] Gauges  Stages  Solver  Stream"), 6);
    assert_int_equal(row_of("building-0           █ "), 8);
    assert_int_equal(row_of("q quit  ? help"), 23);
    tmux("resize-window -t monitor -x 40 -y 12");
    shows("[Forces]               rows 1 to 6 of 30");
    assert_int_equal(row_of("a run  "), 0);
    assert_int_equal(row_of("[Forces] "), 3);
    assert_int_equal(row_of("q quit  ? help"), 11);
    assert_null(strstr(screen, "building-6"));
    tmux("send-keys -t monitor NPage");
    shows("rows 6 to 11 of 30");
    tmux("send-keys -t monitor End");
    shows("rows 25 to 30 of 30");
    tmux("resize-window -t monitor -x 200 -y 60");
    shows("building-0 ");
    assert_int_equal(row_of("building-29 "), 37);
    assert_int_equal(row_of("q quit  ? help"), 59);
    assert_non_null(strstr(screen, "Solver  "));
    tmux("resize-window -t monitor -x 80 -y 24");
    shows("rows 1 to 14 of 30");
    tmux("send-keys -t monitor BTab");
    shows("[Stream]");
    tmux("send-keys -t monitor p");
    shows("a command needs the token of the run");
    tmux("send-keys -t monitor q");
    shows("it ended with 0"); /* after the last values, as text */
    assert_non_null(strstr(screen, "building-29 "));
}

static void a_terminal_without_unicode_gets_ascii(void **unused)
{
    (void)unused;
    begin("C");
    shows("building-13");
    assert_int_equal(row_of("#############.............  50.0 %"), 1);
    assert_int_equal(row_of("building-0           @ "), 8);
    for (const char *at = screen; *at; at++) assert_in_range((unsigned char)*at, '\n', '~');
    tmux("send-keys -t monitor C-c");
    shows("it ended with 0");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_resized_terminal_shows_a_fitting_screen),
        cmocka_unit_test(a_terminal_without_unicode_gets_ascii),
    };
    return cmocka_run_group_tests(tests, record_log, end);
}
