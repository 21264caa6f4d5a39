/* Positions, speeds and pressures of eight bytes are as exact as the document says. */
#include "stream_fixture.h"

#include "stream/points.h"

#include <float.h>
#include <math.h>

static const sb_points_choice everything = {
    .decimation = 1, .min = {-DBL_MAX, -DBL_MAX, -DBL_MAX}, .max = {DBL_MAX, DBL_MAX, DBL_MAX}};

/* Checks the errors of all particles, which are sent in the order of the frame. */
static void check_errors(const sb_points *points, const sb_frame *frame)
{
    double far = 0, speed_error = 0, pressure_error = 0;
    size_t next = 0;
    assert_int_equal(points->count, frame->count);
    for (size_t p = 0; p < points->part_count; p++) {
        const sb_points_part *part = &points->parts[p];
        assert_int_equal(part->first, next);
        assert_true(part->count <= SB_STREAM_POINTS);
        next += part->count;
        for (size_t i = part->first; i < next; i++) {
            const sb_point point = sb_point_decode(points->bytes + SB_STREAM_POINT * i, part->corner, points->quantum,
                                                   (double)points->speed_max, (double)points->pressure_max);
            const float *x = frame->position + 3 * i, *v = frame->velocity + 3 * i;
            const double dx = point.position[0] - frame->origin.x - (double)x[0],
                         dy = point.position[1] - frame->origin.y - (double)x[1],
                         dz = point.position[2] - frame->origin.z - (double)x[2];
            far = fmax(far, sqrt(dx * dx + dy * dy + dz * dz));
            speed_error =
                fmax(speed_error, fabs((double)point.speed - sqrt((double)(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]))));
            pressure_error = fmax(pressure_error, fabs((double)point.pressure - fmax(0, (double)frame->pressure[i])));
        }
    }
    assert_int_equal(next, frame->count);
    assert_in_range(1e4 * far / frame->spacing, 100, 137); /* sqrt(3) / 128 = 0.01353 spacings, plus rounding */
    assert_true(speed_error <= 1.001 * (double)points->speed_max / 255);
    assert_true(pressure_error <= 1.001 * (double)points->pressure_max / 255);
}

static void errors_are_as_stated(void **state)
{
    (void)state;
    sb_points points = {0};
    sb_frame *frame = fixture_frame(1, 0, 50000, 0);
    assert_int_equal(sb_points_encode(&points, frame, &everything, NULL), SB_OK);
    check_errors(&points, frame);
    assert_int_equal(points.part_count, (50000 + SB_STREAM_POINTS - 1) / SB_STREAM_POINTS);
    for (size_t p = 1; p < points.part_count; p++) /* one corner where the frame allows it */
        assert_memory_equal(points.parts[p].corner, points.parts[0].corner, sizeof points.parts[p].corner);
    sb_points_free(&points);
    sb_frame_release(frame);
}

/* A frame that is longer than 65535 quanta is cut into parts with corners of their own. */
static void long_frames_have_several_corners(void **state)
{
    (void)state;
    sb_points points = {0};
    sb_frame *frame = fixture_frame(1, 0, 30000, 0);
    for (size_t i = 0; i < frame->count; i++)
        frame->position[3 * i] = 0.3F * (float)i; /* 9000 m: 12 times 1024 spacings */
    assert_int_equal(sb_points_encode(&points, frame, &everything, NULL), SB_OK);
    assert_in_range(points.part_count, 12, 15);
    check_errors(&points, frame);
    sb_points_free(&points);
    sb_frame_release(frame);
}

static void extremes(void **state)
{
    (void)state;
    sb_points points = {0};
    sb_frame *frame = fixture_frame(1, 0, 4, 0);
    memset(frame->velocity, 0, 12 * sizeof(float));
    for (size_t i = 0; i < 4; i++) frame->pressure[i] = -5;
    frame->position[0] = NAN; /* particles without a place are not sent */
    frame->position[4] = INFINITY;
    assert_int_equal(sb_points_encode(&points, frame, &everything, NULL), SB_OK);
    assert_int_equal(points.count, 2);
    assert_int_equal(points.bytes[6] + points.bytes[7], 0);
    assert_true(points.speed_max <= 0 && points.pressure_max <= 0);
    frame->velocity[6] = 3; /* of the fastest particle the speed is exact */
    frame->pressure[3] = 20;
    assert_int_equal(sb_points_encode(&points, frame, &everything, NULL), SB_OK);
    assert_int_equal(points.bytes[6], 255);
    assert_int_equal(points.bytes[15], 255);
    sb_frame_release(frame);
    frame = fixture_frame(1, 0, 0, 0);
    assert_int_equal(sb_points_encode(&points, frame, &everything, NULL), SB_OK);
    assert_int_equal(points.part_count, 1);
    assert_int_equal(points.parts[0].count, 0);
    sb_points_free(&points);
    sb_frame_release(frame);
}

static void a_region_limits_what_is_sent(void **state)
{
    (void)state;
    sb_points points = {0};
    sb_frame *frame = fixture_frame(1, 0, 20000, 0);
    sb_points_choice choice = everything;
    choice.min.x = frame->origin.x;
    choice.max.x = frame->origin.x + 70;
    size_t within = 0;
    for (size_t i = 0; i < frame->count; i++) within += frame->position[3 * i] >= 0 && frame->position[3 * i] <= 70;
    assert_int_equal(sb_points_encode(&points, frame, &choice, NULL), SB_OK);
    assert_int_equal(points.count, within);
    assert_in_range(within, 1500, 2500);
    choice.max.x = choice.min.x - 1; /* an empty region is an empty frame */
    assert_int_equal(sb_points_encode(&points, frame, &choice, NULL), SB_OK);
    assert_int_equal(points.count, 0);
    assert_int_equal(points.part_count, 1);
    sb_points_free(&points);
    sb_frame_release(frame);
}

static void without_memory(void **state)
{
    (void)state;
    sb_points points = {0};
    sb_frame *frame = fixture_frame(1, 0, 100, 0);
    for (long n = 1; n <= 3; n++) {
        sb_memory_fail_at(n);
        assert_int_equal(sb_points_encode(&points, frame, &everything, NULL), SB_FAILED);
        sb_memory_fail_at(0);
        sb_points_free(&points);
    }
    sb_frame_release(frame);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_are_as_stated),
        cmocka_unit_test(long_frames_have_several_corners),
        cmocka_unit_test(extremes),
        cmocka_unit_test(a_region_limits_what_is_sent),
        cmocka_unit_test(without_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
