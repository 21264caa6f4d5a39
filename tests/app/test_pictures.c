/* The times of pictures, stills, cameras that move by themselves, and plots in pictures; also of resumed runs. */
#include "program.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/memory.h"

#include <png.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Water that falls to the right, and towards larger y, with a camera of each kind. */
static const char scene[] =
    "title: Pictures\n"
    "resolution: 0.1\n"
    "duration: 0.3\n"
    "domain: {min: [0, 0, 0], max: [2.6, 0.8, 1]}\n"
    "water: {boxes: [{min: [0, 0, 0], max: [0.8, 0.8, 0.6]}]}\n"
    "bodies:\n"
    "  - {name: post, shape: box, min: [1.0, 0.3, 0], max: [1.3, 0.6, 0.8]}\n"
    "measure: {interval: 0.02, gauges: [{name: wet, x: 0.4, y: 0.4}]}\n"
    "output: {particle_interval: 0.07, plots: false}\n"
    "render:\n"
    "  interval: 0.07\n"
    "  width: 320\n"
    "  height: 240\n"
    "  still_width: 480\n"
    "  still_height: 270\n"
    "  speed_max: 2\n"
    "  video: false\n"
    "  stills: [0.03, 0.21, 0.25]\n"
    "  insets: [{force: post, axis: x}, {gauge: wet}]\n"
    "  cameras:\n"
    "    - {name: crest, eye: [0.4, -2, 1.2], target: [0.4, 0.4, 0.3], follow: crest, travel: true}\n"
    "    - {name: round, orbit: {target: [1, 0.4, 0.3], radius: 3, height: 1, period: 1}}\n"
    "    - {name: post, closeup: post}\n";

static int setup(void **state)
{
    if (program_setup(state) != 0) return -1;
    write_text("p.yaml", scene);
    RUN_AND_FORGET(0, "run", "p.yaml", "--out", "r", "--quiet");
    return 0;
}

/* Checks the k-th event of this kind in the log: its time, and that its step ended at this time or later by less than
   a step. */
static void check_event(const char *log, const char *event, int k, double time)
{
    char mark[64];
    double drawn = -1, end = -1;
    unsigned long long step = 0;
    snprintf(mark, sizeof mark, "{\"event\":\"%s\"", event);
    for (int i = 0; i <= k && log; i++) log = strstr(i > 0 ? log + 1 : log, mark);
    if (!log) fail_msg("no %s number %d", event, k);
    const char *text = strstr(log, "\"text\":\"");
    assert_non_null(text);
    assert_int_equal(sscanf(text, "\"text\":\"t = %lf s, from step %llu at t = %lf s", &drawn, &step, &end), 3);
    assert_true(drawn > time - 1e-12 && drawn < time + 1e-12);
    if (!(end >= time - 1e-9 && end < time + 0.03))
        fail_msg("%s at %g s is from a step that ended at %g s", event, time, end);
}

static size_t count_of(const char *text, const char *word)
{
    size_t count = 0;
    for (; (text = strstr(text, word)); text++) count++;
    return count;
}

static void pictures_have_their_exact_times(void **state)
{
    (void)state;
    char *log = text_of("r/run.jsonl");
    for (int k = 0; k < 5; k++) check_event(log, "picture", k, 0.07 * k);
    check_event(log, "still", 0, 0.03);
    check_event(log, "still", 1, 0.21);
    check_event(log, "still", 2, 0.25);
    assert_int_equal(count_of(log, "{\"event\":\"picture\""), 5);
    assert_int_equal(count_of(log, "{\"event\":\"still\""), 3);
    sb_free(log);
    assert_true(exists("r/frames/round/000005.png") && !exists("r/frames/round/000006.png"));
    assert_true(exists("r/stills/round/000003.png") && !exists("r/stills/round/000004.png"));
}

/* With an interval shorter than the time step, each picture still has its time. */
static void a_step_can_have_several_pictures(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "p.yaml", "--out", "fine", "--quiet", "--until", "0.03", "--set", "render.interval=0.002",
                   "--set", "render.insets=[]", "--set", "render.stills=[]", "--set",
                   "render.cameras=[{name: a, closeup: post}]", "--set", "render.width=64", "--set",
                   "render.height=48");
    char *log = text_of("fine/run.jsonl");
    for (int k = 0; k < 15; k++) check_event(log, "picture", k, 0.002 * k);
    sb_free(log);
    assert_true(exists("fine/frames/a/000015.png"));
}

static png_bytep read_png(const char *path, png_image *image)
{
    *image = (png_image){.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_file(image, path)) fail_msg("%s: %s", path, image->message);
    image->format = PNG_FORMAT_RGB;
    png_bytep pixels = sb_alloc(PNG_IMAGE_SIZE(*image), 1);
    assert_non_null(pixels);
    assert_true(png_image_finish_read(image, NULL, pixels, 0, NULL));
    return pixels;
}

static void stills_have_their_own_size(void **state)
{
    (void)state;
    png_image image;
    sb_free(read_png(in_folder("r/stills/post/000002.png"), &image));
    assert_int_equal(image.width, 480);
    assert_int_equal(image.height, 270);
    sb_free(read_png(in_folder("r/frames/post/000002.png"), &image));
    assert_int_equal(image.width, 320);
    /* A run may have stills alone. */
    RUN_AND_FORGET(0, "run", "p.yaml", "--out", "alone", "--quiet", "--until", "0.05", "--set", "render.interval=0");
    assert_true(exists("alone/stills/crest/000001.png") && !exists("alone/stills/crest/000002.png"));
    assert_false(exists("alone/frames"));
    /* They are files of a run, which the next one replaces. */
    RUN_AND_FORGET(0, "run", "p.yaml", "--out", "alone", "--quiet", "--until", "0.01", "--overwrite", "--set",
                   "render.stills=[]");
    assert_false(exists("alone/stills"));
}

static void assert_same_file(const char *a, const char *b)
{
    size_t length[2];
    char *bytes[2];
    sb_error error = {0};
    assert_int_equal(sb_file_read(in_folder("%s", a), 1 << 24, &bytes[0], &length[0], &error), SB_OK);
    assert_int_equal(sb_file_read(in_folder("%s", b), 1 << 24, &bytes[1], &length[1], &error), SB_OK);
    if (length[0] != length[1] || memcmp(bytes[0], bytes[1], length[0]) != 0) fail_msg("%s and %s differ", a, b);
    sb_free(bytes[0]);
    sb_free(bytes[1]);
}

/* Cameras that follow and plots continue after a pause as if there had been none. */
static void a_resumed_run_has_the_same_pictures(void **state)
{
    (void)state;
    static const char *const cameras[] = {"crest", "round", "post"};
    RUN_AND_FORGET(0, "run", "p.yaml", "--out", "two", "--quiet", "--until", "0.12");
    assert_true(exists("two/stills/crest/000001.png") && !exists("two/stills/crest/000002.png"));
    RUN_AND_FORGET(0, "run", "p.yaml", "--out", "two", "--quiet", "--resume");
    for (size_t c = 0; c < 3; c++)
        for (int k = 1; k <= 8; k++) {
            char a[128], b[128];
            const char *folder = k <= 5 ? "frames" : "stills";
            snprintf(a, sizeof a, "r/%s/%s/%06d.png", folder, cameras[c], k <= 5 ? k : k - 5);
            snprintf(b, sizeof b, "two/%s/%s/%06d.png", folder, cameras[c], k <= 5 ? k : k - 5);
            assert_same_file(a, b);
        }
}

/* A house stands in water that falls, so that only what is remembered shows how high the water has been. */
static const char painted[] = "title: Painted\n"
                              "resolution: 0.1\n"
                              "duration: 0.42\n"
                              "domain: {min: [0, 0, 0], max: [2.6, 0.8, 1]}\n"
                              "water: {boxes: [{min: [0, 0, 0], max: [0.8, 0.8, 0.6]}]}\n"
                              "bodies:\n"
                              "  - {name: house, shape: box, min: [0.2, 0.3, 0], max: [0.5, 0.6, 0.8]}\n"
                              "  - {name: post, shape: box, min: [1.0, 0.3, 0], max: [1.3, 0.6, 0.8]}\n"
                              "numerics: {settle_steps: 0}\n"
                              "measure: {interval: 0.02}\n"
                              "output: {particle_interval: 0.07, plots: false, checkpoint: {steps: 3, minutes: 0}}\n"
                              "render:\n"
                              "  interval: 0.07\n"
                              "  width: 320\n"
                              "  height: 240\n"
                              "  still_width: 160\n"
                              "  still_height: 90\n"
                              "  speed_max: 2\n"
                              "  video: false\n"
                              "  wet_ground: true\n"
                              "  greatest_depth: true\n"
                              "  stills: [0.1, 0.42]\n"
                              "  cameras:\n"
                              "    - {name: house, eye: [-0.6, -0.9, 1.4], target: [0.35, 0.45, 0.4]}\n"
                              "    - {name: balls, eye: [0.4, -2, 1.2], target: [0.4, 0.4, 0.3], style: particles}\n";

static void assert_same_pictures(const char *a, const char *b, const char *folder, int from, int to)
{
    static const char *const cameras[] = {"house", "balls"};
    for (int c = 0; c < 2; c++)
        for (int k = from; k <= to; k++) {
            char one[128], other[128];
            snprintf(one, sizeof one, "%s/%s/%s/%06d.png", a, folder, cameras[c], k);
            snprintf(other, sizeof other, "%s/%s/%s/%06d.png", b, folder, cameras[c], k);
            assert_same_file(one, other);
        }
}

static void start_and_kill(const char *directory)
{
    char third[128];
    snprintf(third, sizeof third, "%s/frames/balls/000003.png", directory);
    const pid_t process =
        program_start((const char *const[]){"run", "painted.yaml", "--out", directory, "--quiet", NULL});
    for (double end = sb_clock() + 30; !exists(third) && sb_clock() < end;) usleep(1000);
    assert_true(exists(third));
    kill(process, SIGKILL);
    outcome o = program_finish(process);
    assert_int_equal(o.status, 128 + SIGKILL);
    outcome_free(&o);
    assert_false(exists("killed/frames/house/000007.png")); /* or nothing would be left to do */
}

/* What the water has reached is remembered over a kill, by the film and by stills. */
static void what_water_reached_survives_a_kill(void **state)
{
    (void)state;
    write_text("painted.yaml", painted);
    RUN_AND_FORGET(0, "run", "painted.yaml", "--out", "whole", "--quiet");
    start_and_kill("killed");
    RUN_AND_FORGET(0, "run", "killed/scene.yaml", "--out", "killed", "--quiet", "--resume");
    assert_same_pictures("whole", "killed", "frames", 1, 7);
    assert_same_pictures("whole", "killed", "stills", 1, 2);
}

/* Fraction of pixels that differ by more than a few levels, in the part of the picture where plots are or elsewhere. */
static double difference(const char *a, const char *b, bool plots)
{
    png_image one, other;
    png_bytep left = read_png(in_folder("%s", a), &one), right = read_png(in_folder("%s", b), &other);
    assert_true(one.width == other.width && one.height == other.height);
    size_t unlike = 0, count = 0;
    for (size_t p = 0; p < (size_t)one.width * one.height; p++) {
        const bool within = p % one.width < 210 && p / one.width > 25;
        if (within != plots) continue;
        int most = 0;
        for (size_t c = 3 * p; c < 3 * p + 3; c++)
            if (abs(left[c] - right[c]) > most) most = abs(left[c] - right[c]);
        unlike += most > 8;
        count++;
    }
    sb_free(left);
    sb_free(right);
    return (double)unlike / (double)count;
}

/* Pictures with all that a run stores for them are those of the run; only a body that moves is where the step left it.
 */
static void render_draws_the_same_effects(void **state)
{
    (void)state;
    static const char *const set[] = {"--set",
                                      "render.loads=true",
                                      "--set",
                                      "foam.enabled=true",
                                      "--set",
                                      "output.checkpoint.steps=0",
                                      "--set",
                                      "render.cameras=[{name: house, eye: [-0.6, -0.9, 1.4], target: [0.35, 0.45, "
                                      "0.4], color: density_error}, {name: balls, eye: [0.4, -2, 1.2], target: [0.4, "
                                      "0.4, 0.3], slice: {point: [0.4, 0.5, 0.3], normal: [0, 1, 0], vectors: 0.2}}]"};
    write_text("painted.yaml", painted);
    RUN_AND_FORGET(0, "run", "painted.yaml", "--out", "effects", "--quiet", set[0], set[1], set[2], set[3], set[4],
                   set[5], set[6], set[7]);
    outcome o = RUN(0, "render", "effects", "--out", "effects-again", "--quiet", "--set", "render.stills=[]");
    assert_string_equal(o.err, "");
    outcome_free(&o);
    assert_true(exists("effects/foam/000007.vtp"));
    assert_same_pictures("effects", "effects-again", "frames", 1, 7);
    /* The still at 0.1 s, which is left out, adds nothing: the water falls. */
    RUN_AND_FORGET(0, "render", "whole", "--out", "whole-again", "--quiet", "--set", "render.stills=[]");
    assert_same_pictures("whole", "whole-again", "frames", 1, 7);
}

/* `render` carries the water of the particle files to the same times, and has the plots from the tables. */
static void render_draws_the_same_pictures(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "render", "r", "--out", "again", "--quiet");
    RUN_AND_FORGET(0, "render", "r", "--out", "bare", "--quiet", "--set", "render.insets=[]");
    for (int k = 1; k <= 5; k++) {
        char drawn[64], again[64], bare[64];
        snprintf(drawn, sizeof drawn, "r/frames/round/%06d.png", k);
        snprintf(again, sizeof again, "again/frames/round/%06d.png", k);
        snprintf(bare, sizeof bare, "bare/frames/round/%06d.png", k);
        assert_same_file(drawn, again);
        /* The plots would be missed. */
        assert_true(difference(drawn, bare, true) > 0.2 && difference(drawn, bare, false) < 0.003);
    }
    /* A still that the run does not reach is a warning. */
    outcome o = RUN(0, "check", "p.yaml", "--set", "duration=0.1");
    assert_contains(o.out, "render.stills: 0.25 s is after the end of the run at 0.1 s: it has no still");
    outcome_free(&o);
    o = RUN(1, "render", "r", "--out", "none", "--set", "render.cameras=[{name: a, closeup: pots}]");
    assert_one_line(o.err, "no body is named pots, did you mean post?");
    outcome_free(&o);
}

/* A still whose time a particle file has is that of the run. Others show the nearest time, with a warning. */
static void render_draws_stills(void **state)
{
    (void)state;
    png_image image;
    outcome o = RUN(0, "render", "r", "--out", "later");
    assert_contains(o.err, "render.stills: 0.03 s: no particle file has this time; the still shows the water at 0 s\n");
    assert_contains(o.err,
                    "render.stills: 0.25 s: no particle file has this time; the still shows the water at 0.28 s\n");
    assert_null(strstr(o.err, "0.21 s"));
    assert_contains(o.out, "3 of 3 stills\n");
    outcome_free(&o);
    assert_same_file("r/stills/round/000002.png", "later/stills/round/000002.png");
    assert_same_file("r/stills/post/000002.png", "later/stills/post/000002.png");
    assert_same_file("r/frames/round/000004.png", "later/frames/round/000004.png");
    /* Stills alone, of one camera and another size. */
    o = RUN(0, "render", "r", "--out", "only", "--camera", "post", "--set", "render.interval=0", "--set",
            "render.stills=[0.14, 5]", "--set", "render.still_width=64", "--set", "render.still_height=48");
    assert_one_line(o.err, "render.stills: 5 s: no particle file is near this time, there is no still of it");
    outcome_free(&o);
    sb_free(read_png(in_folder("only/stills/post/000001.png"), &image));
    assert_true(image.width == 64 && image.height == 48);
    assert_false(exists("only/stills/post/000002.png") || exists("only/stills/round") || exists("only/frames"));
    /* Files of other origin are not overwritten. */
    write_text("only/stills/post/000001.png", "mine");
    o = RUN(1, "render", "r", "--out", "only", "--set", "render.interval=0");
    assert_one_line(o.err, "was not written by shorebreak");
    outcome_free(&o);
}

/* Columns of the middle row of a picture that show water, which is darker than the sky, on the left and
   the right half. */
static void count_water(const char *path, int water[2])
{
    png_image image;
    png_bytep pixels = read_png(in_folder("%s", path), &image);
    const png_bytep row = pixels + 3 * (size_t)(image.height / 2) * image.width;
    water[0] = water[1] = 0;
    for (unsigned x = 0; x < image.width; x++) water[x >= image.width / 2] += row[3 * x] < 130;
    sb_free(pixels);
}

/* The side of the domain, where the water of the grid and that of the particles meet, is in the middle of the picture;
   both water is as high as the view. */
static void water_of_the_grid_joins_that_of_particles(void **state)
{
    (void)state;
    int water[2];
    write_text("nested.yaml", "title: t\ndimensions: 2\nresolution: 0.04\nduration: 0.9\nnumerics: {settle_steps: 20}\n"
                              "output: {plots: false}\nwater: {level: 0.4, seed: [1, 0.2]}\n"
                              "domain: {min: [0, 0], max: [2, 0.8], sides: {x_min: sea}}\nsea: {source: offshore}\n"
                              "offshore: {cell: 0.04, min: [-4], max: [2], manning: 0, sides: {x_min: wall},\n"
                              "  wave: {kind: solitary, height: 0.1, depth: 0.4, position: -1.5, theory: serre}}\n"
                              "render: {stills: [0, 0.7], still_width: 200, still_height: 100, scale_bar: false,\n"
                              "  cameras: [{name: side, eye: [0, -3, 0.2], target: [0, 0, 0.2], fov: 20}]}\n");
    RUN_AND_FORGET(0, "run", "nested.yaml", "--out", "joined", "--quiet", "--set", "offshore.drawn=2");
    RUN_AND_FORGET(0, "run", "nested.yaml", "--out", "parted", "--quiet", "--set", "offshore.drawn=0", "--until",
                   "0.01");
    for (int k = 1; k <= 2; k++) {
        char name[64];
        snprintf(name, sizeof name, "joined/stills/side/%06d.png", k);
        count_water(name, water);
        assert_int_equal(water[0], 100);
        assert_int_equal(water[1], 100);
    }
    count_water("parted/stills/side/000001.png", water);
    assert_true(water[0] < 5);
    assert_int_equal(water[1], 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_have_their_exact_times),
        cmocka_unit_test(a_step_can_have_several_pictures),
        cmocka_unit_test(stills_have_their_own_size),
        cmocka_unit_test(a_resumed_run_has_the_same_pictures),
        cmocka_unit_test(what_water_reached_survives_a_kill),
        cmocka_unit_test(render_draws_the_same_pictures),
        cmocka_unit_test(render_draws_the_same_effects),
        cmocka_unit_test(render_draws_stills),
        cmocka_unit_test(water_of_the_grid_joins_that_of_particles),
    };
    return cmocka_run_group_tests(tests, setup, program_teardown);
}
