/* Ctrl-C, SIGTERM and a closed terminal end a run between two steps, or before the first step, with all files complete.
 */
#include "program.h"

#include "../output/json_check.h"
#include "base/clock.h"
#include "base/memory.h"
#include "frame/frame.h"
#include "output/particles/pvd.h"
#include "output/particles/vtp.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static void wait_for_file(const char *name)
{
    for (double end = sb_clock() + 30; !exists(name) && sb_clock() < end;) usleep(2000);
    if (!exists(name)) fail_msg("no %s within 30 s", name);
}

/* Starts a very long run and waits until it has written `file` in its directory. `top` raises the top of the domain, so
   that no particle leaves through it before the run is stopped. */
static pid_t start_endless(const char *scene, const char *top, const char *run, const char *file)
{
    pid_t process = program_start((const char *const[]){"run", scene, "--out", run, "--set", "duration=1000", "--set",
                                                        top, "--set", "output.particle_interval=0.05", "--set",
                                                        "measure.interval=0.01", "--set", "render.video=true", NULL});
    char name[96];
    snprintf(name, sizeof name, "%s/%s", run, file);
    for (double end = sb_clock() + 30; !exists(name) && sb_clock() < end;) usleep(2000);
    if (!exists(name)) {
        kill(process, SIGKILL);
        fail_msg("no %s within 30 s", name);
    }
    return process;
}

/* Each line ends with a newline and has as many commas as the header. */
static void check_table(const char *name)
{
    char *text = text_of(name);
    size_t length = strlen(text), lines = 0, commas = 0, expected = 0;
    assert_true(length > 0 && text[length - 1] == '\n');
    for (const char *c = text; *c; c++) {
        commas += *c == ',';
        if (*c != '\n') continue;
        if (lines++ == 0) expected = commas;
        assert_int_equal(commas, expected);
        commas = 0;
    }
    assert_true(lines > 3);
    sb_free(text);
}

static void check_particles(const char *run, size_t count)
{
    sb_particle_list list = {0};
    sb_error error = {0};
    assert_int_equal(sb_pvd_read(in_folder("%s/particles.pvd", run), &list, &error), SB_OK);
    assert_true(list.count >= 3);
    for (size_t i = 0; i < list.count; i++) {
        sb_frame *frame = NULL;
        if (sb_vtp_read(in_folder("%s/%s", run, list.entries[i].file), &frame, &error) != SB_OK)
            fail_msg("%s", error.text);
        assert_int_equal(frame->count, count);
        sb_frame_release(frame);
    }
    /* There is no file that the list does not name. */
    assert_false(access(in_folder("%s/particles/%06zu.vtp", run, list.count + 1), F_OK) == 0);
    sb_particle_list_free(&list);
}

static void check_reports(const char *run, const char *last_event)
{
    char name[96];
    snprintf(name, sizeof name, "%s/summary.json", run);
    double simulated = json_number_of(name, "simulated_s");
    assert_true(simulated > 0.1 && simulated < 1000);
    char *text = text_of(name);
    assert_contains(text, "\"status\": \"interrupted\"");
    sb_free(text);
    snprintf(name, sizeof name, "%s/run.jsonl", run);
    text = text_of(name);
    size_t length = strlen(text);
    assert_true(length > 0 && text[length - 1] == '\n');
    text[length - 1] = '\0';
    const char *last = strrchr(text, '\n');
    assert_non_null(last);
    assert_true(json_valid(last + 1));
    assert_contains(last, last_event);
    assert_contains(last, "interrupted");
    sb_free(text);
}

static void check_stopped(const char *run, pid_t process, int signal_number, size_t particles)
{
    static const char *const tables[] = {"forces.csv", "gauges.csv", "probes.csv", "energy.csv"};
    assert_int_equal(kill(process, signal_number), 0);
    outcome o = program_finish(process);
    if (o.status != 128 + signal_number) fail_msg("exit status %d: %s", o.status, o.err);
    assert_one_line(o.err, "stopped by a signal at t = ");
    outcome_free(&o);
    for (size_t t = 0; t < sizeof tables / sizeof tables[0]; t++) {
        char name[96];
        snprintf(name, sizeof name, "%s/%s", run, tables[t]);
        check_table(name);
    }
    check_particles(run, particles);
    check_reports(run, "\"end\"");
    assert_false(any_ending(run, ".tmp"));
}

static void interrupt_ends_with_130(void **state)
{
    (void)state;
    pid_t process = start_endless("tank2.yaml", "domain.max=[2, 2]", "stopped", "particles/000003.vtp");
    check_stopped("stopped", process, SIGINT, 300);
}

static void terminate_ends_with_143(void **state)
{
    (void)state;
    pid_t process = start_endless("tank3.yaml", "domain.max=[2.6, 0.8, 2]", "ended", "frames/front/000003.png");
    check_stopped("ended", process, SIGTERM, 384);
    /* A run that is stopped makes no films. */
    assert_false(any_ending("ended", ".mp4"));
    char *log = text_of("ended/run.jsonl");
    assert_contains(log, "films: the run was stopped");
    sb_free(log);
    /* Each picture is complete: it has the last bytes of a PNG file. */
    for (int i = 1; i <= 3; i++) {
        char tail[12] = {0};
        FILE *file = fopen(in_folder("ended/frames/side/%06d.png", i), "rb");
        assert_non_null(file);
        assert_int_equal(fseek(file, -8, SEEK_END), 0);
        assert_int_equal(fread(tail, 1, 8, file), 8);
        fclose(file);
        assert_memory_equal(tail, "IEND\xae\x42\x60\x82", 8);
    }
}

/* Waits until `file` contains `event`. */
static void wait_for(const char *file, const char *event)
{
    bool there = false;
    for (double end = sb_clock() + 30; !there && sb_clock() < end; usleep(2000)) {
        if (!exists(file)) continue;
        char *text = text_of(file);
        there = strstr(text, event) != NULL;
        sb_free(text);
    }
    assert_true(there);
    usleep(500000);
}

static void check_stops_soon(pid_t process, const char *expected)
{
    static const double PROMPT = 20; /* s; a settling step may take a second with sanitizers */
    const double sent = sb_clock();
    assert_int_equal(kill(process, SIGTERM), 0);
    outcome o = program_finish(process);
    if (sb_clock() - sent > PROMPT) fail_msg("it took %g s to stop", sb_clock() - sent);
    if (o.status != 128 + SIGTERM) fail_msg("exit status %d: %s", o.status, o.err);
    assert_one_line(o.err, expected);
    outcome_free(&o);
}

/* A signal also stops a run long before its first step. Until the model is built, an earlier run's files stay. */
static void a_signal_stops_building_the_model(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "early", "--quiet", "--until", "0.02");
    char *log = text_of("early/run.jsonl"), *forces = text_of("early/forces.csv");
    pid_t process = program_start((const char *const[]){"run", "tank3.yaml", "--out", "early", "--overwrite", "--set",
                                                        "resolution=0.004", NULL}); /* building it takes seconds */
    usleep(800000);
    check_stops_soon(process, "stopped by a signal while the model was built: nothing is computed yet");
    char *log_then = text_of("early/run.jsonl"), *forces_then = text_of("early/forces.csv");
    assert_string_equal(log, log_then);
    assert_string_equal(forces, forces_then);
    sb_free(log);
    sb_free(forces);
    sb_free(log_then);
    sb_free(forces_then);
}

static void a_signal_stops_settling(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "early", "--quiet", "--overwrite", "--until", "0.02");
    assert_int_equal(unlink(in_folder("early/run.jsonl")), 0);
    pid_t process =
        program_start((const char *const[]){"run", "tank2.yaml", "--out", "early", "--overwrite", "--set",
                                            "domain.max=[250, 1]", "--set", "water.boxes[0].max=[225, 0.6]", NULL});
    wait_for("early/run.jsonl", "\"start\"");
    check_stops_soon(process, "stopped by a signal while the water came to rest: nothing is computed yet");
    char *log = text_of("early/run.jsonl");
    assert_contains(log, "\"interrupted\"");
    sb_free(log);
    assert_false(any_ending("early", ".tmp"));
    /* Only its own summary is there, without tables of the earlier run. */
    char *text = text_of("early/summary.json");
    assert_contains(text, "\"interrupted\"");
    sb_free(text);
    assert_false(exists("early/forces.csv") || exists("early/energy.csv") || exists("early/particles.pvd"));
}

/* A terminal that closes may send the signal several times. */
static void a_closed_terminal_ends_with_129(void **state)
{
    (void)state;
    pid_t process = start_endless("tank2.yaml", "domain.max=[2, 2]", "hung", "particles/000003.vtp");
    for (int k = 0; k < 5; k++) assert_int_equal(kill(process, SIGHUP), 0);
    check_stopped("hung", process, SIGHUP, 300);
}

static void nohup_is_respected(void **state)
{
    (void)state;
    signal(SIGHUP, SIG_IGN); /* inherited */
    pid_t process = start_endless("tank2.yaml", "domain.max=[2, 2]", "kept", "particles/000003.vtp");
    signal(SIGHUP, SIG_DFL);
    assert_int_equal(kill(process, SIGHUP), 0);
    wait_for_file("kept/particles/000012.vtp");
    check_stopped("kept", process, SIGTERM, 300);
}

/* The reader of the progress is gone: a run continues to its end, or saves its state when a signal stops it. */
static void a_run_without_readers_continues(void **state)
{
    (void)state;
    pid_t process = program_start_without_reader((const char *const[]){"run", "tank2.yaml", "--out", "alone", NULL});
    outcome o = program_finish(process);
    assert_int_equal(o.status, 0);
    outcome_free(&o);
    char *summary = text_of("alone/summary.json");
    assert_contains(summary, "\"status\": \"done\"");
    sb_free(summary);

    process = program_start_without_reader(
        (const char *const[]){"run", "tank2.yaml", "--out", "alone", "--until", "1000", "--resume", NULL});
    wait_for_file("alone/particles/000008.vtp");
    assert_int_equal(kill(process, SIGINT), 0);
    o = program_finish(process);
    assert_int_equal(o.status, 128 + SIGINT);
    outcome_free(&o);
    check_reports("alone", "\"end\"");
    const double end = json_number_of("alone/summary.json", "simulated_s");
    char until[32];
    snprintf(until, sizeof until, "%.12g", end * (1 - 1e-6)); /* rounded up, it would need one more step */
    o = RUN(0, "run", "tank2.yaml", "--out", "alone", "--until", until, "--resume");
    assert_contains(o.out, "resuming from step ");
    outcome_free(&o);
    assert_near(json_number_of("alone/summary.json", "simulated_s"), end, 0); /* its state was saved */
}

static void write_program(const char *name, const char *text)
{
    write_text(name, text);
    assert_int_equal(chmod(in_folder("%s", name), 0700), 0);
}

/* A signal stops a run while it makes films; the films are made when the run is resumed. */
static void films_are_stopped_and_made_later(void **state)
{
    (void)state;
    char path[4200];
    const char *before = getenv("PATH");
    assert_int_equal(mkdir(in_folder("bin"), 0700), 0);
    write_program("bin/ffmpeg", "#!/bin/sh\ntouch begun\nsleep 200\n");
    snprintf(path, sizeof path, "%s:%s", in_folder("bin"), before);
    char *kept = sb_strdup(before);
    setenv("PATH", path, 1);
    const double began = sb_clock();
    pid_t process = program_start(
        (const char *const[]){"run", "tank3.yaml", "--out", "filmed", "--set", "render.video=true", NULL});
    wait_for_file("filmed/begun");
    assert_int_equal(kill(process, SIGTERM), 0);
    outcome o = program_finish(process);
    assert_int_equal(o.status, 128 + SIGTERM);
    assert_contains(o.err, "stopped by a signal while films were made");
    outcome_free(&o);
    assert_true(sb_clock() - began < 100);
    assert_false(exists("filmed/side.mp4"));
    write_program("bin/ffmpeg", "#!/bin/sh\nfor last; do :; done\necho film > \"${last#file:}\"\n");
    o = RUN(0, "run", "tank3.yaml", "--out", "filmed", "--set", "render.video=true", "--resume");
    outcome_free(&o);
    assert_true(exists("filmed/side.mp4") && exists("filmed/front.mp4"));
    setenv("PATH", kept, 1);
    sb_free(kept);
}

/* The particle files of a stopped run can be drawn. */
static void a_stopped_run_can_be_drawn(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "render", "ended", "--camera", "side", "--out", "drawn", "--quiet");
    assert_true(exists("drawn/frames/side/000001.png"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(interrupt_ends_with_130),           cmocka_unit_test(terminate_ends_with_143),
        cmocka_unit_test(a_stopped_run_can_be_drawn),        cmocka_unit_test(films_are_stopped_and_made_later),
        cmocka_unit_test(a_signal_stops_building_the_model), cmocka_unit_test(a_signal_stops_settling),
        cmocka_unit_test(a_closed_terminal_ends_with_129),   cmocka_unit_test(nohup_is_respected),
        cmocka_unit_test(a_run_without_readers_continues),
    };
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
