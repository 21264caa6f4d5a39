/* The rows that the web server keeps for its clients. */
#include "check.h"

#include "web/history.h"

#include <stdlib.h>
#include <string.h>

typedef char name[SB_STREAM_NAME];
static const name two[2] = {"quay", "house"};

static sb_history_table table_of(int components)
{
    return (sb_history_table){.components = components, .stride = 1};
}

static void add(sb_history_table *table, double time, float first, float second)
{
    const float values[] = {first, second};
    sb_history_add(table, &(sb_history_rows){time, 2, 0, 2, two, values});
}

static char *text_of(const sb_history_table *table, uint64_t generation, size_t from, size_t limit)
{
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    sb_history_write(table, generation, from, limit, stream);
    fclose(stream);
    return text;
}

static void rows_in_parts(void **state)
{
    (void)state;
    sb_history_table table = table_of(1);
    const float quay = 1.5F, house = NAN;
    sb_history_add(&table, &(sb_history_rows){0.5, 2, 0, 1, &two[0], &quay});
    assert_int_equal(sb_history_count(&table), 0); /* its second half is missing */
    sb_history_add(&table, &(sb_history_rows){0.5, 2, 1, 1, &two[1], &house});
    assert_int_equal(sb_history_count(&table), 1);
    char *text = text_of(&table, 0, 0, 1000);
    assert_non_null(strstr(text, "\"names\":[\"quay\",\"house\"],\"rows\":[[0.5,1.5,null]],\"more\":false}"));
    free(text);
    /* A lost part leaves null. */
    sb_history_add(&table, &(sb_history_rows){1.0, 2, 0, 1, &two[0], &quay});
    add(&table, 1.5, 2, 3);
    assert_int_equal(sb_history_count(&table), 3);
    text = text_of(&table, table.generation, 1, 1000);
    assert_non_null(strstr(text, "\"from\":1,"));
    assert_non_null(strstr(text, "\"rows\":[[1,1.5,null],[1.5,2,3]]"));
    free(text);
    text = text_of(&table, table.generation, 0, 1);
    assert_non_null(strstr(text, "\"rows\":[[0.5,1.5,null]],\"more\":true}"));
    free(text);
    sb_history_free(&table);
}

/* 100 000 rows fit; the peak of 0.1 ms stays. */
static void full_table_keeps_peaks(void **state)
{
    (void)state;
    sb_history_table table = table_of(1);
    for (int i = 0; i < 100000; i++) add(&table, 1e-3 * i, i == 54321 ? -99 : 1, 2);
    assert_true(sb_history_count(&table) <= 8192 && sb_history_count(&table) > 4000);
    assert_int_equal(table.stride, 16);
    float lowest = 0;
    double when = 0;
    for (size_t r = 0; r < sb_history_count(&table); r++) {
        if (r > 0) assert_true(table.time[r] > table.time[r - 1]);
        if (table.value[2 * r] < lowest) {
            lowest = table.value[2 * r];
            when = table.time[r];
        }
    }
    assert_near((double)lowest, -99, 0);
    assert_near(when, 54.321, 0.016);
    sb_history_free(&table);
}

static void resumed_run(void **state)
{
    (void)state;
    sb_history_table table = table_of(1);
    for (int i = 0; i < 10; i++) add(&table, i, 1, 2);
    const uint64_t generation = table.generation;
    sb_history_cut(&table, 6);
    assert_int_equal(sb_history_count(&table), 6);
    assert_true(table.generation != generation);
    add(&table, 6, 3, 4);
    assert_int_equal(sb_history_count(&table), 7);
    const uint64_t before = table.generation;
    sb_history_cut(&table, 7);
    assert_int_equal(table.generation, before); /* nothing to forget */
    /* Another number of names is another run. */
    static const name one = "tower";
    const float value = 5;
    sb_history_add(&table, &(sb_history_rows){7, 1, 0, 1, &one, &value});
    assert_int_equal(sb_history_count(&table), 1);
    /* And so is another name. */
    static const name other = "<b>";
    sb_history_add(&table, &(sb_history_rows){8, 1, 0, 1, &other, &value});
    assert_int_equal(sb_history_count(&table), 1);
    sb_history_free(&table);
}

static void nonsense_is_ignored(void **state)
{
    (void)state;
    sb_history_table table = table_of(3);
    const float values[6] = {0};
    sb_history_add(&table, &(sb_history_rows){0, 0, 0, 0, two, values});
    sb_history_add(&table, &(sb_history_rows){0, 1, 0, 2, two, values});
    sb_history_add(&table, &(sb_history_rows){0, 2, 2, 1, two, values});
    assert_int_equal(sb_history_count(&table), 0);
    char *text = text_of(&table, 5, 7, 100);
    assert_non_null(strstr(text, "\"from\":0"));
    assert_non_null(strstr(text, "\"names\":[],\"rows\":[],\"more\":false}"));
    free(text);
    sb_history_cut(&table, 0);
    sb_history_free(&table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_in_parts),
        cmocka_unit_test(full_table_keeps_peaks),
        cmocka_unit_test(resumed_run),
        cmocka_unit_test(nonsense_is_ignored),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
