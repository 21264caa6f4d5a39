/* Pictures drawn from the particle files of a finished run. */
#include "program.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/memory.h"

#include <limits.h>
#include <png.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WIDTH = 160, HEIGHT = 90, FRAMES = 4, BYTES = 3 * WIDTH * HEIGHT };

typedef unsigned char picture[BYTES];

/* Makes a run whose pictures and particle files have the same times. */
static int setup(void **state)
{
    if (program_setup(state) != 0) return -1;
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "r", "--quiet");
    return 0;
}

static void read_picture(const char *path, picture pixels, int width, int height)
{
    png_image image = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_file(&image, path)) fail_msg("%s: %s", path, image.message);
    image.format = PNG_FORMAT_RGB;
    assert_int_equal(image.width, width);
    assert_int_equal(image.height, height);
    assert_true(PNG_IMAGE_SIZE(image) <= BYTES);
    assert_true(png_image_finish_read(&image, NULL, pixels, 0, NULL));
}

/* Fraction of the pixels whose colours differ by more than a few levels. */
static double difference(const picture a, const picture b)
{
    size_t unlike = 0;
    for (size_t p = 0; p < BYTES; p += 3) {
        int most = 0;
        for (size_t c = p; c < p + 3; c++)
            if (abs(a[c] - b[c]) > most) most = abs(a[c] - b[c]);
        unlike += most > 8;
    }
    return (double)unlike / (WIDTH * HEIGHT);
}

static void one_camera_into_another_folder(void **state)
{
    (void)state;
    static picture drawn, during;
    outcome o = RUN(0, "render", "r", "--camera", "side", "--out", "one");
    assert_contains(o.out, "picture 4 of 4\n");
    assert_string_equal(o.err, "");
    outcome_free(&o);
    assert_false(exists("one/frames/front"));
    assert_false(exists("one/frames/side/000005.png"));
    for (int i = 1; i <= FRAMES; i++) {
        read_picture(in_folder("one/frames/side/%06d.png", i), drawn, WIDTH, HEIGHT);
        read_picture(in_folder("r/frames/side/%06d.png", i), during, WIDTH, HEIGHT);
        double unlike = difference(drawn, during);
        if (unlike > 0.01) fail_msg("picture %d: %g of the pixels differ from the run's", i, unlike);
    }
    /* Pictures of different cameras must differ, otherwise the comparison would prove nothing. */
    read_picture(in_folder("r/frames/front/%06d.png", FRAMES), during, WIDTH, HEIGHT);
    assert_true(difference(drawn, during) > 0.1);
}

/* Each camera that is named is drawn, in any order; those that are not named are left alone. */
static void several_cameras(void **state)
{
    (void)state;
    static const char cameras[] = "render.cameras=[{name: a, eye: [1, -3, 1], target: [1, 0, 0]}, "
                                  "{name: b, eye: [1, -2, 2], target: [1, 0, 0]}, "
                                  "{name: c, eye: [1, -1, 3], target: [1, 0, 0]}]";
    RUN_AND_FORGET(0, "render", "r", "--out", "two", "--quiet", "--set", cameras, "--camera", "c", "--camera", "a",
                   "--camera", "c");
    assert_true(exists("two/frames/a/000004.png") && exists("two/frames/c/000004.png"));
    assert_false(exists("two/frames/b"));
    outcome o = RUN(1, "render", "r", "--out", "none", "--set", cameras, "--camera", "a", "--camera", "d");
    assert_one_line(o.err, "--camera d: no such camera");
    outcome_free(&o);
    assert_false(exists("none"));
}

/* The niceness of a process; INT_MIN: it has ended. The graphics library gives threads of its own a lower priority. */
static int niceness_of(pid_t process)
{
    char path[64], text[1024];
    snprintf(path, sizeof path, "/proc/%d/stat", (int)process);
    FILE *file = fopen(path, "r");
    text[file ? fread(text, 1, sizeof text - 1, file) : 0] = '\0';
    if (file) fclose(file);
    const char *at = strrchr(text, ')'); /* behind it: state, 15 numbers, the niceness */
    for (int k = 0; at && k < 17; k++) at = strchr(at + 1, ' ');
    return at ? atoi(at) : INT_MIN;
}

/* No simulation runs in a render, so that it keeps the priority that it was started with. */
static void at_its_own_priority(void **state)
{
    (void)state;
    int samples = 0, most = INT_MIN;
    const pid_t process = program_start(
        (const char *const[]){"render", "r", "--out", "own", "--quiet", "--set", "render.width=640", NULL});
    for (double end = sb_clock() + 30; !exists("own/frames/front/000004.png") && sb_clock() < end; usleep(500)) {
        const int now = niceness_of(process);
        if (!exists("own/frames/side/000001.png") || now == INT_MIN) continue;
        samples++;
        most = now > most ? now : most;
    }
    outcome o = program_finish(process);
    assert_int_equal(o.status, 0);
    outcome_free(&o);
    assert_true(samples > 0);
    assert_int_equal(most, getpriority(PRIO_PROCESS, 0));
}

static void all_cameras_without_a_choice(void **state)
{
    (void)state;
    outcome o =
        RUN(0, "render", "r", "--out", "all", "--quiet", "--set", "render.width=64", "--set", "render.height=48");
    assert_string_equal(o.out, "");
    outcome_free(&o);
    static picture small;
    read_picture(in_folder("all/frames/side/000004.png"), small, 64, 48);
    read_picture(in_folder("all/frames/front/000004.png"), small, 64, 48);
}

static void a_new_camera(void **state)
{
    (void)state;
    static picture top, side;
    RUN_AND_FORGET(0, "render", "r", "--out", "new", "--quiet", "--set",
                   "render.cameras=[{name: top, eye: [1, 0.3, 4], target: [1, 0.4, 0]}]");
    assert_false(exists("new/frames/side"));
    read_picture(in_folder("new/frames/top/000002.png"), top, WIDTH, HEIGHT);
    read_picture(in_folder("r/frames/side/000002.png"), side, WIDTH, HEIGHT);
    assert_true(difference(top, side) > 0.1);
    RUN_AND_FORGET(0, "render", "r", "--out", "new", "--quiet", "--camera", "low", "--set",
                   "render.cameras=[{name: top, eye: [1, 0.3, 4], target: [1, 0.4, 0]}, "
                   "{name: low, eye: [1, -2, 0.3], target: [1, 0.4, 0.3]}]");
    assert_true(exists("new/frames/low/000004.png"));
}

/* Without --out the pictures go to the run itself. */
static void into_the_run_itself(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "bare", "--quiet", "--until", "0.02", "--set", "render.interval=0");
    assert_false(exists("bare/frames"));
    RUN_AND_FORGET(0, "render", "bare", "--quiet");
    assert_true(exists("bare/frames/side/000001.png"));
}

/* During a run, `render` cannot draw into its directory, but can draw into another one. */
static void during_a_run(void **state)
{
    (void)state;
    pid_t process =
        program_start((const char *const[]){"run", "tank3.yaml", "--out", "busy", "--quiet", "--until", "1000", NULL});
    for (double end = sb_clock() + 30; !exists("busy/frames/front/000002.png") && sb_clock() < end;) usleep(2000);
    outcome o = RUN(1, "render", "busy", "--quiet");
    assert_one_line(o.err, "busy: another run or render is writing there, expected another directory given with --out");
    outcome_free(&o);
    assert_true(exists("busy/frames/side/000001.png") && exists("busy/frames/front/000001.png"));
    RUN_AND_FORGET(0, "render", "busy", "--quiet", "--camera", "side", "--out", "beside");
    assert_true(exists("beside/frames/side/000002.png"));
    assert_int_equal(kill(process, SIGTERM), 0);
    o = program_finish(process);
    assert_int_equal(o.status, 143);
    outcome_free(&o);
    RUN_AND_FORGET(0, "render", "busy", "--quiet", "--camera", "side");
}

static void unknown_camera(void **state)
{
    (void)state;
    outcome o = RUN(1, "render", "r", "--camera", "cellar", "--out", "none");
    assert_one_line(o.err, "cellar");
    outcome_free(&o);
    assert_false(exists("none"));
    o = RUN(1, "render", "r", "--out", "none", "--set", "render.cameras=[{name: x}]");
    assert_one_line(o.err, "render.cameras");
    outcome_free(&o);
}

static void no_particle_files(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "flat", "--quiet", "--until", "0.02", "--set",
                   "output.particle_interval=0");
    outcome o = RUN(1, "render", "flat", "--set", "render.cameras=[{name: a, eye: [1, -3, 1], target: [1, 0, 0]}]");
    assert_one_line(o.err, "flat: the run has no particle files; expected one with output.particle_interval");
    outcome_free(&o);
    o = RUN(1, "render", "flat");
    assert_one_line(o.err, "no camera");
    outcome_free(&o);
}

static void copy_with(const char *from, const char *to, size_t keep, size_t damaged)
{
    char *bytes;
    size_t length;
    assert_int_equal(sb_file_read(in_folder("%s", from), 1 << 24, &bytes, &length, NULL), SB_OK);
    assert_true(keep <= length && damaged < length);
    if (damaged > 0) bytes[damaged] = '#';
    FILE *file = fopen(in_folder("%s", to), "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, keep > 0 ? keep : length, file), keep > 0 ? keep : length);
    assert_int_equal(fclose(file), 0);
    sb_free(bytes);
}

static void damaged_particle_file(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "hurt", "--quiet", "--until", "0.2", "--set", "render.interval=0");
    static const struct {
        size_t keep, damaged;
    } damages[] = {{4000, 0}, {100, 0}, {0, 35}};
    for (size_t w = 0; w < sizeof damages / sizeof damages[0]; w++) {
        copy_with("r/particles/000002.vtp", "hurt/particles/000002.vtp", damages[w].keep, damages[w].damaged);
        outcome o = RUN(1, "render", "hurt", "--out", "worse", "--quiet");
        assert_one_line(o.err, "hurt/particles/000002.vtp: ");
        outcome_free(&o);
    }
    /* Until the first new picture, those of an earlier command stay. */
    assert_true(exists("worse/frames/side/000001.png"));
    copy_with("r/particles/000001.vtp", "hurt/particles/000001.vtp", 300, 0);
    RUN_AND_FORGET(1, "render", "hurt", "--out", "worse", "--quiet");
    assert_true(exists("worse/frames/side/000001.png"));
    copy_with("r/particles/000001.vtp", "hurt/particles/000001.vtp", 0, 0);
    assert_int_equal(unlink(in_folder("hurt/particles/000002.vtp")), 0);
    outcome o = RUN(1, "render", "hurt", "--out", "worse", "--quiet");
    assert_one_line(o.err, "hurt/particles/000002.vtp: ");
    outcome_free(&o);
    write_text("hurt/particles.pvd", "<VTKFile");
    o = RUN(1, "render", "hurt", "--out", "worse", "--quiet");
    assert_one_line(o.err, "hurt/particles.pvd");
    outcome_free(&o);
    assert_false(any_ending("worse", ".tmp"));
}

/* 0.4 m of water: particles from x = 0 to 4 m, the grid's from -6 m on. The wave is in the grid, 2 m before the side.
 */
static const char nested[] =
    "title: t\ndimensions: 2\nresolution: 0.04\nduration: 0.4\nnumerics: {settle_steps: 0}\n"
    "output: {plots: false, particle_interval: 0.2}\n"
    "water: {level: 0.4, seed: [1, 0.2]}\ndomain: {min: [0, 0], max: [4, 0.8], sides: {x_min: sea}}\n"
    "sea: {source: offshore}\n"
    "offshore: {cell: 0.04, min: [-6], max: [4], manning: 0, maps: false, drawn: 4,\n"
    "  wave: {kind: solitary, height: 0.1, depth: 0.4, position: -2, theory: serre}}\n"
    "render: {interval: 0.2, width: 160, height: 90, speed_max: 1, cameras: [{name: side, eye: [0, -8, 1.5], target: "
    "[0, 0, "
    "0.3]}]}\n";

/* The water of the grid comes from its files: pictures are those of the run, but for the grid's time, which is ahead by
   less than a step. Without a file, the picture shows the particles only, and a warning says so. */
static void water_of_the_grid_is_shown(void **state)
{
    (void)state;
    static picture run, again, without;
    write_text("nested.yaml", nested);
    RUN_AND_FORGET(0, "run", "nested.yaml", "--out", "nested", "--quiet");
    outcome o = RUN(0, "render", "nested", "--out", "nested-again", "--quiet");
    assert_string_equal(o.err, "");
    outcome_free(&o);
    RUN_AND_FORGET(0, "render", "nested", "--out", "nested-dry", "--quiet", "--set", "offshore.drawn=0");
    read_picture(in_folder("nested/frames/side/000002.png"), run, WIDTH, HEIGHT);
    read_picture(in_folder("nested-again/frames/side/000002.png"), again, WIDTH, HEIGHT);
    read_picture(in_folder("nested-dry/frames/side/000002.png"), without, WIDTH, HEIGHT);
    printf("grid in pictures: %.4f, without it %.4f\n", difference(run, again), difference(run, without));
    assert_true(difference(run, without) > 0.02);
    assert_true(difference(run, again) < 0.1 * difference(run, without));
    assert_int_equal(unlink(in_folder("nested/grid/000002.vti")), 0);
    o = RUN(0, "render", "nested", "--out", "nested-lost", "--quiet");
    assert_one_line(o.err, "grid/000002.vti: ");
    assert_contains(o.err, "show no water of the grid");
    outcome_free(&o);
    read_picture(in_folder("nested-lost/frames/side/000002.png"), without, WIDTH, HEIGHT);
    assert_true(difference(again, without) > 0.02);
    write_text("nested/grid/000002.vti", "<?xml version=\"1.0\"?>\n<VTKFile");
    o = RUN(0, "render", "nested", "--out", "nested-damaged", "--quiet");
    assert_one_line(o.err, "grid/000002.vti: no appended data, expected a grid file of shorebreak");
    outcome_free(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(water_of_the_grid_is_shown),
        cmocka_unit_test(one_camera_into_another_folder),
        cmocka_unit_test(several_cameras),
        cmocka_unit_test(at_its_own_priority),
        cmocka_unit_test(all_cameras_without_a_choice),
        cmocka_unit_test(a_new_camera),
        cmocka_unit_test(into_the_run_itself),
        cmocka_unit_test(during_a_run),
        cmocka_unit_test(unknown_camera),
        cmocka_unit_test(no_particle_files),
        cmocka_unit_test(damaged_particle_file),
    };
    return cmocka_run_group_tests(tests, setup, program_teardown);
}
