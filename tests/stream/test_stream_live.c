/* A subscriber's view: joins late, follows one run, sees losses, restarts and the end of a run, and changes to the
   limits of a stream. */
#include "stream_fixture.h"

#include "base/clock.h"

#include <math.h>
#include <stdlib.h>
#include <unistd.h>

static size_t statuses, frames, restarts;

static void on_status(void *user, const sb_status_message *message)
{
    (void)user;
    (void)message;
    statuses++;
}

static void on_frame(void *user, const sb_live_frame *frame)
{
    (void)user;
    (void)frame;
    frames++;
}

static void on_restart(void *user, int64_t run_id)
{
    (void)user;
    (void)run_id;
    restarts++;
}

static sb_live *live;

static int begin(void **state)
{
    (void)state;
    static const sb_live_calls calls = {.status = on_status, .frame = on_frame, .restarted = on_restart};
    statuses = frames = restarts = 0;
    live = sb_live_create(&calls);
    return live ? 0 : -1;
}

static int end(void **state)
{
    (void)state;
    sb_live_destroy(live);
    return 0;
}

static void same_scene(const sb_live_scene *got, const fixture_scene *f, int64_t run_id)
{
    assert_int_equal(got->run_id, run_id);
    assert_string_equal(got->run, "a run");
    assert_string_equal(got->units, "m s kg N Pa");
    assert_true(got->dimensions == 3 && got->spacing == 0.75 && got->duration == 90 && got->has_level);
    assert_true(got->level == 10 && got->frame_interval == 0.5 && got->measure_interval == 0.1);
    assert_memory_equal(got->domain_max, &f->scene.domain.max, 24);
    assert_true(fabs(got->speed_max - 2 * sqrt(9.81 * 10)) < 1e-9);
    assert_true(fabs(got->pressure_max - 1025 * 9.81 * 10) < 1e-6);
    assert_int_equal(got->body_count, f->model.body_count);
    for (size_t b = 0; b < got->body_count; b++) {
        const sb_live_body *body = &got->bodies[b];
        const sb_model_body *sent = &f->model.bodies[b];
        assert_string_equal(body->name, sent->name);
        assert_int_equal(body->reported, sent->report);
        assert_int_equal(body->terrain, sent->role == SB_ROLE_TERRAIN);
        assert_int_equal(body->moves, b == 1);
        assert_memory_equal(body->color, sent->color, sizeof body->color);
        assert_memory_equal(body->moment_point, &sent->moment_point, 24);
        assert_int_equal(body->vertex_count, sent->mesh.vertex_count);
        assert_int_equal(body->triangle_count, sent->mesh.triangle_count);
        for (size_t v = 0; v < body->vertex_count; v++)
            assert_true(fabs((double)body->vertices[3 * v] + got->domain_min[0] - sent->mesh.vertices[v].x) < 1e-5);
        for (size_t c = 0; c < 3 * body->triangle_count; c++)
            assert_int_equal(body->corners[c], sent->mesh.triangles[c / 3][c % 3]);
    }
    assert_int_equal(got->camera_count, 2);
    assert_int_equal(got->wavemaker_count, 2);
    assert_string_equal(got->wavemakers[0], "piston");
    assert_string_equal(got->wavemakers[1], "slide");
    assert_string_equal(got->cameras[1].name, "flight");
    assert_int_equal(got->cameras[1].key_count, 3);
    for (size_t k = 0; k < 3; k++) {
        assert_memory_equal(got->cameras[1].eye + 3 * k, &f->keys[k + 1].eye, 24);
        assert_memory_equal(got->cameras[1].target + 3 * k, &f->keys[k + 1].target, 24);
        assert_true(got->cameras[1].fov[k] == f->keys[k + 1].fov && got->cameras[1].time[k] == f->keys[k + 1].time);
    }
    assert_int_equal(got->gauge_count, f->scene.measure.gauge_count);
    assert_string_equal(got->gauges[1].name, "gauge-1");
    assert_true(got->gauges[1].x == 5 && got->gauges[1].y == 7.5);
}

/* One that joins in the middle of a cycle has the scene, a status and the newest frame's number within two seconds,
   also while the run is paused and sends no frames. */
static void joins_late(void **state)
{
    (void)state;
    enum { BODIES = 2000 }; /* 150 bytes each, and meshes: several pieces */
    fixture_scene f;
    fixture_scene_make(&f, BODIES, 3);
    sb_stream *stream = fixture_stream("memq://", 0, 1);
    assert_int_equal(sb_stream_set_scene(stream, &f.scene, &f.model, NULL), SB_OK);
    sb_stream_set_state(stream, SB_RUN_PAUSED);
    for (double until = sb_clock() + 0.8; sb_clock() < until;) { /* no subscriber yet */
        sb_stream_serve(stream);
        usleep(20000);
    }
    fixture_follow(stream, live);
    const double joined = sb_clock();
    while (!sb_live_get_scene(live) && sb_clock() < joined + 4) {
        const double pause = sb_stream_serve(stream);
        assert_true(pause > 0 && pause <= SB_STREAM_SERVE);
        fixture_drain(stream);
        usleep((unsigned)(1e6 * pause));
    }
    assert_true(sb_clock() - joined < 2);
    assert_non_null(sb_live_get_scene(live));
    same_scene(sb_live_get_scene(live), &f, sb_stream_run_id(stream));
    assert_in_range(statuses, 2, 6);
    assert_int_equal(sb_live_get_status(live)->state, SB_RUN_PAUSED);
    assert_true(sb_live_get_status(live)->duration == 90);
    assert_int_equal(sb_live_get_status(live)->fluid_particles, 777);
    const sb_live_counts counts = sb_live_count(live);
    assert_int_equal(counts.refused + counts.lost + counts.foreign, 0);
    sb_stream_destroy(stream);
    fixture_scene_free(&f);
}

/* Messages of a stream, kept to be passed on in any order and at any time. */
enum { KEPT = 64 };
static struct {
    size_t size;
    sb_channel_kind kind;
    unsigned char bytes[SB_STREAM_MESSAGE_MAX];
} kept[KEPT];
static size_t kept_count;

static void keep(const lcm_recv_buf_t *received, const char *channel, void *user)
{
    (void)user;
    assert_true(kept_count < KEPT);
    kept[kept_count].kind = sb_channel_guess(channel);
    kept[kept_count].size = received->data_size;
    memcpy(kept[kept_count++].bytes, received->data, received->data_size);
}

static sb_status pass(size_t i, double time)
{
    return sb_live_take(live, kept[i].kind, kept[i].bytes, kept[i].size, time);
}

/* Keeps the messages of a run: status and parts of each of its frames, and the last status. */
static void keep_run(size_t frame_count, size_t particles)
{
    sb_stream *stream = fixture_stream("memq://", 0, 1);
    lcm_subscription_set_queue_capacity(lcm_subscribe(sb_stream_provider(stream), ".*", keep, NULL), 100000);
    for (size_t i = 1; i <= frame_count; i++) {
        sb_frame *frame = fixture_frame(i, (double)i, particles, 1);
        fixture_publish(stream, frame);
        sb_frame_release(frame);
    }
    sb_stream_finish(stream);
    fixture_drain(stream);
    sb_stream_destroy(stream);
}

static void losses_are_counted(void **state)
{
    (void)state;
    kept_count = 0;
    keep_run(4, 3 * SB_STREAM_POINTS); /* per frame a status and three parts, then the last status */
    assert_int_equal(kept_count, 17);
    for (size_t i = 0; i < kept_count; i++)
        if (i != 2 && i != 8 && i != 9) assert_int_equal(pass(i, 0), SB_OK); /* a part; a status and a part */
    const sb_live_counts counts = sb_live_count(live);
    assert_int_equal(counts.lost, 3);
    assert_int_equal(counts.frames_complete, 2);
    assert_int_equal(counts.frames_partial, 2);
    assert_int_equal(counts.parts_lost, 2);
    assert_int_equal(frames, 2);
    assert_int_equal(sb_live_get_frame(live)->frame, 4);
    assert_int_equal(sb_live_get_status(live)->state, SB_RUN_DONE);
}

/* One part of each group may be lost: the frame is that of the sender. Two parts of a group are lost for good. */
static void lost_parts_are_repaired(void **state)
{
    (void)state;
    enum { PARTS = 14, GROUPS = 2, FIRST = 1 }; /* a status comes first */
    static unsigned char sent[SB_STREAM_POINT * SB_STREAM_POINTS * PARTS];
    kept_count = 0;
    keep_run(2, PARTS * SB_STREAM_POINTS - 100); /* the last part is not full */
    const size_t each = 1 + PARTS + GROUPS;
    assert_int_equal(kept_count, 2 * each + 1);
    for (size_t i = 0; i < each; i++) assert_int_equal(pass(i, 0), SB_OK);
    memcpy(sent, sb_live_get_frame(live)->points, sizeof sent - 100 * SB_STREAM_POINT);
    const size_t lost[] = {0, 7, PARTS - 1, PARTS - 2}; /* two pairs of neighbours in different groups, one by one */
    for (size_t pair = 0; pair < 2; pair++) {
        end(state);
        begin(state);
        for (size_t i = 0; i < each; i++)
            if (i != FIRST + lost[2 * pair] && i != FIRST + lost[2 * pair + 1]) assert_int_equal(pass(i, 0), SB_OK);
        const sb_live_frame *got = sb_live_get_frame(live);
        assert_non_null(got);
        assert_memory_equal(got->points, sent, (size_t)got->count * SB_STREAM_POINT);
        assert_memory_equal(got->parts[lost[2 * pair]].corner, got->parts[1].corner, sizeof got->parts[1].corner);
        assert_int_equal(frames, 1);
        assert_int_equal(sb_live_count(live).parts_repaired, 2);
        assert_int_equal(sb_live_count(live).parts_lost, 0);
        assert_int_equal(sb_live_count(live).lost, 2);
    }
    for (size_t i = each; i < kept_count; i++) /* of the second frame, parts 4 and 6 are of one group */
        if (i != each + FIRST + 4 && i != each + FIRST + 6) pass(i, 0);
    assert_int_equal(frames, 1);
    assert_int_equal(sb_live_count(live).parts_repaired, 2);
}

static void invalid_messages_have_no_effect(void **state)
{
    (void)state;
    kept_count = 0;
    keep_run(1, 10);
    assert_int_equal(pass(0, 0), SB_OK);
    assert_int_equal(sb_live_take(live, SB_CHANNEL_FRAME, kept[1].bytes, kept[1].size - 1, 0), SB_BAD_INPUT);
    assert_int_equal(sb_live_take(live, SB_CHANNEL_FORCES, kept[1].bytes, kept[1].size, 0), SB_BAD_INPUT);
    assert_int_equal(sb_live_take(live, SB_CHANNELS, kept[1].bytes, kept[1].size, 0), SB_BAD_INPUT);
    assert_int_equal(sb_live_count(live).refused, 3);
    assert_null(sb_live_get_frame(live));
    assert_int_equal(pass(1, 0), SB_OK);
    assert_int_equal(frames, 1);
    assert_int_equal(sb_live_count(live).lost, 0);
}

static void follows_one_run_until_it_ends_or_is_silent(void **state)
{
    (void)state;
    kept_count = 0;
    keep_run(1, 10); /* 0 status, 1 frame, 2 done */
    keep_run(1, 10); /* 3 status, 4 frame, 5 done */
    keep_run(1, 10); /* 6, 7, 8 */
    pass(0, 0);
    pass(3, 1); /* another run while the first one sends: ignored */
    pass(1, 1);
    assert_int_equal(sb_live_count(live).foreign, 1);
    assert_int_equal(restarts, 0);
    pass(4, 1 + SB_LIVE_SILENCE + 0.1); /* the first one was killed */
    assert_int_equal(restarts, 1);
    assert_int_equal(frames, 2); /* its frame has number 1, as that of the first run */
    pass(5, 4);
    pass(6, 4); /* the second one has ended */
    assert_int_equal(restarts, 2);
    pass(7, 4);
    pass(8, 4);
    pass(6, 4.1); /* the same run from its first message: a replay that begins again */
    pass(7, 4.1);
    assert_int_equal(restarts, 3);
    assert_int_equal(frames, 4);
    assert_int_equal(sb_live_count(live).lost, 0);
    assert_int_equal(sb_live_count(live).restarts, 3);
}

static void another_order_is_no_restart(void **state)
{
    (void)state;
    kept_count = 0;
    keep_run(2, 3 * SB_STREAM_POINTS);
    static const size_t order[] = {0, 3, 1, 2, 4, 6, 5, 7, 8, 6};
    for (size_t i = 0; i < sizeof order / sizeof *order; i++) pass(order[i], 0);
    assert_int_equal(restarts, 0);
    assert_int_equal(frames, 2);
    assert_int_equal(sb_live_count(live).lost, 0);
}

static void limits_change_what_is_sent(void **state)
{
    (void)state;
    sb_stream *stream = fixture_stream("memq://", 0, 1);
    fixture_follow(stream, live);
    sb_stream_limits limits = sb_stream_get_limits(stream);
    assert_true(limits.decimation == 1 && !limits.region && !(limits.rate > 0));
    limits = (sb_stream_limits){.rate = 4, .decimation = 10, .region = true, .max = {2e6, 0, 100}};
    limits.min = sb_vec(1e6, -3e6, 30.5 - 100);
    sb_stream_set_limits(stream, &limits);
    sb_frame *frame = fixture_frame(1, 0, 20000, 1);
    const double started = sb_clock();
    for (; sb_clock() < started + 0.9; frame->index++) {
        fixture_publish(stream, frame);
        usleep(10000);
    }
    fixture_drain(stream);
    assert_in_range(frames, 3, 4); /* at 0, 0.25, 0.5 and 0.75 s */
    const int64_t sent = sb_live_get_frame(live)->count;
    assert_in_range(sent, 20000 / 10 / 8, 20000 / 10 / 2); /* of a half of the particles, and a tenth of these */
    const sb_status_message *status = sb_live_get_status(live);
    assert_true(status->rate == 4 && status->decimation == 10 && status->region_min[0] == 1e6);
    assert_in_range(status->frames_skipped, 30, 100);
    limits = (sb_stream_limits){.rate = -1, .decimation = 0, .bytes_per_second = 1};
    sb_stream_set_limits(stream, &limits);
    limits = sb_stream_get_limits(stream);
    assert_true(limits.decimation == 1 && !(limits.rate > 0 || limits.rate < 0));
    assert_true(limits.bytes_per_second == SB_STREAM_BYTES_MIN);
    sb_frame_release(frame);
    sb_stream_destroy(stream);
}

static void the_pace_follows_the_losses(void **state)
{
    (void)state;
    sb_stream_limits limits = {.decimation = 3, .bytes_per_second = SB_STREAM_BYTES_MAX};
    limits = sb_stream_adapt(limits, 0.2);
    assert_true(fabs(limits.bytes_per_second - 0.7 * SB_STREAM_BYTES_MAX) < 1);
    for (int i = 0; i < 50; i++) limits = sb_stream_adapt(limits, 1);
    assert_true(limits.bytes_per_second == SB_STREAM_BYTES_MIN);
    const sb_stream_limits same = sb_stream_adapt(limits, 0.001);
    assert_true(same.bytes_per_second == limits.bytes_per_second);
    for (int i = 0; i < 200; i++) limits = sb_stream_adapt(limits, 0);
    assert_true(limits.bytes_per_second == SB_STREAM_BYTES_MAX && limits.decimation == 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(joins_late, begin, end),
        cmocka_unit_test_setup_teardown(losses_are_counted, begin, end),
        cmocka_unit_test_setup_teardown(lost_parts_are_repaired, begin, end),
        cmocka_unit_test_setup_teardown(invalid_messages_have_no_effect, begin, end),
        cmocka_unit_test_setup_teardown(follows_one_run_until_it_ends_or_is_silent, begin, end),
        cmocka_unit_test_setup_teardown(another_order_is_no_restart, begin, end),
        cmocka_unit_test_setup_teardown(limits_change_what_is_sent, begin, end),
        cmocka_unit_test(the_pace_follows_the_losses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
