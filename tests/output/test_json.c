#include "output/log/json.h"

#include "folder.h"
#include "json_check.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static void the_checker_refuses_invalid_json(void **state)
{
    (void)state;
    const char *const good[] = {"{}", "[1, -2.5e3, null]", "{\"a\": \"\\u00e4\\n\"}"};
    const char *const bad[] = {"{", "[1,]", "{\"a\" 1}", "nan", "01", "\"\\x\"", "{} x", "\"\n\""};
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) assert_true(json_valid(good[i]));
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) assert_false(json_valid(bad[i]));
}

static void writes(FILE *stream, bool pretty)
{
    sb_json json;
    sb_json_begin(&json, stream, pretty);
    sb_json_open(&json, NULL, '{');
    sb_json_text(&json, "name", "a \"b\" \\ \n \x01 \x7f caf\xc3\xa9 \xff \xe2\x82");
    sb_json_number(&json, "third", 1.0 / 3);
    sb_json_number(&json, "nan", (double)NAN);
    sb_json_number(&json, "inf", -HUGE_VAL);
    sb_json_count(&json, "many", UINT64_MAX);
    sb_json_bool(&json, "yes", true);
    sb_json_text(&json, "none", NULL);
    sb_json_open(&json, "empty", '[');
    sb_json_close(&json);
    sb_json_open(&json, "list", '[');
    for (int i = 0; i < 3; i++) {
        sb_json_open(&json, NULL, '{');
        sb_json_vector(&json, "v", sb_vec(i, (double)NAN, 2));
        sb_json_close(&json);
    }
    sb_json_close(&json);
    sb_json_hash(&json, "hash", 0xabc);
    sb_json_close(&json);
}

static void the_output_is_valid_json(void **state)
{
    (void)state;
    for (int pretty = 0; pretty < 2; pretty++) {
        FILE *stream = fopen(in_folder("a.json"), "w");
        writes(stream, pretty);
        fclose(stream);
        char *text = text_of("a.json");
        assert_true(json_valid(text));
        assert_true(strncmp(json_find(text, "name"),
                            "\"a \\\"b\\\" \\\\ \\n \\u0001 \\u007f caf\xc3\xa9 \\ufffd "
                            "\\ufffd\\ufffd\"",
                            50) == 0);
        assert_true(strtod(json_find(text, "third"), NULL) == 0.333333333);
        assert_true(strncmp(json_find(text, "nan"), "null", 4) == 0);
        assert_true(strncmp(json_find(text, "inf"), "null", 4) == 0);
        assert_true(strncmp(json_find(text, "many"), "18446744073709551615", 20) == 0);
        assert_true(strncmp(json_find(text, "hash"), "\"0000000000000abc\"", 18) == 0);
        /* A line of a log is one line. */
        assert_true(pretty || strchr(text, '\n') == text + strlen(text) - 1);
        sb_free(text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_checker_refuses_invalid_json),
        cmocka_unit_test(the_output_is_valid_json),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
