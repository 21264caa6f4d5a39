/* Files are complete or absent; paths are joined; directories are made with their parents. */
#include "../check.h"
#include "base/file.h"
#include "base/input.h"
#include "base/memory.h"

#include <errno.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

static char folder[] = "/tmp/shorebreak-files-XXXXXX";

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    return rmdir(folder); /* fails if a test has left a file behind */
}

static const char *at(const char *name)
{
    static char path[SB_PATH_MAX];
    assert_int_equal(sb_path_join(path, folder, name, NULL), SB_OK);
    return path;
}

static bool exists(const char *name)
{
    return access(at(name), F_OK) == 0;
}

static void write_whole(const char *name, const char *text, int durable)
{
    sb_atomic_file file = {0};
    sb_error error = {0};
    assert_int_equal(sb_atomic_open(&file, at(name), &error), SB_OK);
    assert_true(fputs(text, file.stream) >= 0);
    assert_int_equal(sb_atomic_commit(&file, durable, &error), SB_OK);
    assert_null(file.stream);
}

static void check_text(const char *name, const char *expected)
{
    char *text;
    size_t length;
    assert_int_equal(sb_file_read(at(name), 1000, &text, &length, NULL), SB_OK);
    assert_int_equal(length, strlen(expected));
    assert_string_equal(text, expected);
    sb_free(text);
}

static void commit_renames_the_complete_file(void **state)
{
    (void)state;
    for (int durable = 0; durable <= 1; durable++) {
        sb_atomic_file file = {0};
        assert_int_equal(sb_atomic_open(&file, at("a"), NULL), SB_OK);
        fputs("whole", file.stream);
        fflush(file.stream);
        assert_false(exists("a"));
        assert_true(exists("a.tmp"));
        assert_int_equal(sb_atomic_commit(&file, durable, NULL), SB_OK);
        assert_false(exists("a.tmp"));
        check_text("a", "whole");
        assert_int_equal(unlink(at("a")), 0);
    }
}

static void abort_keeps_the_old_file(void **state)
{
    (void)state;
    write_whole("b", "old", 0);
    sb_atomic_file file = {0};
    assert_int_equal(sb_atomic_open(&file, at("b"), NULL), SB_OK);
    fputs("half", file.stream);
    sb_atomic_abort(&file);
    assert_null(file.stream);
    sb_atomic_abort(&file);
    assert_false(exists("b.tmp"));
    check_text("b", "old");
    write_whole("b", "new", 0);
    check_text("b", "new");
    assert_int_equal(unlink(at("b")), 0);
}

static void failures_leave_no_file_and_name_the_reason(void **state)
{
    (void)state;
    sb_atomic_file file = {0};
    sb_error error = {0};
    assert_int_equal(sb_atomic_open(&file, at("none/a"), &error), SB_FAILED);
    assert_null(file.stream);
    assert_non_null(strstr(error.text, "none/a"));
    assert_non_null(strstr(error.text, "No such file"));

    /* The final name is a directory that is not empty: the rename must fail. */
    assert_int_equal(sb_atomic_open(&file, at("taken"), &error), SB_OK);
    assert_int_equal(sb_make_directories(at("taken/inner"), NULL), SB_OK);
    fputs("x", file.stream);
    assert_int_equal(sb_atomic_commit(&file, 0, &error), SB_FAILED);
    assert_int_equal(error.status, SB_FAILED);
    assert_false(exists("taken.tmp"));
    assert_int_equal(rmdir(at("taken/inner")), 0);
    assert_int_equal(rmdir(at("taken")), 0);

    char long_path[SB_PATH_MAX + 1];
    memset(long_path, 'x', SB_PATH_MAX);
    long_path[SB_PATH_MAX] = '\0';
    assert_int_equal(sb_atomic_open(&file, long_path, &error), SB_BAD_INPUT);
}

static void numbered_files_above_a_number_are_removed(void **state)
{
    (void)state;
    static const char *const names[] = {"000001.a",     "000002.a", "000003.a", "000000004.a", "000002.a.tmp",
                                        "000004.a.tmp", "000003.b", "x3.a",     "000003.ab",   "3.a"};
    static const bool stays[] = {true, true, false, false, false, false, true, true, true, true};
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) write_whole(names[n], "", 0);
    assert_int_equal(sb_remove_numbered(folder, ".a", 2, NULL), SB_OK);
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        if (exists(names[n]) != stays[n]) fail_msg("%s should %s", names[n], stays[n] ? "stay" : "be removed");
        unlink(at(names[n]));
    }
    assert_int_equal(sb_remove_numbered(at("none"), ".a", 0, NULL), SB_OK);
}

/* A full disk is detected only when the buffer is flushed. */
static void full_disk_is_an_error(void **state)
{
    (void)state;
    if (access("/dev/full", W_OK) != 0) skip();
    sb_atomic_file file = {0};
    sb_error error = {0};
    assert_int_equal(sb_atomic_open(&file, at("c"), NULL), SB_OK);
    assert_int_equal(fclose(file.stream), 0);
    file.stream = fopen("/dev/full", "wb");
    assert_non_null(file.stream);
    fputs("lost", file.stream);
    assert_int_equal(sb_atomic_commit(&file, 0, &error), SB_FAILED);
    assert_non_null(strstr(error.text, "No space left"));
    assert_false(exists("c"));
    assert_false(exists("c.tmp"));
}

static void directories_are_made_with_their_parents(void **state)
{
    (void)state;
    assert_int_equal(sb_make_directories(at("p/q/r"), NULL), SB_OK);
    assert_int_equal(sb_make_directories(at("p/q/r"), NULL), SB_OK);
    assert_true(exists("p/q/r"));
    write_whole("p/file", "x", 0);
    sb_error error = {0};
    assert_int_equal(sb_make_directories(at("p/file"), &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "p/file: is not a directory, expected one"));
    assert_int_equal(sb_make_directories(at("p/file/below"), NULL), SB_BAD_INPUT);
    assert_int_equal(sb_make_directories("", NULL), SB_BAD_INPUT);
    assert_int_equal(unlink(at("p/file")), 0);
    assert_int_equal(rmdir(at("p/q/r")), 0);
    assert_int_equal(rmdir(at("p/q")), 0);
    assert_int_equal(rmdir(at("p")), 0);
}

/* Other kinds of files are not written to or removed, and opening them does not block. */
static void only_regular_files_with_one_name_are_opened(void **state)
{
    (void)state;
    static const char *const kinds[] = {"a symbolic link", "a directory", "a FIFO", "a device", "2 names (hard links)"};
    static const char *const modes[] = {"w", "a", "r+"};
    struct stat before, after;
    char path[SB_PATH_MAX], target[SB_PATH_MAX];
    snprintf(path, sizeof path, "%s", at("place"));
    snprintf(target, sizeof target, "%s", at("target"));
    write_whole("target", "kept", 0);
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        if (k == 0) assert_int_equal(symlink("target", path), 0);
        if (k == 1) assert_int_equal(mkdir(path, 0700), 0);
        if (k == 2) assert_int_equal(mkfifo(path, 0600), 0);
        if (k == 3 && mknod(path, S_IFCHR | 0600, makedev(1, 3)) != 0) continue; /* only root may create a device */
        if (k == 4) assert_int_equal(link(target, path), 0);
        assert_int_equal(lstat(path, &before), 0);
        for (size_t m = 0; m < sizeof modes / sizeof *modes; m++) {
            FILE *stream;
            sb_error error = {0};
            assert_int_equal(sb_file_open(path, modes[m], &stream, &error), SB_FAILED);
            assert_null(stream);
            assert_non_null(strstr(error.text, "place: "));
            assert_non_null(strstr(error.text, kinds[k]));
        }
        sb_atomic_file file;
        sb_error error = {0};
        const sb_status status = sb_atomic_open(&file, path, &error);
        assert_int_equal(status, k == 4 ? SB_OK : SB_FAILED); /* a rename replaces only one of the names */
        if (status == SB_OK)
            sb_atomic_abort(&file);
        else
            assert_non_null(strstr(error.text, kinds[k]));
        assert_int_equal(lstat(path, &after), 0);
        assert_true(before.st_ino == after.st_ino && before.st_mode == after.st_mode);
        assert_int_equal(remove(path), 0);
    }
    check_text("target", "kept");
    assert_int_equal(unlink(at("target")), 0);
}

static void paths_are_joined_and_split(void **state)
{
    (void)state;
    char out[SB_PATH_MAX], name[SB_PATH_MAX + 1];
    assert_int_equal(sb_path_join(out, "a/b", "c.obj", NULL), SB_OK);
    assert_string_equal(out, "a/b/c.obj");
    assert_int_equal(sb_path_join(out, "a/b", "/c.obj", NULL), SB_OK);
    assert_string_equal(out, "/c.obj");
    memset(name, 'n', SB_PATH_MAX);
    name[SB_PATH_MAX] = '\0';
    assert_int_equal(sb_path_join(out, "a", name, NULL), SB_BAD_INPUT);
    name[SB_PATH_MAX - 3] = '\0'; /* "a/", 4093 characters and the zero fill the buffer exactly */
    assert_int_equal(sb_path_join(out, "a", name, NULL), SB_OK);
    sb_path_folder(out, "a/b/c.obj");
    assert_string_equal(out, "a/b");
    sb_path_folder(out, "c.obj");
    assert_string_equal(out, ".");
    sb_path_folder(out, "/c.obj");
    assert_string_equal(out, "/");
}

static void reading_is_limited_in_size(void **state)
{
    (void)state;
    char *text;
    size_t length;
    sb_error error = {0};
    write_whole("d", "0123456789", 0);
    assert_int_equal(sb_file_read(at("d"), 10, &text, &length, NULL), SB_OK);
    assert_int_equal(length, 10);
    sb_free(text);
    assert_int_equal(sb_file_read(at("d"), 9, &text, &length, &error), SB_BAD_INPUT);
    assert_null(text);
    assert_non_null(strstr(error.text, "9 bytes"));
    assert_int_equal(sb_file_read(at("nothing"), 9, &text, &length, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "nothing"));
    assert_int_equal(sb_file_read(folder, 9, &text, &length, &error), SB_BAD_INPUT);
    sb_memory_fail_at(1);
    assert_int_equal(sb_file_read(at("d"), 10, &text, &length, &error), SB_FAILED);
    assert_null(text);
    assert_int_equal(unlink(at("d")), 0);
}

static void text_is_read_without_a_byte_order_mark(void **state)
{
    (void)state;
    static const char *const pairs[][2] = {{"\xef\xbb\xbftext", "text"},
                                           {"\xef\xbb\xbf", ""},
                                           {"", ""},
                                           {"\xef\xbbtext", "\xef\xbbtext"},
                                           {"te\xef\xbb\xbf", "te\xef\xbb\xbf"}};
    for (size_t k = 0; k < sizeof pairs / sizeof *pairs; k++) {
        char *text;
        size_t length;
        write_whole("m", pairs[k][0], 0);
        assert_int_equal(sb_text_read(at("m"), 100, &text, &length, NULL), SB_OK);
        assert_string_equal(text, pairs[k][1]);
        assert_int_equal(length, strlen(pairs[k][1]));
        sb_free(text);
    }
    assert_int_equal(unlink(at("m")), 0);
}

static void long_files_are_read_completely(void **state)
{
    (void)state;
    enum { LENGTH = 200000 };
    sb_atomic_file file = {0};
    assert_int_equal(sb_atomic_open(&file, at("e"), NULL), SB_OK);
    for (int i = 0; i < LENGTH; i++) putc('a' + i % 26, file.stream);
    assert_int_equal(sb_atomic_commit(&file, 0, NULL), SB_OK);
    char *text;
    size_t length;
    assert_int_equal(sb_file_read(at("e"), LENGTH, &text, &length, NULL), SB_OK);
    assert_int_equal(length, LENGTH);
    assert_int_equal(text[LENGTH], '\0');
    for (int i = 0; i < LENGTH; i++) assert_true(text[i] == 'a' + i % 26);
    sb_free(text);
    assert_int_equal(unlink(at("e")), 0);
}

static void expect_no_input(const char *path, const char *reason)
{
    char *text;
    size_t length;
    FILE *stream;
    sb_error error = {0};
    errno = ENOENT;
    assert_int_equal(sb_input_open(path, &stream, &error), SB_BAD_INPUT);
    assert_null(stream);
    assert_int_equal(errno, 0);
    if (!strstr(error.text, path) || !strstr(error.text, reason))
        fail_msg("\"%s\" does not contain \"%s\"", error.text, reason);
    assert_int_equal(sb_file_read(path, 1000, &text, &length, &error), SB_BAD_INPUT);
    assert_null(text);
}

/* A plain open would wait for the writer of a FIFO, and a device has no end. */
static void inputs_are_regular_files(void **state)
{
    (void)state;
    char target[SB_PATH_MAX];
    expect_no_input(folder, "is a directory, expected a regular file");
    expect_no_input("/dev/zero", "is a device, expected a regular file");
    assert_int_equal(mkfifo(at("pipe"), 0600), 0);
    expect_no_input(at("pipe"), "is a FIFO, expected a regular file");
    assert_int_equal(symlink("pipe", at("link")), 0);
    expect_no_input(at("link"), "is a FIFO, expected a regular file");
    assert_int_equal(unlink(at("link")), 0);
    assert_int_equal(unlink(at("pipe")), 0);
    /* Links to regular files are accepted. */
    write_whole("file", "text", 0);
    assert_int_equal(symlink("file", at("soft")), 0);
    snprintf(target, sizeof target, "%s", at("file"));
    assert_int_equal(link(target, at("hard")), 0);
    check_text("soft", "text");
    check_text("hard", "text");
    assert_int_equal(unlink(at("soft")), 0);
    assert_int_equal(unlink(at("hard")), 0);
    /* A sparse file is refused by its size before it is read. */
    char *text;
    size_t length;
    sb_error error = {0};
    assert_int_equal(truncate(at("file"), (off_t)1 << 40), 0);
    assert_int_equal(sb_file_read(at("file"), 1000, &text, &length, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "larger than the 1000 bytes allowed"));
    assert_int_equal(sb_file_read(at("file"), SIZE_MAX, &text, &length, &error), SB_FAILED);
    assert_non_null(strstr(error.text, "1.1e+03 GB, expected no more than"));
    assert_int_equal(unlink(at("file")), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(commit_renames_the_complete_file),
        cmocka_unit_test(abort_keeps_the_old_file),
        cmocka_unit_test(failures_leave_no_file_and_name_the_reason),
        cmocka_unit_test(numbered_files_above_a_number_are_removed),
        cmocka_unit_test(full_disk_is_an_error),
        cmocka_unit_test(directories_are_made_with_their_parents),
        cmocka_unit_test(only_regular_files_with_one_name_are_opened),
        cmocka_unit_test(paths_are_joined_and_split),
        cmocka_unit_test(reading_is_limited_in_size),
        cmocka_unit_test(text_is_read_without_a_byte_order_mark),
        cmocka_unit_test(long_files_are_read_completely),
        cmocka_unit_test(inputs_are_regular_files),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
