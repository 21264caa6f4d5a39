/* Particles that leave are counted by side, the first with their positions; a resumed run keeps the counts. */
#include "program.h"

#include "../output/json_check.h"
#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define OPEN "--set", "bodies=[]", "--set", "domain.sides={x_max: open}"

/* The number at `key`, searched for after the text `within`. */
static double number_behind(const char *text, const char *within, const char *key)
{
    const char *at = strstr(text, within);
    assert_non_null(at);
    const char *value = json_find(at, key);
    assert_non_null(value);
    return strtod(value, NULL);
}

static int count_of(const char *text, const char *part)
{
    int count = 0;
    for (; (text = strstr(text, part)); text += strlen(part)) count++;
    return count;
}

/* From "left_by_side" to the end of "first_left". */
static void copy_departures(const char *summary, char out[4096])
{
    char *text = text_of(summary);
    const char *from = strstr(text, "\"left_by_side\""), *to = from ? strstr(from, "\"particle_files\"") : NULL;
    assert_non_null(to);
    snprintf(out, 4096, "%.*s", (int)(to - from), from);
    sb_free(text);
}

static void each_is_counted_and_the_first_are_placed(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "leaves", "--quiet", "--until", "1", OPEN);
    char *text = text_of("leaves/summary.json"), *log = text_of("leaves/run.jsonl");
    const double left = json_number_of("leaves/summary.json", "left_domain");
    assert_true(left > 8);
    assert_near(number_behind(text, "left_by_side", "x_max"), left, 0);
    assert_near(number_behind(text, "left_by_side", "z_max"), 0, 0);
    assert_int_equal(count_of(strstr(text, "\"first_left\""), "\"side\": \"x_max\""), 8);
    assert_int_equal(count_of(log, "left through the open side x_max at t = "), 8);
    /* The first particle is at most one step's distance beyond the side. */
    const char *place = json_find(strstr(text, "\"first_left\""), "position_m");
    const double x = strtod(place + strcspn(place, "-.0123456789"), NULL);
    const double speed = number_behind(text, "first_left", "speed_m_s");
    assert_true(x > 2 && x < 2 + 0.01 * speed);
    assert_true(speed > 2 && speed < 6);
    sb_free(text);
    sb_free(log);
}

static void none_is_a_row_of_zeros(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "stays", "--quiet", "--until", "0.05");
    char *text = text_of("stays/summary.json"), *log = text_of("stays/run.jsonl");
    assert_near(number_behind(text, "left_by_side", "x_max"), 0, 0);
    assert_contains(text, "\"first_left\": []");
    assert_int_equal(count_of(log, "\"event\":\"left\""), 0);
    sb_free(text);
    sb_free(log);
}

static void a_resumed_run_keeps_them(void **state)
{
    (void)state;
    char whole[4096], parts[4096];
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "gone-on", "--quiet", "--until", "0.7", OPEN);
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "gone-on", "--quiet", "--until", "1", "--resume", OPEN);
    copy_departures("leaves/summary.json", whole);
    copy_departures("gone-on/summary.json", parts);
    assert_string_equal(whole, parts);
    char *log = text_of("gone-on/run.jsonl");
    assert_int_equal(count_of(log, "\"event\":\"left\""), 8);
    sb_free(log);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_is_counted_and_the_first_are_placed),
        cmocka_unit_test(none_is_a_row_of_zeros),
        cmocka_unit_test(a_resumed_run_keeps_them),
    };
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
