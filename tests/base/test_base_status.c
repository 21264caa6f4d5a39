/* Text that a message quotes cannot send control sequences to a terminal. */
#include "../check.h"

#include "base/status.h"

#include <string.h>

static void control_characters_are_replaced(void **state)
{
    (void)state;
    static const struct {
        const char *quoted, *left;
    } rows[] = {
        {"plain", "plain"},
        {"two\nlines\x1b[31m\x7f", "two?lines?[31m?"},
        {"a\xc2\x9b"
         "31mb\xc2\x80\xc2\x9f",
         "a??31mb????"},
        {"\xc2\xa0\xc3\xa9 \xe2\x82\xac", "\xc2\xa0\xc3\xa9 \xe2\x82\xac"},
        {"\xe2\x80\xaetxt.\xe2\x81\xa6\xd8\x9c\xe2\x80\x8f", "???txt.????????"},
        {"\xe2\x80\x90 \xe2\x80\xaf \xe2\x81\xa5", "\xe2\x80\x90 \xe2\x80\xaf \xe2\x81\xa5"},
        {"truncated \xe2\x80", "truncated \xe2\x80"},
        {"truncated \xc2", "truncated \xc2"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        sb_error error = {0};
        assert_int_equal(sb_fail(&error, SB_BAD_INPUT, "%s", rows[i].quoted), SB_BAD_INPUT);
        assert_int_equal(error.status, SB_BAD_INPUT);
        assert_string_equal(error.text, rows[i].left);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(control_characters_are_replaced)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
