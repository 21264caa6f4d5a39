/* Particle files in pieces: the pieces together are the frame that was divided; a damaged list, or one that leads
   elsewhere, is refused. */
#include "output/particles/pvtp.h"

#include "base/random.h"
#include "folder.h"
#include "output/particles/vtp.h"

#include <setjmp.h>
#include <stdarg.h>
#include <sys/stat.h>

#include <cmocka.h>

enum { NUMBER = 12, PIECES = 3 };

/* Particles [from, from + count) of a frame that is the same in each call. */
static sb_frame *make_part(size_t from, size_t count)
{
    sb_frame *frame = sb_frame_create(count, 1);
    assert_non_null(frame);
    assert_true(sb_frame_add_density_error(frame));
    frame->origin = sb_vec(100, -20, 3);
    frame->spacing = 0.5;
    frame->index = NUMBER;
    frame->status = (sb_frame_status){.step = 9, .time = 1.25, .duration = 2};
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < 3; k++) {
            frame->position[3 * i + k] = (float)sb_random(k, from + i);
            frame->velocity[3 * i + k] = (float)sb_random(10 + k, from + i);
        }
        frame->pressure[i] = (float)sb_random(20, from + i);
        frame->density_error[i] = (float)sb_random(30, from + i);
        frame->id[i] = (uint32_t)(from + i);
    }
    snprintf(frame->bodies[0].name, sizeof frame->bodies[0].name, "house");
    frame->bodies[0].force = sb_vec(1, 2, 3);
    return frame;
}

/* Writes three pieces, of which the second one has no particles. */
static void write_pieces(const char *list)
{
    static const size_t from[] = {0, 5, 5}, count[] = {5, 0, 4};
    sb_error error = {0};
    for (int r = PIECES - 1; r >= 0; r--) {
        sb_frame *part = make_part(from[r], count[r]);
        const sb_status status = r > 0 ? sb_pvtp_write_piece(folder, r, part, NUMBER, &error)
                                       : sb_pvtp_write(in_folder(list), part, NUMBER, PIECES, &error);
        if (status != SB_OK) fail_msg("%s", error.text);
        sb_frame_release(part);
    }
}

static void pieces_together_are_the_whole(void **state)
{
    (void)state;
    sb_frame *whole = make_part(0, 9), *read = NULL;
    sb_error error = {0};
    write_pieces("000012.pvtp");
    if (sb_pvtp_read(in_folder("000012.pvtp"), &read, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(read->count, 9);
    assert_int_equal(read->index, NUMBER);
    assert_true(read->status.step == 9 && read->status.time == 1.25);
    assert_memory_equal(read->position, whole->position, 9 * 12);
    assert_memory_equal(read->velocity, whole->velocity, 9 * 12);
    assert_memory_equal(read->pressure, whole->pressure, 9 * 4);
    assert_memory_equal(read->density_error, whole->density_error, 9 * 4);
    assert_memory_equal(read->id, whole->id, 9 * 4);
    assert_int_equal(read->body_count, 1);
    assert_string_equal(read->bodies[0].name, "house");
    sb_frame_release(read);
    sb_frame_release(whole);
}

/* Writes the list with `from` replaced by `to`, and expects that it is refused for this reason. */
static void refuses(const char *from, const char *to, const char *reason)
{
    char text[4096];
    sb_error error = {0};
    sb_frame *read = NULL;
    char *list = text_of("000012.pvtp"), *at = strstr(list, from);
    assert_non_null(at);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - list), list, to, at + strlen(from));
    sb_free(list);
    FILE *stream = fopen(in_folder("bad.pvtp"), "w");
    assert_non_null(stream);
    fputs(text, stream);
    fclose(stream);
    assert_int_equal(sb_pvtp_read(in_folder("bad.pvtp"), &read, &error), SB_BAD_INPUT);
    assert_null(read);
    if (!strstr(error.text, reason)) fail_msg("\"%s\", expected \"%s\"", error.text, reason);
}

static void damaged_lists_are_refused(void **state)
{
    (void)state;
    write_pieces("000012.pvtp");
    refuses("PPolyData", "PolyData", "is no complete list");
    refuses("</PPolyData>", "", "is no complete list");
    refuses("rank1/", "../rank1/", "names a file outside of rank<R>");
    refuses("rank1/", "/etc/", "names a file outside of rank<R>");
    refuses("rank1/000012.vtp", "rank1/..", "names a file outside of rank<R>");
    refuses("rank1/000012.vtp", "rank1/000013.vtp", "rank1/000013.vtp: cannot read");
    refuses("rank1/000012.vtp\"", "rank1/000012.vtp", "");
    refuses("rank2/000012.vtp", "", "has a damaged entry");
}

static void a_piece_of_another_step_is_refused(void **state)
{
    (void)state;
    sb_error error = {0};
    sb_frame *part = make_part(5, 4), *read = NULL;
    write_pieces("000012.pvtp");
    part->status.step = 10;
    assert_int_equal(sb_pvtp_write_piece(folder, 2, part, NUMBER, &error), SB_OK);
    assert_int_equal(sb_pvtp_read(in_folder("000012.pvtp"), &read, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "rank2/000012.vtp: is of step 10, expected one of step 9"));
    sb_frame_release(part);
}

static bool there(const char *name)
{
    struct stat found;
    return stat(in_folder(name), &found) == 0;
}

static void later_pieces_are_removed(void **state)
{
    (void)state;
    sb_error error = {0};
    sb_frame *part = make_part(0, 2);
    write_pieces("000012.pvtp");
    for (int r = 0; r < PIECES; r++) assert_int_equal(sb_pvtp_write_piece(folder, r, part, 13, &error), SB_OK);
    assert_int_equal(sb_pvtp_remove_pieces(folder, 12, &error), SB_OK);
    assert_true(there("rank0/000012.vtp") && there("rank2/000012.vtp"));
    assert_false(there("rank0/000013.vtp") || there("rank1/000013.vtp") || there("rank2/000013.vtp"));
    assert_int_equal(sb_pvtp_remove_pieces(in_folder("absent"), 0, &error), SB_OK);
    sb_frame_release(part);
}

/* A file where the folder of a rank should be. */
static void a_folder_that_cannot_be_made_is_named(void **state)
{
    (void)state;
    sb_error error = {0};
    sb_frame *part = make_part(0, 2);
    FILE *stream = fopen(in_folder("rank7"), "w");
    assert_non_null(stream);
    fclose(stream);
    assert_int_equal(sb_pvtp_write_piece(folder, 7, part, 1, &error), SB_FAILED);
    assert_non_null(strstr(error.text, "rank7: is not a directory"));
    sb_frame_release(part);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pieces_together_are_the_whole),         cmocka_unit_test(damaged_lists_are_refused),
        cmocka_unit_test(a_piece_of_another_step_is_refused),    cmocka_unit_test(later_pieces_are_removed),
        cmocka_unit_test(a_folder_that_cannot_be_made_is_named),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
