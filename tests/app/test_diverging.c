/* A run that diverges reports where and when, and writes its last good state. */
#include "program.h"

#include "../output/json_check.h"
#include "base/memory.h"
#include "frame/frame.h"
#include "output/particles/vtp.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct failure {
    unsigned long long step;
    double time, x, y, z;
} failure;

/* Reads step, time and position from the message. */
static failure read_failure(const char *line)
{
    failure f;
    assert_contains(line, "diverged");
    int found = sscanf(line, "shorebreak: step %llu, t = %lf s", &f.step, &f.time);
    const char *place = strstr(line, " at (");
    if (found != 2 || !place || sscanf(place, " at (%lf, %lf, %lf) m", &f.x, &f.y, &f.z) != 3)
        fail_msg("no step or position in %s", line);
    return f;
}

/* The last line of stderr; warnings may precede it. */
static const char *last_line(char *text)
{
    size_t length = strlen(text);
    assert_true(length > 0 && text[length - 1] == '\n');
    text[length - 1] = '\0';
    const char *before = strrchr(text, '\n');
    return before ? before + 1 : text;
}

/* The file contains all particles except those that the run counted as lost or left. */
static void check_last_good(const char *run, size_t count, double time)
{
    char summary[64];
    snprintf(summary, sizeof summary, "%s/summary.json", run);
    count -= (size_t)(json_number_of(summary, "lost_particles") + json_number_of(summary, "left_domain"));
    sb_frame *frame = NULL;
    sb_error error = {0};
    if (sb_vtp_read(in_folder("%s/particles/last-good.vtp", run), &frame, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(frame->count, count);
    assert_near(frame->status.time, time, 1e-5 * (1 + time));
    for (size_t i = 0; i < 3 * count; i++) {
        assert_true(isfinite(frame->position[i]) && isfinite(frame->velocity[i]));
        double coordinate = (double)frame->position[i] + (i % 3 == 0   ? frame->origin.x
                                                          : i % 3 == 1 ? frame->origin.y
                                                                       : frame->origin.z);
        assert_true(coordinate > -1 && coordinate < 3);
    }
    sb_frame_release(frame);
}

static void check_summary(const char *run)
{
    char name[64];
    snprintf(name, sizeof name, "%s/summary.json", run);
    assert_true(json_number_of(name, "simulated_s") >= 0);
    char *text = text_of(name);
    assert_contains(text, "\"status\": \"failed\"");
    const char *reason = json_find(text, "reason");
    assert_non_null(reason);
    assert_contains(reason, "diverged");
    sb_free(text);
    snprintf(name, sizeof name, "%s/run.jsonl", run);
    text = text_of(name);
    assert_contains(text, "last_good_state");
    for (char *line = text, *end; (end = strchr(line, '\n')); line = end + 1) {
        *end = '\0';
        if (!json_valid(line)) fail_msg("no JSON: %s", line);
    }
    sb_free(text);
}

static void an_extreme_start_fails_at_once(void **state)
{
    (void)state;
    outcome o = RUN(2, "run", "tank2.yaml", "--out", "start", "--quiet", "--set", "water.boxes.0.velocity=[300, 0]");
    failure f = read_failure(last_line(o.err));
    assert_in_range(f.step, 1, 2);
    assert_true(f.x > 0 && f.x < 2 && f.z > 0 && f.z < 1);
    outcome_free(&o);
    check_last_good("start", 300, f.time);
    check_summary("start");
    assert_false(any_ending("start", ".tmp"));
}

/* A paddle that starts at 100 km/s after a tenth of a second. */
static void an_extreme_paddle_fails_during_the_run(void **state)
{
    (void)state;
    write_text("paddle.yaml", "dimensions: 2\n"
                              "resolution: 0.04\n"
                              "duration: 0.3\n"
                              "domain: {min: [-0.3, 0], max: [2, 1]}\n"
                              "water:\n"
                              "  boxes:\n"
                              "    - {min: [0, 0], max: [0.8, 0.6]}\n"
                              "bodies:\n"
                              "  - {name: paddle, shape: box, min: [-0.2, 0], max: [0, 0.9]}\n"
                              "wavemakers:\n"
                              "  - {name: blow, body: paddle, kind: stroke, stroke: 2,\n"
                              "     speed: 100000, start: 0.1}\n"
                              "measure: {interval: 0.02}\n"
                              "output: {particle_interval: 0.04, plots: false}\n");
    outcome o = RUN(2, "run", "paddle.yaml", "--out", "blow", "--quiet");
    failure f = read_failure(last_line(o.err));
    assert_true(f.step > 5);
    assert_true(f.time > 0.08 && f.time < 0.12);
    outcome_free(&o);
    check_last_good("blow", 300, f.time);
    check_summary("blow");
    /* Earlier results stay: particle files of 0, 0.04 and 0.08 s, rows up to the failure. */
    for (int i = 1; i <= 3; i++) {
        sb_frame *frame = NULL;
        assert_int_equal(sb_vtp_read(in_folder("blow/particles/%06d.vtp", i), &frame, NULL), SB_OK);
        sb_frame_release(frame);
    }
    char *forces = text_of("blow/forces.csv");
    assert_contains(forces, "\n0.08,paddle,");
    assert_int_equal(forces[strlen(forces) - 1], '\n');
    sb_free(forces);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_extreme_start_fails_at_once),
        cmocka_unit_test(an_extreme_paddle_fails_during_the_run),
    };
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
