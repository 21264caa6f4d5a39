/* Numbers that are not finite, at every place of every message and of the scene: they are refused, or they were not
   read as a number. No decoder lets one through to a subscriber. */
#include "captured.h"

#include <math.h>
#include <stdlib.h>

static int capture_all(void **state)
{
    (void)state;
    fixture_scene f;
    sb_stream *stream = captured_stream(&f, 20);
    if (!stream) return -1;
    sb_stream_destroy(stream);
    fixture_scene_free(&f);
    return 0;
}

static void all_finite(const double *values, size_t count)
{
    for (size_t i = 0; i < count; i++) assert_true(isfinite(values[i]));
}

static void all_finite_floats(const float *values, size_t count)
{
    for (size_t i = 0; i < count; i++) assert_true(isfinite(values[i]));
}

static size_t accepted;

static void on_status(void *user, const sb_status_message *m)
{
    (void)user;
    const double values[] = {m->time,      m->duration,  m->time_step,    m->density_error, m->density_error_max,
                             m->tolerance, m->max_speed, m->wall_seconds, m->eta_seconds,   m->rate};
    all_finite(values, sizeof values / sizeof *values);
    all_finite(m->region_min, 3);
    all_finite(m->region_max, 3);
    all_finite(m->stage_seconds, (size_t)m->stage_count);
    accepted++;
}

static void on_forces(void *user, const sb_forces_message *m)
{
    (void)user;
    all_finite(&m->time, 1);
    all_finite(m->force, 3 * (size_t)m->count);
    all_finite(m->moment, 3 * (size_t)m->count);
    all_finite(m->pressure, 3 * (size_t)m->count);
    all_finite(m->friction, 3 * (size_t)m->count);
    accepted++;
}

static void on_gauges(void *user, const sb_gauges_message *m)
{
    (void)user;
    all_finite(&m->time, 1);
    all_finite(m->eta, (size_t)m->count);
    all_finite(m->z, (size_t)m->count);
    accepted++;
}

static void on_part(void *user, const sb_frame_message *m)
{
    (void)user;
    const double values[] = {m->time, m->spacing, m->quantum, m->speed_max, m->pressure_max};
    all_finite(values, sizeof values / sizeof *values);
    all_finite(m->corner, 3);
    all_finite(m->displacement, 3 * (size_t)m->moved_count);
    accepted++;
}

static void on_reply(void *user, const sb_reply_message *m)
{
    (void)user;
    all_finite(&m->time, 1);
    accepted++;
}

static void check_scene(const sb_live_scene *s)
{
    const double values[] = {s->spacing,   s->duration,     s->gravity,     s->density,          s->level,
                             s->speed_max, s->pressure_max, s->still_depth, s->measure_interval, s->frame_interval};
    all_finite(values, sizeof values / sizeof *values);
    all_finite(s->domain_min, 3);
    all_finite(s->domain_max, 3);
    for (size_t b = 0; b < s->body_count; b++) {
        all_finite_floats(s->bodies[b].color, 3);
        all_finite(s->bodies[b].moment_point, 3);
        all_finite_floats(s->bodies[b].vertices, 3 * s->bodies[b].vertex_count);
    }
    for (size_t c = 0; c < s->camera_count; c++) {
        all_finite(s->cameras[c].time, s->cameras[c].key_count);
        all_finite(s->cameras[c].eye, 3 * s->cameras[c].key_count);
        all_finite(s->cameras[c].target, 3 * s->cameras[c].key_count);
        all_finite(s->cameras[c].fov, s->cameras[c].key_count);
    }
    for (size_t g = 0; g < s->gauge_count; g++) assert_true(isfinite(s->gauges[g].x) && isfinite(s->gauges[g].y));
}

/* NaN and both infinities as doubles and as floats, as they are encoded. */
static const struct {
    size_t size;
    unsigned char bytes[8];
} patterns[] = {{8, {0x7f, 0xf8}}, {8, {0x7f, 0xf0}}, {8, {0xff, 0xf0}},
                {4, {0x7f, 0xc0}}, {4, {0x7f, 0x80}}, {4, {0xff, 0x80}}};
enum { PATTERNS = sizeof patterns / sizeof *patterns, HEAD = 28 };

static void messages_with_numbers_that_are_not_finite(void **state)
{
    (void)state;
    const sb_live_calls calls = {
        .status = on_status, .forces = on_forces, .gauges = on_gauges, .part = on_part, .reply = on_reply};
    const sb_channel_kind kinds[] = {SB_CHANNEL_STATUS, SB_CHANNEL_FORCES, SB_CHANNEL_GAUGES, SB_CHANNEL_FRAME,
                                     SB_CHANNEL_REPLY};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        const message *from = &good[kinds[k]];
        assert_true(from->size > HEAD && from->size < 5000);
        accepted = 0;
        uint64_t refused = 0;
        for (size_t p = 0; p < PATTERNS; p++) {
            for (size_t at = HEAD; at + patterns[p].size <= from->size; at++) {
                sb_live *live = sb_live_create(&calls);
                message bad = *from;
                memcpy(bad.bytes + at, patterns[p].bytes, patterns[p].size);
                sb_live_take(live, kinds[k], bad.bytes, bad.size, 0);
                refused += sb_live_count(live).refused;
                sb_live_destroy(live);
            }
        }
        assert_true(refused > 0 && accepted > 0); /* accepted: the bytes were those of a name or of particles */
    }
}

static void scenes_with_numbers_that_are_not_finite(void **state)
{
    (void)state;
    sb_scene_piece_message piece;
    const message *from = &good[SB_CHANNEL_SCENE];
    assert_int_equal(sb_stream_decode_piece(from->bytes, from->size, &piece, NULL), SB_OK);
    assert_int_equal(piece.piece_count, 1);
    size_t refused = 0, taken = 0;
    for (size_t p = 0; p < PATTERNS; p++) {
        for (size_t at = HEAD; at + patterns[p].size <= (size_t)piece.count; at++) {
            sb_live_scene scene;
            unsigned char *bad = malloc((size_t)piece.count);
            assert_non_null(bad);
            memcpy(bad, piece.data, (size_t)piece.count);
            memcpy(bad + at, patterns[p].bytes, patterns[p].size);
            const sb_status status = sb_live_scene_decode(bad, (size_t)piece.count, &scene, NULL);
            free(bad);
            if (status == SB_OK) {
                check_scene(&scene);
                sb_live_scene_free(&scene);
                taken++;
            } else
                refused++;
        }
    }
    assert_true(refused > 0 && taken > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(messages_with_numbers_that_are_not_finite),
        cmocka_unit_test(scenes_with_numbers_that_are_not_finite),
    };
    return cmocka_run_group_tests(tests, capture_all, NULL);
}
