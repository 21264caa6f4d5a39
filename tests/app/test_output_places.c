/* Something other than a regular file in the place of each file that run, render or sample writes: the command refuses
   it at once, with its path, and does not change it. */
#include "program.h"

#include "base/clock.h"
#include "base/memory.h"

#include <ftw.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

enum { LINK, FIFO, DEVICE, FOLDER, HARD_LINK, KINDS };
static const char *const kinds[KINDS] = {"a symbolic link", "a FIFO", "a device", "a directory",
                                         "2 names (hard links)"};

static char places[64][96]; /* paths below the run directory */
static size_t count;

static bool has_tool(const char *command)
{
    return system(command) == 0;
}

static int add_place(const char *path, const struct stat *info, int kind, struct FTW *where)
{
    (void)info;
    (void)where;
    const char *name = path + strlen(in_folder("r/"));
    if (kind != FTW_F || strstr(name, "000003.") || strstr(name, "000002."))
        return 0; /* the first of each kind is enough */
    if (count == sizeof places / sizeof *places) return -1;
    snprintf(places[count++], sizeof *places, "%.95s", name);
    return 0;
}

/* Makes a run that writes all kinds of files, and lists them. */
static int setup(void **state)
{
    if (program_setup(state) != 0) return -1;
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "r", "--quiet", "--set", "measure.map={}", "--set",
                   "measure.planes=[{name: p, from: [0.9, 0], to: [0.9, 0.8]}]", "--set",
                   "measure.runups=[{name: r, from: [0.2, 0.4], to: [2.4, 0.4]}]", "--set", "output.plots=true",
                   "--set", "render.video=true");
    if (nftw(in_folder("r"), add_place, 16, FTW_PHYS) != 0) return -1;
    /* Temporary files, and files that are written only after a failure or at the start of a run. */
    static const char *const more[] = {"scene.yaml.tmp",
                                       "summary.json.tmp",
                                       "particles.pvd.tmp",
                                       "maps/max_depth.asc.tmp",
                                       "particles/000009.vtp.tmp",
                                       "particles/last-good.vtp",
                                       "frames/side/000009.png.tmp",
                                       "checkpoints/000000999.state.tmp",
                                       "checkpoints/settling.state",
                                       ".side.part.mp4",
                                       "plots/part.png"};
    for (size_t k = 0; k < sizeof more / sizeof *more; k++) snprintf(places[count++], sizeof *places, "%s", more[k]);
    return 0;
}

static void every_kind_of_file_is_on_the_list(void **state)
{
    (void)state;
    static const char *const names[] = {"scene.yaml",
                                        "run.jsonl",
                                        "summary.json",
                                        "forces.csv",
                                        "gauges.csv",
                                        "probes.csv",
                                        "energy.csv",
                                        "overtopping.csv",
                                        "runup.csv",
                                        "particles.pvd",
                                        "particles/000001.vtp",
                                        "maps/max_depth.asc",
                                        "frames/side/000001.png",
                                        "frames/front/000001.png"};
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        bool found = false;
        for (size_t k = 0; k < count; k++) found = found || strcmp(places[k], names[n]) == 0;
        if (!found) fail_msg("%s is not tested", names[n]);
    }
    size_t films = 0, plots = 0, checkpoints = 0;
    for (size_t k = 0; k < count; k++) {
        films += strcmp(places[k], "side.mp4") == 0;
        plots += strcmp(places[k], "plots/forces.png") == 0;
        checkpoints += strncmp(places[k], "checkpoints/0000000", 19) == 0;
    }
    assert_true(films == 1 || !has_tool("command -v ffmpeg >/dev/null"));
    assert_true(plots == 1 || !has_tool("command -v gnuplot >/dev/null"));
    assert_true(checkpoints >= 1);
}

/* Returns false when it cannot be made: only root can make devices. */
static bool put(int kind, const char *path)
{
    switch (kind) {
    case LINK:
        return symlink(in_folder("precious"), path) == 0;
    case FIFO:
        return mkfifo(path, 0600) == 0;
    case DEVICE:
        return mknod(path, S_IFCHR | 0600, makedev(1, 3)) == 0;
    case FOLDER:
        return mkdir(path, 0700) == 0;
    default:
        return link(in_folder("precious"), path) == 0;
    }
}

static void check_refused(const char *place, int kind, const char *path, const char *const *arguments, int status)
{
    struct stat before, after;
    assert_int_equal(lstat(path, &before), 0);
    const double start = sb_clock();
    outcome o = program_expect(status, arguments);
    assert_contains(o.err, place);
    assert_contains(o.err, kinds[kind]);
    outcome_free(&o);
    if (sb_clock() - start > 30) fail_msg("%s as %s blocked the program", place, kinds[kind]);
    assert_int_equal(lstat(path, &after), 0);
    assert_true(before.st_ino == after.st_ino && before.st_mode == after.st_mode);
    char *text = text_of("precious");
    assert_string_equal(text, "precious\n");
    sb_free(text);
}

/* Tables and the log are written in place, so a file that is linked to them would change. */
static bool grows(const char *place)
{
    return strstr(place, ".csv") || strcmp(place, "run.jsonl") == 0;
}

static void a_run_is_refused(void **state)
{
    (void)state;
    write_text("precious", "precious\n");
    for (size_t k = 0; k < count; k++)
        for (int kind = 0; kind < KINDS; kind++) {
            char path[1200], aside[1200];
            snprintf(path, sizeof path, "%s", in_folder("r/%s", places[k]));
            snprintf(aside, sizeof aside, "%s", in_folder("aside"));
            if (kind == HARD_LINK && !grows(places[k])) continue;
            const bool was = rename(path, aside) == 0;
            if (put(kind, path)) {
                check_refused(places[k], kind, path,
                              (const char *const[]){"run", "tank3.yaml", "--out", "r", "--quiet", "--overwrite", NULL},
                              2);
                check_refused(places[k], kind, path,
                              (const char *const[]){"run", "tank3.yaml", "--out", "r", "--quiet", "--resume", NULL}, 2);
            }
            assert_int_equal(remove(path), 0);
            if (was) assert_int_equal(rename(aside, path), 0);
        }
    RUN_AND_FORGET(0, "run", "r/scene.yaml", "--out", "r", "--quiet", "--resume"); /* nothing has changed */
}

static void render_and_sample_are_refused(void **state)
{
    (void)state;
    write_text("precious", "precious\n");
    assert_int_equal(mkdir(in_folder("album"), 0700), 0);
    assert_int_equal(mkdir(in_folder("album/frames"), 0700), 0);
    assert_int_equal(mkdir(in_folder("album/frames/side"), 0700), 0);
    for (int kind = 0; kind < HARD_LINK; kind++) {
        static const char *const names[] = {"album/frames/side/000002.png", "album/frames/side/000002.png.tmp",
                                            "album/side.mp4"};
        for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
            char path[1200];
            snprintf(path, sizeof path, "%s", in_folder("%s", names[n]));
            if (!put(kind, path)) continue;
            check_refused(names[n], kind, path, (const char *const[]){"render", "r", "--out", "album", "--quiet", NULL},
                          2);
            assert_int_equal(remove(path), 0);
        }
        char path[1200];
        snprintf(path, sizeof path, "%s", in_folder("s.vtp"));
        if (!put(kind, path)) continue;
        check_refused("--out s.vtp", kind, path, (const char *const[]){"sample", "tank3.yaml", "--out", "s.vtp", NULL},
                      1);
        assert_int_equal(remove(path), 0);
    }
}

/* The summary's path is blocked during the run: the run ends and reports it, and the summary does not claim success. */
static void a_summary_that_cannot_be_written_is_reported(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "late", "--quiet", "--until", "0.1");
    char *first = text_of("late/summary.json");
    assert_contains(first, "\"status\": \"done\"");
    sb_free(first);
    pid_t process = program_start(
        (const char *const[]){"run", "tank2.yaml", "--out", "late", "--quiet", "--until", "1000", "--resume", NULL});
    for (double end = sb_clock() + 30; !exists("late/particles/000004.vtp") && sb_clock() < end;) usleep(2000);
    char *then = text_of("late/summary.json");
    assert_contains(then, "\"status\": \"running\"");
    sb_free(then);
    assert_int_equal(mkfifo(in_folder("late/summary.json.tmp"), 0600), 0);
    assert_int_equal(kill(process, SIGTERM), 0);
    outcome o = program_finish(process);
    assert_int_equal(o.status, 2);
    assert_contains(o.err, "shorebreak: late/summary.json.tmp: is a FIFO, expected a regular file or nothing");
    outcome_free(&o);
    then = text_of("late/summary.json");
    assert_contains(then, "\"status\": \"running\"");
    sb_free(then);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_of_file_is_on_the_list),
        cmocka_unit_test(a_run_is_refused),
        cmocka_unit_test(render_and_sample_are_refused),
        cmocka_unit_test(a_summary_that_cannot_be_written_is_reported),
    };
    return cmocka_run_group_tests(tests, setup, program_teardown);
}
