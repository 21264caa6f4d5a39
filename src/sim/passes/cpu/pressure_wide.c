/* The pressure passes with vectors of 64 bytes: the records of four neighbours instead of two. The lanes are the two
   sums of the narrow form side by side, so that both forms add the same terms in the same order. */
#include "sim/passes/cpu/cpu.h"
#include "sim/passes/groups.h"

#if defined(SB_MULTIVERSIONED) || (defined(SB_NATIVE) && defined(__AVX512BW__) && defined(__AVX512DQ__) &&             \
                                   defined(__AVX512VL__) && defined(__FMA__))
#include <immintrin.h>

/* The instructions of x86-64-v4, the set that the loader selects on processors with such vectors. Products and sums are
   contracted as in the narrow form, so that both forms round alike (tests/sim/test_pressure.c). The instructions are
   named one by one because a build for one processor has more than that set. */
#define WIDE __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,fma,bmi,bmi2")))

/* The slopes of four neighbours, each in four lanes: a byte shuffle puts 16 bits into the lower half of a lane. */
WIDE SB_INLINE __m512 four_slopes(const uint16_t *slope)
{
    const int32_t first = (int32_t)0x80800100, step = 0x202; /* bytes 1 and 0; 3 and 2; ... */
    const int32_t a = first, b = a + step, c = b + step, d = c + step;
    const __m512i pick = _mm512_setr_epi32(a, a, a, a, b, b, b, b, c, c, c, c, d, d, d, d);
    int64_t bits;
    memcpy(&bits, slope, sizeof bits);
    const __m512 root = _mm512_cvtepi32_ps(_mm512_shuffle_epi8(_mm512_set1_epi64(bits), pick));
    return _mm512_mul_ps(root, root);
}

/* The records of four neighbours in the output of sb_around. */
WIDE SB_INLINE __m512 four_at(const sb_f4 *around, const uint16_t *place)
{
    __m512 records = _mm512_castps128_ps512((__m128)*sb_at(around, place[0]));
    records = _mm512_insertf32x4(records, (__m128)*sb_at(around, place[1]), 1);
    records = _mm512_insertf32x4(records, (__m128)*sb_at(around, place[2]), 2);
    return _mm512_insertf32x4(records, (__m128)*sb_at(around, place[3]), 3);
}

/* Record and value of a neighbour, then those of the next, in the output of sb_around_with. */
WIDE SB_INLINE __m512 two_with(const sb_f4 *around, const uint16_t *place)
{
    const __m512 one = _mm512_castps256_ps512((__m256)*sb_both_at(around, place[0]));
    return _mm512_insertf32x8(one, (__m256)*sb_both_at(around, place[1]), 1);
}

/* The sum of the four quarters, in the order of the narrow form. */
WIDE SB_INLINE sb_f4 fold(__m512 v)
{
    const __m256 both = _mm256_add_ps(_mm512_castps512_ps256(v), _mm512_extractf32x8_ps(v, 1));
    return (sb_f4)_mm_add_ps(_mm256_castps256_ps128(both), _mm256_extractf128_ps(both, 1));
}

WIDE static void accelerate_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    (void)arguments;
    const bool reflects = sim->needs.images;
    const sb_wall_vectors wall = sb_wall_vectors_of(sim);
    _Alignas(64) sb_f4 around[SB_AROUND_MAX];
    sb_around(sim, group, around);
    for (size_t i = group->first; i < group->end; i++) {
        const sb_four_pairs *four = sim->work.pairs.four + sim->work.pairs.first[i],
                            *end = four + sim->work.pairs.count[i];
        const sb_f4 own = sb_in_group(sim, group, i);
        const __m512 self = _mm512_broadcast_f32x4((__m128)own), q = _mm512_set1_ps(own[3]);
        __m512 total = _mm512_setzero_ps();
        for (; four < end; four++) {
            sb_prefetch(four);
            const __m512 at = four_at(around, four->place);
            const __m512 both = _mm512_add_ps(q, _mm512_permute_ps(at, 0xff)); /* q_i + q_j in all lanes of j */
            const __m512 weight = _mm512_mul_ps(both, four_slopes(four->slope));
            total = _mm512_fmadd_ps(_mm512_sub_ps(self, at), weight, total);
        }
        const sb_f4 sum = fold(total) * sb_splat(sim->work.pairs.unit) + sb_splat(own[3]) * wall.vector[i * wall.step];
        sim->work.acceleration[i] = (sb_f4){-sum[0], -sum[1], -sum[2], 0};
        if (reflects && sim->work.edge_pairs.count[i] > 0) sim->work.acceleration[i] -= sb_edges_push(sim, i, own[3]);
    }
}

WIDE static void diverge_group(sb_sim *sim, const sb_group *group, const void *arguments)
{
    const sb_divergence *of = arguments;
    const sb_f4 *field = of->field;
    const float factor = of->factor;
    float *out = of->out;
    const bool reflects = sim->needs.images;
    const sb_wall_vectors wall = sb_wall_vectors_of(sim);
    _Alignas(64) sb_f4 around[2 * SB_AROUND_MAX];
    sb_around_vectors(sim, group, field, around);
    for (size_t i = group->first; i < group->end; i++) {
        const sb_four_pairs *four = sim->work.pairs.four + sim->work.pairs.first[i],
                            *end = four + sim->work.pairs.count[i];
        const __m512 self = _mm512_broadcast_f32x4((__m128)sb_in_group(sim, group, i));
        const __m512 own = _mm512_broadcast_f32x4((__m128)field[i]);
        __m512 total = _mm512_setzero_ps();
        for (; four < end; four++) {
            sb_prefetch(four);
            const __m512 ab = two_with(around, four->place), cd = two_with(around, four->place + 2);
            const __m512 at = _mm512_shuffle_f32x4(ab, cd, 0x88), value = _mm512_shuffle_f32x4(ab, cd, 0xdd);
            const __m512 weight = _mm512_mul_ps(_mm512_sub_ps(own, value), four_slopes(four->slope));
            total = _mm512_fmadd_ps(_mm512_sub_ps(self, at), weight, total);
        }
        out[i] = factor * sb_sum3(fold(total) * sb_splat(sim->work.pairs.unit) + field[i] * wall.vector[i * wall.step]);
        if (reflects && sim->work.edge_pairs.count[i] > 0) out[i] += factor * sb_edges_flow(sim, i, field);
    }
}

static void accelerate(sb_sim *sim)
{
    sb_each_group(sim, accelerate_group, NULL);
}

static void diverge(sb_sim *sim, const sb_f4 *field, float factor, float *out)
{
    sb_each_group(sim, diverge_group, &(sb_divergence){field, factor, out});
}

static const sb_passes wide = {
    .name = "cpu, vectors of 64 bytes",
    SB_CPU_PASSES,
    .accelerate = accelerate,
    .diverge = diverge,
};

const sb_passes *sb_passes_cpu_wide(void)
{
    __builtin_cpu_init();
    return __builtin_cpu_supports("x86-64-v4") ? &wide : NULL;
}

/* Zen 5 and later are the only AMD processors with this instruction. Their units are as wide as the vectors, and this
   form was measured to be faster on them. On two Xeons other passes with such vectors were slower
   (docs/decisions/0012). Processors that were not measured use the narrow form. */
bool sb_cpu_wide_pays(void)
{
    return __builtin_cpu_is("amd") && __builtin_cpu_supports("avx512vp2intersect");
}
#else
const sb_passes *sb_passes_cpu_wide(void)
{
    return NULL;
}

bool sb_cpu_wide_pays(void)
{
    return false;
}
#endif
