/* Functions that the stream's tests share: a frame of known random content, a scene, and a stream over memq. */
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
#include "stream/live.h"
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
            frame->position[3 * i + k] = (float)fixture_number(6 * i + k, 350);
            frame->velocity[3 * i + k] = (float)fixture_number(6 * i + 3 + k, 20);
        }
        frame->pressure[i] = (float)fixture_number(i, 1e5);
        frame->id[i] = (uint32_t)i;
    }
    for (size_t b = 0; b < bodies; b++) {
        snprintf(frame->bodies[b].name, sizeof frame->bodies[b].name, "building-%zu", b);
        frame->bodies[b].displacement = b % 4 == 1 ? fixture_vector(2900 + b, 10) : sb_vec(0, 0, 0);
    }
    return frame;
}

static inline sb_stream_progress fixture_progress(const sb_frame *frame)
{
    return (sb_stream_progress){.status = frame->status,
                                .density_error_max = 0.0125,
                                .tolerance = 1e-3,
                                .capped_steps = 5,
                                .fluid_particles = frame->count,
                                .frames_dropped = 2,
                                .stage_count = 2,
                                .stages = {{"neighbours", 1.5, 10}, {"pressure", 2.25, 10}}};
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

/* Publishes a frame after setting the progress to that of the frame. */
static inline void fixture_publish(sb_stream *stream, const sb_frame *frame)
{
    const sb_stream_progress progress = fixture_progress(frame);
    sb_stream_set_progress(stream, &progress);
    sb_stream_publish(stream, frame);
}

/* A scene with `bodies` bodies, each a tetrahedron but the last, which has no mesh; two cameras; `gauges` gauges;
   three wave makers, of which the first and the last wait for a command. Free with fixture_scene_free. */
typedef struct fixture_scene {
    sb_scene scene;
    sb_model model;
    sb_camera cameras[2];
    sb_camera_key keys[4];
    sb_wavemaker_use wavemakers[3];
} fixture_scene;

static inline void fixture_scene_make(fixture_scene *f, size_t bodies, size_t gauges)
{
    *f = (fixture_scene){0};
    f->scene.dimensions = 3;
    f->scene.resolution = 0.75;
    f->scene.duration = 90;
    f->scene.fluid = (sb_fluid_properties){.density = 1025, .gravity = 9.81};
    f->scene.domain = (sb_domain){.min = {1e6, -2e6, 0}, .max = {1e6 + 400, -2e6 + 300, 50}};
    f->scene.sea = (sb_sea){.present = true, .level = 10};
    f->scene.measure.interval = 0.1;
    f->scene.measure.gauge_count = gauges;
    f->scene.measure.gauges = sb_alloc(gauges, sizeof *f->scene.measure.gauges);
    for (size_t g = 0; g < gauges; g++) {
        snprintf(f->scene.measure.gauges[g].name, SB_NAME_MAX, "gauge-%zu", g);
        f->scene.measure.gauges[g].x = 5.0 * (double)g;
        f->scene.measure.gauges[g].y = 7.5;
    }
    f->scene.render = (sb_render_settings){.width = 160, .height = 90, .camera_count = 2, .cameras = f->cameras};
    for (size_t k = 0; k < 4; k++)
        f->keys[k] = (sb_camera_key){.time = (double)k,
                                     .eye = fixture_vector(k, 100),
                                     .target = fixture_vector(50 + k, 10),
                                     .fov = 40 + (double)k};
    f->cameras[0] = (sb_camera){.name = "shore", .key_count = 1, .keys = f->keys};
    f->cameras[1] = (sb_camera){.name = "flight", .key_count = 3, .keys = f->keys + 1};
    f->wavemakers[0] = (sb_wavemaker_use){.name = "piston", .law.start = (double)INFINITY};
    f->wavemakers[1] = (sb_wavemaker_use){.name = "flap", .law.start = 3};
    f->wavemakers[2] = (sb_wavemaker_use){.name = "slide", .law.start = (double)INFINITY};
    f->scene.wavemaker_count = 3;
    f->scene.wavemakers = f->wavemakers;
    f->scene.stream.interval = 0.5;
    f->model = (sb_model){.spacing = 0.75, .still_depth = 10, .fluid_count = 777, .body_count = bodies};
    f->model.bodies = sb_alloc(bodies, sizeof *f->model.bodies);
    for (size_t b = 0; b < bodies; b++) {
        sb_model_body *body = &f->model.bodies[b];
        snprintf(body->name, sizeof body->name, "building-%zu", b);
        body->report = b % 3 != 2;
        body->role = b == 2 ? SB_ROLE_TERRAIN : SB_ROLE_SOLID;
        body->wavemaker = b == 1 ? 0 : -1;
        body->moment_point = fixture_vector(80 + b, 30);
        for (int k = 0; k < 3; k++) body->color[k] = b == 0 ? 0.25F * (float)(k + 1) : -1;
        if (b + 1 == bodies) continue;
        assert_int_equal(sb_mesh_alloc(&body->mesh, 4, 4, NULL), SB_OK);
        for (size_t v = 0; v < 4; v++) body->mesh.vertices[v] = sb_add(f->scene.domain.min, fixture_vector(90 + v, 20));
        for (uint32_t t = 0; t < 12; t++) body->mesh.triangles[t / 3][t % 3] = (t + t / 3) % 4;
    }
}

static inline void fixture_scene_free(fixture_scene *f)
{
    for (size_t b = 0; b < f->model.body_count; b++) sb_mesh_free(&f->model.bodies[b].mesh);
    sb_free(f->model.bodies);
    sb_free(f->scene.measure.gauges);
}

/* Rows of forces on the reported bodies and of all gauges (the odd ones dry) at one instant. Free both arrays. */
static inline sb_measure_records fixture_rows(const fixture_scene *f, double time)
{
    const size_t gauges = f->scene.measure.gauge_count;
    sb_force_record *forces = sb_alloc(f->model.body_count, sizeof *forces);
    sb_gauge_record *levels = sb_alloc(gauges, sizeof *levels);
    size_t count = 0;
    for (size_t b = 0; b < f->model.body_count; b++) {
        const uint64_t seed = 900 + b + (uint64_t)(1000 * time);
        if (!f->model.bodies[b].report) continue;
        forces[count++] = (sb_force_record){.body = b,
                                            .time = time,
                                            .force = fixture_vector(seed, 1e8),
                                            .moment = fixture_vector(seed + 1, 1e9),
                                            .pressure = fixture_vector(seed + 2, 1e8),
                                            .friction = fixture_vector(seed + 3, 1e6)};
    }
    for (size_t g = 0; g < gauges; g++) {
        const double z = g % 2 ? (double)NAN : fixture_number(500 + g, 3);
        levels[g] = (sb_gauge_record){.gauge = g, .time = time, .eta = z - 10, .z = z};
    }
    return (sb_measure_records){.force_count = count, .forces = forces, .gauge_count = gauges, .gauges = levels};
}

static inline void fixture_rows_free(sb_measure_records *rows)
{
    sb_free((void *)(uintptr_t)rows->forces);
    sb_free((void *)(uintptr_t)rows->gauges);
}

/* Handles all waiting messages of a memq stream. */
static inline void fixture_drain(sb_stream *stream)
{
    while (lcm_handle_timeout(sb_stream_provider(stream), 0) > 0)
        ;
}

/* Passes the messages of a memq stream to sb_live. */
static inline void fixture_forward(const lcm_recv_buf_t *received, const char *channel, void *user)
{
    sb_live_take(user, sb_channel_guess(channel), received->data, received->data_size,
                 1e-6 * (double)received->recv_utime);
}

static inline void fixture_follow(sb_stream *stream, sb_live *live)
{
    lcm_subscription_t *made = lcm_subscribe(sb_stream_provider(stream), "test_.*", fixture_forward, live);
    lcm_subscription_set_queue_capacity(made, 100000);
}

#endif
