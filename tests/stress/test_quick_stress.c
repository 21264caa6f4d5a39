/* Quick forms of stress cases, by the programs themselves. */
#include "check.h"

#include "base/file.h"
#include "base/memory.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static char folder[512], *spoken;

static int set_up(void **state)
{
    (void)state;
    const char *base = getenv("TMPDIR");
    snprintf(folder, sizeof folder, "%.400s/shorebreak-stress-XXXXXX", base && *base ? base : "/tmp");
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_one(const char *path, const struct stat *info, int kind, struct FTW *where)
{
    (void)info;
    (void)kind;
    (void)where;
    return remove(path);
}

static int tear_down(void **state)
{
    (void)state;
    sb_free(spoken);
    return nftw(folder, remove_one, 16, FTW_DEPTH | FTW_PHYS);
}

/* Exit status of the battery with these arguments; what it said is in `spoken`. */
static int stress(const char *arguments)
{
    char command[2048], said[600];
    size_t length;
    snprintf(said, sizeof said, "%s/said.txt", folder);
    snprintf(command, sizeof command, "'%s/shorebreak-stress' --jobs 1 --out '%s' %s >'%s' 2>&1", SB_BINARY_DIR,
             folder, arguments, said);
    int how = system(command);
    sb_free(spoken);
    assert_int_equal(sb_file_read(said, 1 << 20, &spoken, &length, NULL), SB_OK);
    return WIFEXITED(how) ? WEXITSTATUS(how) : -1;
}

static void must_pass(const char *names)
{
    char arguments[256];
    snprintf(arguments, sizeof arguments, "--quick %s", names);
    int status = stress(arguments);
    if (status != 0) fail_msg("exit status %d:\n%s", status, spoken);
}

static void test_still_water_rests(void **state)
{
    (void)state;
    must_pass("still-water flume");
}

static void test_thin_plates_hold(void **state)
{
    (void)state;
    must_pass("plates");
}

static void test_impacts_make_no_energy(void **state)
{
    (void)state;
    must_pass("drop jet");
}

static void test_each_solver_keeps_its_word(void **state)
{
    (void)state;
    must_pass("time-step tolerance");
}

static void test_walls_paddles_and_open_sides_hold(void **state)
{
    (void)state;
    must_pass("sampling paddles immersed leaving");
}

/* Numerics at the ends of their ranges may spoil a run, but not the program. */
static void test_no_key_crashes_or_hangs(void **state)
{
    (void)state;
    int status = stress("--quick keys");
    if ((status != 0 && status != 4) || strstr(spoken, ": signal ") || strstr(spoken, ": hung"))
        fail_msg("exit status %d:\n%s", status, spoken);
}

static void test_what_was_run_is_kept(void **state)
{
    (void)state;
    char path[SB_PATH_MAX], *text;
    size_t length;
    must_pass("jet");
    assert_null(strstr(spoken, "exit status"));
    snprintf(path, sizeof path, "%s/quick/stability.md", folder);
    assert_int_equal(sb_file_read(path, 1 << 20, &text, &length, NULL), SB_OK);
    assert_non_null(strstr(text, "slice-into-corner"));
    assert_non_null(strstr(text, "not run")); /* other cases */
    sb_free(text);
}

static void test_bad_command_lines(void **state)
{
    (void)state;
    assert_int_equal(stress("stil-water"), 1);
    assert_non_null(strstr(spoken, "stress: stil-water: no such case; --list names them"));
    assert_int_equal(stress("--quik"), 1);
    assert_non_null(strstr(spoken, "--quik: no such option"));
    assert_int_equal(stress(""), 1);
    assert_non_null(strstr(spoken, "no case named"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_still_water_rests),
        cmocka_unit_test(test_thin_plates_hold),
        cmocka_unit_test(test_impacts_make_no_energy),
        cmocka_unit_test(test_each_solver_keeps_its_word),
        cmocka_unit_test(test_walls_paddles_and_open_sides_hold),
        cmocka_unit_test(test_no_key_crashes_or_hangs),
        cmocka_unit_test(test_what_was_run_is_kept),
        cmocka_unit_test(test_bad_command_lines),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
