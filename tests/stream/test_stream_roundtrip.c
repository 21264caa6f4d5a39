/* A subscriber decodes exactly the bits that a stream sends. */
#include "stream_fixture.h"

#include "shorebreak_forces_t.h"
#include "shorebreak_particles_t.h"
#include "shorebreak_status_t.h"

#include <math.h>

/* The messages that one subscriber of all channels has received. */
typedef struct received_data {
    size_t statuses, forces, chunks, largest;
    sb_status_message status;
    sb_forces_message force;
    sb_particles_message chunk;
    size_t particles;
    float *position, *velocity, *pressure; /* of all chunks in order */
    size_t capacity;
} received_data;

static void on_status(const lcm_recv_buf_t *received, const char *channel, void *user)
{
    received_data *all = user;
    assert_string_equal(channel, "test_status");
    assert_int_equal(sb_stream_decode_status(received->data, received->data_size, &all->status, NULL), SB_OK);
    all->statuses++;
    /* The decoder that lcm-gen generates must give the same values. */
    shorebreak_status_t other = {0};
    assert_true(shorebreak_status_t_decode(received->data, 0, (int)received->data_size, &other) > 0);
    assert_string_equal(other.run, all->status.run);
    assert_int_equal(other.step, all->status.step);
    assert_true(other.time == all->status.time && other.duration == all->status.duration);
    assert_true(other.time_step == all->status.time_step);
    assert_int_equal(other.iterations, all->status.iterations);
    assert_true(other.density_error == all->status.density_error);
    assert_true(other.max_speed == all->status.max_speed);
    assert_true(other.wall_seconds == all->status.wall_seconds);
    assert_true(other.eta_seconds == all->status.eta_seconds);
    assert_int_equal(other.lost_particles, all->status.lost_particles);
    assert_int_equal(other.fluid_particles, all->status.fluid_particles);
    assert_int_equal(other.frame, all->status.frame);
    shorebreak_status_t_decode_cleanup(&other);
}

static void on_forces(const lcm_recv_buf_t *received, const char *channel, void *user)
{
    received_data *all = user;
    assert_string_equal(channel, "test_forces");
    if (received->data_size > all->largest) all->largest = received->data_size;
    assert_int_equal(sb_stream_decode_forces(received->data, received->data_size, &all->force, NULL), SB_OK);
    all->forces++;
    if (all->force.count == 0) return; /* LCM's decoder copies from a null pointer then */
    shorebreak_forces_t other = {0};
    assert_true(shorebreak_forces_t_decode(received->data, 0, (int)received->data_size, &other) > 0);
    assert_int_equal(other.n, all->force.count);
    size_t vectors = 3 * sizeof(double) * (size_t)other.n;
    for (int32_t i = 0; i < other.n; i++) {
        assert_string_equal(other.names[i], all->force.names[i]);
        assert_int_equal(other.reported[i], all->force.reported[i]);
    }
    if (vectors > 0) {
        assert_memory_equal(other.force, all->force.force, vectors);
        assert_memory_equal(other.moment, all->force.moment, vectors);
        assert_memory_equal(other.displacement, all->force.displacement, vectors);
    }
    shorebreak_forces_t_decode_cleanup(&other);
}

static void on_particles(const lcm_recv_buf_t *received, const char *channel, void *user)
{
    received_data *all = user;
    assert_string_equal(channel, "test_particles");
    if (received->data_size > all->largest) all->largest = received->data_size;
    sb_particles_message *chunk = &all->chunk;
    assert_int_equal(sb_stream_decode_particles(received->data, received->data_size, chunk, NULL), SB_OK);
    all->chunks++;
    size_t count = (size_t)chunk->count;
    assert_true(all->particles + count <= all->capacity);
    assert_int_equal(chunk->first, all->particles);
    memcpy(all->position + 3 * all->particles, chunk->position, 12 * count);
    memcpy(all->velocity + 3 * all->particles, chunk->velocity, 12 * count);
    memcpy(all->pressure + all->particles, chunk->pressure, 4 * count);
    all->particles += count;
    shorebreak_particles_t other = {0};
    assert_true(shorebreak_particles_t_decode(received->data, 0, (int)received->data_size, &other) > 0);
    assert_int_equal(other.count, chunk->count);
    assert_int_equal(other.total, chunk->total);
    if (count > 0) {
        assert_memory_equal(other.position, chunk->position, 12 * count);
        assert_memory_equal(other.velocity, chunk->velocity, 12 * count);
        assert_memory_equal(other.pressure, chunk->pressure, 4 * count);
    }
    shorebreak_particles_t_decode_cleanup(&other);
}

static received_data *watch(sb_stream *stream, size_t capacity)
{
    received_data *all = sb_alloc(1, sizeof *all);
    assert_non_null(all);
    all->capacity = capacity;
    all->position = sb_alloc(3 * capacity, sizeof(float));
    all->velocity = sb_alloc(3 * capacity, sizeof(float));
    all->pressure = sb_alloc(capacity, sizeof(float));
    lcm_t *lcm = sb_stream_provider(stream);
    lcm_subscription_t *made[] = {lcm_subscribe(lcm, "test_status", on_status, all),
                                  lcm_subscribe(lcm, "test_forces", on_forces, all),
                                  lcm_subscribe(lcm, "test_particles", on_particles, all)};
    for (size_t i = 0; i < 3; i++) lcm_subscription_set_queue_capacity(made[i], 100000);
    return all;
}

static void free_received(received_data *all)
{
    sb_free(all->position);
    sb_free(all->velocity);
    sb_free(all->pressure);
    sb_free(all);
}

static void check_status(const sb_status_message *got, const sb_frame *frame)
{
    const sb_frame_status *sent = &frame->status;
    assert_string_equal(got->run, "a run");
    assert_int_equal(got->step, sent->step);
    assert_true(got->time == sent->time && got->duration == sent->duration);
    assert_true(got->time_step == sent->time_step && got->iterations == sent->iterations);
    assert_true(got->density_error == sent->density_error && got->max_speed == sent->max_speed);
    assert_true(got->wall_seconds == sent->wall_seconds && got->eta_seconds == sent->eta_seconds);
    assert_int_equal(got->lost_particles, sent->lost_particles);
    assert_int_equal(got->fluid_particles, frame->count);
    assert_int_equal(got->frame, frame->index);
}

static void check_forces(const sb_forces_message *got, const sb_frame *frame)
{
    assert_int_equal(got->frame, frame->index);
    assert_true(got->time == frame->status.time);
    assert_int_equal(got->total, frame->body_count);
    assert_int_equal(got->count, frame->body_count);
    for (size_t b = 0; b < frame->body_count; b++) {
        const sb_frame_body *body = &frame->bodies[b];
        assert_string_equal(got->names[b], body->name);
        assert_int_equal(got->reported[b], body->report);
        assert_memory_equal(&got->force[3 * b], &body->force, sizeof body->force);
        assert_memory_equal(&got->moment[3 * b], &body->moment, sizeof body->moment);
        assert_memory_equal(&got->displacement[3 * b], &body->displacement, sizeof body->displacement);
    }
}

static void all_types_arrive_unchanged(void **state)
{
    (void)state;
    enum { PARTICLES = 100000, BODIES = 17 };
    sb_stream *stream = fixture_stream("memq://", 0, 1);
    received_data *all = watch(stream, PARTICLES);
    sb_frame *frame = fixture_frame(5, 12.5, PARTICLES, BODIES);
    sb_stream_publish(stream, frame);
    fixture_drain(stream);

    assert_int_equal(all->statuses, 1);
    check_status(&all->status, frame);
    assert_int_equal(all->forces, 1);
    check_forces(&all->force, frame);
    assert_int_equal(all->chunks, (PARTICLES + SB_STREAM_CHUNK - 1) / SB_STREAM_CHUNK);
    assert_int_equal(all->chunk.chunk_count, all->chunks);
    assert_int_equal(all->chunk.total, PARTICLES);
    assert_memory_equal(all->chunk.origin, &frame->origin, sizeof frame->origin);
    assert_true(all->chunk.spacing == frame->spacing && all->chunk.time == frame->status.time);
    assert_int_equal(all->particles, PARTICLES);
    assert_memory_equal(all->position, frame->position, 12 * PARTICLES);
    assert_memory_equal(all->velocity, frame->velocity, 12 * PARTICLES);
    assert_memory_equal(all->pressure, frame->pressure, 4 * PARTICLES);
    assert_in_range(all->largest, 59000, SB_STREAM_MESSAGE_MAX);

    sb_stream_counters count = sb_stream_count(stream);
    assert_int_equal(count.messages, 2 + all->chunks);
    assert_int_equal(count.errors, 0);
    assert_true(count.bytes > 28 * PARTICLES);
    sb_frame_release(frame);
    sb_stream_destroy(stream);
    free_received(all);
}

static void empty_frames_and_many_bodies(void **state)
{
    (void)state;
    enum { BODIES = 2 * SB_STREAM_BODIES + 5 };
    sb_stream *stream = fixture_stream("memq://", 0, 1);
    received_data *all = watch(stream, 1);
    sb_frame *frame = fixture_frame(1, 0, 0, BODIES);
    for (size_t b = 0; b < BODIES; b++) /* the longest names */
        memset(frame->bodies[b].name, 'n', sizeof frame->bodies[b].name - 1);
    sb_stream_publish(stream, frame);
    fixture_drain(stream);
    assert_int_equal(all->forces, 3);
    assert_in_range(all->largest, 50000, SB_STREAM_MESSAGE_MAX);
    assert_int_equal(all->force.first, 2 * SB_STREAM_BODIES);
    assert_int_equal(all->force.count, 5);
    assert_memory_equal(&all->force.force[12], &frame->bodies[BODIES - 1].force, 24);
    assert_int_equal(all->chunks, 1);
    assert_int_equal(all->chunk.total, 0);
    assert_int_equal(sb_stream_count(stream).errors, 0);
    sb_frame_release(frame);
    frame = fixture_frame(2, 0, 0, 0);
    sb_stream_publish(stream, frame);
    fixture_drain(stream);
    assert_int_equal(all->forces, 4);
    assert_int_equal(all->force.total, 0);
    sb_frame_release(frame);
    sb_stream_destroy(stream);
    free_received(all);
}

static void status_is_sent_without_a_frame(void **state)
{
    (void)state;
    sb_stream *stream = fixture_stream("memq://", 0, 1);
    received_data *all = watch(stream, 1);
    sb_frame_status status = {.step = 9, .time = 1.5, .duration = 3, .eta_seconds = (double)NAN};
    sb_stream_status(stream, &status);
    fixture_drain(stream);
    assert_int_equal(all->statuses, 1);
    assert_int_equal(all->status.step, 9);
    assert_int_equal(all->status.frame, 0);
    assert_true(all->status.eta_seconds < 0);
    assert_int_equal(all->forces + all->chunks, 0);
    sb_stream_destroy(stream);
    free_received(all);
}

/* The x coordinate of a streamed particle identifies it. */
static int by_x(const void *a, const void *b)
{
    float left = *(const float *)a, right = *(const float *)b;
    return (left > right) - (left < right);
}

static void decimation_keeps_the_same_particles(void **state)
{
    (void)state;
    enum { PARTICLES = 60000, EVERY = 7 };
    sb_stream *stream = fixture_stream("memq://", 0, EVERY);
    received_data *all = watch(stream, PARTICLES);
    sb_frame *frame = fixture_frame(1, 0, PARTICLES, 0);
    for (size_t i = 0; i < PARTICLES; i++) frame->position[3 * i] = (float)i;
    sb_stream_publish(stream, frame);
    fixture_drain(stream);
    size_t first_count = all->particles;
    assert_int_equal(all->chunk.decimation, EVERY);
    assert_in_range(first_count, 0.95 * PARTICLES / EVERY, 1.05 * PARTICLES / EVERY);
    float *first = sb_alloc(first_count, sizeof *first);
    for (size_t i = 0; i < first_count; i++) first[i] = all->position[3 * i];

    /* The simulation sorts its particles, so the same ids are at other indices. */
    for (size_t i = 0; i < PARTICLES; i++) {
        frame->id[i] = (uint32_t)(PARTICLES - 1 - i);
        frame->position[3 * i] = (float)frame->id[i];
    }
    all->particles = 0;
    frame->index = 2;
    sb_stream_publish(stream, frame);
    fixture_drain(stream);
    assert_int_equal(all->particles, first_count);
    for (size_t i = 0; i < first_count; i++) all->pressure[i] = all->position[3 * i];
    qsort(all->pressure, first_count, sizeof(float), by_x);
    assert_memory_equal(all->pressure, first, first_count * sizeof(float));
    sb_free(first);
    sb_frame_release(frame);
    sb_stream_destroy(stream);
    free_received(all);
}

static void particles_come_once_per_interval(void **state)
{
    (void)state;
    static const struct {
        double time;
        size_t chunks;
    } steps[] = {{0, 1}, {0.2, 1}, {0.5 - 1e-9, 2}, {0.5, 2}, {0.9, 2}, {2.75, 3}, {2.9, 3}, {3.01, 4}};
    sb_stream *stream = fixture_stream("memq://", 0.5, 1);
    received_data *all = watch(stream, 1000);
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        sb_frame *frame = fixture_frame(i + 1, steps[i].time, 10, 1);
        all->particles = 0;
        sb_stream_publish(stream, frame);
        sb_frame_release(frame);
        fixture_drain(stream);
        assert_int_equal(all->chunks, steps[i].chunks);
        assert_int_equal(all->statuses, i + 1);
        assert_int_equal(all->forces, i + 1);
    }
    sb_stream_destroy(stream);
    free_received(all);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_types_arrive_unchanged),       cmocka_unit_test(empty_frames_and_many_bodies),
        cmocka_unit_test(status_is_sent_without_a_frame),   cmocka_unit_test(decimation_keeps_the_same_particles),
        cmocka_unit_test(particles_come_once_per_interval),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
