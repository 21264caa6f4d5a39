/* The directories into which a run writes: only files that the user names for replacement are lost. */
#include "program.h"

#include "base/clock.h"
#include "base/hash.h"
#include "base/memory.h"

#include <ftw.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static uint64_t all;
static size_t files;

static int add_one(const char *path, const struct stat *info, int kind, struct FTW *where)
{
    char bytes[4096];
    (void)where;
    uint64_t one = sb_hash((uint64_t)info->st_size, path, strlen(path));
    FILE *file = kind == FTW_F ? fopen(path, "rb") : NULL;
    for (size_t got; file && (got = fread(bytes, 1, sizeof bytes, file)) > 0;) one = sb_hash(one, bytes, got);
    if (file) fclose(file);
    all += one; /* independent of the order of the files */
    files += kind == FTW_F;
    return 0;
}

/* A hash of the names and contents of all files below a folder. */
static uint64_t hash_all(const char *name)
{
    all = files = 0;
    assert_int_equal(nftw(in_folder("%s", name), add_one, 16, FTW_PHYS), 0);
    return all;
}

static void make_folders(const char *const *names)
{
    for (; *names; names++) assert_int_equal(mkdir(in_folder("%s", *names), 0777), 0);
}

/* Files with the names of a run's files that no run has written. */
static void other_peoples_files_are_left_alone(void **state)
{
    (void)state;
    static const char *const names[] = {"alien/forces.csv",
                                        "alien/gauges.csv",
                                        "alien/scene.yaml",
                                        "alien/summary.json",
                                        "alien/side.mp4",
                                        "alien/talk.mp4",
                                        "alien/particles.pvd",
                                        "alien/particles/000001.vtp",
                                        "alien/maps/max_depth.asc",
                                        "alien/plots/forces.png",
                                        "alien/run.jsonl",
                                        "alien/frames/side/000001.png",
                                        "alien/frames/a/000002.png",
                                        "alien/checkpoints/000000001.state",
                                        "alien/thesis.tex"};
    static const char *const ways[] = {"--quiet", "--overwrite", "--resume"};
    make_folders((const char *const[]){"alien", "alien/particles", "alien/maps", "alien/plots", "alien/frames",
                                       "alien/frames/side", "alien/frames/a", "alien/checkpoints", NULL});
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) write_text(names[k], "years of work\n");
    const uint64_t before = hash_all("alien");
    assert_int_equal(files, sizeof names / sizeof *names);
    for (size_t w = 0; w < sizeof ways / sizeof *ways; w++) {
        outcome o = RUN(1, "run", "tank3.yaml", "--out", "alien", ways[w]);
        assert_one_line(o.err, "alien: holds \"");
        assert_contains(o.err, "\" but no run of shorebreak; name an empty or a new directory with --out");
        outcome_free(&o);
        assert_true(hash_all("alien") == before);
    }
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "r", "--quiet", "--until", "0.02");
    /* The log of a run does not make the other files the run's. */
    char *log = text_of("r/run.jsonl");
    write_text("alien/run.jsonl", log);
    sb_free(log);
    const uint64_t marked = hash_all("alien");
    outcome o = RUN(1, "run", "tank3.yaml", "--out", "alien", "--overwrite");
    assert_one_line(o.err, ": was not written by shorebreak, and the run would overwrite it; move it away");
    outcome_free(&o);
    assert_true(hash_all("alien") == marked);
}

/* Only --overwrite replaces an earlier run. */
/* A sea that an open side lets out is found when the model is made. */
static void a_refused_run_leaves_no_folder(void **state)
{
    (void)state;
    write_text("escape.yaml", "title: t\ndimensions: 2\nresolution: 0.1\nduration: 1\n"
                              "domain: {min: [0, 0], max: [2, 1], sides: {x_max: open}}\n"
                              "water: {level: 0.5, seed: [1, 0.2]}\n");
    outcome o = RUN(1, "run", "escape.yaml", "--out=escaped", "--quiet");
    assert_contains(o.err, "escape.yaml: domain.sides.x_max: the sea escapes through the open side x_max");
    outcome_free(&o);
    assert_false(exists("escaped"));
    /* A folder that was there stays. */
    assert_int_equal(mkdir(in_folder("escaped"), 0777), 0);
    RUN_AND_FORGET(1, "run", "escape.yaml", "--out=escaped", "--quiet");
    assert_true(exists("escaped"));
}

static void a_run_is_replaced_on_request(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "dear", "--quiet", "--until", "0.1");
    const uint64_t before = hash_all("dear");
    outcome o = RUN(1, "run", "tank2.yaml", "--out", "dear", "--until", "0.1");
    assert_one_line(o.err, "dear: holds a finished run; add --overwrite to replace it, --resume with a later --until");
    assert_string_equal(o.out, "");
    outcome_free(&o);
    o = RUN(1, "run", "tank3.yaml", "--out", "dear", "--resume", "--overwrite");
    assert_one_line(o.err, "--overwrite: cannot be used together with --resume");
    outcome_free(&o);
    assert_true(hash_all("dear") == before);
    o = RUN(0, "run", "tank3.yaml", "--out", "dear", "--until", "0.1", "--overwrite");
    assert_contains(o.out, "dear: the files of the earlier run are removed, and a new run starts\n");
    assert_string_equal(o.err, "");
    outcome_free(&o);
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "like", "--until", "0.1");
    hash_all("like");
    const size_t expected = files;
    hash_all("dear");
    assert_int_equal(files, expected);
}

static void a_run_that_has_not_ended_is_kept(void **state)
{
    (void)state;
    pid_t process =
        program_start((const char *const[]){"run", "tank2.yaml", "--out", "cut", "--quiet", "--until", "1000", NULL});
    for (double end = sb_clock() + 30; !exists("cut/particles/000002.vtp") && sb_clock() < end;) usleep(2000);
    assert_int_equal(kill(process, SIGKILL), 0);
    outcome o = program_finish(process);
    outcome_free(&o);
    char *summary = text_of("cut/summary.json");
    assert_contains(summary, "\"status\": \"running\"");
    sb_free(summary);
    const uint64_t before = hash_all("cut");
    o = RUN(1, "run", "tank2.yaml", "--out", "cut", "--until", "0.1");
    assert_one_line(o.err,
                    "cut: holds an unfinished run; add --resume to continue it, --overwrite to replace it, or name");
    outcome_free(&o);
    assert_true(hash_all("cut") == before);
    /* It wrote no checkpoint, so it starts from the beginning. */
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "cut", "--quiet", "--until", "0.1", "--resume");
}

/* Without a checkpoint, --resume starts from the beginning, which would lose the finished run. */
static void a_finished_run_without_checkpoints_is_kept(void **state)
{
    (void)state;
    static const char none[] = "output.checkpoint.minutes=0";
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "bare", "--quiet", "--until", "0.02", "--set", none);
    const uint64_t before = hash_all("bare");
    outcome o = RUN(1, "run", "tank2.yaml", "--out", "bare", "--resume", "--until", "0.1", "--set", none);
    assert_one_line(o.err, "bare: holds a finished run and no checkpoint to continue from; add --overwrite");
    outcome_free(&o);
    assert_true(hash_all("bare") == before);
}

/* A user may prepare a directory with other files by making an empty log. */
static void an_empty_log_marks_a_run_directory(void **state)
{
    (void)state;
    make_folders((const char *const[]){"claimed", NULL});
    write_text("claimed/run.jsonl", "");
    write_text("claimed/output.txt", "mine\n");
    outcome o = RUN(0, "run", "tank2.yaml", "--out", "claimed", "--quiet", "--until", "0.1");
    assert_string_equal(o.err, "");
    outcome_free(&o);
    char *text = text_of("claimed/output.txt");
    assert_string_equal(text, "mine\n");
    sb_free(text);
}

/* A run was killed before it wrote anything else. */
static void a_half_written_scene_is_replaced(void **state)
{
    (void)state;
    make_folders((const char *const[]){"early", NULL});
    write_text("early/scene.yaml.tmp", "# A sce");
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "early", "--quiet", "--until", "0.1");
    assert_false(exists("early/scene.yaml.tmp"));
}

/* Older versions did not mark their pictures. These are recognised by the cameras of the run's scene. */
static void an_older_runs_pictures_are_recognised(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "older", "--quiet", "--until", "0.12");
    assert_true(exists("older/frames/front/000002.png"));
    for (int n = 1; n <= 2; n++) write_text(n == 1 ? "older/frames/side/000001.png" : "older/side.mp4", "\x89PNG\r\n");
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "older", "--quiet", "--until", "0.02", "--overwrite");
    assert_false(exists("older/frames") || exists("older/side.mp4"));
}

static void render_replaces_its_own_pictures_only(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "drawn", "--quiet", "--until", "0.12");
    assert_int_equal(link(in_folder("drawn/forces.csv"), in_folder("kept.csv")),
                     0); /* a table that the command does not write to */
    make_folders((const char *const[]){"album", "album/frames", "album/frames/front", NULL});
    write_text("album/frames/front/000009.png", "my picture\n");
    write_text("album/notes.txt", "mine\n");
    outcome o = RUN(1, "render", "drawn", "--out", "album", "--quiet");
    assert_one_line(o.err,
                    "album/frames/front/000009.png: was not written by shorebreak, and render would overwrite it");
    outcome_free(&o);
    assert_false(exists("album/frames/side"));
    RUN_AND_FORGET(0, "render", "drawn", "--out", "album", "--quiet", "--camera", "side");
    RUN_AND_FORGET(0, "render", "drawn", "--out", "album", "--quiet", "--camera", "side"); /* its own */
    char *text = text_of("album/frames/front/000009.png");
    assert_string_equal(text, "my picture\n");
    sb_free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(other_peoples_files_are_left_alone),
        cmocka_unit_test(a_refused_run_leaves_no_folder),
        cmocka_unit_test(a_run_is_replaced_on_request),
        cmocka_unit_test(a_run_that_has_not_ended_is_kept),
        cmocka_unit_test(a_finished_run_without_checkpoints_is_kept),
        cmocka_unit_test(an_empty_log_marks_a_run_directory),
        cmocka_unit_test(a_half_written_scene_is_replaced),
        cmocka_unit_test(an_older_runs_pictures_are_recognised),
        cmocka_unit_test(render_replaces_its_own_pictures_only),
    };
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
