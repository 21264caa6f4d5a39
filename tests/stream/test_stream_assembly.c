/* A subscriber's counts of frames and chunks when chunks are missing, duplicated or contradictory. */
#include "stream_fixture.h"

#include "stream/assembly.h"

static sb_particles_message chunk; /* static because it is large; only its counts are used here */

static void add(sb_assembly *assembly, int64_t frame, int32_t index, int32_t count)
{
    chunk.frame = frame;
    chunk.chunk = index;
    chunk.chunk_count = count;
    chunk.total = 100 * count;
    assert_int_equal(sb_assembly_add(assembly, &chunk), SB_OK);
}

static void whole_frames(void **state)
{
    (void)state;
    sb_assembly assembly = {0};
    for (int64_t frame = 1; frame <= 3; frame++)
        for (int32_t i = 0; i < 5; i++) add(&assembly, frame, i, 5);
    assert_int_equal(assembly.frames_complete, 3);
    assert_int_equal(assembly.chunks, 15);
    assert_int_equal(assembly.chunks_lost + assembly.frames_partial + assembly.chunks_ignored, 0);
    sb_assembly_free(&assembly);
    assert_int_equal(assembly.frames_complete, 0);
}

static void gaps(void **state)
{
    (void)state;
    sb_assembly assembly = {0};
    add(&assembly, 1, 1, 4); /* the first two of four lost or late */
    add(&assembly, 1, 3, 4);
    add(&assembly, 1, 0, 4);
    assert_int_equal(assembly.chunks_lost, 0); /* chunk 2 may still come */
    add(&assembly, 4, 0, 2000);                /* frames 2 and 3 were not streamed or all lost */
    assert_int_equal(assembly.frames_partial, 1);
    assert_int_equal(assembly.chunks_lost, 1);
    add(&assembly, 5, 0, 1);
    assert_int_equal(assembly.chunks_lost, 2000);
    assert_int_equal(assembly.frames_complete, 1);
    add(&assembly, 1, 0, 1); /* a new run starts at 1 again */
    assert_int_equal(assembly.frames_complete, 2);
    assert_int_equal(assembly.frames_partial, 2);
    sb_assembly_free(&assembly);
}

static void duplicates_and_contradictions(void **state)
{
    (void)state;
    sb_assembly assembly = {0};
    add(&assembly, 1, 0, 3);
    add(&assembly, 1, 0, 3);
    add(&assembly, 1, 7, 9); /* the same frame with another number of chunks */
    assert_int_equal(assembly.chunks_ignored, 2);
    assert_int_equal(assembly.received, 1);
    add(&assembly, 1, 1, 3);
    add(&assembly, 1, 2, 3);
    assert_int_equal(assembly.frames_complete, 1);
    sb_assembly_free(&assembly);
}

static void without_memory(void **state)
{
    (void)state;
    sb_assembly assembly = {0};
    add(&assembly, 1, 0, 2);
    sb_memory_fail_at(1);
    chunk.frame = 2;
    chunk.chunk = 900;
    chunk.chunk_count = 1000;
    assert_int_equal(sb_assembly_add(&assembly, &chunk), SB_FAILED);
    sb_memory_fail_at(0);
    add(&assembly, 2, 900, 1000);
    assert_int_equal(assembly.received, 1);
    assert_int_equal(assembly.chunks_lost, 1);
    sb_assembly_free(&assembly);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_frames),
        cmocka_unit_test(gaps),
        cmocka_unit_test(duplicates_and_contradictions),
        cmocka_unit_test(without_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
