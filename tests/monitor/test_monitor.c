/* Runs the monitor program with a log, without a terminal, and with bad options. */
#include "stream/forged.h"
#include "stream/stream_fixture.h"

#include "base/clock.h"
#include "base/hash.h"

#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

enum { STRAY_PORT = 7671 };

static char output[1 << 16]; /* stdout and stderr of the last run */
static char log_path[] = "/tmp/sb-monitor-XXXXXX";
static char log_url[64];

/* Runs the monitor with these arguments. Returns its exit code, or 128 + signal if it was killed. */
static int monitor(const char *arguments)
{
    char command[512];
    snprintf(command, sizeof command, "exec '%s/shorebreak-monitor' %s 2>&1", SB_BINARY_DIR, arguments);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    size_t length = fread(output, 1, sizeof output - 1, pipe);
    output[length] = 0;
    int status = pclose(pipe);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

static void shows(const char *text)
{
    if (!strstr(output, text)) fail_msg("\"%s\" is not in:\n%s", text, output);
}

static void shows_not(const char *text)
{
    if (strstr(output, text)) fail_msg("\"%s\" is in:\n%s", text, output);
}

/* Records two frames of a run, each followed by invalid messages on the same channels. */
static int record_log(void **state)
{
    (void)state;
    int file = mkstemp(log_path);
    if (file < 0) return -1;
    close(file);
    char url[64];
    snprintf(url, sizeof url, "file://%s?mode=w", log_path);
    snprintf(log_url, sizeof log_url, "'file://%s?speed=0'", log_path);
    fixture_scene f;
    fixture_scene_make(&f, 6, 2);
    snprintf(f.model.bodies[0].name, sizeof f.model.bodies[0].name, "reactor\x1b[31m");
    sb_stream *stream = fixture_stream(url, 0, 1);
    if (sb_stream_set_scene(stream, &f.scene, &f.model, NULL) != SB_OK) return -1;
    lcm_t *lcm = sb_stream_provider(stream);
    for (uint64_t index = 1; index <= 2; index++) {
        sb_frame *frame = fixture_frame(index, 22.5 * (double)index, 5000, 5);
        sb_force_record forces[4] = {{.body = 0}, {.body = 1}, {.body = 3}, {.body = 4}};
        for (size_t i = 0; i < 4; i++) {
            forces[i].time = frame->status.time;
            forces[i].force =
                i == 0 ? sb_vec(-3e6 * (double)(3 - index), 4e6 * (double)(3 - index), 7e6) : sb_vec(1e6, 0, 0);
        }
        const sb_gauge_record gauges[2] = {
            {.gauge = 0, .time = frame->status.time, .eta = (double)NAN, .z = (double)NAN},
            {.gauge = 1, .time = frame->status.time, .eta = (double)index}};
        const sb_measure_records rows = {.force_count = 4, .forces = forces, .gauge_count = 2, .gauges = gauges};
        sb_stream_measure(stream, &rows);
        fixture_publish(stream, frame);
        sb_frame_release(frame);
        unsigned char invalid[300];
        for (size_t i = 0; i < sizeof invalid; i++) invalid[i] = (unsigned char)sb_hash_mix(i);
        lcm_publish(lcm, "test_status", invalid, sizeof invalid);
        lcm_publish(lcm, "test_forces", invalid, 7);
        lcm_publish(lcm, "test_frame", invalid, 0);
    }
    sb_stream_destroy(stream);
    fixture_scene_free(&f);
    return 0;
}

static int remove_log(void **state)
{
    (void)state;
    return unlink(log_path);
}

static void shows_a_recorded_run(void **state)
{
    (void)state;
    char arguments[200];
    snprintf(arguments, sizeof arguments, "--prefix test --plain --url %s", log_url);
    assert_int_equal(monitor(arguments), 0);
    shows("a run");
    shows(" 50.0 %  45.00 of 90.00 s  ETA 33 s");
    shows("step 1236  dt 3.1 ms  particles 5000  lost particles 3");
    shows("iterations 17 @@  density error 0.04 of 0.1 % @@  max speed 21.25 m/s");
    shows("messages lost 0  refused 6  frames 2 complete, 0 partial  repaired 0");
    shows("|Fxy| MN");
    /* The force is |(-3, 4)| = 5 now, half of the peak. The escape sequence in the name is replaced. */
    shows("reactor?[31m         @+                  5.00      10.00      22.50      -3.00      +4.00      +7.00");
    shows("gauge-1              _@");
    shows("building-4");
    shows_not("building-2"); /* not reported */
    shows_not("\x1b");
}

static void once_shows_the_first_status(void **state)
{
    (void)state;
    char arguments[200];
    snprintf(arguments, sizeof arguments, "--prefix test --once --url %s", log_url);
    assert_int_equal(monitor(arguments), 0);
    shows(" 25.0 %  22.50 of 90.00 s");
    shows("frames 1 complete");
    shows("10.00      10.00      22.50      -6.00      +8.00      +7.00");
    snprintf(arguments, sizeof arguments, "--prefix other --once --url %s", log_url);
    assert_int_equal(monitor(arguments), 1);
    shows("no status message received");
}

static void options_are_checked(void **state)
{
    (void)state;
    assert_int_equal(monitor("--help"), 0);
    shows("--duration S");
    assert_int_equal(monitor("--version"), 0);
    shows("shorebreak-monitor " SB_VERSION);
    assert_int_equal(monitor("--duration 3s"), 1);
    shows("--duration: \"3s\" is not a number");
    assert_int_equal(monitor("--duration nan"), 1);
    assert_int_equal(monitor("--url"), 1);
    shows("--url: a value is missing");
    assert_int_equal(monitor("--run a --token-file b"), 1);
    shows("--run and --token-file: only one of them");
    assert_int_equal(monitor("--colour"), 1);
    shows("--colour: unknown option");
    assert_int_equal(monitor("--url udpm://999.1.1.1:7667"), 1);
    shows("ip link set lo multicast on; ip route add 224.0.0.0/4 dev lo");
}

static void reports_when_no_data_arrive(void **state)
{
    (void)state;
    assert_int_equal(monitor("--url memq:// --plain --duration 3.5"), 0);
    assert_string_equal(output, "no data for 3 s\n");
}

/* Skipped where the monitor ends because there is no multicast route. */
static void restarts_after_a_crash_of_its_receiver(void **state)
{
    (void)state;
    const pid_t sender = fork();
    if (sender == 0) {
        usleep(700000);
        send_forged_packets("239.255.76.68", STRAY_PORT, "shorebreak_status");
        _exit(0);
    }
    char options[128];
    snprintf(options, sizeof options, "--plain --duration 2.5 --url 'udpm://239.255.76.68:%d?ttl=0'", STRAY_PORT);
    const double begun = sb_clock();
    const int code = monitor(options);
    waitpid(sender, NULL, 0);
    if (code == 1 && strstr(output, "multicast")) skip();
    assert_int_equal(code, 0);
    assert_true(sb_clock() - begun >= 2.4);
    if (!strstr(output, "restarting it")) print_message("this version of LCM does not crash on forged packets\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shows_a_recorded_run),
        cmocka_unit_test(once_shows_the_first_status),
        cmocka_unit_test(options_are_checked),
        cmocka_unit_test(reports_when_no_data_arrive),
        cmocka_unit_test(restarts_after_a_crash_of_its_receiver),
    };
    return cmocka_run_group_tests(tests, record_log, remove_log);
}
