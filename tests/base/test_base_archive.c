/* Archives: the values that were written are read back; damage at any byte, and reads that do not match the written
   values, are errors. */
#include "../check.h"
#include "base/archive.h"
#include "base/file.h"
#include "base/memory.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[] = "/tmp/shorebreak-archive-XXXXXX";
static char path[64];

static const double numbers[] = {0.1, -0.0, 1e300, (double)NAN, (double)INFINITY};
enum { NUMBERS = sizeof numbers / sizeof *numbers, LARGE = 100000 };

static void fill(sb_archive_out *out)
{
    sb_archive_section(out, "first");
    sb_put_count(out, UINT64_MAX);
    sb_put_flag(out, true);
    sb_put_text(out, "a text");
    sb_put_text(out, "");
    sb_archive_section(out, "hollow");
    sb_archive_section(out, "eightchr");
    for (int i = 0; i < NUMBERS; i++) sb_put_real(out, numbers[i]);
    sb_put_vector(out, sb_vec(1, 2, 3));
    sb_put_list(out, numbers, NUMBERS, sizeof *numbers);
    sb_put_list(out, NULL, 0, 12);
}

/* Writes an archive and returns it as bytes; the caller frees them with sb_free. */
static char *bytes_of(size_t *length)
{
    sb_archive_out out = {0};
    sb_error error = {0};
    char *bytes;
    assert_int_equal(sb_archive_create(&out, path, "TEST", 7, &error), SB_OK);
    fill(&out);
    if (sb_archive_close(&out, &error) != SB_OK) fail_msg("%s", error.text);
    assert_null(out.bytes);
    sb_archive_out_free(&out);
    assert_int_equal(sb_file_read(path, 1 << 20, &bytes, length, &error), SB_OK);
    return bytes;
}

static int setup(void **state)
{
    (void)state;
    if (!mkdtemp(folder)) return -1;
    snprintf(path, sizeof path, "%s/a", folder);
    return 0;
}

static int teardown(void **state)
{
    (void)state;
    unlink(path);
    return rmdir(folder);
}

static void written_values_are_read_back(void **state)
{
    (void)state;
    size_t length;
    sb_free(bytes_of(&length));
    sb_archive_in in;
    sb_error error = {0};
    if (sb_archive_open(&in, path, "TEST", 7, &error) != SB_OK) fail_msg("%s", error.text);
    /* Sections can be read in any order. */
    assert_int_equal(sb_archive_enter(&in, "eightchr", &error), SB_OK);
    for (int i = 0; i < NUMBERS; i++) {
        double read = sb_take_real(&in);
        assert_memory_equal(&read, &numbers[i], sizeof read);
    }
    sb_vec3 v = sb_take_vector(&in);
    assert_true(v.x == 1 && v.y == 2 && v.z == 3);
    double list[NUMBERS];
    assert_int_equal(sb_take_length(&in, sizeof *list, NUMBERS), NUMBERS);
    sb_take_list(&in, list, NUMBERS, sizeof *list);
    assert_memory_equal(list, numbers, sizeof list);
    sb_take_list(&in, NULL, 0, 12);
    assert_int_equal(sb_archive_leave(&in, &error), SB_OK);
    assert_int_equal(sb_archive_enter(&in, "first", &error), SB_OK);
    assert_true(sb_take_count(&in, UINT64_MAX) == UINT64_MAX);
    assert_true(sb_take_flag(&in));
    char *text = sb_take_text(&in), *empty = sb_take_text(&in);
    assert_string_equal(text, "a text");
    assert_string_equal(empty, "");
    assert_int_equal(sb_archive_leave(&in, &error), SB_OK);
    assert_int_equal(sb_archive_enter(&in, "hollow", &error), SB_OK);
    assert_int_equal(sb_archive_leave(&in, &error), SB_OK);
    assert_int_equal(sb_archive_enter(&in, "absent", &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "no section \"absent\""));
    sb_free(text);
    sb_free(empty);
    sb_archive_in_free(&in);
}

static void expect_refusal(const char *bytes, size_t length, const char *message)
{
    sb_archive_in in;
    sb_error error = {0};
    assert_int_equal(sb_archive_parse(&in, "a", bytes, length, "TEST", 7, &error), SB_BAD_INPUT);
    if (strncmp(error.text, "a: ", 3) != 0 || !strstr(error.text, message)) fail_msg("%s", error.text);
    sb_archive_in_free(&in);
}

static void truncated_or_longer_archives_are_refused(void **state)
{
    (void)state;
    size_t length;
    char *bytes = bytes_of(&length);
    char *more = calloc(length + 1, 1);
    assert_non_null(more);
    for (size_t cut = 0; cut < length; cut++) {
        char *exact = malloc(cut + !cut); /* of exactly this size, so that a sanitizer detects a read beyond the end */
        assert_non_null(exact);
        memcpy(exact, bytes, cut);
        expect_refusal(exact, cut, "");
        free(exact);
    }
    memcpy(more, bytes, length);
    expect_refusal(more, length + 1, "1 bytes after its end");
    free(more);
    sb_free(bytes);
}

static void every_flipped_bit_is_refused(void **state)
{
    (void)state;
    size_t length;
    char *bytes = bytes_of(&length);
    for (size_t bit = 0; bit < 8 * length; bit++) {
        bytes[bit / 8] = (char)(bytes[bit / 8] ^ 1 << bit % 8);
        expect_refusal(bytes, length, "");
        bytes[bit / 8] = (char)(bytes[bit / 8] ^ 1 << bit % 8);
    }
    sb_archive_in in;
    assert_int_equal(sb_archive_parse(&in, "a", bytes, length, "TEST", 7, NULL), SB_OK);
    assert_int_equal(sb_archive_parse(&in, "a", bytes, length, "TEST", 8, NULL), SB_BAD_INPUT);
    assert_int_equal(sb_archive_parse(&in, "a", bytes, length, "TEAT", 7, NULL), SB_BAD_INPUT);
    bytes[8] = 9;
    expect_refusal(bytes, length, "version 9 of the format, expected 7");
    bytes[0] = 'B';
    expect_refusal(bytes, length, "begins with \"BEST\", expected \"TEST\"");
    sb_free(bytes);
}

/* Each function reads the first section in one wrong way. */
static void read_a_number(sb_archive_in *in)
{
    sb_take_real(in);
}
static void read_too_much(sb_archive_in *in)
{
    sb_take_count(in, UINT64_MAX);
    sb_take_flag(in);
    sb_free(sb_take_text(in));
    sb_free(sb_take_text(in));
    sb_take_flag(in);
}
static void read_a_small_count(sb_archive_in *in)
{
    sb_take_count(in, 5);
}
static void read_a_longer_list(sb_archive_in *in)
{
    double list[9] = {1};
    sb_take_count(in, UINT64_MAX);
    sb_take_flag(in);
    sb_take_list(in, list, 9, sizeof *list);
    for (int i = 0; i < 9; i++) assert_true(list[i] == 0);
}
static void read_a_bounded_list(sb_archive_in *in)
{
    sb_take_count(in, UINT64_MAX);
    sb_take_flag(in);
    assert_int_equal(sb_take_length(in, 1, 5), 0);
}
static void read_too_little(sb_archive_in *in)
{
    sb_take_count(in, UINT64_MAX);
}

static void reads_that_do_not_match_are_refused(void **state)
{
    (void)state;
    static const struct {
        void (*read)(sb_archive_in *in);
        const char *message;
    } cases[] = {{read_a_number, "a count at byte "},
                 {read_too_much, "0 bytes left, expected 1"},
                 {read_a_small_count, "expected at most 5"},
                 {read_a_longer_list, "a list of 6 elements of 1 bytes, expected 9 of 8"},
                 {read_a_bounded_list, "a list of 6 elements of 1 bytes, expected at most 5 of 1"},
                 {read_too_little, "bytes left over"}};
    size_t length;
    sb_free(bytes_of(&length));
    sb_archive_in in;
    assert_int_equal(sb_archive_open(&in, path, "TEST", 7, NULL), SB_OK);
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        sb_error error = {0};
        assert_int_equal(sb_archive_enter(&in, "first", &error), SB_OK);
        cases[c].read(&in);
        if (in.error.status != SB_OK) /* all later reads fail, too */
            assert_true(sb_take_real(&in) == 0 && !sb_take_flag(&in) && sb_take_count(&in, 3) == 0);
        assert_int_equal(sb_archive_leave(&in, &error), SB_BAD_INPUT);
        if (!strstr(error.text, cases[c].message) || !strstr(error.text, "section \"first\""))
            fail_msg("%zu: %s", c, error.text);
    }
    sb_archive_in_free(&in);
}

static double *large_list(void)
{
    double *large = sb_alloc(LARGE, sizeof *large);
    assert_non_null(large);
    for (int i = 0; i < LARGE; i++) large[i] = i;
    return large;
}

/* Sections of zero, one and several blocks, and of one byte less than a block, with lists that begin anywhere in a
   block. */
static void memory_and_file_have_equal_bytes(void **state)
{
    (void)state;
    static const size_t lengths[] = {0, SB_ARCHIVE_BLOCK - 17, SB_ARCHIVE_BLOCK - 16, 3 * SB_ARCHIVE_BLOCK, 400001};
    static sb_archive_out out[2];
    sb_archive_in in;
    sb_error error = {0};
    double *large = large_list();
    sb_archive_begin(&out[0], "TEST", 7);
    assert_int_equal(sb_archive_create(&out[1], path, "TEST", 7, &error), SB_OK);
    for (int o = 0; o < 2; o++) {
        for (size_t l = 0; l < sizeof lengths / sizeof *lengths; l++) {
            sb_archive_section(&out[o], l % 2 ? "odd" : "even");
            sb_put_list(&out[o], large, lengths[l], 1);
            if (l == 4) sb_put_list(&out[o], large, LARGE / 2, sizeof *large);
        }
        assert_int_equal(sb_archive_close(&out[o], &error), SB_OK);
    }
    size_t length;
    char *bytes;
    assert_int_equal(sb_file_read(path, 1 << 24, &bytes, &length, &error), SB_OK);
    assert_int_equal(length, out[0].used);
    assert_int_equal(length, out[1].used);
    assert_memory_equal(bytes, out[0].bytes, length);
    assert_int_equal(sb_archive_parse(&in, "it", bytes, length, "TEST", 7, &error), SB_OK);
    for (size_t at = 100; at < length; at += length / 50) { /* in every block */
        bytes[at] ^= 4;
        assert_int_equal(sb_archive_parse(&in, "it", bytes, length, "TEST", 7, &error), SB_BAD_INPUT);
        bytes[at] ^= 4;
    }
    sb_free(bytes);
    sb_free(large);
    for (int o = 0; o < 2; o++) sb_archive_out_free(&out[o]);
}

static void out_of_memory_is_an_error(void **state)
{
    (void)state;
    double *large = large_list();
    for (long n = 1; n < 100; n++) {
        sb_archive_out out = {0};
        sb_error error = {0};
        sb_memory_fail_at(n);
        sb_archive_begin(&out, "TEST", 7);
        fill(&out);
        sb_put_list(&out, large, LARGE, sizeof *large);
        sb_status status = sb_archive_close(&out, &error);
        sb_memory_fail_at(0);
        sb_archive_out_free(&out);
        if (status == SB_OK) {
            assert_true(n > 1);
            sb_free(large);
            return;
        }
        assert_int_equal(status, SB_FAILED);
        assert_non_null(strstr(error.text, "out of memory"));
    }
    fail_msg("no allocation succeeded within 100 attempts");
}

static bool is_there(const char *suffix)
{
    char name[96];
    snprintf(name, sizeof name, "%s%s", path, suffix);
    return access(name, F_OK) == 0;
}

/* An archive that is written to a file needs no allocation, whatever its size. */
static void writing_to_a_file_allocates_no_memory(void **state)
{
    (void)state;
    sb_archive_out out = {0};
    sb_error error = {0};
    double *large = large_list();
    unlink(path);
    sb_memory_fail_at(1);
    assert_int_equal(sb_archive_create(&out, path, "TEST", 7, &error), SB_OK);
    fill(&out);
    sb_put_list(&out, large, LARGE, sizeof *large);
    const sb_status status = sb_archive_close(&out, &error);
    sb_memory_fail_at(0);
    assert_int_equal(status, SB_OK);
    assert_true(is_there(""));
    sb_archive_out_free(&out);
    sb_free(large);
}

/* When the disk is full, the older archive stays and no partial file is left. A discarded archive leaves no file
   either. */
static void a_full_disk_keeps_the_older_archive(void **state)
{
    (void)state;
    struct rlimit before, small;
    size_t length, now;
    char *bytes = bytes_of(&length), *found;
    double *large = large_list();
    sb_archive_out out = {0};
    sb_error error = {0};
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    small = before;
    signal(SIGXFSZ, SIG_IGN);
    for (rlim_t most = 0; most < 200000; most += 40001) {
        small.rlim_cur = most;
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
        assert_int_equal(sb_archive_create(&out, path, "TEST", 7, &error), SB_OK);
        fill(&out);
        sb_put_list(&out, large, LARGE, sizeof *large);
        sb_archive_section(&out, "more");
        const sb_status status = sb_archive_close(&out, &error);
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
        assert_int_equal(status, SB_FAILED);
        if (!strstr(error.text, "/a: cannot write: File too large")) fail_msg("%s", error.text);
        assert_false(is_there(".tmp"));
        assert_int_equal(sb_file_read(path, 1 << 20, &found, &now, &error), SB_OK);
        assert_int_equal(now, length);
        assert_memory_equal(found, bytes, length);
        sb_free(found);
    }
    assert_int_equal(sb_archive_create(&out, path, "TEST", 7, &error), SB_OK);
    fill(&out);
    assert_true(is_there(".tmp"));
    sb_archive_out_free(&out);
    assert_true(is_there("") && !is_there(".tmp"));
    sb_free(large);
    sb_free(bytes);
}

static void an_unwritable_path_is_named(void **state)
{
    (void)state;
    sb_archive_out out = {0};
    sb_error error = {0};
    assert_int_equal(sb_archive_create(&out, "/nonexistent/a", "TEST", 7, &error), SB_FAILED);
    assert_non_null(strstr(error.text, "/nonexistent/a: cannot write: No such file"));
    /* The next archive is complete. */
    assert_int_equal(sb_archive_create(&out, path, "TEST", 7, &error), SB_OK);
    fill(&out);
    assert_int_equal(sb_archive_close(&out, &error), SB_OK);
    sb_archive_out_free(&out);
    sb_archive_in in;
    assert_int_equal(sb_archive_open(&in, path, "TEST", 7, &error), SB_OK);
    sb_archive_in_free(&in);
    assert_int_equal(sb_archive_open(&in, folder, "TEST", 7, &error), SB_BAD_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(written_values_are_read_back),
        cmocka_unit_test(truncated_or_longer_archives_are_refused),
        cmocka_unit_test(every_flipped_bit_is_refused),
        cmocka_unit_test(reads_that_do_not_match_are_refused),
        cmocka_unit_test(memory_and_file_have_equal_bytes),
        cmocka_unit_test(out_of_memory_is_an_error),
        cmocka_unit_test(writing_to_a_file_allocates_no_memory),
        cmocka_unit_test(a_full_disk_keeps_the_older_archive),
        cmocka_unit_test(an_unwritable_path_is_named),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
