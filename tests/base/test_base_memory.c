/* Memory, errors, hashes, random numbers and vectors. */
#include "../check.h"
#include "base/hash.h"
#include "base/memory.h"
#include "base/random.h"
#include "base/status.h"
#include "base/vec.h"

#include <string.h>

static void memory_is_zeroed_and_aligned(void **state)
{
    (void)state;
    for (size_t count = 0; count < 300; count += 7) {
        unsigned char *bytes = sb_alloc(count, 3);
        assert_non_null(bytes);
        assert_int_equal((uintptr_t)bytes % 64, 0);
        for (size_t i = 0; i < 3 * count; i++) assert_int_equal(bytes[i], 0);
        memset(bytes, 0xff, 3 * count); /* so that a missing initialisation of reused memory is detected */
        sb_free(bytes);
    }
    sb_free(NULL);
}

static void absurd_sizes_are_refused(void **state)
{
    (void)state;
    assert_null(sb_alloc(SIZE_MAX, 2));
    assert_null(sb_alloc(SIZE_MAX / 2 + 1, 2));
    assert_null(sb_alloc_untouched(SIZE_MAX, 1));
    assert_null(sb_alloc(1, SIZE_MAX - 32));
}

static void the_chosen_allocation_fails_once(void **state)
{
    (void)state;
    sb_memory_fail_at(3);
    void *first = sb_alloc(1, 1), *second = sb_alloc_untouched(1, 1);
    assert_true(first && second);
    assert_null(sb_strdup("third"));
    char *fourth = sb_strdup("fourth");
    assert_string_equal(fourth, "fourth");
    sb_memory_fail_at(1);
    sb_memory_fail_at(0);
    void *fifth = sb_alloc(1, 1);
    assert_non_null(fifth);
    sb_free(first);
    sb_free(second);
    sb_free(fourth);
    sb_free(fifth);
    assert_null(sb_strdup(NULL));
}

static void growing_keeps_the_contents(void **state)
{
    (void)state;
    int *array = NULL;
    size_t capacity = 0;
    for (int i = 0; i < 1000; i++) {
        assert_int_equal(sb_grow((void **)&array, &capacity, (size_t)i + 1, sizeof *array), 0);
        assert_true(capacity > (size_t)i);
        array[i] = i;
    }
    assert_true(capacity >= 1000 && capacity <= 2048);
    for (int i = 0; i < 1000; i++) assert_int_equal(array[i], i);

    int *kept = array;
    size_t kept_capacity = capacity;
    sb_memory_fail_at(1);
    assert_int_equal(sb_grow((void **)&array, &capacity, capacity + 1, sizeof *array), -1);
    assert_int_equal(sb_grow((void **)&array, &capacity, SIZE_MAX, sizeof *array), -1);
    assert_int_equal(sb_grow((void **)&array, &capacity, SIZE_MAX / 2, sizeof *array), -1);
    assert_ptr_equal(array, kept);
    assert_int_equal(capacity, kept_capacity);
    assert_int_equal(array[999], 999);
    sb_free(array);
}

static void memory_figures_are_plausible(void **state)
{
    (void)state;
    assert_true(sb_memory_available() > 1 << 20);
    size_t before = sb_memory_peak();
    assert_true(before > 100000);
    unsigned char *bytes = sb_alloc(64 << 20, 1);
    assert_non_null(bytes);
    for (size_t i = 0; i < 64 << 20; i += 4096) *(volatile unsigned char *)&bytes[i] = 1;
    assert_true(sb_memory_peak() >= before + (32 << 20));
    sb_free(bytes);
}

static void errors_hold_one_line(void **state)
{
    (void)state;
    sb_error error = {0};
    assert_int_equal(sb_fail(&error, SB_BAD_INPUT, "%s: %d is too many", "x", 7), SB_BAD_INPUT);
    assert_int_equal(error.status, SB_BAD_INPUT);
    assert_string_equal(error.text, "x: 7 is too many");
    assert_int_equal(sb_fail_memory(&error, "particles"), SB_FAILED);
    assert_string_equal(error.text, "out of memory for particles");
    assert_int_equal(sb_fail(NULL, SB_FAILED, "no error struct"), SB_FAILED);
    char text[3000];
    memset(text, 'y', sizeof text);
    text[sizeof text - 1] = '\0';
    sb_fail(&error, SB_FAILED, "%s", text);
    assert_int_equal(strlen(error.text), sizeof error.text - 1);
}

static void check_all_differ(const uint64_t *hashes, size_t count)
{
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < i; j++) assert_true(hashes[i] != hashes[j]);
}

/* The hash changes with every flipped bit, with the seed, and with the length of the same bytes. */
static void different_bytes_have_different_hashes(void **state)
{
    (void)state;
    enum { LENGTH = 29, BITS = 8 * LENGTH };
    unsigned char bytes[LENGTH] = {0};
    uint64_t hashes[BITS + 1];
    for (size_t bit = 0; bit < BITS; bit++) {
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        hashes[bit] = sb_hash(0, bytes, LENGTH);
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
    }
    hashes[BITS] = sb_hash(0, bytes, LENGTH);
    check_all_differ(hashes, BITS + 1);
    for (size_t length = 0; length <= LENGTH; length++) hashes[length] = sb_hash(0, bytes, length);
    check_all_differ(hashes, LENGTH + 1);
    for (size_t seed = 0; seed < 100; seed++) hashes[seed] = sb_hash(seed, bytes, LENGTH);
    check_all_differ(hashes, 100);
    /* The hash does not depend on the alignment. */
    memcpy(bytes, "xabcdefghijklmnopqrstuvwxyz", 27);
    unsigned char shifted[LENGTH];
    memcpy(shifted, bytes + 1, 20);
    assert_true(sb_hash(5, bytes + 1, 20) == sb_hash(5, shifted, 20));
}

/* The hash does not depend on how the bytes are divided into pieces. Reading the hash in between does not change it. */
static void hashes_do_not_depend_on_pieces(void **state)
{
    (void)state;
    enum { LENGTH = 5000 };
    unsigned char bytes[LENGTH];
    for (size_t i = 0; i < LENGTH; i++) bytes[i] = (unsigned char)(255 * sb_random(3, i));
    sb_running_hash whole = {0};
    sb_hash_add(&whole, bytes, LENGTH);
    for (size_t piece = 1; piece < LENGTH; piece += 1 + piece / 7) {
        sb_running_hash parts = {0};
        for (size_t at = 0; at < LENGTH; at += piece) {
            sb_hash_add(&parts, bytes + at, at + piece < LENGTH ? piece : LENGTH - at);
            assert_true((sb_hash_sum(&parts) == sb_hash_sum(&whole)) == (at + piece >= LENGTH));
        }
    }
}

static void random_numbers_are_uniform_and_repeatable(void **state)
{
    (void)state;
    enum { COUNT = 100000, BINS = 10 };
    int bins[BINS] = {0};
    double sum = 0, product = 0, last = 0.5;
    for (uint64_t i = 0; i < COUNT; i++) {
        double value = sb_random(42, i);
        assert_true(value >= 0 && value < 1);
        bins[(int)(value * BINS)]++;
        sum += value;
        product += (value - 0.5) * (last - 0.5);
        last = value;
    }
    assert_near(sum / COUNT, 0.5, 5e-3);
    assert_near(product / COUNT, 0, 2e-3);
    for (int i = 0; i < BINS; i++) assert_true(bins[i] > 9500 && bins[i] < 10500);
    assert_true(sb_random(42, 7) == sb_random(42, 7));
    assert_true(sb_random(42, 7) != sb_random(43, 7));
    assert_true(sb_random(0, 0) != sb_random(0, 1));
}

static void vector_functions_are_correct(void **state)
{
    (void)state;
    sb_vec3 a = sb_vec(1, -2, 3), b = sb_vec(4, 5, -6), c = sb_cross(a, b);
    assert_near(sb_dot(a, b), -24, 0);
    assert_near(sb_dot(c, a), 0, 1e-12);
    assert_near(sb_dot(c, b), 0, 1e-12);
    assert_near(sb_cross(sb_vec(1, 0, 0), sb_vec(0, 1, 0)).z, 1, 0);
    assert_near(sb_norm(sb_normalize(a)), 1, 1e-15);
    assert_true(sb_norm(sb_normalize(sb_vec(0, 0, 0))) == 0);
    assert_near(sb_madd(a, 2, b).y, 8, 0);
    assert_near(sb_norm(sb_sub(sb_add(a, b), sb_add(sb_min(a, b), sb_max(a, b)))), 0, 0);
    assert_true(sb_isfinite(a) && !sb_isfinite(sb_vec(0, (double)NAN, 0)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_is_zeroed_and_aligned),
        cmocka_unit_test(absurd_sizes_are_refused),
        cmocka_unit_test(the_chosen_allocation_fails_once),
        cmocka_unit_test(growing_keeps_the_contents),
        cmocka_unit_test(memory_figures_are_plausible),
        cmocka_unit_test(errors_hold_one_line),
        cmocka_unit_test(different_bytes_have_different_hashes),
        cmocka_unit_test(random_numbers_are_uniform_and_repeatable),
        cmocka_unit_test(vector_functions_are_correct),
        cmocka_unit_test(hashes_do_not_depend_on_pieces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
