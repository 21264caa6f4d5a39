/* A real run, recorded: its rows are those of the tables, its pictures those of the run, and streaming changes no bit.
 */
#include "program.h"

#include "base/memory.h"
#include "stream/live.h"
#include "stream/log.h"

#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WIDTH = 160, HEIGHT = 90, FRAMES = 4, BYTES = 3 * WIDTH * HEIGHT };

static void write_to_log(const char *name)
{
    char url[1024];
    snprintf(url, sizeof url, "file://%s?mode=w", in_folder("%s", name));
    setenv("LCM_DEFAULT_URL", url, 1);
}

static int setup(void **state)
{
    if (program_setup(state) != 0) return -1;
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "r", "--quiet");
    write_to_log("run.log");
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "streamed", "--quiet", "--set", "stream.enabled=true");
    unsetenv("LCM_DEFAULT_URL");
    return 0;
}

/* The text of the log's rows, written as the tables are. */
typedef struct tables {
    FILE *forces, *gauges;
} tables;

static void put(FILE *out, double value)
{
    fprintf(out, ",%.9g", value + 0.0);
}

static void on_forces(void *user, const sb_forces_message *m)
{
    FILE *out = ((tables *)user)->forces;
    for (int32_t i = 0; i < m->count; i++) {
        const double *const vectors[] = {m->force, m->moment, m->pressure, m->friction};
        fprintf(out, "%.12g,%s", m->time, m->names[i]);
        for (size_t v = 0; v < 4; v++)
            for (int k = 0; k < 3; k++) put(out, vectors[v][3 * i + k]);
        fputc('\n', out);
    }
}

static void on_gauges(void *user, const sb_gauges_message *m)
{
    FILE *out = ((tables *)user)->gauges;
    for (int32_t i = 0; i < m->count; i++) {
        fprintf(out, "%.12g,%s,", m->time, m->names[i]); /* the tank has no still-water level, so that eta is empty */
        if (m->wet[i])
            put(out, m->z[i]);
        else
            fputc(',', out);
        fputc('\n', out);
    }
}

static sb_live *read_log(const char *name, tables *to)
{
    const sb_live_calls calls = {.user = to, .forces = to ? on_forces : NULL, .gauges = to ? on_gauges : NULL};
    sb_live *live = sb_live_create(&calls);
    sb_log *log;
    sb_log_event event;
    sb_error error = {0};
    assert_non_null(live);
    if (sb_log_open(in_folder("%s", name), &log, &error) != SB_OK) fail_msg("%s", error.text);
    while (sb_log_next(log, &event))
        sb_live_take(live, sb_channel_guess(event.channel), event.data, event.size, event.time);
    sb_log_close(log);
    return live;
}

static void same_rows(const char *table, const char *rows)
{
    char *text = text_of(table), *body = strchr(text, '\n');
    assert_non_null(body);
    assert_string_equal(rows, body + 1);
    assert_true(strlen(rows) > 100);
    sb_free(text);
}

static void rows_are_those_of_the_tables(void **state)
{
    (void)state;
    char *forces = NULL, *gauges = NULL;
    size_t sizes[2];
    tables to = {open_memstream(&forces, &sizes[0]), open_memstream(&gauges, &sizes[1])};
    sb_live *live = read_log("run.log", &to);
    fclose(to.forces);
    fclose(to.gauges);
    same_rows("streamed/forces.csv", forces);
    same_rows("streamed/gauges.csv", gauges);
    free(forces);
    free(gauges);
    const sb_live_counts counts = sb_live_count(live);
    assert_int_equal(counts.refused + counts.lost + counts.foreign + counts.restarts + counts.frames_partial, 0);
    assert_int_equal(counts.frames_complete, FRAMES);
    const sb_status_message *status = sb_live_get_status(live);
    assert_int_equal(status->state, SB_RUN_DONE);
    assert_string_equal(status->run, "Tank in 3D");
    assert_true(status->time >= 0.3 && status->stage_count > 5 && status->iterations > 0);
    assert_int_equal(status->fluid_particles, 384);
    assert_int_equal(sb_live_get_scene(live)->camera_count, 2);
    sb_live_destroy(live);
}

static void streaming_changes_no_bit(void **state)
{
    (void)state;
    static const char *const files[] = {"forces.csv", "gauges.csv", "energy.csv", "probes.csv"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char name[64];
        snprintf(name, sizeof name, "r/%s", files[i]);
        char *without = text_of(name);
        snprintf(name, sizeof name, "streamed/%s", files[i]);
        char *with = text_of(name);
        assert_string_equal(with, without);
        sb_free(without);
        sb_free(with);
    }
    char *hashes[2] = {text_of("r/summary.json"), text_of("streamed/summary.json")};
    const char *a = strstr(hashes[0], "state_hash"), *b = strstr(hashes[1], "state_hash");
    if (!a || !b) fail_msg("no state_hash in summary.json");
    assert_memory_equal(a, b, 32);
    sb_free(hashes[0]);
    sb_free(hashes[1]);
}

static void a_replay_can_be_recorded_again(void **state)
{
    (void)state;
    write_to_log("again.log");
    outcome o = RUN(0, "replay", "run.log", "--speed", "0");
    unsetenv("LCM_DEFAULT_URL");
    assert_contains(o.out, "Tank in 3D: t = ");
    assert_string_equal(o.err, "");
    outcome_free(&o);
    sb_live *was = read_log("run.log", NULL), *is = read_log("again.log", NULL);
    assert_int_equal(sb_live_count(is).frames_complete, FRAMES);
    assert_int_equal(sb_live_count(is).lost + sb_live_count(is).refused, 0);
    const sb_live_frame *a = sb_live_get_frame(was), *b = sb_live_get_frame(is);
    assert_int_equal(a->count, b->count);
    assert_memory_equal(a->points, b->points, SB_STREAM_POINT * (size_t)a->count);
    sb_live_destroy(was);
    sb_live_destroy(is);
    o = RUN(1, "replay", "tank3.yaml");
    assert_one_line(o.err, "tank3.yaml: does not begin as a log of lcm-logger");
    outcome_free(&o);
    o = RUN(1, "replay", "run.log", "--speed", "-1");
    assert_one_line(o.err, "--speed -1: expected a factor from 0");
    outcome_free(&o);
}

/* The example of a subscriber, which uses LCM's own types only. */
static void the_example_prints_the_run(void **state)
{
    (void)state;
    char command[2048], text[1 << 14];
    snprintf(command, sizeof command, "exec '%s/example-subscriber' 'file://%s?speed=0' 2>&1", SB_BINARY_DIR,
             in_folder("run.log"));
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    const size_t length = fread(text, 1, sizeof text - 1, pipe);
    text[length] = '\0';
    assert_int_equal(pclose(pipe), 0);
    assert_contains(text, "Tank in 3D: t = 0 of 0.3 s, step 0\n");
    assert_contains(text, "  t = 0.3 s: force on post in x: ");
    assert_contains(text, ", part 1 of 1: 384 particles, the first one at x = ");
}

typedef unsigned char picture[BYTES];

static void read_picture(const char *path, picture pixels)
{
    png_image image = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_file(&image, path)) fail_msg("%s: %s", path, image.message);
    image.format = PNG_FORMAT_RGB;
    assert_int_equal(PNG_IMAGE_SIZE(image), BYTES);
    assert_true(png_image_finish_read(&image, NULL, pixels, 0, NULL));
}

/* Fraction of the pixels whose colours differ by more than a few levels. */
static double difference(const picture a, const picture b)
{
    size_t unlike = 0;
    for (size_t p = 0; p < BYTES; p += 3) {
        int most = 0;
        for (size_t c = p; c < p + 3; c++) most = abs(a[c] - b[c]) > most ? abs(a[c] - b[c]) : most;
        unlike += most > 8;
    }
    return (double)unlike / (WIDTH * HEIGHT);
}

/* Positions in a log are rounded to 1/64 of a spacing, a tenth of a pixel here, and speeds to 0.4 % of the largest. */
static void pictures_are_those_of_the_run(void **state)
{
    (void)state;
    static picture drawn, during, before;
    outcome o = RUN(0, "render", "run.log");
    assert_contains(o.out, ": picture 4\n");
    assert_string_equal(o.err, "");
    outcome_free(&o);
    for (int i = 1; i <= FRAMES; i++) {
        read_picture(in_folder("run.log-pictures/frames/front/%06d.png", i), drawn);
        read_picture(in_folder("r/frames/front/%06d.png", i), during);
        printf("picture %d: %.4f of the pixels differ\n", i, difference(drawn, during));
        assert_true(difference(drawn, during) < 0.01);
        if (i > 1) assert_true(difference(drawn, before) > 0.01); /* the water moves */
        memcpy(before, drawn, sizeof before);
    }
    o = RUN(0, "render", "run.log", "--camera", "side", "--out", "side", "--quiet");
    assert_string_equal(o.out, "");
    outcome_free(&o);
    assert_true(exists("side/frames/side/000004.png"));
    assert_false(exists("side/frames/front"));
    o = RUN(1, "render", "run.log", "--camera", "top");
    assert_one_line(o.err, "--camera top: no such camera");
    outcome_free(&o);
    o = RUN(1, "render", "run.log", "--set", "render.width=64");
    assert_one_line(o.err, "is a log, whose scene cannot be changed");
    outcome_free(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_are_those_of_the_tables),   cmocka_unit_test(streaming_changes_no_bit),
        cmocka_unit_test(a_replay_can_be_recorded_again), cmocka_unit_test(the_example_prints_the_run),
        cmocka_unit_test(pictures_are_those_of_the_run),
    };
    return cmocka_run_group_tests(tests, setup, program_teardown);
}
