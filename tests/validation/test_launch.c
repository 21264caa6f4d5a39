/* Tests of the launcher: a stopped run is resumed, and its processor time is added. */
#include "check.h"

#include "cases.h"
#include "runs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[] = "/tmp/test-launch-XXXXXX";

/* Replaces shorebreak: records its arguments, ends as if stopped the first time, and succeeds the second time. */
static const char program[] = "#!/bin/sh\n"
                              "echo \"$@\" >> arguments\n"
                              "[ -f once ] && exit 0\n"
                              "touch once\n"
                              "exit 143\n";

static int set_up(void **state)
{
    (void)state;
    if (!mkdtemp(folder) || chdir(folder) != 0) return -1;
    FILE *out = fopen("program", "w");
    return !out || fputs(program, out) < 0 || fclose(out) != 0 || chmod("program", 0755) != 0 ? -1 : 0;
}

static int tear_down(void **state)
{
    (void)state;
    char command[64];
    snprintf(command, sizeof command, "rm -r %s", folder);
    return chdir("/") == 0 ? system(command) : -1;
}

static void test_stopped_run_is_resumed(void **state)
{
    (void)state;
    sb_store store;
    sb_error error = {0};
    const sb_common_options options = {.program = "program", .jobs = 1};
    char place[SB_PATH_MAX];
    assert_int_equal(sb_store_open(&store, &options, "out", "assets/validation", false, &error), SB_OK);
    const sb_request request = {.of = sb_cases[0], .plan = sb_cases[0]->quick, .quick = true, .seed = 1};
    assert_int_equal(sb_runs_launch(&store, &request, 1, &error), SB_INTERRUPTED);
    assert_false(sb_run_find(&store, &request, false, place));
    assert_int_equal(sb_run_folder(&store, &request, place, &error), SB_OK);
    assert_int_equal(sb_run_spend(place, 20, &error), SB_OK);
    assert_int_equal(sb_runs_launch(&store, &request, 1, &error), SB_OK);
    assert_int_equal(store.failed, 0);
    assert_true(sb_run_find(&store, &request, false, place));
    const double spent = sb_record_number(place, "cpu_s");
    assert_true(spent >= 20 && spent < 21);
    /* A third launch runs nothing. */
    assert_int_equal(sb_runs_launch(&store, &request, 1, &error), SB_OK);

    char line[2][2048];
    FILE *arguments = fopen("arguments", "r");
    assert_non_null(arguments);
    for (int i = 0; i < 2; i++) {
        assert_non_null(fgets(line[i], sizeof line[i], arguments));
        assert_non_null(strstr(line[i], " --resume "));
    }
    assert_string_equal(line[0], line[1]);
    assert_null(fgets(line[0], sizeof line[0], arguments));
    assert_int_equal(fclose(arguments), 0);
}

static void test_folder_of_report_is_relative_to_the_present_one(void **state)
{
    (void)state;
    sb_common_options options = {.report = "some/folder"};
    sb_store store = {.options = &options};
    assert_int_equal(sb_store_report(&store, NULL, NULL), SB_OK);
    assert_string_equal(store.report, "./some/folder");
    options.report = "/some/folder";
    assert_int_equal(sb_store_report(&store, NULL, NULL), SB_OK);
    assert_string_equal(store.report, "/some/folder");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_stopped_run_is_resumed),
                                       cmocka_unit_test(test_folder_of_report_is_relative_to_the_present_one)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
