/* Frames that cannot be written are reported when it happens, later frames are tried, and the failure is kept. */
#include "program.h"

#include "../output/json_check.h"
#include "base/clock.h"
#include "base/memory.h"
#include "output/particles/pvd.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

/* Limits the length of the process's files from now on: tables and log fit, a particle file does not. */
static void limit_files(pid_t process, rlim_t bytes)
{
    const struct rlimit limit = {bytes, RLIM_INFINITY};
    assert_int_equal(prlimit(process, RLIMIT_FSIZE, &limit, NULL), 0);
}

static void wait_for(const char *name, const char *expected)
{
    for (double end = sb_clock() + 60; sb_clock() < end; usleep(2000)) {
        char *text = exists(name) ? text_of(name) : NULL;
        const bool there = text && strstr(text, expected);
        sb_free(text);
        if (there) return;
    }
    fail_msg("no \"%s\" in %s within a minute", expected, name);
}

static void check_summary(const char *expected)
{
    char *text = text_of("short/summary.json");
    assert_contains(text, "\"status\": \"failed\"");
    assert_contains(text, expected);
    sb_free(text);
}

/* The disk is full for a while: the frames of that time are missing, later ones exist. The run reports it at once, and
   again whenever it is resumed. */
static void a_disk_that_is_full_for_a_while(void **state)
{
    (void)state;
    static const char again[] = "particle files: written again; ", reason[] = ": cannot write: File too large; ";
    char until[64], expected[96];
    const pid_t process = program_start((const char *const[]){
        "run", "tank2.yaml", "--out", "short", "--quiet", "--until", "1000", "--set", "resolution=0.02", "--set",
        "output.particle_interval=0.02", "--set", "domain.max=[2, 2]", NULL});
    for (double end = sb_clock() + 30; !exists("short/particles/000003.vtp") && sb_clock() < end;) usleep(2000);
    limit_files(process, 40000); /* 1200 particles take 60 kB */
    wait_for("stderr.txt", reason);
    limit_files(process, RLIM_INFINITY);
    wait_for("short/run.jsonl", again);
    assert_int_equal(kill(process, SIGTERM), 0);
    outcome o = program_finish(process);
    assert_int_equal(o.status, 2);
    assert_contains(o.err, "shorebreak: warning: particle files: short/particles/");
    assert_contains(o.err, "the run continues, and each later frame is tried\n");
    const char *first = strstr(o.err, reason);
    assert_non_null(first);
    assert_null(strstr(strstr(first, again) + 1, "warning")); /* each is reported once */
    outcome_free(&o);

    const double missing = json_number_of("short/summary.json", "particle_files_missing");
    assert_true(missing >= 1);
    snprintf(expected, sizeof expected, "%s%.0f frame", reason, missing);
    check_summary(expected);
    sb_particle_list list = {0};
    assert_int_equal(sb_pvd_read(in_folder("short/particles.pvd"), &list, NULL), SB_OK);
    assert_near(json_number_of("short/summary.json", "particle_files"), (double)list.count, 0);
    const double end = json_number_of("short/summary.json", "simulated_s");
    assert_in_range(list.count + (size_t)missing, (size_t)(end / 0.02) - 1, (size_t)(end / 0.02) + 2);
    assert_true(exists("short/particles/000004.vtp"));
    sb_particle_list_free(&list);

    snprintf(until, sizeof until, "%.9g", end + 0.05);
    o = RUN(2, "run", "tank2.yaml", "--out", "short", "--quiet", "--resume", "--until", until, "--set",
            "resolution=0.02", "--set", "output.particle_interval=0.02", "--set", "domain.max=[2, 2]");
    assert_one_line(o.err, expected);
    outcome_free(&o);
    assert_near(json_number_of("short/summary.json", "particle_files_missing"), missing, 0);
    check_summary(expected);
}

/* A folder that cannot be written to is refused before a run begins or is resumed. */
static void unwritable_folders_are_refused(void **state)
{
    (void)state;
    static const char *const folders[] = {"particles", "frames", "frames/front", "maps"};
    for (size_t k = 0; k < 2 * sizeof folders / sizeof *folders; k++) {
        char expected[128], command[1200], place[64];
        const char *folder = folders[k / 2];
        assert_int_equal(mkdir(in_folder("blocked"), 0700), 0);
        write_text("blocked/run.jsonl", ""); /* marks a run directory */
        if (strchr(folder, '/')) assert_int_equal(mkdir(in_folder("blocked/frames"), 0700), 0);
        snprintf(place, sizeof place, "blocked/%s", folder);
        if (k % 2)
            write_text(place, "no folder\n");
        else
            assert_int_equal(symlink("nowhere", in_folder("%s", place)), 0);
        outcome o = RUN(2, "run", "tank3.yaml", "--out", "blocked", "--quiet", "--set", "measure.map={}");
        snprintf(expected, sizeof expected, "%s: is %s, expected a directory of the run's own", place,
                 k % 2 ? "not a directory" : "a symbolic link");
        assert_one_line(o.err, expected);
        outcome_free(&o);
        assert_false(exists("blocked/scene.yaml"));
        char *log = text_of("blocked/run.jsonl");
        assert_string_equal(log, "");
        sb_free(log);
        snprintf(command, sizeof command, "rm -r '%s'", in_folder("blocked"));
        assert_int_equal(system(command), 0);
    }
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "later", "--quiet", "--until", "0.02");
    char *scene = text_of("later/scene.yaml");
    assert_int_equal(rename(in_folder("later/particles"), in_folder("elsewhere")), 0);
    assert_int_equal(symlink("../elsewhere", in_folder("later/particles")), 0);
    outcome o = RUN(2, "run", "tank2.yaml", "--out", "later", "--quiet", "--resume");
    assert_one_line(o.err, "later/particles: is a symbolic link, expected a directory of the run's own");
    outcome_free(&o);
    char *scene_now = text_of("later/scene.yaml");
    assert_string_equal(scene, scene_now);
    sb_free(scene);
    sb_free(scene_now);
}

/* Pictures that were removed, for example by `render` into the run's folder, are reported, and no film is made that
   would end at the first missing picture. */
static void removed_pictures_are_reported(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "robbed", "--quiet", "--set", "render.video=true");
    assert_int_equal(unlink(in_folder("robbed/frames/side/000002.png")), 0);
    outcome o = RUN(0, "run", "tank3.yaml", "--out", "robbed", "--quiet", "--set", "render.video=true", "--resume",
                    "--until", "0.4");
    assert_contains(o.err, "frames/side/000002.png");
    outcome_free(&o);
    char *log = text_of("robbed/run.jsonl");
    assert_contains(log, "frames/side/000002.png");
    if (strstr(log, "\"video\"")) assert_contains(log, "side.mp4: not made: picture 2 of 5 is missing");
    sb_free(log);
}

/* Steps that end on multiples of the interval, up to rounding, give one frame each. */
static void no_frame_is_lost_to_rounding(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "even", "--quiet", "--until", "0.2", "--set",
                   "numerics.time_step_max=0.002", "--set", "output.particle_interval=0.002", "--set",
                   "output.checkpoint.minutes=0");
    assert_near(json_number_of("even/summary.json", "steps"), 100, 0);
    assert_near(json_number_of("even/summary.json", "particle_files"), 101, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_disk_that_is_full_for_a_while),
        cmocka_unit_test(unwritable_folders_are_refused),
        cmocka_unit_test(removed_pictures_are_reported),
        cmocka_unit_test(no_frame_is_lost_to_rounding),
    };
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
