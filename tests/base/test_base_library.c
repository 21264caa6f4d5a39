/* Libraries loaded on demand: a loaded function works; a missing library or function is named in the error. */
#include "../check.h"
#include "base/library.h"

#include <string.h>

static void a_function_of_a_library_works(void **state)
{
    (void)state;
    double (*cosine)(double) = NULL;
    const sb_library_function functions[] = {{"cos", &cosine}};
    sb_error error = {0};
    assert_int_equal(sb_library_load("libm.so.6", functions, 1, &error), SB_OK);
    assert_non_null(cosine);
    assert_true(cosine(0) == 1);
}

static void a_missing_library_or_function_is_named(void **state)
{
    (void)state;
    double (*function)(double) = NULL;
    const sb_library_function functions[] = {{"no_such_function", &function}};
    sb_error error = {0};
    assert_int_equal(sb_library_load("libm.so.6", functions, 1, &error), SB_FAILED);
    assert_non_null(strstr(error.text, "libm.so.6"));
    assert_non_null(strstr(error.text, "no_such_function"));
    assert_null(function);
    error = (sb_error){0};
    assert_int_equal(sb_library_load("libnowhere.so.7", functions, 1, &error), SB_FAILED);
    assert_non_null(strstr(error.text, "libnowhere.so.7"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_function_of_a_library_works),
        cmocka_unit_test(a_missing_library_or_function_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
