/* A subscriber has the values that a stream was given; the decoders that lcm-gen generates agree. */
#include "stream_fixture.h"

#include "stream/points.h"

#include "shorebreak_forces_t.h"
#include "shorebreak_frame_t.h"
#include "shorebreak_gauges_t.h"
#include "shorebreak_scene_t.h"
#include "shorebreak_status_t.h"

#include <math.h>
#include <stdlib.h>

/* What one subscriber of all channels has received. */
typedef struct received_data {
    sb_live *live;
    size_t statuses, forces, gauges, parts, frames, largest;
    sb_status_message status;
    sb_forces_message force;
    sb_gauges_message gauge;
    sb_frame_message part;
} received_data;

static received_data all;

static void on_status(void *user, const sb_status_message *message)
{
    (void)user;
    all.statuses++;
    all.status = *message;
}

static void on_forces(void *user, const sb_forces_message *message)
{
    (void)user;
    all.forces++;
    all.force = *message;
}

static void on_gauges(void *user, const sb_gauges_message *message)
{
    (void)user;
    all.gauges++;
    all.gauge = *message;
}

static void on_part(void *user, const sb_frame_message *message)
{
    (void)user;
    all.parts++;
    all.part = *message;
}

static void on_frame(void *user, const sb_live_frame *frame)
{
    (void)user;
    (void)frame;
    all.frames++;
}

static void note_size(const lcm_recv_buf_t *received, const char *channel, void *user)
{
    (void)channel;
    (void)user;
    if (received->data_size > all.largest) all.largest = received->data_size;
}

/* The generated decoders must give the same values as ours. */
static void compare_status(const lcm_recv_buf_t *received, const char *channel, void *user)
{
    (void)channel;
    (void)user;
    sb_status_message own;
    shorebreak_status_t other = {0};
    assert_int_equal(sb_stream_decode_status(received->data, received->data_size, &own, NULL), SB_OK);
    assert_true(shorebreak_status_t_decode(received->data, 0, (int)received->data_size, &other) > 0);
    assert_int_equal(other.version, SHOREBREAK_STATUS_T_VERSION);
    assert_int_equal(other.version, SB_STREAM_VERSION);
    assert_int_equal(other.run_id, own.head.run_id);
    assert_int_equal(other.sequence, own.head.sequence);
    assert_string_equal(other.run, own.run);
    assert_int_equal(other.state, own.state);
    assert_int_equal(other.step, own.step);
    assert_true(other.time == own.time && other.duration == own.duration && other.time_step == own.time_step);
    assert_true(other.density_error == own.density_error && other.eta_seconds == own.eta_seconds);
    assert_int_equal(other.frames_skipped, own.frames_skipped);
    assert_int_equal(other.stage_count, own.stage_count);
    for (int32_t i = 0; i < own.stage_count; i++) assert_string_equal(other.stages[i], own.stages[i]);
    assert_memory_equal(other.region_max, own.region_max, sizeof own.region_max);
    assert_memory_equal(other.stage_seconds, own.stage_seconds, sizeof(double) * (size_t)own.stage_count);
    shorebreak_status_t_decode_cleanup(&other);
}

static void compare_rows(const lcm_recv_buf_t *received, const char *channel, void *user)
{
    (void)user;
    static sb_forces_message forces;
    static sb_gauges_message gauges;
    if (strstr(channel, "forces")) {
        shorebreak_forces_t other = {0};
        assert_int_equal(sb_stream_decode_forces(received->data, received->data_size, &forces, NULL), SB_OK);
        assert_true(shorebreak_forces_t_decode(received->data, 0, (int)received->data_size, &other) > 0);
        assert_int_equal(other.n, forces.count);
        const size_t vectors = 3 * sizeof(double) * (size_t)other.n;
        for (int32_t i = 0; i < other.n; i++) assert_string_equal(other.names[i], forces.names[i]);
        assert_memory_equal(other.body, forces.body, sizeof(int32_t) * (size_t)other.n);
        assert_memory_equal(other.force, forces.force, vectors);
        assert_memory_equal(other.friction, forces.friction, vectors);
        shorebreak_forces_t_decode_cleanup(&other);
    } else {
        shorebreak_gauges_t other = {0};
        assert_int_equal(sb_stream_decode_gauges(received->data, received->data_size, &gauges, NULL), SB_OK);
        assert_true(shorebreak_gauges_t_decode(received->data, 0, (int)received->data_size, &other) > 0);
        assert_int_equal(other.n, gauges.count);
        assert_memory_equal(other.wet, gauges.wet, (size_t)other.n);
        assert_memory_equal(other.z, gauges.z, sizeof(double) * (size_t)other.n);
        shorebreak_gauges_t_decode_cleanup(&other);
    }
}

static void compare_part(const lcm_recv_buf_t *received, const char *channel, void *user)
{
    (void)channel;
    (void)user;
    sb_frame_message own;
    shorebreak_frame_t other = {0};
    assert_int_equal(sb_stream_decode_frame(received->data, received->data_size, &own, NULL), SB_OK);
    if (own.count == 0) return; /* LCM's decoder copies to a null pointer then */
    assert_true(shorebreak_frame_t_decode(received->data, 0, (int)received->data_size, &other) > 0);
    assert_int_equal(other.count, own.count);
    assert_int_equal(other.moved_count, own.moved_count);
    assert_memory_equal(other.corner, own.corner, sizeof own.corner);
    assert_true(other.quantum == own.quantum && other.speed_max == own.speed_max);
    if (own.count > 0) assert_memory_equal(other.points, own.points, SB_STREAM_POINT * (size_t)own.count);
    shorebreak_frame_t_decode_cleanup(&other);
}

static sb_stream *begin(double interval, int decimation)
{
    static const sb_live_calls calls = {
        .status = on_status, .forces = on_forces, .gauges = on_gauges, .part = on_part, .frame = on_frame};
    sb_stream *stream = fixture_stream("memq://", interval, decimation);
    lcm_t *lcm = sb_stream_provider(stream);
    memset(&all, 0, sizeof all);
    all.live = sb_live_create(&calls);
    assert_non_null(all.live);
    fixture_follow(stream, all.live);
    const struct {
        const char *channels;
        lcm_msg_handler_t handler;
    } others[] = {{".*", note_size},
                  {"test_status", compare_status},
                  {"test_forces", compare_rows},
                  {"test_gauges", compare_rows},
                  {"test_frame", compare_part}};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        lcm_subscription_set_queue_capacity(lcm_subscribe(lcm, others[i].channels, others[i].handler, NULL), 100000);
    return stream;
}

static void end(sb_stream *stream)
{
    const sb_live_counts counts = sb_live_count(all.live);
    assert_int_equal(counts.refused + counts.foreign + counts.lost + counts.restarts, 0);
    assert_int_equal(counts.messages, sb_stream_count(stream).messages);
    assert_int_equal(counts.bytes, sb_stream_count(stream).bytes);
    assert_int_equal(sb_stream_count(stream).errors, 0);
    sb_live_destroy(all.live);
    sb_stream_destroy(stream);
}

static void check_status(const sb_status_message *got, const sb_frame *frame, int64_t run_id)
{
    const sb_frame_status *sent = &frame->status;
    assert_int_equal(got->head.run_id, run_id);
    assert_string_equal(got->run, "a run");
    assert_int_equal(got->step, sent->step);
    assert_true(got->time == sent->time && got->duration == sent->duration);
    assert_true(got->time_step == sent->time_step && got->iterations == sent->iterations);
    assert_true(got->density_error == sent->density_error && got->max_speed == sent->max_speed);
    assert_true(got->density_error_max == 0.0125 && got->tolerance == 1e-3);
    assert_true(got->wall_seconds == sent->wall_seconds && got->eta_seconds == sent->eta_seconds);
    assert_int_equal(got->lost_particles, sent->lost_particles);
    assert_int_equal(got->capped_steps, 5);
    assert_int_equal(got->frames_skipped, 2);
    assert_int_equal(got->fluid_particles, frame->count);
    assert_int_equal(got->stage_count, 2);
    assert_string_equal(got->stages[1], "pressure");
    assert_true(got->stage_seconds[1] == 2.25);
}

static void check_points(const sb_live_frame *got, const sb_frame *frame)
{
    double far = 0;
    assert_int_equal(got->count, frame->count);
    for (int32_t p = 0; p < got->part_count; p++)
        for (int64_t i = got->parts[p].first; i < got->parts[p].first + got->parts[p].count; i++) {
            const sb_point point = sb_point_decode(got->points + SB_STREAM_POINT * i, got->parts[p].corner,
                                                   got->quantum, got->speed_max, got->pressure_max);
            const float *x = frame->position + 3 * i;
            const sb_vec3 at = sb_sub(sb_vec(point.position[0], point.position[1], point.position[2]), frame->origin);
            far = fmax(far, sb_norm(sb_sub(at, sb_vec((double)x[0], (double)x[1], (double)x[2]))));
        }
    assert_true(far > 0 && far < 0.02 * frame->spacing);
}

static void frames_arrive(void **state)
{
    (void)state;
    enum { PARTICLES = 100000, BODIES = 17 };
    sb_stream *stream = begin(0, 1);
    sb_frame *frame = fixture_frame(5, 12.5, PARTICLES, BODIES);
    fixture_publish(stream, frame);
    fixture_drain(stream);
    assert_int_equal(all.statuses, 1);
    check_status(&all.status, frame, sb_stream_run_id(stream));
    assert_int_equal(all.status.state, SB_RUN_RUNNING);
    assert_int_equal(all.parts, (PARTICLES + SB_STREAM_POINTS - 1) / SB_STREAM_POINTS);
    assert_int_equal(all.frames, 1);
    const sb_live_frame *got = sb_live_get_frame(all.live);
    assert_int_equal(got->frame, 5);
    assert_int_equal(got->step, frame->status.step);
    assert_true(got->time == 12.5 && got->spacing == frame->spacing);
    check_points(got, frame);
    assert_int_equal(got->moved_count, 4);
    for (size_t m = 0; m < 4; m++) {
        assert_int_equal(got->moved[m], 4 * m + 1);
        assert_memory_equal(got->displacement + 3 * m, &frame->bodies[4 * m + 1].displacement, 24);
    }
    assert_in_range(all.largest, 56000, SB_STREAM_MESSAGE_MAX);
    assert_true(sb_stream_count(stream).bytes < 8.2 * PARTICLES * (1 + 2 / 15.0)); /* parity of 15 parts */
    sb_frame_release(frame);
    end(stream);
}

static void empty_frames_and_many_moved_bodies(void **state)
{
    (void)state;
    enum { BODIES = 500 };
    sb_stream *stream = begin(0, 1);
    sb_frame *frame = fixture_frame(1, 0, 0, BODIES);
    fixture_publish(stream, frame);
    sb_frame_release(frame);
    frame = fixture_frame(2, 0, 20000, BODIES);
    fixture_publish(stream, frame);
    fixture_drain(stream);
    assert_int_equal(all.frames, 2);
    assert_int_equal(all.parts, 1 + 3);
    assert_int_equal(sb_live_get_frame(all.live)->moved_count, SB_STREAM_MOVED);
    assert_in_range(all.largest, 58000, SB_STREAM_MESSAGE_MAX);
    sb_frame_release(frame);
    end(stream);
}

static void rows_arrive_once(void **state)
{
    (void)state;
    enum { BODIES = 3 * SB_STREAM_ROWS, GAUGES = SB_STREAM_ROWS + 5 }; /* two thirds of the bodies are reported */
    fixture_scene f;
    fixture_scene_make(&f, BODIES, GAUGES);
    for (size_t b = 0; b < BODIES; b++) /* the longest names */
        memset(f.model.bodies[b].name, 'n', sizeof f.model.bodies[b].name - 1);
    sb_stream *stream = begin(0, 1);
    assert_int_equal(sb_stream_set_scene(stream, &f.scene, &f.model, NULL), SB_OK);
    for (int i = 1; i <= 3; i++) {
        sb_measure_records rows = fixture_rows(&f, 0.1 * i);
        sb_stream_measure(stream, &rows);
        fixture_rows_free(&rows);
    }
    sb_stream_serve(stream);
    sb_stream_serve(stream);
    fixture_drain(stream);
    assert_int_equal(all.forces, 3 * 2);
    assert_int_equal(all.gauges, 3 * 2);
    assert_in_range(all.largest, 55000, SB_STREAM_MESSAGE_MAX);
    sb_measure_records rows = fixture_rows(&f, 0.3);
    assert_true(all.force.time == 0.1 * 3);
    assert_int_equal(all.force.total, rows.force_count);
    assert_int_equal(all.force.first, SB_STREAM_ROWS);
    assert_int_equal(all.force.count, rows.force_count - SB_STREAM_ROWS);
    for (int32_t i = 0; i < all.force.count; i++) {
        const sb_force_record *row = &rows.forces[SB_STREAM_ROWS + i];
        assert_int_equal(all.force.body[i], row->body);
        assert_memory_equal(&all.force.force[3 * i], &row->force, 24);
        assert_memory_equal(&all.force.moment[3 * i], &row->moment, 24);
        assert_memory_equal(&all.force.pressure[3 * i], &row->pressure, 24);
        assert_memory_equal(&all.force.friction[3 * i], &row->friction, 24);
    }
    assert_int_equal(all.gauge.first, SB_STREAM_ROWS);
    assert_int_equal(all.gauge.count, 5);
    assert_string_equal(all.gauge.names[4], f.scene.measure.gauges[GAUGES - 1].name);
    for (int32_t i = 0; i < 5; i++) {
        const sb_gauge_record *row = &rows.gauges[SB_STREAM_ROWS + i];
        assert_int_equal(all.gauge.wet[i], !isnan(row->z));
        assert_true(all.gauge.z[i] == (isnan(row->z) ? 0 : row->z));
        assert_true(all.gauge.eta[i] == (isnan(row->z) ? 0 : row->eta));
    }
    fixture_rows_free(&rows);
    end(stream);
    fixture_scene_free(&f);
}

static void the_last_rows_and_the_end_arrive(void **state)
{
    (void)state;
    fixture_scene f;
    fixture_scene_make(&f, 4, 2);
    sb_stream *stream = begin(0, 1);
    assert_int_equal(sb_stream_set_scene(stream, &f.scene, &f.model, NULL), SB_OK);
    sb_stream_serve(stream);
    sb_measure_records rows = fixture_rows(&f, 90);
    sb_stream_measure(stream, &rows);
    fixture_rows_free(&rows);
    sb_stream_finish(stream);
    fixture_drain(stream);
    assert_int_equal(all.forces, 1);
    assert_int_equal(all.force.count, 3);
    assert_int_equal(all.gauges, 1);
    assert_int_equal(all.status.state, SB_RUN_DONE);
    end(stream);
    fixture_scene_free(&f);
}

/* The x coordinates of the particles that arrived, sorted: they identify the particles. */
static int by_x(const void *a, const void *b)
{
    const double left = *(const double *)a, right = *(const double *)b;
    return (left > right) - (left < right);
}

static size_t places(double *x)
{
    const sb_live_frame *got = sb_live_get_frame(all.live);
    for (int32_t p = 0; p < got->part_count; p++)
        for (int64_t i = got->parts[p].first; i < got->parts[p].first + got->parts[p].count; i++)
            x[i] = sb_point_decode(got->points + SB_STREAM_POINT * i, got->parts[p].corner, got->quantum, 1, 1)
                       .position[0];
    qsort(x, (size_t)got->count, sizeof *x, by_x);
    return (size_t)got->count;
}

static void decimation_keeps_the_same_particles(void **state)
{
    (void)state;
    enum { PARTICLES = 60000, EVERY = 7 };
    static double first[PARTICLES], second[PARTICLES];
    sb_stream *stream = begin(0, EVERY);
    sb_frame *frame = fixture_frame(1, 0, PARTICLES, 0);
    for (size_t i = 0; i < PARTICLES; i++) frame->position[3 * i] = 0.01F * (float)i;
    fixture_publish(stream, frame);
    fixture_drain(stream);
    const size_t count = places(first);
    assert_int_equal(all.part.decimation, EVERY);
    assert_in_range(count, 0.95 * PARTICLES / EVERY, 1.05 * PARTICLES / EVERY);
    /* The simulation sorts its particles, so the same ids are at other indices. */
    for (size_t i = 0; i < PARTICLES; i++) {
        frame->id[i] = (uint32_t)(PARTICLES - 1 - i);
        frame->position[3 * i] = 0.01F * (float)frame->id[i];
    }
    frame->index = 2;
    fixture_publish(stream, frame);
    fixture_drain(stream);
    assert_int_equal(places(second), count);
    assert_memory_equal(first, second, count * sizeof *first);
    sb_frame_release(frame);
    end(stream);
}

static void particles_come_once_per_interval(void **state)
{
    (void)state;
    static const struct {
        double time;
        size_t frames;
    } steps[] = {{0, 1}, {0.2, 1}, {0.5 - 1e-9, 2}, {0.5, 2}, {0.9, 2}, {2.75, 3}, {2.9, 3}, {3.01, 4}};
    sb_stream *stream = begin(0.5, 1);
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        sb_frame *frame = fixture_frame(i + 1, steps[i].time, 10, 1);
        fixture_publish(stream, frame);
        sb_frame_release(frame);
        fixture_drain(stream);
        assert_int_equal(all.frames, steps[i].frames);
        assert_int_equal(all.statuses, i + 1);
    }
    end(stream);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_arrive),
        cmocka_unit_test(empty_frames_and_many_moved_bodies),
        cmocka_unit_test(rows_arrive_once),
        cmocka_unit_test(the_last_rows_and_the_end_arrive),
        cmocka_unit_test(decimation_keeps_the_same_particles),
        cmocka_unit_test(particles_come_once_per_interval),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
