/* Integer positions, their order along the Z-curve, and the table of used cells. */
#include "base/memory.h"
#include "base/random.h"
#include "check.h"
#include "sim/search/cells.h"
#include "sim/search/sort.h"
#include "sim/state/space.h"
#include "sim/tank.h"

#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CLOUD = 20000 };

static sb_space make_space(sb_vec3 min, sb_vec3 max, double cell)
{
    sb_error error = {0};
    sb_space space;
    if (sb_space_create(min, max, cell, &space, &error) != SB_OK) fail_msg("%s", error.text);
    return space;
}

static sb_vec3 anywhere(sb_vec3 min, sb_vec3 max, uint64_t seed, uint64_t i)
{
    return sb_vec(min.x + (max.x - min.x) * sb_random(seed, 3 * i),
                  min.y + (max.y - min.y) * sb_random(seed, 3 * i + 1),
                  min.z + (max.z - min.z) * sb_random(seed, 3 * i + 2));
}

static void a_position_returns_to_half_a_quantum(void **state)
{
    (void)state;
    const sb_vec3 min = {-3, 2, -40}, max = {1300, 1150, 260};
    sb_space space = make_space(min, max, 4);
    double worst = 0;
    for (uint64_t i = 0; i < CLOUD; i++) {
        sb_vec3 x = anywhere(min, max, 1, i);
        sb_record record = sb_space_record(&space, x);
        sb_vec3 back = sb_space_position(&space, record), d = sb_sub(back, x);
        worst = fmax(worst, fmax(fabs(d.x), fmax(fabs(d.y), fabs(d.z))));
        sb_record again = sb_space_record(&space, back);
        for (int axis = 0; axis < 3; axis++) assert_int_equal(again[axis], record[axis]);
        assert_true(sb_space_inside(&space, record));
    }
    printf("round trip: worst %.3g quanta of %.3g m\n", worst / space.quantum, space.quantum);
    assert_true(worst > 0.49 * space.quantum && worst < 0.5001 * space.quantum);
    sb_record low = sb_space_record(&space, sb_vec(-1e9, -1e300, -100));
    sb_record high = sb_space_record(&space, sb_vec(1e9, 1e300, 1e5));
    for (int axis = 0; axis < 3; axis++) {
        assert_int_equal(low[axis], 0);
        assert_int_equal(high[axis], 0x7fffffff);
        assert_false(sb_space_inside(&space, low) || sb_space_inside(&space, high));
    }
}

static void differences_are_exact_within_three_cells(void **state)
{
    (void)state;
    sb_space space = make_space(sb_vec(0, 0, 0), sb_vec(10, 10, 10), 0.5);
    assert_int_equal(space.shift, 22);
    const double range = 3.0 * (1 << 22);
    sb_record from = sb_space_record(&space, sb_vec(5, 5, 5));
    for (uint64_t i = 0; i < CLOUD; i++) {
        sb_record to = from;
        int64_t step[3];
        for (uint64_t axis = 0; axis < 3; axis++) {
            step[axis] = (int64_t)((2 * sb_random(2, 3 * i + axis) - 1) * range);
            to[axis] = (uint32_t)((int64_t)from[axis] + step[axis]);
        }
        sb_f4 d = sb_offset(to, from);
        for (int axis = 0; axis < 3; axis++) assert_true((double)d[axis] == (double)step[axis]);
    }
}

static void a_thousand_kilometres_change_no_integer(void **state)
{
    (void)state;
    const sb_vec3 max = {100, 50, 20}, away = {1e6, -1e6, 3e5};
    sb_space here = make_space(sb_vec(0, 0, 0), max, 2);
    sb_space there = make_space(away, sb_add(max, away), 2);
    for (uint64_t i = 0; i < CLOUD; i++) {
        sb_vec3 x = anywhere(sb_vec(0, 0, 0), max, 3, i);
        /* Rounded to 2^-30 m, so that the sums with whole metres are exact in double. */
        x = sb_vec(ldexp(rint(ldexp(x.x, 30)), -30), ldexp(rint(ldexp(x.y, 30)), -30),
                   ldexp(rint(ldexp(x.z, 30)), -30));
        sb_record a = sb_space_record(&here, x), b = sb_space_record(&there, sb_add(x, away));
        for (int axis = 0; axis < 3; axis++) assert_int_equal(a[axis], b[axis]);
        assert_true(sb_space_key(&here, a) == sb_space_key(&there, b));
    }
}

/* The same dam break near the origin and far from it, after some steps. */
static void a_run_far_away_is_the_same_run(void **state)
{
    (void)state;
    enum { STEPS = 20 };
    const sb_vec3 away = {1e6, 0, -2e6};
    tank near, far;
    tank_make(&near, 2, 0.0625, sb_vec(2, 0, 2), 1, 1, 0);
    tank_make(&far, 2, 0.0625, sb_vec(2, 0, 2), 1, 1, 0);
    tank_shift(&far, away);
    sb_sim *a = tank_sim(&near), *b = tank_sim(&far);
    assert_non_null(a);
    assert_non_null(b);
    assert_int_equal(tank_steps(a, STEPS), 0);
    assert_int_equal(tank_steps(b, STEPS), 0);
    assert_int_equal(a->state.n, near.model.fluid_count);
    assert_int_equal(b->state.n, a->state.n);
    for (size_t i = 0; i < a->state.n; i++) {
        assert_memory_equal(&a->state.position[i], &b->state.position[i], 12);
        assert_memory_equal(&a->state.velocity[i], &b->state.velocity[i], 16);
        assert_int_equal(a->state.id[i], b->state.id[i]);
    }
    assert_true(a->report.time == b->report.time);
    assert_true(a->report.max_speed > 0.1);
    sb_sim_destroy(a);
    sb_sim_destroy(b);
    tank_free(&near);
    tank_free(&far);
}

static void a_domain_beyond_the_integers_is_refused(void **state)
{
    (void)state;
    sb_error error = {0};
    sb_space space;
    /* Too long along one axis; and too many cells, although each axis alone is within the limit. */
    assert_int_equal(sb_space_create(sb_vec(0, 0, 0), sb_vec(1e6, 1, 1), 1, &space, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "expected fewer"));
    error = (sb_error){0};
    assert_int_equal(sb_space_create(sb_vec(0, 0, 0), sb_vec(1e5, 1e5, 1e5), 1, &space, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "expected"));
    /* The largest permitted domain leaves room for 2^27 particles in a sort word of 64 bits. */
    space = make_space(sb_vec(0, 0, 0), sb_vec(1.2e5, 0, 1e5), 1);
    assert_int_equal(space.key_bits, 64 - 27);
}

/* ---- sorting ---- */

typedef struct ranked {
    uint64_t key, word;
    size_t place;
} ranked;

static int by_key_then_place(const void *a, const void *b)
{
    const ranked *x = a, *y = b;
    if (x->key != y->key) return x->key < y->key ? -1 : 1;
    return x->place < y->place ? -1 : x->place > y->place;
}

static void check_sort(size_t count, int low, int high, int threads)
{
    uint64_t *words = sb_alloc(count, 8), *other = sb_alloc(count, 8);
    ranked *expected = sb_alloc(count, sizeof *expected);
    assert_true(words && other && expected);
    uint64_t mask = high == 64 ? UINT64_MAX : ((uint64_t)1 << high) - 1;
    for (size_t i = 0; i < count; i++) {
        /* Few different keys, so that stability is tested. */
        words[i] = sb_hash_mix(i + 1) & ~((uint64_t)0x1ffff0 << low);
        expected[i] = (ranked){(words[i] & mask) >> low, words[i], i};
    }
    omp_set_num_threads(threads);
    qsort(expected, count, sizeof *expected, by_key_then_place);
    const uint64_t *sorted = sb_sort(words, other, count, low, high);
    assert_true(sorted == words || sorted == other);
    for (size_t i = 0; i < count; i++)
        if (sorted[i] != expected[i].word)
            fail_msg("%zu words, bits %d to %d, %d threads: wrong word at %zu", count, low, high, threads, i);
    sb_free(words);
    sb_free(other);
    sb_free(expected);
}

static void sorting_is_stable_for_any_number_of_threads(void **state)
{
    (void)state;
    const size_t counts[] = {0, 1, 2, 1000, 65535, 100003};
    const int threads[] = {1, 2, 3, 8};
    int before = omp_get_max_threads();
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++)
        for (size_t t = 0; t < sizeof threads / sizeof *threads; t++) {
            check_sort(counts[c], 27, 27 + 21, threads[t]);
            check_sort(counts[c], 27, 64, threads[t]);
            check_sort(counts[c], 0, 8, threads[t]);
        }
    omp_set_num_threads(before);
    uint64_t words[2] = {2, 1}, other[2];
    sb_memory_fail_at(1);
    assert_null(sb_sort(words, other, 2, 0, 8));
}

/* ---- cells ---- */

typedef struct cloud {
    sb_space space;
    sb_record *record;
    size_t count;
} cloud;

/* A sorted cloud that leaves many cells empty: it lies on two planes and in a cluster. */
static cloud make_cloud(sb_vec3 min, sb_vec3 max, double cell)
{
    cloud c = {.space = make_space(min, max, cell), .count = CLOUD};
    uint64_t *words = sb_alloc(CLOUD, 8), *other = sb_alloc(CLOUD, 8);
    sb_record *raw = sb_alloc(CLOUD, sizeof *raw);
    c.record = sb_alloc(CLOUD, sizeof *c.record);
    assert_true(words && other && raw && c.record);
    for (uint64_t i = 0; i < CLOUD; i++) {
        sb_vec3 x = anywhere(min, max, 5, i), size = sb_sub(max, min);
        if (i % 3 == 0) x.z = min.z + 0.3 * size.z + 0.05 * (x.x - min.x);
        if (i % 3 == 1) x.x = min.x + 0.7 * size.x;
        if (i % 3 == 2) x = sb_madd(min, 0.1, sb_sub(x, min));
        raw[i] = sb_space_record(&c.space, x);
        words[i] = sb_space_key(&c.space, raw[i]) << 27 | i;
    }
    const uint64_t *sorted = sb_sort(words, other, CLOUD, SB_INDEX_BITS, SB_INDEX_BITS + c.space.key_bits);
    assert_non_null(sorted);
    for (size_t i = 0; i < CLOUD; i++) c.record[i] = raw[sorted[i] & ((1 << 27) - 1)];
    sb_free(words);
    sb_free(other);
    sb_free(raw);
    return c;
}

static void check_cells(const cloud *c, const sb_cells *cells)
{
    int shift = c->space.shift;
    assert_int_equal(cells->begin[0], 0);
    assert_int_equal(cells->begin[cells->count], c->count);
    for (size_t k = 0; k < cells->count; k++) {
        assert_true(cells->begin[k] < cells->begin[k + 1]);
        assert_int_equal(sb_cells_find(cells, cells->code[k]), k);
        for (uint32_t i = cells->begin[k]; i < cells->begin[k + 1]; i++)
            assert_true(sb_cell_code(c->record[i], shift) == cells->code[k]);
        if (k > 0) {
            sb_record last = c->record[cells->begin[k] - 1], first = c->record[cells->begin[k]];
            assert_true(sb_space_key(&c->space, last) < sb_space_key(&c->space, first));
        }
    }
}

static void all_used_cells_are_found_and_no_other(void **state)
{
    (void)state;
    const sb_vec3 min = {-10, 4, 100}, max = {15, 20, 109};
    cloud c = make_cloud(min, max, 1);
    sb_cells cells = {0};
    assert_int_equal(sb_cells_build(&cells, c.record, c.count, c.space.shift), 0);
    check_cells(&c, &cells);
    /* Compares every cell of the grid with a separate table. */
    static bool used[64][64][64];
    memset(used, 0, sizeof used);
    size_t distinct = 0, found = 0;
    for (size_t i = 0; i < c.count; i++) {
        sb_record cell = c.record[i] >> (uint32_t)c.space.shift;
        bool *mark = &used[cell[0]][cell[1]][cell[2]];
        distinct += !*mark;
        *mark = true;
    }
    assert_int_equal(cells.count, distinct);
    for (uint64_t z = 0; z < 64; z++)
        for (uint64_t y = 0; y < 64; y++)
            for (uint64_t x = 0; x < 64; x++) {
                int64_t k = sb_cells_find(&cells, x | y << 21 | z << 42);
                assert_true((k >= 0) == used[x][y][z]);
                found += k >= 0;
            }
    assert_int_equal(found, distinct);
    assert_true(distinct < 25 * 16 * 9 * 9 / 10);
    /* Fewer cells in the same tables, no cells, and failing allocations. */
    assert_int_equal(sb_cells_build(&cells, c.record, 7, c.space.shift), 0);
    assert_int_equal(cells.begin[cells.count], 7);
    assert_int_equal(sb_cells_build(&cells, c.record, 0, c.space.shift), 0);
    assert_int_equal(cells.count, 0);
    assert_int_equal(sb_cells_find(&cells, sb_cell_code(c.record[0], c.space.shift)), -1);
    sb_cells_free(&cells);
    for (long n = 1; n <= 4; n++) {
        sb_memory_fail_at(n);
        assert_int_equal(sb_cells_build(&cells, c.record, c.count, c.space.shift), -1);
        assert_int_equal(cells.count, 0);
        sb_cells_free(&cells);
    }
    sb_memory_fail_at(0);
    sb_free(c.record);
}

/* 3 km by 3 km by 10 m at h = 0.1 m: memory must be proportional to the number of used cells. */
static void a_vast_domain_costs_only_its_used_cells(void **state)
{
    (void)state;
    cloud c = make_cloud(sb_vec(0, 0, 0), sb_vec(3000, 3000, 10), 0.1);
    sb_cells cells = {0};
    assert_int_equal(sb_cells_build(&cells, c.record, c.count, c.space.shift), 0);
    check_cells(&c, &cells);
    printf("vast domain: %d key bits, %zu cells used, %.1f bytes for each\n", c.space.key_bits, cells.count,
           (double)sb_cells_bytes(&cells) / (double)cells.count);
    assert_true(sb_cells_bytes(&cells) < 40 * cells.count);
    sb_cells_free(&cells);
    sb_free(c.record);
}

/* Keys are unique on the grid, and eight successive keys are a cube of 2 x 2 x 2 cells. */
static void keys_follow_the_z_curve(void **state)
{
    (void)state;
    sb_space space = make_space(sb_vec(0, 0, 0), sb_vec(27, 11, 3), 1);
    assert_int_equal(space.key_bits, 5 + 4 + 3);
    static bool seen[1 << 12];
    memset(seen, 0, sizeof seen);
    for (uint32_t x = 0; x < 32; x++)
        for (uint32_t y = 0; y < 16; y++)
            for (uint32_t z = 0; z < 8; z++) {
                sb_record record = {x << space.shift, y << space.shift, z << space.shift, 0};
                sb_record even = {(x & ~1u) << space.shift, (y & ~1u) << space.shift, (z & ~1u) << space.shift, 0};
                uint64_t key = sb_space_key(&space, record);
                assert_true(key < 1 << 12 && !seen[key]);
                seen[key] = true;
                assert_true(key >> 3 == sb_space_key(&space, even) >> 3);
                assert_int_equal(key & 7, (x & 1) | (y & 1) << 1 | (z & 1) << 2);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_position_returns_to_half_a_quantum),
        cmocka_unit_test(differences_are_exact_within_three_cells),
        cmocka_unit_test(a_thousand_kilometres_change_no_integer),
        cmocka_unit_test(a_run_far_away_is_the_same_run),
        cmocka_unit_test(a_domain_beyond_the_integers_is_refused),
        cmocka_unit_test(sorting_is_stable_for_any_number_of_threads),
        cmocka_unit_test(all_used_cells_are_found_and_no_other),
        cmocka_unit_test(a_vast_domain_costs_only_its_used_cells),
        cmocka_unit_test(keys_follow_the_z_curve),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
