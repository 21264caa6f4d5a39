/* Runs that go on from a checkpoint end as those that were never disturbed: state, tables, pictures, particle files. */
#include "program.h"

#include "../output/json_check.h"
#include "base/clock.h"
#include "base/file.h"
#include "base/memory.h"
#include "frame/frame.h"
#include "output/pvd.h"
#include "output/vtp.h"

#include <dirent.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#define EVERY_THREE "output.checkpoint={steps: 3, minutes: 0}"

/* All that can be measured; a paddle that is still moving when the run is cut. */
static const char measured[] =
    "dimensions: 2\n"
    "resolution: 0.05\n"
    "duration: 0.6\n"
    "domain: {min: [0, 0], max: [3, 1]}\n"
    "water: {boxes: [{min: [0.3, 0], max: [1.4, 0.5]}]}\n"
    "bodies:\n"
    "  - {name: paddle, shape: box, min: [0, 0], max: [0.28, 0.9]}\n"
    "  - {name: step, shape: box, min: [1.5, 0], max: [1.8, 0.2]}\n"
    "wavemakers: [{name: w, body: paddle, kind: stroke, stroke: 0.2, speed: 0.5}]\n"
    "measure:\n"
    "  interval: 0.03\n"
    "  gauges: [{name: wet, x: 0.8}, {name: dry, x: 2.8}]\n"
    "  probes: [{name: deep, at: [0.8, 0.2]}]\n"
    "  planes: [{name: lip, from: [1.45]}]\n"
    "  runups: [{name: floor, from: [0.3], to: [2.9]}]\n"
    "  map: {}\n"
    "output: {particle_interval: 0.1, plots: false}\n";

static int setup(void **state)
{
    if (program_setup(state) != 0) return -1;
    write_text("measured.yaml", measured);
    return 0;
}

/* ---- what two runs have in common ---- */

static void assert_same_file(const char *a, const char *b, const char *name)
{
    sb_error error = {0};
    char *text[2];
    size_t length[2];
    const char *const runs[] = {a, b};
    for (int k = 0; k < 2; k++)
        if (sb_file_read(in_folder("%s/%s", runs[k], name), 1 << 26, &text[k], &length[k], &error) != SB_OK)
            fail_msg("%s", error.text);
    if (length[0] != length[1] || memcmp(text[0], text[1], length[0]) != 0)
        fail_msg("%s/%s and %s/%s differ:\n%s---\n%s", a, name, b, name, text[0], text[1]);
    sb_free(text[0]);
    sb_free(text[1]);
}

/* Particle files carry the wall time: all else is compared. */
static void assert_same_particles(const char *a, const char *b)
{
    sb_pvd list = {0};
    sb_error error = {0};
    assert_same_file(a, b, "particles.pvd");
    assert_int_equal(sb_pvd_read(in_folder("%s/particles.pvd", a), &list, &error), SB_OK);
    for (size_t i = 0; i < list.count; i++) {
        sb_frame *one = NULL, *two = NULL;
        if (sb_vtp_read(in_folder("%s/%s", a, list.entries[i].file), &one, &error) != SB_OK ||
            sb_vtp_read(in_folder("%s/%s", b, list.entries[i].file), &two, &error) != SB_OK)
            fail_msg("%s", error.text);
        assert_int_equal(one->count, two->count);
        assert_int_equal(one->index, two->index);
        assert_memory_equal(one->position, two->position, 12 * one->count);
        assert_memory_equal(one->velocity, two->velocity, 12 * one->count);
        assert_memory_equal(one->pressure, two->pressure, 4 * one->count);
        assert_memory_equal(one->id, two->id, 4 * one->count);
        sb_frame_release(one);
        sb_frame_release(two);
    }
    assert_false(access(in_folder("%s/particles/%06zu.vtp", b, list.count + 1), F_OK) == 0);
    sb_pvd_free(&list);
}

static void hash_of(const char *run, char hash[32])
{
    char name[96];
    snprintf(name, sizeof name, "%s/summary.json", run);
    char *text = text_of(name);
    const char *value = json_find(text, "state_hash");
    assert_non_null(value);
    assert_int_equal(sscanf(value, "\"%31[0-9a-f]\"", hash), 1);
    sb_free(text);
}

static void assert_same_run(const char *a, const char *b, const char *const *files)
{
    static const char *const numbers[] = {"simulated_s", "steps", "mean_iterations", "peak_N", "peak_time_s",
                                          "impulse_Ns", "kinetic_J", "particle_files", "pictures"};
    char hash[2][32], name[2][96];
    hash_of(a, hash[0]);
    hash_of(b, hash[1]);
    if (strcmp(hash[0], hash[1]) != 0) fail_msg("%s ends as %s, %s as %s", a, hash[0], b, hash[1]);
    snprintf(name[0], sizeof name[0], "%s/summary.json", a);
    snprintf(name[1], sizeof name[1], "%s/summary.json", b);
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++)
        assert_near(json_number_of(name[0], numbers[k]), json_number_of(name[1], numbers[k]), 0);
    for (; *files; files++) assert_same_file(a, b, *files);
    assert_same_particles(a, b);
}

static const char *const tables[] = {"forces.csv",      "gauges.csv", "probes.csv",          "energy.csv",
                                     "overtopping.csv", "runup.csv",  "maps/max_depth.asc",  "maps/max_speed.asc",
                                     "maps/arrival_time.asc", "maps/max_momentum_flux.asc", NULL};

/* ---- checkpoints of a run ---- */

/* Their names in order, oldest first; returns how many. */
static int list_checkpoints(const char *run, char names[16][64])
{
    struct dirent **entries;
    int found = scandir(in_folder("%s/checkpoints", run), &entries, NULL, alphasort), count = 0;
    assert_true(found >= 0);
    for (int i = 0; i < found; i++) {
        if (entries[i]->d_name[0] != '.' && count < 16) snprintf(names[count++], 64, "%.63s", entries[i]->d_name);
        free(entries[i]);
    }
    free(entries);
    return count;
}

static int count_of(const char *text, const char *words)
{
    int count = 0;
    for (; (text = strstr(text, words)); text += strlen(words)) count++;
    return count;
}

static void each_solver_goes_on(void **state)
{
    (void)state;
    static const char *const solvers[] = {"numerics.solver=jacobi", "numerics.solver=chebyshev",
                                          "numerics.solver=cg"};
    for (int s = 0; s < 3; s++) {
        RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "whole", "--quiet", "--set", solvers[s]);
        RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "parts", "--quiet", "--set", solvers[s], "--until", "0.2");
        RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "parts", "--quiet", "--set", solvers[s], "--until", "0.41",
                       "--resume", "--threads", "2");
        RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "parts", "--quiet", "--set", solvers[s], "--resume");
        assert_same_run("whole", "parts", tables);
        char *log = text_of("parts/run.jsonl");
        assert_int_equal(count_of(log, "\"event\":\"resumed\""), 2);
        assert_int_equal(count_of(log, "\"event\":\"start\""), 1);
        sb_free(log);
        assert_false(any_ending("parts", ".tmp"));
    }
}

static void a_run_in_3d_with_pictures_goes_on(void **state)
{
    (void)state;
    static const char *const files[] = {"forces.csv", "gauges.csv", "frames/side/000001.png",
                                        "frames/side/000004.png", "frames/front/000003.png", NULL};
    static const char sides[] = "domain.sides={y_min: periodic, y_max: periodic}";
    for (int periodic = 0; periodic < 2; periodic++) {
        const char *set = periodic ? sides : "numerics.turbulence=sps";
        RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "whole3", "--quiet", "--set", set);
        RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "parts3", "--quiet", "--set", set, "--until", "0.17");
        /* The run's own scene will do as well: it names the same files, and what was set. */
        RUN_AND_FORGET(0, "run", "parts3/scene.yaml", "--out", "parts3", "--quiet", "--resume", "--until", "0.3");
        assert_same_run("whole3", "parts3", files);
    }
}

static void checkpoints_change_nothing(void **state)
{
    (void)state;
    char names[16][64], hash[2][32];
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "with", "--quiet", "--set", EVERY_THREE);
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "without", "--quiet", "--set", "output.checkpoint.minutes=0");
    assert_same_run("with", "without", tables);
    assert_int_equal(list_checkpoints("with", names), 2);
    assert_false(exists("without/checkpoints"));
    hash_of("with", hash[0]);
    char *log = text_of("without/run.jsonl");
    assert_contains(log, "checkpoints: off");
    assert_null(strstr(log, "\"event\":\"checkpoint\""));
    sb_free(log);
    log = text_of("with/run.jsonl");
    assert_null(strstr(log, "checkpoints: off"));
    assert_true(count_of(log, "\"event\":\"checkpoint\"") > 5);
    sb_free(log);
}

static void the_last_ones_are_kept(void **state)
{
    (void)state;
    char names[16][64], last[64];
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "kept", "--quiet", "--set",
                   "output.checkpoint={steps: 4, keep: 3}");
    assert_int_equal(list_checkpoints("kept", names), 3);
    const int steps = (int)json_number_of("kept/summary.json", "steps");
    snprintf(last, sizeof last, "%09d.state", steps);
    assert_string_equal(names[2], last);
    snprintf(last, sizeof last, "%09d.state", (steps - 1) / 4 * 4);
    assert_string_equal(names[1], last);
    /* A new run there begins anew and says so. */
    outcome o = RUN(0, "run", "measured.yaml", "--out", "kept", "--until", "0.02", "--set",
                    "output.checkpoint={steps: 1000, minutes: 0}");
    assert_contains(o.out, "kept: a new run in the place of an earlier one, whose checkpoints are removed");
    outcome_free(&o);
    assert_int_equal(list_checkpoints("kept", names), 1);
    assert_true(strcmp(names[0], last) < 0);
}

static void without_a_checkpoint_it_begins(void **state)
{
    (void)state;
    outcome o = RUN(0, "run", "measured.yaml", "--out", "nothing", "--until", "0.05", "--resume");
    assert_contains(o.out, "nothing: no checkpoint to go on from, so the run starts from the beginning");
    outcome_free(&o);
    assert_true(exists("nothing/summary.json"));
}

static void a_finished_run_says_so(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "done", "--quiet", "--until", "0.2");
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "again", "--quiet", "--until", "0.2");
    outcome o = RUN(0, "run", "measured.yaml", "--out", "again", "--until", "0.2", "--resume");
    assert_contains(o.out, "the run is finished; a longer duration, as by --until, would go on");
    outcome_free(&o);
    assert_same_run("done", "again", tables);
}

/* ---- signals ---- */

static void a_signal_leaves_a_checkpoint(void **state)
{
    (void)state;
    static const int signals[] = {SIGINT, SIGTERM};
    for (int s = 0; s < 2; s++) {
        char names[16][64];
        pid_t process = program_start((const char *const[]){"run", "measured.yaml", "--out", "cut", "--until", "1000",
                                                            "--set", "output.checkpoint.minutes=60", NULL});
        for (double end = sb_clock() + 30; !exists("cut/particles/000002.vtp") && sb_clock() < end;) usleep(2000);
        assert_int_equal(kill(process, signals[s]), 0);
        outcome o = program_finish(process);
        assert_int_equal(o.status, 128 + signals[s]);
        assert_one_line(o.err, "; to go on: shorebreak run cut/scene.yaml --out cut --resume");
        outcome_free(&o);
        assert_int_equal(list_checkpoints("cut", names), 1);
        const double steps = json_number_of("cut/summary.json", "steps");
        assert_near(strtod(names[0], NULL), steps, 0);
        const double until = json_number_of("cut/summary.json", "simulated_s") + 0.1;
        char text[32];
        snprintf(text, sizeof text, "%.6f", until);
        RUN_AND_FORGET(0, "run", "cut/scene.yaml", "--out", "cut", "--quiet", "--resume", "--until", text);
        RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "uncut", "--quiet", "--until", text);
        assert_same_run("uncut", "cut", tables);
        RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "cut", "--quiet", "--until", "0.01"); /* clears it */
        unlink(in_folder("cut/particles/000002.vtp"));
    }
}

/* ---- damage ---- */

static char *bytes_of(const char *name, size_t *length)
{
    sb_error error = {0};
    char *bytes;
    if (sb_file_read(in_folder("%s", name), 1 << 26, &bytes, length, &error) != SB_OK) fail_msg("%s", error.text);
    return bytes;
}

static void put_bytes(const char *name, const char *bytes, size_t length)
{
    FILE *file = fopen(in_folder("%s", name), "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, length, file), length);
    assert_int_equal(fclose(file), 0);
}

/* The newest checkpoint of "hurt" is replaced; the one before is used, with a word, and the end is the same. */
static void goes_on_from_the_one_before(const char *newest, const char *bytes, size_t length, const char *words)
{
    put_bytes(newest, bytes, length);
    outcome o = RUN(0, "run", "measured.yaml", "--out", "hurt", "--quiet", "--resume", "--set", EVERY_THREE);
    assert_contains(o.err, "shorebreak: warning: hurt/checkpoints/");
    assert_contains(o.err, words);
    assert_contains(o.err, "; trying the one before");
    outcome_free(&o);
    assert_same_run("sound", "hurt", tables);
}

static void damaged_ones_are_passed_over(void **state)
{
    (void)state;
    char names[16][64], newest[128];
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "sound", "--quiet", "--set", EVERY_THREE);
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "hurt", "--quiet", "--set", EVERY_THREE);
    assert_int_equal(list_checkpoints("hurt", names), 2);
    snprintf(newest, sizeof newest, "hurt/checkpoints/%s", names[1]);
    size_t length;
    char *bytes = bytes_of(newest, &length);
    goes_on_from_the_one_before(newest, bytes, 0, "has 0 bytes");
    goes_on_from_the_one_before(newest, bytes, length / 2, "cut short");
    goes_on_from_the_one_before(newest, bytes, length - 1, "cut short");
    bytes[length / 2] ^= 4;
    goes_on_from_the_one_before(newest, bytes, length, "damaged: the checksum of section");
    bytes[length / 2] ^= 4;
    bytes[8] ^= 2;
    goes_on_from_the_one_before(newest, bytes, length, "version 3 of the format, expected 1");
    sb_free(bytes);
}

/* Refused at the end of every section, and with every byte of its head or any section's head changed. */
static void no_part_may_be_missing(void **state)
{
    (void)state;
    char names[16][64], newest[128];
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "ends", "--quiet", "--until", "0.05", "--set",
                   "output.checkpoint={steps: 1000, minutes: 0}");
    assert_int_equal(list_checkpoints("ends", names), 1);
    snprintf(newest, sizeof newest, "ends/checkpoints/%s", names[0]);
    size_t length, sections = 0;
    char *bytes = bytes_of(newest, &length), *before = text_of("ends/forces.csv");
    for (size_t at = 16; at < length; sections++) {
        uint64_t size;
        put_bytes(newest, bytes, at);
        outcome o = RUN(1, "run", "measured.yaml", "--out", "ends", "--quiet", "--resume");
        assert_one_line(o.err, "no checkpoint to go on from: ends/checkpoints/");
        assert_contains(o.err, "cut short");
        outcome_free(&o);
        memcpy(&size, bytes + at + 8, sizeof size);
        at += 24 + size;
    }
    assert_int_equal(sections, 5); /* scene, run, sim, measure, end */
    assert_same_file("ends", "ends", "forces.csv");
    char *after = text_of("ends/forces.csv");
    assert_string_equal(before, after);
    sb_free(before);
    sb_free(after);
    sb_free(bytes);
}

static void other_scenes_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *set, *words;
    } cases[] = {
        {"resolution=0.04", "of another scene: it has \"resolution: 0.05 # m\" where this one has \"resolution: 0.04"},
        {"measure.interval=0.05", "\"interval: 0.03"},
        {"bodies.step.max=[1.81, 0.2]", "\"max: [1.8"},
        {"numerics.seed=2", "\"seed: 1\" where this one has \"seed: 2\""},
    };
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "other", "--quiet", "--until", "0.1");
    char *scene = text_of("other/scene.yaml"), *forces = text_of("other/forces.csv");
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        outcome o = RUN(1, "run", "measured.yaml", "--out", "other", "--quiet", "--resume", "--set", cases[c].set);
        assert_one_line(o.err, "no checkpoint to go on from: other/checkpoints/");
        assert_contains(o.err, cases[c].words);
        outcome_free(&o);
    }
    char *scene_now = text_of("other/scene.yaml"), *forces_now = text_of("other/forces.csv");
    assert_string_equal(scene, scene_now);
    assert_string_equal(forces, forces_now);
    sb_free(scene);
    sb_free(scene_now);
    sb_free(forces);
    sb_free(forces_now);
    /* A table that was cut by someone cannot be gone on with. */
    assert_int_equal(truncate(in_folder("other/gauges.csv"), 30), 0);
    outcome o = RUN(1, "run", "measured.yaml", "--out", "other", "--quiet", "--resume", "--until", "0.2");
    assert_contains(o.err, "other/gauges.csv: has 30 bytes, expected the ");
    outcome_free(&o);
}

/* ---- disks ---- */

/* Starts the program where no file may be longer than this: as on a disk that is full. */
static outcome run_limited(rlim_t bytes, const char *const *arguments)
{
    struct rlimit kept, limit;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &kept), 0);
    limit = kept;
    limit.rlim_cur = bytes;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
    pid_t process = program_start(arguments);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &kept), 0);
    return program_finish(process);
}

/* The checkpoint is the longest of the files: it fails alone, the run goes on, and those before stay. */
static void a_checkpoint_that_fails_is_a_warning(void **state)
{
    (void)state;
    char names[16][64], left[16][64];
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "full", "--quiet", "--until", "0.05", "--set",
                   "output.particle_interval=0");
    assert_int_equal(list_checkpoints("full", names), 1);
    struct stat size;
    assert_int_equal(stat(in_folder("full/checkpoints/%s", names[0]), &size), 0);
    assert_true(size.st_size > 10000);
    outcome o = run_limited((rlim_t)size.st_size - 500, (const char *const[]){"run", "measured.yaml", "--out", "full", "--quiet", "--resume",
                                                         "--until", "0.1", "--set", "output.particle_interval=0",
                                                         "--set", "output.checkpoint.steps=5", NULL});
    assert_int_equal(o.status, 0);
    assert_contains(o.err, "shorebreak: warning: no checkpoint at step ");
    assert_contains(o.err, ", the run goes on: full/checkpoints/");
    assert_contains(o.err, "cannot write: File too large");
    outcome_free(&o);
    assert_int_equal(list_checkpoints("full", left), 1);
    assert_string_equal(left[0], names[0]);
}

/* A table that cannot be written ends the run; with room again it goes on as if nothing had been. */
static void a_full_disk_ends_the_run_and_it_goes_on(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "roomy", "--quiet", "--set", "measure.interval=0.002");
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "tight", "--quiet", "--set", "measure.interval=0.002", "--until",
                   "0.1");
    outcome o = run_limited(25000, (const char *const[]){"run", "measured.yaml", "--out", "tight", "--quiet", "--set",
                                                         "measure.interval=0.002", "--resume", NULL});
    assert_int_equal(o.status, 2);
    assert_contains(o.err, ".csv: cannot write: File too large");
    outcome_free(&o);
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "tight", "--quiet", "--set", "measure.interval=0.002",
                   "--resume");
    assert_same_run("roomy", "tight", tables);
}

/* A second run in the same directory is refused before it touches anything. */
static void one_run_at_a_time(void **state)
{
    (void)state;
    pid_t process = program_start((const char *const[]){"run", "measured.yaml", "--out", "one", "--quiet", "--until",
                                                        "1000", NULL});
    for (double end = sb_clock() + 30; !exists("one/particles/000002.vtp") && sb_clock() < end;) usleep(2000);
    outcome o = RUN(1, "run", "measured.yaml", "--out", "one", "--quiet", "--resume");
    assert_one_line(o.err, "one: another run is writing there");
    outcome_free(&o);
    assert_int_equal(kill(process, SIGTERM), 0);
    o = program_finish(process);
    assert_int_equal(o.status, 143);
    outcome_free(&o);
    char *log = text_of("one/run.jsonl");
    assert_int_equal(count_of(log, "\"event\":\"end\""), 1);
    sb_free(log);
}

static void removed_tables_end_the_run(void **state)
{
    (void)state;
    pid_t process = program_start((const char *const[]){"run", "measured.yaml", "--out", "gone", "--quiet", "--until",
                                                        "1000", NULL});
    for (double end = sb_clock() + 30; !exists("gone/particles/000002.vtp") && sb_clock() < end;) usleep(2000);
    unlink(in_folder("gone/probes.csv"));
    outcome o = program_finish(process);
    assert_int_equal(o.status, 2);
    assert_contains(o.err, "gone/probes.csv: was removed while the run wrote it");
    outcome_free(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_solver_goes_on),
        cmocka_unit_test(a_run_in_3d_with_pictures_goes_on),
        cmocka_unit_test(checkpoints_change_nothing),
        cmocka_unit_test(the_last_ones_are_kept),
        cmocka_unit_test(without_a_checkpoint_it_begins),
        cmocka_unit_test(a_finished_run_says_so),
        cmocka_unit_test(a_signal_leaves_a_checkpoint),
        cmocka_unit_test(damaged_ones_are_passed_over),
        cmocka_unit_test(no_part_may_be_missing),
        cmocka_unit_test(other_scenes_are_refused),
        cmocka_unit_test(a_checkpoint_that_fails_is_a_warning),
        cmocka_unit_test(a_full_disk_ends_the_run_and_it_goes_on),
        cmocka_unit_test(one_run_at_a_time),
        cmocka_unit_test(removed_tables_end_the_run),
    };
    return cmocka_run_group_tests(tests, setup, program_teardown);
}
