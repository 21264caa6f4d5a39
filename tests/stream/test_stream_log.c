/* Logs that are whole, damaged or cut off; replays of them. */
#include "stream_fixture.h"

#include "base/clock.h"
#include "base/file.h"
#include "stream/log.h"
#include "stream/replay.h"

#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

enum { FRAMES = 3, MESSAGES = 3 + FRAMES * 2 + 1 }; /* scene, forces, gauges; status and part of each frame; done */
static char path[] = "/tmp/sb-log-XXXXXX", other[] = "/tmp/sb-log-XXXXXX";

static const char *url_of(const char *file, const char *mode)
{
    static char url[128];
    snprintf(url, sizeof url, "file://%s?mode=%s", file, mode);
    return url;
}

/* Records a run with LCM's own writer. The scene comes after the first frame. */
static int record(void **state)
{
    (void)state;
    close(mkstemp(path));
    close(mkstemp(other));
    fixture_scene f;
    fixture_scene_make(&f, 3, 2);
    sb_stream *stream = fixture_stream(url_of(path, "w"), 0, 1);
    for (uint64_t i = 1; i <= FRAMES; i++) {
        if (i == 2 && sb_stream_set_scene(stream, &f.scene, &f.model, NULL) != SB_OK) return -1;
        sb_measure_records rows = fixture_rows(&f, 0.5);
        if (i == 2) sb_stream_measure(stream, &rows);
        fixture_rows_free(&rows);
        sb_frame *frame = fixture_frame(i, 0.5 * (double)i, 1000, 3);
        fixture_publish(stream, frame);
        sb_frame_release(frame);
        usleep(50000);
    }
    sb_stream_finish(stream);
    const int status = sb_stream_count(stream).messages == MESSAGES ? 0 : -1;
    sb_stream_destroy(stream);
    fixture_scene_free(&f);
    return status;
}

static int remove_logs(void **state)
{
    (void)state;
    unlink(other);
    return unlink(path);
}

/* Writes bytes to the other log. */
static void write_other(const char *bytes, size_t size)
{
    FILE *file = fopen(other, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

/* Counts the messages of a log, whose data must all be valid. */
static size_t count_messages(const char *name, uint64_t *left_out)
{
    static const sb_live_calls none = {0};
    sb_log *log;
    sb_log_event event;
    size_t count = 0;
    assert_int_equal(sb_log_open(name, &log, NULL), SB_OK);
    sb_live *live = sb_live_create(&none);
    while (sb_log_next(log, &event)) {
        assert_int_equal(strncmp(event.channel, "test_", 5), 0);
        assert_int_equal(sb_live_take(live, sb_channel_guess(event.channel), event.data, event.size, event.time),
                         SB_OK);
        count++;
    }
    assert_false(sb_log_next(log, &event));
    *left_out = sb_log_left_out(log);
    sb_log_rewind(log);
    assert_true(sb_log_next(log, &event));
    sb_live_destroy(live);
    sb_log_close(log);
    return count;
}

static void whole_and_damaged_logs(void **state)
{
    (void)state;
    char *bytes;
    size_t size;
    uint64_t left_out;
    assert_int_equal(count_messages(path, &left_out), MESSAGES);
    assert_int_equal(left_out, 0);
    assert_int_equal(sb_file_read(path, 1 << 20, &bytes, &size, NULL), SB_OK);
    write_other(bytes, size - 5); /* as lcm-logger leaves it */
    assert_int_equal(count_messages(other, &left_out), MESSAGES - 1);
    assert_in_range(left_out, 20, 1000);
    bytes[20] = 0x7f; /* the length of the first channel: 2 GB */
    write_other(bytes, size);
    assert_int_equal(count_messages(other, &left_out), MESSAGES - 1);
    bytes[24] = 0x7f; /* and of its data */
    bytes[2] = 0;     /* the file no longer begins as a log */
    write_other(bytes, size);
    sb_log *log;
    sb_error error = {0};
    assert_int_equal(sb_log_open(other, &log, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "does not begin as a log"));
    sb_free(bytes);
}

static void what_is_no_log_is_refused(void **state)
{
    (void)state;
    sb_log *log;
    sb_error error = {0};
    assert_int_equal(sb_log_open("/no/such.log", &log, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "/no/such.log: cannot read"));
    assert_int_equal(sb_log_open("/tmp", &log, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "is a directory"));
    unlink(other);
    assert_int_equal(mkfifo(other, 0600), 0);
    assert_int_equal(sb_log_open(other, &log, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "is a FIFO"));
    unlink(other);
    write_other("\xed\xa1\xda\x01", 4);
    assert_int_equal(sb_log_open(other, &log, &error), SB_OK);
    sb_log_event event;
    assert_false(sb_log_next(log, &event));
    sb_log_close(log);
}

/* A subscriber of the messages of a log. */
static sb_live *view_log(const char *name)
{
    static const sb_live_calls none = {0};
    sb_live *live = sb_live_create(&none);
    sb_log *log;
    sb_log_event event;
    assert_int_equal(sb_log_open(name, &log, NULL), SB_OK);
    while (sb_log_next(log, &event))
        sb_live_take(live, sb_channel_guess(event.channel), event.data, event.size, event.time);
    sb_log_close(log);
    return live;
}

static void a_replay_is_the_run_again(void **state)
{
    (void)state;
    sb_replay *replay = NULL;
    sb_error error = {0};
    char to[128];
    snprintf(to, sizeof to, "%s", url_of(other, "w"));
    const sb_replay_options options = {.url = to, .speed = 0.25};
    const double begun = sb_clock();
    if (sb_replay_create(path, &options, &replay, &error) != SB_OK) fail_msg("%s", error.text);
    while (sb_replay_run(replay, 0.1) == SB_OK) assert_true(sb_clock() < begun + 5);
    assert_true(sb_clock() - begun >= 4 * 0.1); /* the last message came at least 0.1 s after the first one */
    assert_int_equal(sb_replay_errors(replay), 0);
    assert_int_equal(sb_replay_left_out(replay), 0);
    sb_replay_destroy(replay);

    sb_live *was = view_log(path), *is = view_log(other);
    const sb_live_counts counts = sb_live_count(is);
    assert_int_equal(counts.refused + counts.lost + counts.foreign + counts.restarts, 0);
    assert_int_equal(counts.frames_complete, FRAMES);
    assert_int_equal(sb_live_get_status(is)->state, SB_RUN_DONE);
    assert_true(sb_live_get_status(is)->head.run_id != sb_live_get_status(was)->head.run_id);
    const sb_live_frame *a = sb_live_get_frame(was), *b = sb_live_get_frame(is);
    assert_int_equal(b->frame, FRAMES);
    assert_memory_equal(a->points, b->points, SB_STREAM_POINT * (size_t)a->count);
    assert_string_equal(sb_live_get_scene(is)->bodies[0].name, sb_live_get_scene(was)->bodies[0].name);
    sb_live_destroy(was);
    sb_live_destroy(is);

    /* The scene comes first, although it was recorded later. */
    sb_log *log;
    sb_log_event event;
    assert_int_equal(sb_log_open(other, &log, NULL), SB_OK);
    size_t until_scene = 0;
    while (sb_log_next(log, &event) && sb_channel_guess(event.channel) != SB_CHANNEL_SCENE) until_scene++;
    assert_in_range(until_scene, 0, 2);
    sb_log_close(log);
}

static void replays_that_cannot_begin(void **state)
{
    (void)state;
    sb_replay *replay = NULL;
    sb_error error = {0};
    const sb_replay_options elsewhere = {.url = "memq://", .prefix = "elsewhere", .speed = 1};
    assert_int_equal(sb_replay_create(path, &elsewhere, &replay, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "no valid message on the channels elsewhere_status"));
    const sb_replay_options options = {.url = "memq://", .speed = 1};
    write_other("\xed\xa1\xda\x01", 4);
    assert_int_equal(sb_replay_create(other, &options, &replay, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "has no message of a run of this version"));
    for (long n = 1; n <= 4; n++) {
        sb_memory_fail_at(n);
        assert_int_equal(sb_replay_create(path, &options, &replay, &error), SB_FAILED);
        sb_memory_fail_at(0);
    }
    assert_null(replay);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_and_damaged_logs),
        cmocka_unit_test(what_is_no_log_is_refused),
        cmocka_unit_test(a_replay_is_the_run_again),
        cmocka_unit_test(replays_that_cannot_begin),
    };
    return cmocka_run_group_tests(tests, record, remove_logs);
}
