/* The search for hits among candidates: the implementation for this processor finds the same hits as the portable one,
   bit for bit and in the same order, and writes nowhere else. */
#include "sim/passes/cpu/hits.h"

#include "base/memory.h"
#include "base/random.h"
#include "check.h"

#include <string.h>

enum { CANDIDATES = 5000, GUARD = 64 };

typedef struct cloud {
    float x[CANDIDATES + SB_HIT_SPARE], y[CANDIDATES + SB_HIT_SPARE], z[CANDIDATES + SB_HIT_SPARE];
    sb_f4 place[CANDIDATES];
} cloud;

typedef struct guarded {
    sb_hits hits;
    unsigned char after[GUARD];
} guarded;

/* With the largest numbers of ranges and candidates nothing is read or written beyond the arrays. */
static void limits_are_kept(void **state)
{
    (void)state;
    enum { LONG = SB_CANDIDATES_MAX / SB_CANDIDATE_RANGES_MAX / 16 * 16 + 1 };
    float *place = sb_alloc(SB_CANDIDATES_MAX + SB_HIT_SPARE, sizeof *place);
    sb_f4 *record = sb_alloc(SB_CANDIDATES_MAX, sizeof *record);
    guarded *out = sb_alloc(1, sizeof *out);
    assert_true(place && record && out);
    sb_candidate_range range[SB_CANDIDATE_RANGES_MAX];
    for (uint32_t s = 0; s < SB_CANDIDATE_RANGES_MAX; s++) range[s] = (sb_candidate_range){s * LONG, (s + 1) * LONG};
    range[SB_CANDIDATE_RANGES_MAX - 1].end = SB_CANDIDATES_MAX;
    const sb_candidates of = {place, place, place, record};
    memset(out, 0xa5, sizeof *out);
    assert_int_equal(sb_find_hits_choose()(&of, range, SB_CANDIDATE_RANGES_MAX, &out->hits, (sb_f4){9, 9, 9, 0}, 1, 7),
                     0);
    assert_true(sb_find_hits_choose()(&of, range, SB_CANDIDATE_RANGES_MAX, &out->hits, (sb_f4){0}, 1, 7) >=
                SB_HITS_MAX);
    const float *const fields[] = {out->hits.x, out->hits.y, out->hits.z, out->hits.q2,
                                   (const float *)out->hits.candidate};
    const uint32_t untouched = 0xa5a5a5a5;
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++)
        assert_memory_equal(fields[f] + SB_HITS_MAX + SB_HIT_SPARE - 1, &untouched, sizeof untouched);
    for (int k = 0; k < GUARD; k++) assert_int_equal(out->after[k], 0xa5);
    sb_free(place);
    sb_free(record);
    sb_free(out);
}

/* Scatters whole quanta in a cube of 4000, as offsets are. */
static void scatter(cloud *c, uint64_t seed)
{
    for (size_t k = 0; k < CANDIDATES; k++) {
        c->x[k] = (float)(int)(4000 * sb_random(seed, 3 * k));
        c->y[k] = (float)(int)(4000 * sb_random(seed, 3 * k + 1));
        c->z[k] = (float)(int)(4000 * sb_random(seed, 3 * k + 2));
        c->place[k] = (sb_f4){c->x[k], c->y[k], c->z[k], 0};
    }
}

static size_t find(sb_find_hits *form, const cloud *c, const sb_candidate_range *range, size_t ranges, float radius,
                   guarded *out)
{
    const sb_f4 self = {c->x[40], c->y[40], c->z[40], 0};
    memset(out->after, 0xa5, GUARD);
    const size_t n =
        form(&(sb_candidates){c->x, c->y, c->z, c->place}, range, ranges, &out->hits, self, 1 / (radius * radius), 40);
    for (int k = 0; k < GUARD; k++) assert_int_equal(out->after[k], 0xa5);
    return n;
}

static void forms_agree(void **state)
{
    (void)state;
    static const sb_candidate_range ranges[][4] = {
        {{0, CANDIDATES}},                                /* all */
        {{0, 1}, {16, 17}, {31, 63}, {4999, 5000}},       /* vectors that are not full, or just full */
        {{40, 41}, {41, 200}, {900, 1044}, {1100, 3000}}, /* longer than eight vectors */
        {{40, 41}},                                       /* only the particle itself */
    };
    static const size_t counts[] = {1, 4, 4, 1};
    static const float radii[] = {300, 1000, 1500, 9000};
    cloud *c = sb_alloc(1, sizeof *c);
    guarded *one = sb_alloc(1, sizeof *one), *other = sb_alloc(1, sizeof *other);
    assert_true(c && one && other);
    for (uint64_t seed = 0; seed < 5; seed++)
        for (size_t s = 0; s < sizeof counts / sizeof *counts; s++)
            for (size_t r = 0; r < sizeof radii / sizeof *radii; r++) {
                scatter(c, seed);
                const size_t n = find(sb_find_hits_portable, c, ranges[s], counts[s], radii[r], one);
                const size_t m = find(sb_find_hits_choose(), c, ranges[s], counts[s], radii[r], other);
                if (n >= SB_HITS_MAX) {
                    assert_true(m >= SB_HITS_MAX);
                    continue;
                }
                assert_int_equal(n, m);
                assert_memory_equal(one->hits.x, other->hits.x, n * 4);
                assert_memory_equal(one->hits.y, other->hits.y, n * 4);
                assert_memory_equal(one->hits.z, other->hits.z, n * 4);
                assert_memory_equal(one->hits.q2, other->hits.q2, n * 4);
                assert_memory_equal(one->hits.candidate, other->hits.candidate, n * 4);
                if (radii[r] > 8000 && s == 1) assert_int_equal(n, 34); /* without the particle itself */
            }
    sb_free(c);
    sb_free(one);
    sb_free(other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(forms_agree), cmocka_unit_test(limits_are_kept)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
