/* Failures outside a run: the run continues, or stops with a reason, and all written files are complete. */
#include "program.h"

#include "../output/json_check.h"
#include "base/clock.h"
#include "base/memory.h"
#include "frame/frame.h"
#include "output/particles/pvd.h"
#include "output/particles/vtp.h"

#include <arpa/inet.h>
#include <ctype.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static void assert_ended(const char *summary, const char *expected)
{
    char *text = text_of(summary);
    assert_true(json_valid(text));
    assert_contains(text, expected);
    sb_free(text);
}

/* Starts a very long run and waits for its third particle file. */
static pid_t start_endless(const char *run, const char *more)
{
    pid_t process = program_start((const char *const[]){"run", "tank2.yaml", "--out", run, "--quiet", "--until", "1000",
                                                        "--set", "output.particle_interval=0.02", "--set",
                                                        more ? more : "measure.interval=0.05", NULL});
    char third[96];
    snprintf(third, sizeof third, "%s/particles/000003.vtp", run);
    for (double end = sb_clock() + 30; !exists(third) && sb_clock() < end;) usleep(2000);
    return process;
}

/* ---- subscribers ---- */

static uint32_t read_word(int from)
{
    uint32_t word = 0;
    if (recv(from, &word, sizeof word, MSG_WAITALL) != (ssize_t)sizeof word) _exit(1);
    return ntohl(word);
}

/* Accepts one publisher of LCM's TCP provider, completes the handshake, reads a little, then stops for good or ends. */
static _Noreturn void subscribe(int listening, bool dies)
{
    static char bytes[4096];
    prctl(PR_SET_PDEATHSIG, SIGKILL); /* a stopped process would outlive a failing test and keep its output open */
    int from = accept(listening, NULL, NULL);
    const uint32_t greeting[2] = {htonl(0x287617fa), htonl(0x0100)};
    if (from < 0 || read_word(from) != 0x287617fb || read_word(from) != 0x0100) _exit(1);
    if (send(from, greeting, sizeof greeting, 0) != (ssize_t)sizeof greeting) _exit(1);
    for (size_t got = 0; got < 1 << 14;) {
        ssize_t more = recv(from, bytes, sizeof bytes, 0);
        if (more <= 0) _exit(1);
        got += (size_t)more;
    }
    if (!dies) raise(SIGSTOP);
    _exit(0);
}

/* Opens a listening socket at *port. Its buffer is small, so that data that no one reads soon blocks the sender. */
static int start_listening(unsigned *port)
{
    struct sockaddr_in at = {.sin_family = AF_INET, .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    socklen_t size = sizeof at;
    const int small = 4096, listening = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    assert_true(listening >= 0);
    assert_int_equal(setsockopt(listening, SOL_SOCKET, SO_RCVBUF, &small, sizeof small), 0);
    assert_int_equal(bind(listening, (struct sockaddr *)&at, size), 0);
    assert_int_equal(listen(listening, 1), 0);
    assert_int_equal(getsockname(listening, (struct sockaddr *)&at, &size), 0);
    *port = ntohs(at.sin_port);
    return listening;
}

static pid_t start_subscriber(bool dies, unsigned *port)
{
    const int listening = start_listening(port);
    pid_t process = fork();
    assert_true(process >= 0);
    if (process == 0) subscribe(listening, dies);
    close(listening);
    return process;
}

static void check_subscriber(bool dies, const char *expected)
{
    unsigned port;
    char url[96];
    pid_t subscriber = start_subscriber(dies, &port);
    snprintf(url, sizeof url, "stream={enabled: true, url: 'tcpq://127.0.0.1:%u', interval: 0.001}", port);
    /* Frames of 130 kB, many more than the system's buffers hold. */
    outcome o = RUN(0, "run", "tank2.yaml", "--out", "streamed", "--quiet", "--overwrite", "--until", "0.2", "--set",
                    url, "--set", "resolution=0.01", "--set", "output.particle_interval=0.05");
    char *log = text_of("streamed/run.jsonl");
    assert_contains(log, expected);
    assert_contains(log, "\"status\":\"done\"");
    sb_free(log);
    outcome_free(&o);
    kill(subscriber, SIGKILL);
    assert_int_equal(waitpid(subscriber, NULL, 0), subscriber);
    assert_near(json_number_of("streamed/summary.json", "particle_files"), 5, 0);
}

static void a_subscriber_that_stops(void **state)
{
    (void)state;
    check_subscriber(
        false, "stream: timed out after 5 s: the receiver accepts no more data, and the last frames are not sent");
}

static void a_subscriber_that_dies(void **state)
{
    (void)state;
    check_subscriber(true, "stream: the provider refused messages at t = ");
}

/* The system accepts the connection, but there is no handshake, as with a server that was stopped before the run. */
static void a_peer_that_never_answers(void **state)
{
    (void)state;
    unsigned port;
    char url[96];
    const int listening = start_listening(&port);
    snprintf(url, sizeof url, "stream={enabled: true, url: 'tcpq://127.0.0.1:%u'}", port);
    outcome o = RUN(0, "run", "tank2.yaml", "--out", "mute", "--quiet", "--set", url);
    close(listening);
    assert_contains(o.err, "warning: LCM cannot open \"tcpq://127.0.0.1:");
    assert_contains(o.err, "no answer within 5 s");
    outcome_free(&o);
    assert_ended("mute/summary.json", "\"done\"");
    assert_near(json_number_of("mute/summary.json", "particle_files"), 4, 0);
}

/* A scene may use each provider that the warning suggests. */
static void suggested_providers_are_accepted(void **state)
{
    (void)state;
    outcome o = RUN(0, "run", "tank2.yaml", "--out", "nowhere", "--quiet", "--until", "0.1", "--set",
                    "stream={enabled: true, url: 'carrier-pigeon://here'}");
    const char *at = strstr(o.err, "; expected ");
    assert_contains(o.err, "warning: LCM cannot open \"carrier-pigeon://here\"");
    assert_non_null(at);
    size_t found = 0;
    for (const char *scheme; (scheme = strstr(at, "://")); found++) {
        char url[160];
        while (scheme[-1] >= 'a' && scheme[-1] <= 'z') scheme--;
        const int length = (int)strcspn(scheme, " ,;\n");
        snprintf(url, sizeof url, "stream={enabled: true, url: '%.*s'}", length, scheme);
        RUN_AND_FORGET(0, "check", "tank2.yaml", "--set", url);
        at = scheme + length;
    }
    assert_true(found >= 2);
    outcome_free(&o);
}

/* ---- threads ---- */

/* The OpenMP library ends the process itself, with the exit status of bad input. */
static void a_thread_that_is_refused(void **state)
{
    (void)state;
    assert_int_equal(setenv("OMP_STACKSIZE", "900000G", 1), 0);
    outcome o = program_run((const char *const[]){"run", "tank2.yaml", "--out", "threads", "--threads", "4", NULL});
    unsetenv("OMP_STACKSIZE");
    assert_int_equal(o.status, 2);
    assert_contains(o.err, "shorebreak: a library ended the program for the reason above");
    outcome_free(&o);
}

/* ---- pictures ---- */

/* The run continues to its end without pictures and reports why. All other files exist. */
static void check_no_pictures(const char *run, const char *expected)
{
    char name[96];
    outcome o = RUN(2, "run", "tank3.yaml", "--out", run, "--quiet");
    assert_contains(o.err, expected);
    outcome_free(&o);
    snprintf(name, sizeof name, "%s/summary.json", run);
    assert_ended(name, expected);
    assert_near(json_number_of(name, "particle_files"), 4, 0);
    assert_near(json_number_of(name, "pictures"), 0, 0);
    assert_true(json_number_of(name, "simulated_s") > 0.29);
    assert_false(any_ending(run, ".tmp"));
}

static void no_graphics_library(void **state)
{
    (void)state;
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
    skip(); /* the sanitizer has its own search path */
#endif
    char before[1024];
    const char *path = getenv("LD_LIBRARY_PATH");
    snprintf(before, sizeof before, "%s", path ? path : "");
    assert_int_equal(mkdir(in_folder("broken"), 0700), 0);
    write_text("broken/libOSMesa.so.8", "no library\n");
    assert_int_equal(setenv("LD_LIBRARY_PATH", in_folder("broken"), 1), 0);
    check_no_pictures("bare", "pictures: pictures cannot be drawn without OSMesa: ");
    setenv("LD_LIBRARY_PATH", before, 1);
}

/* ---- disks ---- */

static void no_room_for_particle_files(void **state)
{
    (void)state;
    /* 300 particles take 15 kB; log and tables stay below 12. */
    static const char *const arguments[] = {
        "run", "tank2.yaml", "--out", "tight", "--quiet", "--set", "output.checkpoint.minutes=0", NULL};
    outcome o = program_run_limited(12000, arguments);
    if (o.status != 2) fail_msg("exit status %d: %s", o.status, o.err);
    assert_contains(o.err, "particle files: tight/particles/000001.vtp: cannot write: File too large");
    outcome_free(&o);
    assert_ended("tight/summary.json", "\"failed\"");
    assert_true(json_number_of("tight/summary.json", "simulated_s") > 0.29);
    assert_false(exists("tight/particles/000001.vtp"));
    assert_false(exists("tight/particles.pvd"));
    assert_false(any_ending("tight", ".tmp"));
}

static void no_room_for_pictures(void **state)
{
    (void)state;
    static const char *const arguments[] = {"run",
                                            "tank3.yaml",
                                            "--out",
                                            "narrow",
                                            "--quiet",
                                            "--set",
                                            "render.width=1280",
                                            "--set",
                                            "render.height=720",
                                            "--set",
                                            "output.checkpoint.minutes=0",
                                            NULL};
    outcome o = program_run_limited(40000, arguments);
    if (o.status != 2) fail_msg("exit status %d: %s", o.status, o.err);
    assert_contains(o.err, "pictures: narrow/frames/side/000001.png: ");
    assert_contains(o.err, "cannot write: ");
    outcome_free(&o);
    assert_near(json_number_of("narrow/summary.json", "particle_files"), 4, 0);
    assert_false(any_ending("narrow", ".png"));
    assert_false(any_ending("narrow", ".tmp"));
}

/* In a place where not even root can make a directory, the run is refused in one line before anything is computed. */
static void a_directory_that_cannot_be_made(void **state)
{
    (void)state;
    outcome o = RUN(2, "run", "tank2.yaml", "--out", "/proc/none", "--quiet", "--until", "1000");
    assert_one_line(o.err, "/proc/none: cannot make directory");
    outcome_free(&o);
    o = RUN(1, "run", "tank2.yaml", "--out", "/dev/null/run", "--quiet", "--until", "1000");
    assert_one_line(o.err, "/dev/null: is not a directory, expected one");
    outcome_free(&o);
}

/* The directory is removed during the run: the run stops and reports it. */
static void a_directory_that_is_removed(void **state)
{
    (void)state;
    char command[2200];
    pid_t process = start_endless("brief", NULL);
    snprintf(command, sizeof command, "for turn in 1 2 3 4 5 6; do rm -rf '%s' 2>/dev/null && exit 0; done; exit 1",
             in_folder("brief"));
    assert_int_equal(system(command), 0);
    outcome o = program_finish(process);
    assert_int_equal(o.status, 2);
    assert_contains(o.err, "shorebreak: brief/");
    assert_true(strstr(o.err, "was removed while the run wrote it") || strstr(o.err, "No such file or directory"));
    outcome_free(&o);
}

/* Suspends the process while no file of its run is half written, because such a file would keep its temporary name. */
static void hold_between_files(pid_t process, const char *run)
{
    for (double end = sb_clock() + 30; sb_clock() < end; usleep(1000)) {
        int how = 0;
        assert_int_equal(kill(process, SIGSTOP), 0);
        assert_int_equal(waitpid(process, &how, WUNTRACED), process);
        assert_true(WIFSTOPPED(how));
        if (!any_ending(run, ".tmp")) return;
        assert_int_equal(kill(process, SIGCONT), 0);
    }
    kill(process, SIGKILL);
    fail_msg("%s: a file is always half written", run);
}

/* Waits until the file contains the text, also on a busy machine. */
static void wait_for_text(const char *log, const char *expected)
{
    bool there = false;
    for (double end = sb_clock() + 30; !there && sb_clock() < end; usleep(20000)) {
        char *text = text_of(log);
        there = strstr(text, expected);
        sb_free(text);
    }
    assert_true(there);
}

/* The directory is moved: particle files no longer have a folder. The files that exist are complete. */
static void a_directory_that_moves(void **state)
{
    (void)state;
    pid_t process = start_endless("here", NULL);
    hold_between_files(process, "here");
    assert_int_equal(rename(in_folder("here"), in_folder("there")), 0);
    assert_int_equal(kill(process, SIGCONT), 0);
    wait_for_text("there/run.jsonl", "particle files: here/particles");
    kill(process, SIGTERM);
    outcome o = program_finish(process);
    assert_true(o.status == 2);
    assert_contains(o.err, "particle files: here/particles");
    outcome_free(&o);
    assert_false(any_ending("there", ".tmp"));
    sb_particle_list list = {0};
    sb_error error = {0};
    assert_int_equal(sb_pvd_read(in_folder("there/particles.pvd"), &list, &error), SB_OK);
    for (size_t i = 0; i < list.count; i++) {
        sb_frame *frame = NULL;
        assert_int_equal(sb_vtp_read(in_folder("there/%s", list.entries[i].file), &frame, &error), SB_OK);
        sb_frame_release(frame);
    }
    sb_particle_list_free(&list);
}

/* ---- closed streams ---- */

/* Messages are lost, and are not written into the first files that the run opens. */
static void closed_standard_streams_damage_no_file(void **state)
{
    (void)state;
    char command[2200];
    snprintf(command, sizeof command, "cd '%s' && exec '%s/shorebreak' run tank2.yaml --out unheard <&- >&- 2>&-",
             in_folder("."), SB_BINARY_DIR);
    assert_int_equal(system(command), 0);
    char *log = text_of("unheard/run.jsonl");
    size_t lines = 0;
    for (char *line = log, *end; (end = strchr(line, '\n')); line = end + 1, lines++) {
        *end = '\0';
        if (!json_valid(line)) fail_msg("line %zu of the log: %s", lines + 1, line);
    }
    assert_true(lines > 3);
    sb_free(log);
    static const char *const tables[] = {"forces.csv", "gauges.csv", "probes.csv", "energy.csv"};
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++) {
        char name[64];
        snprintf(name, sizeof name, "unheard/%s", tables[i]);
        char *table = text_of(name);
        assert_null(strstr(table, "shorebreak"));
        sb_free(table);
    }
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "unheard", "--resume");
}

/* ---- clocks ---- */

static void copy_hash(const char *summary, char hash[32])
{
    char *text = text_of(summary);
    const char *at = json_find(text, "state_hash");
    assert_non_null(at);
    assert_int_equal(sscanf(at, "\"%31[0-9a-f]\"", hash), 1);
    sb_free(text);
}

/* The time of day jumps by half a day at each call: no checkpoint is early or late, no reported time contains the
   jumps, and the state is the same. */
static void a_clock_that_jumps(void **state)
{
    (void)state;
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
    skip(); /* a sanitizer's library must be loaded first */
#endif
    char hash[2][32];
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "steady", "--set", "output.checkpoint.minutes=600");
    assert_int_equal(setenv("LD_PRELOAD", SB_BINARY_DIR "/libjumping_clock.so", 1), 0);
    outcome o = RUN(0, "run", "tank2.yaml", "--out", "jumping", "--set", "output.checkpoint.minutes=600");
    unsetenv("LD_PRELOAD");
    assert_non_null(strstr(o.out, "s elapsed, "));
    for (const char *at = o.out; (at = strstr(at, "h ")); at++)
        assert_false(at > o.out && isdigit((unsigned char)at[-1]));
    outcome_free(&o);
    copy_hash("steady/summary.json", hash[0]);
    copy_hash("jumping/summary.json", hash[1]);
    assert_string_equal(hash[0], hash[1]);
    assert_true(json_number_of("jumping/summary.json", "wall_s") < 60);
    char *log = text_of("jumping/run.jsonl");
    const char *first = strstr(log, "\"event\":\"checkpoint\"");
    assert_non_null(first);
    assert_null(strstr(first + 1, "\"event\":\"checkpoint\"")); /* the one at the end */
    sb_free(log);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_subscriber_that_stops),
        cmocka_unit_test(a_subscriber_that_dies),
        cmocka_unit_test(a_peer_that_never_answers),
        cmocka_unit_test(suggested_providers_are_accepted),
        cmocka_unit_test(a_thread_that_is_refused),
        cmocka_unit_test(no_graphics_library),
        cmocka_unit_test(no_room_for_particle_files),
        cmocka_unit_test(no_room_for_pictures),
        cmocka_unit_test(a_directory_that_cannot_be_made),
        cmocka_unit_test(a_directory_that_is_removed),
        cmocka_unit_test(a_directory_that_moves),
        cmocka_unit_test(closed_standard_streams_damage_no_file),
        cmocka_unit_test(a_clock_that_jumps),
    };
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
