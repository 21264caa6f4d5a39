/* A network that drops one message in ten, between a stream and several subscribers: what is lost is repaired or
   missed, never wrong, and the number of lost messages is reported exactly. */
#include "stream_fixture.h"

#include "base/clock.h"

#include <math.h>
#include <stdlib.h>
#include <unistd.h>

static const double DROPPED = 0.1;

enum { SUBSCRIBERS = 4, SEQUENCE = 20 }; /* SEQUENCE: the byte of a message at which its sequence number begins */

/* The network to one subscriber. */
typedef struct network {
    uint64_t seed, count; /* count: messages that were sent */
    uint64_t passed, dropped;
    int64_t first, last; /* sequence numbers that were passed */
    sb_live *live;
    size_t frames, scenes, rows, statuses;
    int64_t newest;
} network;

static network networks[SUBSCRIBERS];
static sb_live *whole;   /* a subscriber that receives everything */
static size_t row_count; /* rows of forces that were sent */

static void same_frame(const sb_live_frame *got, const sb_live_frame *sent)
{
    assert_true(got->frame == sent->frame && got->step == sent->step && got->count == sent->count);
    assert_true(got->time == sent->time && got->quantum == sent->quantum && got->speed_max == sent->speed_max);
    assert_true(got->part_count == sent->part_count && got->moved_count == sent->moved_count);
    assert_memory_equal(got->points, sent->points, SB_STREAM_POINT * (size_t)sent->count);
    assert_memory_equal(got->displacement, sent->displacement, 24 * (size_t)sent->moved_count);
    for (int32_t p = 0; p < sent->part_count; p++) {
        assert_true(got->parts[p].first == sent->parts[p].first && got->parts[p].count == sent->parts[p].count);
        assert_memory_equal(got->parts[p].corner, sent->parts[p].corner, sizeof sent->parts[p].corner);
    }
}

/* A message is passed to all before the next one is sent: a frame that is complete here is complete in `whole`. */
static void on_frame(void *user, const sb_live_frame *frame)
{
    network *n = user;
    same_frame(frame, sb_live_get_frame(whole));
    assert_true(frame->frame > n->newest);
    n->newest = frame->frame;
    n->frames++;
}

static void on_scene(void *user, const sb_live_scene *scene)
{
    network *n = user;
    assert_int_equal(scene->body_count, 2000);
    assert_string_equal(scene->bodies[1999].name, sb_live_get_scene(whole)->bodies[1999].name);
    n->scenes++;
}

static void on_forces(void *user, const sb_forces_message *message)
{
    network *n = user;
    for (int32_t i = 0; i < message->count; i++) {
        assert_true(message->force[3 * i] == 1000 * message->time + message->first + i);
        n->rows++;
    }
}

static void on_status(void *user, const sb_status_message *message)
{
    network *n = user;
    assert_true(message->duration == 90);
    n->statuses++;
}

static int64_t sequence_of(const unsigned char *message)
{
    uint64_t word;
    memcpy(&word, message + SEQUENCE, sizeof word);
    return (int64_t)__builtin_bswap64(word);
}

static void on_message(const lcm_recv_buf_t *received, const char *channel, void *user)
{
    (void)user;
    const sb_channel_kind kind = sb_channel_guess(channel);
    const int64_t sequence = sequence_of(received->data);
    assert_int_equal(sb_live_take(whole, kind, received->data, received->data_size, sb_clock()), SB_OK);
    for (int i = 0; i < SUBSCRIBERS; i++) {
        network *n = &networks[i];
        if (sb_random(n->seed, n->count++) < DROPPED) {
            n->dropped++;
            continue;
        }
        if (n->passed++ == 0) n->first = sequence;
        n->last = sequence;
        assert_int_equal(sb_live_take(n->live, kind, received->data, received->data_size, sb_clock()), SB_OK);
    }
}

static int begin(void **state)
{
    (void)state;
    static const sb_live_calls none;
    row_count = 0;
    whole = sb_live_create(&none);
    for (int i = 0; i < SUBSCRIBERS; i++) {
        networks[i] = (network){.seed = 101 + (uint64_t)i};
        const sb_live_calls calls = {
            .user = &networks[i], .frame = on_frame, .scene = on_scene, .forces = on_forces, .status = on_status};
        networks[i].live = sb_live_create(&calls);
    }
    return whole ? 0 : -1;
}

static int end(void **state)
{
    (void)state;
    for (int i = 0; i < SUBSCRIBERS; i++) sb_live_destroy(networks[i].live);
    sb_live_destroy(whole);
    return 0;
}

static sb_stream *open_stream(void)
{
    sb_stream *stream = fixture_stream("memq://", 0, 1);
    lcm_subscription_set_queue_capacity(lcm_subscribe(sb_stream_provider(stream), ".*", on_message, NULL), 100000);
    return stream;
}

/* Publishes frames of so many particles, and rows of forces of 400 bodies. If the water is long, the particles are in a
   row of 1400 spacings, so that not all parts have the same corner. */
static void publish(sb_stream *stream, size_t frames, size_t particles, bool is_long)
{
    enum { BODIES = 400 };
    static sb_force_record forces[BODIES];
    fixture_scene f;
    fixture_scene_make(&f, 2000, 3);
    assert_int_equal(sb_stream_set_scene(stream, &f.scene, &f.model, NULL), SB_OK);
    for (size_t i = 1; i <= frames; i++) {
        sb_frame *frame = fixture_frame(i, (double)i, particles, BODIES);
        for (size_t k = 0; is_long && k < particles; k++)
            frame->position[3 * k] = 1400 * 0.75f * (float)k / (float)particles;
        for (size_t b = 0; b < BODIES; b++)
            forces[b] =
                (sb_force_record){.body = b, .time = (double)i, .force = sb_vec(1000 * (double)i + (double)b, 0, 0)};
        const sb_measure_records rows = {.force_count = BODIES, .forces = forces};
        sb_stream_measure(stream, &rows);
        row_count += BODIES;
        fixture_publish(stream, frame);
        sb_frame_release(frame);
        fixture_drain(stream);
    }
    sb_stream_finish(stream);
    fixture_drain(stream);
    fixture_scene_free(&f);
}

static void check_counts(const network *n, size_t frames)
{
    const sb_live_counts counts = sb_live_count(n->live);
    assert_int_equal(n->count, n->passed + n->dropped);
    assert_true(fabs((double)n->dropped / (double)n->count - DROPPED) < 0.05);
    assert_int_equal(counts.messages, n->passed);
    assert_int_equal(counts.lost, (uint64_t)(n->last - n->first) + 1 - n->passed);
    assert_in_range(counts.lost, n->dropped - n->dropped / 4, n->dropped);
    assert_int_equal(counts.refused + counts.foreign + counts.restarts, 0);
    assert_int_equal(counts.frames_complete, n->frames);
    assert_true(counts.frames_complete + counts.frames_partial <= frames);
}

/* Of 30 parts in groups of ten, one part may be lost in each group; the parity itself may be, too. */
static void large_frames_are_repaired_or_missed(void **state)
{
    (void)state;
    enum { FRAMES = 25, PARTS = 30 };
    sb_stream *stream = open_stream();
    publish(stream, FRAMES, PARTS * SB_STREAM_POINTS - 1000, false);
    assert_int_equal(sb_live_count(whole).frames_complete, FRAMES);
    assert_int_equal(sb_live_count(whole).lost, 0);
    for (int i = 0; i < SUBSCRIBERS; i++) {
        const network *n = &networks[i];
        const sb_live_counts counts = sb_live_count(n->live);
        check_counts(n, FRAMES);
        assert_true(n->frames > 0 && n->frames < FRAMES && counts.frames_partial > 0);
        assert_true(counts.parts_repaired > n->frames); /* without repair, 4 % of the frames were complete */
        assert_in_range(n->rows, row_count / 2, row_count - 1);
        assert_in_range(n->statuses, FRAMES / 2, sb_live_count(whole).messages);
    }
    sb_stream_destroy(stream);
}

/* Frames whose parts have corners of their own have no parity. */
static void frames_without_parity_are_complete_or_missed(void **state)
{
    (void)state;
    enum { FRAMES = 60 };
    sb_stream *stream = open_stream();
    publish(stream, FRAMES, 9 * SB_STREAM_POINTS, true);
    assert_int_equal(sb_live_count(whole).frames_complete, FRAMES);
    for (int i = 0; i < SUBSCRIBERS; i++) {
        check_counts(&networks[i], FRAMES);
        assert_int_equal(sb_live_count(networks[i].live).parts_repaired, 0);
        assert_true(sb_live_get_frame(whole)->part_count >= 9);
        assert_in_range(networks[i].frames, 1, FRAMES - 1);
    }
    sb_stream_destroy(stream);
}

/* The pieces of a scene come again and again, so that all of them arrive in the end. */
static void the_scene_arrives_in_the_end(void **state)
{
    (void)state;
    fixture_scene f;
    fixture_scene_make(&f, 2000, 3);
    sb_stream *stream = open_stream();
    assert_int_equal(sb_stream_set_scene(stream, &f.scene, &f.model, NULL), SB_OK);
    int complete = 0;
    for (double until = sb_clock() + 8; complete < SUBSCRIBERS && sb_clock() < until;) {
        usleep((unsigned)(1e6 * sb_stream_serve(stream)));
        fixture_drain(stream);
        complete = 0;
        for (int i = 0; i < SUBSCRIBERS; i++) complete += networks[i].scenes > 0;
    }
    assert_int_equal(complete, SUBSCRIBERS);
    uint64_t dropped = 0;
    for (int i = 0; i < SUBSCRIBERS; i++) dropped += networks[i].dropped;
    assert_true(dropped > 0);
    sb_stream_destroy(stream);
    fixture_scene_free(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(large_frames_are_repaired_or_missed, begin, end),
        cmocka_unit_test_setup_teardown(frames_without_parity_are_complete_or_missed, begin, end),
        cmocka_unit_test_setup_teardown(the_scene_arrives_in_the_end, begin, end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
