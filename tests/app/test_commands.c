/* A run that is paused, stepped, watched and commanded has the bits and files of one that is not. */
#include "commander.h"

#include "base/memory.h"
#include "control/message.h"
#include "control/target.h"
#include "output/particles/particle_format.h"
#include "stream/listen.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Longer than the tank's 0.3 s, so that the run lasts until it is paused. */
#define LONGER                                                                                                         \
    "--set", "duration=8", "--set", "numerics.settle_steps=0", "--set", "output.particle_interval=2", "--set",         \
        "render.interval=4"

static void same_file(const char *name)
{
    char path[2][80];
    snprintf(path[0], sizeof path[0], "plain/%s", name);
    snprintf(path[1], sizeof path[1], "commanded/%s", name);
    size_t size[2];
    char *bytes[2];
    for (int i = 0; i < 2; i++) {
        struct stat found;
        if (stat(in_folder("%s", path[i]), &found) != 0) fail_msg("%s is missing", path[i]);
        size[i] = (size_t)found.st_size;
        bytes[i] = text_of(path[i]);
    }
    assert_true(size[0] == size[1] && size[0] > 0);
    assert_memory_equal(bytes[0], bytes[1], size[0]);
    sb_free(bytes[0]);
    sb_free(bytes[1]);
}

static sb_frame *frame_of(const char *name)
{
    sb_frame *frame = NULL;
    sb_error error = {0};
    if (sb_particle_formats[0]->read(in_folder("%s", name), &frame, &error) != SB_OK) fail_msg("%s", error.text);
    return frame;
}

/* All but the wall time. */
static void same_particles(void)
{
    sb_frame *one = frame_of("plain/particles/000004.vtp"), *other = frame_of("commanded/particles/000004.vtp");
    assert_int_equal(one->count, other->count);
    assert_near(one->status.time, other->status.time, 0);
    assert_memory_equal(one->position, other->position, 3 * one->count * sizeof(float));
    assert_memory_equal(one->velocity, other->velocity, 3 * one->count * sizeof(float));
    assert_memory_equal(one->pressure, other->pressure, one->count * sizeof(float));
    assert_memory_equal(one->id, other->id, one->count * sizeof *one->id);
    sb_frame_release(one);
    sb_frame_release(other);
}

static void commands_change_no_bit(void **state)
{
    (void)state;
    static const char *const files[] = {
        "forces.csv", "gauges.csv", "energy.csv", "probes.csv", "frames/side/000002.png", "frames/front/000003.png"};
    struct stat found;
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "plain", "--quiet", LONGER);
    const pid_t run = commander_start("tank3.yaml", "commanded", (const char *const[]){LONGER, NULL});
    assert_int_equal(stat(in_folder("commanded/control.token"), &found), 0);
    assert_int_equal(found.st_mode & 07777, 0600);
    assert_contains(commander_send(0, "commanded", "pause"), "the run is paused already");
    assert_contains(commander_send(0, "commanded", "step 3"), "3 steps, then paused");
    assert_contains(commander_send(0, "commanded", "picture side"), ": pictures/side-0");
    assert_contains(commander_send(0, "commanded", "picture 1 -2 1 1 0.4 0.2"), ": pictures/view-0");
    assert_contains(commander_send(0, "commanded", "picture side"), "-2.png");
    assert_contains(commander_send(1, "commanded", "picture back"), "camera \"back\": there is none of this name");
    assert_contains(commander_send(1, "commanded", "trigger gate"), "wave maker \"gate\": there is none of this name");
    assert_contains(commander_send(0, "commanded", "rate 7"), "at most 7 frames per second");
    assert_contains(commander_send(0, "commanded", "decimation 5"), "one particle in 5 is sent");
    assert_contains(commander_send(0, "commanded", "region 0 0 0 1 1 1"), "particles from (0, 0, 0) to (1, 1, 1) m");
    assert_contains(commander_send(0, "commanded", "region off"), "particles of the whole domain");
    assert_contains(commander_send(0, "commanded", "checkpoint"), "checkpoint of step");
    assert_contains(commander_send(1, "commanded", "step 0"), "steps: 0, expected a whole number");
    assert_contains(commander_send(0, "commanded", "resume"), "resumed");
    assert_contains(commander_send(1, "plain", "pause"), "the run takes no commands");
    outcome o = program_finish(run);
    if (o.status != 0) fail_msg("exit status %d: %s", o.status, o.err);
    outcome_free(&o);
    assert_same_hash("plain", "commanded");
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) same_file(files[i]);
    same_particles();
    assert_false(exists("commanded/frames/side/000004.png"));
    assert_true(any_ending("commanded/pictures", "-2.png"));
    assert_false(exists("commanded/control.token"));
    assert_contains(commander_send(1, "commanded", "pause"), "cannot open");
    /* The pictures are files of the run. */
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "commanded", "--quiet", "--overwrite");
    assert_false(exists("commanded/pictures"));
}

static void ignore(void *user, sb_channel_kind kind, const void *data, size_t size, double time)
{
    (void)user;
    (void)kind;
    (void)data;
    (void)size;
    (void)time;
}

/* A subscriber reports that it lost half of the messages: the speed within a frame is halved after two reports. */
static void reported_losses_slow_the_stream(void **state)
{
    (void)state;
    static const char loss[] = "{\"do\":\"loss\",\"lost\":0.5}";
    const sb_listener_calls calls = {.message = ignore};
    const pid_t run = commander_start("tank3.yaml", "slowed", (const char *const[]){LONGER, NULL});
    sb_target target;
    sb_listener *listener;
    assert_int_equal(sb_target_read(in_folder("%s", "slowed"), &target, NULL), SB_OK);
    assert_int_equal(sb_listener_create(target.url, target.prefix, &calls, &listener, NULL), SB_OK);
    for (int i = 0; i < 3; i++) {
        unsigned char message[SB_COMMAND_MESSAGE_MAX];
        size_t size;
        assert_int_equal(
            sb_command_encode(&target.token, target.run_id, sb_target_counter(), loss, message, &size, NULL), SB_OK);
        assert_int_equal(sb_listener_send_command(listener, message, size, NULL), SB_OK);
        usleep(20000);
    }
    sb_listener_destroy(listener);
    assert_contains(commander_send(0, "slowed", "stop"), "the run stops");
    outcome o = program_finish(run);
    outcome_free(&o);
    size_t count;
    char *text = event_of("slowed", "stream pace", &count);
    assert_non_null(text);
    assert_int_equal(count, 1);
    assert_contains(text, "73.5 MB/s within a frame, since subscribers lost 50 % of the messages");
    sb_free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(commands_change_no_bit),
                                       cmocka_unit_test(reported_losses_slow_the_stream)};
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
