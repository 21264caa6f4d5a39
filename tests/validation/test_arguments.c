/* The reader of the tools' command lines. */
#include "check.h"

#include "arguments.h"
#include "options.h"

#include <stdio.h>
#include <string.h>

enum { WORDS_MAX = 4 };

typedef struct asked {
    bool quick, help;
    const char *out, *words[WORDS_MAX];
    int jobs, count;
    double minutes;
    char command[80];
} asked;

static sb_status take_word(void *user, const char *word, sb_error *error)
{
    asked *a = user;
    if (a->count == WORDS_MAX) return sb_fail(error, SB_BAD_INPUT, "%s: one too many", word);
    a->words[a->count++] = word;
    return SB_OK;
}

static sb_status take_length(void *user, const char *value, sb_error *error)
{
    asked *a = user;
    a->jobs = (int)strlen(value);
    return strcmp(value, "bad") == 0 ? sb_fail(error, SB_BAD_INPUT, "bad is bad") : SB_OK;
}

/* The words of a text, split at blanks, as a command line. */
static sb_status read_line(const char *text, bool words, asked *a, sb_error *error)
{
    static char copy[200];
    char *arguments[20] = {"tool"};
    int count = 1;
    snprintf(copy, sizeof copy, "%s", text);
    for (char *word = strtok(copy, " "); word; word = strtok(NULL, " ")) arguments[count++] = word;
    *a = (asked){.command = "tools/x"};
    const sb_argument options[] = {{.name = "--quick", .flag = &a->quick, .telling = true},
                                   {.name = "--jobs", .count = &a->jobs, .most = 8, .telling = true},
                                   {.name = "--minutes", .number = &a->minutes, .most = 60},
                                   {.name = "--length", .take = take_length, .telling = true},
                                   {.name = "--out", .text = &a->out}};
    const sb_command_line line = {.options = options,
                                  .option_count = 5,
                                  .word = words ? take_word : NULL,
                                  .user = a,
                                  .help = &a->help,
                                  .command = a->command,
                                  .command_size = sizeof a->command};
    return sb_command_line_read(&line, count, arguments, error);
}

static void what_is_said_is_taken(void **state)
{
    (void)state;
    asked a;
    assert_int_equal(read_line("one --quick --jobs 8 --minutes 0.5 --out folder two*", true, &a, NULL), SB_OK);
    assert_true(a.quick && !a.help && a.jobs == 8 && a.minutes == 0.5 && a.count == 2);
    assert_string_equal(a.out, "folder");
    assert_string_equal(a.words[1], "two*");
    assert_string_equal(a.command, "tools/x one --quick --jobs 8 'two*'");
    assert_int_equal(read_line("--length four", false, &a, NULL), SB_OK);
    assert_int_equal(a.jobs, 4);
}

static void help_ends_the_reading(void **state)
{
    (void)state;
    asked a;
    assert_int_equal(read_line("--quick --help --nonsense", true, &a, NULL), SB_OK);
    assert_true(a.quick && a.help);
}

static void what_is_wrong_is_said(void **state)
{
    (void)state;
    static const char *const wrong[][2] = {{"--fast", "--fast: no such option"},
                                           {"--jobs", "--jobs: a value is missing"},
                                           {"--jobs 0", "--jobs: 0 is no number from 1 to 8"},
                                           {"--jobs 9", "--jobs: 9 is no number"},
                                           {"--jobs 2x", "--jobs: 2x is no number"},
                                           {"--minutes 0", "--minutes: 0 is no number above 0, at most 60"},
                                           {"--minutes 61", "61 is no number"},
                                           {"--minutes nan", "nan is no number"},
                                           {"--length bad", "bad is bad"},
                                           {"--out", "--out: a value is missing"},
                                           {"a b c d e", "e: one too many"}};
    for (size_t w = 0; w < sizeof wrong / sizeof *wrong; w++) {
        asked a;
        sb_error error = {0};
        assert_int_equal(read_line(wrong[w][0], true, &a, &error), SB_BAD_INPUT);
        if (!strstr(error.text, wrong[w][1])) fail_msg("%s: %s", wrong[w][0], error.text);
    }
    asked a;
    sb_error error = {0};
    assert_int_equal(read_line("word", false, &a, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "word: no such option"));
}

static void the_validation_takes_one_spacing(void **state)
{
    (void)state;
    char *arguments[] = {(char *)"validate", (char *)"column", (char *)"--spacing", (char *)"0.005", NULL};
    sb_validate_options o;
    assert_int_equal(sb_validate_parse(4, arguments, &o, NULL), SB_OK);
    assert_true(o.spacing == 0.005 && o.spacings == 0 && o.count == 1);
    assert_non_null(strstr(o.command, "column --spacing 0.005"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_said_is_taken),
        cmocka_unit_test(help_ends_the_reading),
        cmocka_unit_test(what_is_wrong_is_said),
        cmocka_unit_test(the_validation_takes_one_spacing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
