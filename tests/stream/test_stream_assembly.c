/* Frames put together from parts that are missing, duplicated, late or contradictory. */
#include "stream_fixture.h"

static unsigned char bytes[SB_STREAM_POINT * 16];
static sb_frame_message part; /* static because it is large */
static sb_assembly assembly;

enum { EACH = 10 }; /* particles per part */

/* Adds a part whose bytes are its frame's number plus its own. Returns whether the frame is complete. */
static bool add(int64_t frame, int32_t index, int32_t count)
{
    bool complete = false;
    part = (sb_frame_message){.frame = frame,
                              .part = index,
                              .part_count = count,
                              .total = (int64_t)EACH * count,
                              .first = (int64_t)EACH * index,
                              .count = EACH,
                              .decimation = 1,
                              .spacing = 1,
                              .quantum = 0.125,
                              .points = bytes};
    memset(bytes, (int)(frame + index), sizeof bytes);
    assert_int_equal(sb_assembly_add(&assembly, &part, &complete), SB_OK);
    return complete;
}

static int clear(void **state)
{
    (void)state;
    sb_assembly_free(&assembly);
    return 0;
}

static void whole_frames(void **state)
{
    (void)state;
    for (int64_t frame = 1; frame <= 3; frame++)
        for (int32_t i = 0; i < 5; i++) assert_int_equal(add(frame, i, 5), i == 4);
    assert_int_equal(assembly.frames_complete, 3);
    assert_int_equal(assembly.parts, 15);
    assert_int_equal(assembly.parts_lost + assembly.frames_partial + assembly.parts_ignored, 0);
    const sb_live_frame *newest = &assembly.newest;
    assert_int_equal(newest->frame, 3);
    assert_int_equal(newest->count, 50);
    for (size_t i = 0; i < 50; i++) assert_int_equal(newest->points[8 * i + 7], 3 + i / EACH);
}

static void gaps_and_another_order(void **state)
{
    (void)state;
    assert_false(add(1, 1, 4));
    assert_false(add(1, 3, 4));
    assert_false(add(1, 0, 4));
    assert_int_equal(assembly.parts_lost, 0); /* part 2 may still come */
    assert_true(add(1, 2, 4));
    assert_int_equal(assembly.newest.points[8 * 25], 3);
    assert_false(add(2, 0, 4));
    assert_false(add(4, 0, 2000)); /* frame 3 was not sent or lost as a whole */
    assert_int_equal(assembly.frames_partial, 1);
    assert_int_equal(assembly.parts_lost, 3);
    assert_int_equal(assembly.newest.frame, 1); /* the newest complete frame stays */
    assert_false(add(2, 1, 4));                 /* late */
    assert_int_equal(assembly.parts_ignored, 1);
    assert_true(add(5, 0, 1));
    assert_int_equal(assembly.parts_lost, 3 + 1999);
    assert_false(add(1, 0, 1)); /* an earlier number is late, unless the run began again */
    sb_assembly_restart(&assembly);
    assert_true(add(1, 0, 1));
}

static void duplicates_and_contradictions(void **state)
{
    (void)state;
    assert_false(add(1, 0, 3));
    assert_false(add(1, 0, 3));
    assert_false(add(1, 7, 9)); /* the same frame with another number of parts */
    assert_int_equal(assembly.parts_ignored, 2);
    assert_int_equal(assembly.received, 1);
    assert_false(add(1, 1, 3));
    assert_true(add(1, 2, 3));
    assert_false(add(1, 2, 3));
    assert_int_equal(assembly.frames_complete, 1);
}

/* Two parts that are valid alone and overlap: the frame has particles that no part brought. */
static void overlapping_parts(void **state)
{
    (void)state;
    bool complete = true;
    assert_false(add(1, 0, 3));
    assert_false(add(1, 2, 3));
    part.part = 1;
    part.first = 5;
    assert_int_equal(sb_assembly_add(&assembly, &part, &complete), SB_OK);
    assert_false(complete);
    assert_int_equal(assembly.frames_complete, 0);
    assert_int_equal(assembly.newest.part_count, 0);
}

static void without_memory(void **state)
{
    (void)state;
    bool complete;
    assert_false(add(1, 0, 2));
    for (long n = 1; n <= 2; n++) {
        sb_memory_fail_at(n);
        part.frame = 2 * n;
        part.part = part.part_count = 1000 * (int32_t)n * (int32_t)n;
        part.part--;
        part.total = (int64_t)EACH * part.part_count;
        part.first = part.total - EACH;
        assert_int_equal(sb_assembly_add(&assembly, &part, &complete), SB_FAILED);
        sb_memory_fail_at(0);
        assert_int_equal(sb_assembly_add(&assembly, &part, &complete), SB_OK);
        assert_int_equal(assembly.received, 1);
    }
    assert_int_equal(assembly.parts_lost, 1 + 999);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(whole_frames, clear),
        cmocka_unit_test_teardown(gaps_and_another_order, clear),
        cmocka_unit_test_teardown(duplicates_and_contradictions, clear),
        cmocka_unit_test_teardown(overlapping_parts, clear),
        cmocka_unit_test_teardown(without_memory, clear),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
