/* Functions that the stream's tests share: a frame of known random content, and a stream over memq. */
#ifndef SB_TESTS_STREAM_FIXTURE_H
#define SB_TESTS_STREAM_FIXTURE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/memory.h"
#include "base/random.h"
#include "stream/decode.h"
#include "stream/provider.h"
#include "stream/stream.h"

#include <stdio.h>
#include <string.h>

static inline double fixture_number(uint64_t index, double scale)
{
    return scale * (2 * sb_random(7, index) - 1);
}

static inline sb_vec3 fixture_vector(uint64_t index, double scale)
{
    return sb_vec(fixture_number(3 * index, scale), fixture_number(3 * index + 1, scale),
                  fixture_number(3 * index + 2, scale));
}

static inline sb_frame *fixture_frame(uint64_t index, double time, size_t particles, size_t bodies)
{
    sb_frame *frame = sb_frame_create(particles, bodies);
    assert_non_null(frame);
    frame->index = index;
    frame->origin = sb_vec(1e6 + 0.125, -2e6, 30.5);
    frame->spacing = 0.75;
    frame->status = (sb_frame_status){.step = 1234 + index,
                                      .time = time,
                                      .duration = 90,
                                      .time_step = 0.0031,
                                      .iterations = 17,
                                      .density_error = 4e-4,
                                      .max_speed = 21.25,
                                      .wall_seconds = 60.5,
                                      .eta_seconds = 33.25,
                                      .lost_particles = 3};
    for (size_t i = 0; i < particles; i++) {
        for (size_t k = 0; k < 3; k++) {
            frame->position[3 * i + k] = (float)fixture_number(6 * i + k, 500);
            frame->velocity[3 * i + k] = (float)fixture_number(6 * i + 3 + k, 20);
        }
        frame->pressure[i] = (float)fixture_number(i, 1e5);
        frame->id[i] = (uint32_t)i;
    }
    for (size_t b = 0; b < bodies; b++) {
        snprintf(frame->bodies[b].name, sizeof frame->bodies[b].name, "building-%zu", b);
        frame->bodies[b].report = b % 3 != 2;
        frame->bodies[b].force = fixture_vector(900 + b, 1e8);
        frame->bodies[b].moment = fixture_vector(1900 + b, 1e9);
        frame->bodies[b].displacement = fixture_vector(2900 + b, 10);
    }
    return frame;
}

static inline sb_stream *fixture_stream(const char *url, double interval, int decimation)
{
    char copy[512];
    snprintf(copy, sizeof copy, "%s", url);
    sb_stream_settings settings = {
        .enabled = true, .url = copy, .prefix = "test", .interval = interval, .decimation = decimation};
    sb_stream *stream = NULL;
    sb_error error = {0};
    if (sb_stream_create(&settings, "a run", &stream, &error) != SB_OK) fail_msg("%s", error.text);
    return stream;
}

/* Handles all waiting messages of a memq stream. */
static inline void fixture_drain(sb_stream *stream)
{
    while (lcm_handle_timeout(sb_stream_provider(stream), 0) > 0)
        ;
}

#endif
