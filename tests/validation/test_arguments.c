/* Tests of the reader of the tools' command lines. */
#include "check.h"

#include "arguments.h"
#include "options.h"

#include <stdio.h>
#include <string.h>

enum { OPERANDS_MAX = 4 };

typedef struct settings {
    sb_common_options common;
    bool fast;
    const char *folder, *operands[OPERANDS_MAX];
    int threads, count;
    double minutes;
} settings;

static sb_status take_operand(void *user, const char *word, sb_error *error)
{
    settings *a = user;
    if (a->count == OPERANDS_MAX) return sb_fail(error, SB_BAD_INPUT, "%s: one too many", word);
    a->operands[a->count++] = word;
    return SB_OK;
}

static sb_status take_length(void *user, const char *value, sb_error *error)
{
    settings *a = user;
    a->threads = (int)strlen(value);
    return strcmp(value, "bad") == 0 ? sb_fail(error, SB_BAD_INPUT, "bad is bad") : SB_OK;
}

/* Reads a text, split at blanks, as a command line. */
static sb_status read_line(const char *text, bool operands, settings *a, sb_error *error)
{
    static char copy[200];
    char *arguments[20] = {"tool"};
    int count = 1;
    snprintf(copy, sizeof copy, "%s", text);
    for (char *word = strtok(copy, " "); word; word = strtok(NULL, " ")) arguments[count++] = word;
    *a = (settings){.count = 0};
    const sb_argument options[] = {{.name = "--fast", .flag = &a->fast, .repeated = true},
                                   {.name = "--threads", .count = &a->threads, .most = 8, .repeated = true},
                                   {.name = "--minutes", .number = &a->minutes, .most = 60},
                                   {.name = "--length", .take = take_length, .repeated = true},
                                   {.name = "--folder", .text = &a->folder}};
    const sb_command_line line = {.tool = "x",
                                  .help = "",
                                  .has = SB_HAS_QUICK | SB_HAS_OUT | SB_HAS_JOBS,
                                  .options = options,
                                  .option_count = 5,
                                  .operand = operands ? take_operand : NULL,
                                  .user = a};
    return sb_command_line_read(&line, count, arguments, &a->common, error);
}

static void test_options_and_operands_are_read(void **state)
{
    (void)state;
    settings a;
    assert_int_equal(read_line("one --fast --threads 8 --minutes 0.5 --folder f --jobs 2 --out o two*", true, &a, NULL),
                     SB_OK);
    assert_true(a.fast && !a.common.answered && a.threads == 8 && a.minutes == 0.5 && a.count == 2);
    assert_true(a.common.jobs == 2 && !a.common.quick);
    assert_string_equal(a.folder, "f");
    assert_string_equal(a.common.out, "o");
    assert_string_equal(a.operands[1], "two*");
    assert_string_equal(a.common.command, "tools/x one --fast --threads 8 --jobs 2 'two*'");
    assert_int_equal(read_line("--length four", false, &a, NULL), SB_OK);
    assert_int_equal(a.threads, 4);
}

static void test_help_ends_reading(void **state)
{
    (void)state;
    settings a;
    assert_int_equal(read_line("--quick --help --nonsense", true, &a, NULL), SB_OK);
    assert_true(a.common.quick && a.common.answered);
}

static void test_bad_command_lines_are_refused(void **state)
{
    (void)state;
    static const char *const wrong[][2] = {{"--slow", "--slow: no such option"},
                                           {"--report r", "--report: no such option"},
                                           {"--threads", "--threads: expected a value"},
                                           {"--threads 0", "--threads: 0 is not a number from 1 to 8"},
                                           {"--threads 9", "--threads: 9 is not a number"},
                                           {"--jobs 2x", "--jobs: 2x is not a number"},
                                           {"--minutes 0", "--minutes: 0 is not a number above 0 and at most 60"},
                                           {"--minutes 61", "61 is not a number"},
                                           {"--minutes nan", "nan is not a number"},
                                           {"--length bad", "bad is bad"},
                                           {"--out", "--out: expected a value"},
                                           {"--folder", "--folder: expected a value"},
                                           {"a b c d e", "e: one too many"}};
    for (size_t w = 0; w < sizeof wrong / sizeof *wrong; w++) {
        settings a;
        sb_error error = {0};
        assert_int_equal(read_line(wrong[w][0], true, &a, &error), SB_BAD_INPUT);
        if (!strstr(error.text, wrong[w][1])) fail_msg("%s: %s", wrong[w][0], error.text);
    }
    settings a;
    sb_error error = {0};
    assert_int_equal(read_line("word", false, &a, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "word: no such option"));
}

static void test_validation_accepts_one_spacing(void **state)
{
    (void)state;
    char *arguments[] = {(char *)"validate", (char *)"column", (char *)"--spacing", (char *)"0.005", NULL};
    sb_validate_options o;
    assert_int_equal(sb_validate_parse(4, arguments, &o, NULL), SB_OK);
    assert_true(o.spacing == 0.005 && o.spacings == 0 && o.cases.count == 1);
    assert_non_null(strstr(o.common.command, "column --spacing 0.005"));
}

static const char *row_name(size_t row)
{
    static const char *const names[] = {"a", "b", "c", NULL};
    return names[row];
}

static void test_rows_are_selected_once(void **state)
{
    (void)state;
    sb_selection rows = {.what = "case", .name = row_name};
    sb_common_options common;
    const sb_command_line line = {.tool = "x", .help = "", .selection = &rows};
    char *two[] = {(char *)"x", (char *)"c", (char *)"a", (char *)"c", NULL},
         *none[] = {(char *)"x", (char *)"d", NULL};
    sb_error error = {0};
    assert_int_equal(sb_command_line_read(&line, 4, two, &common, NULL), SB_OK);
    assert_true(rows.count == 2 && sb_selection_has(&rows, 2) && sb_selection_has(&rows, 0) && rows.rows[0] == 2);
    assert_int_equal(sb_command_line_read(&line, 2, none, &common, &error), SB_BAD_INPUT);
    assert_string_equal(error.text, "d: no such case; --list shows the cases");
    sb_selection_all(&rows);
    assert_int_equal(rows.count, 3);
    rows.count = 0;
    assert_int_equal(sb_selection_check(&rows, &error), SB_BAD_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_options_and_operands_are_read),  cmocka_unit_test(test_help_ends_reading),
        cmocka_unit_test(test_bad_command_lines_are_refused),  cmocka_unit_test(test_rows_are_selected_once),
        cmocka_unit_test(test_validation_accepts_one_spacing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
