#include "sim/passes/cpu/hits.h"

#include <math.h>

#if defined(__x86_64__)
#include <immintrin.h>
#define SB_AVX512
#endif

SB_MULTIVERSION
size_t sb_find_hits_portable(const sb_candidates *of, const sb_candidate_range *range, size_t ranges, sb_hits *h,
                             sb_f4 self, float scale2, uint32_t skip)
{
    size_t n = 0;
    for (size_t s = 0; s < ranges; s++)
        for (uint32_t k = range[s].begin; k < range[s].end && n < SB_HITS_MAX; k++) {
            float x = self[0] - of->x[k], y = self[1] - of->y[k], z = self[2] - of->z[k];
            float q2 = fmaf(x, x, fmaf(y, y, z * z)) * scale2;
            h->x[n] = x;
            h->y[n] = y;
            h->z[n] = z;
            h->q2[n] = q2;
            h->candidate[n] = k;
            n += (q2 < 1.0f) & (k != skip);
        }
    return n;
}

#ifdef SB_AVX512
#define WIDE __attribute__((target("avx512f")))
enum { LANES = 16, BATCH = 8, BATCHES = SB_CANDIDATES_MAX / LANES + SB_CANDIDATE_RANGES_MAX + BATCH };

/* Candidates to be tested together: LANES candidates from `begin` on, of which those below `end` count. */
typedef struct batches {
    size_t count;
    uint32_t begin[BATCHES], end[BATCHES];
} batches;

/* Divides the ranges into batches of sixteen, eight batches at a time. There is no branch on the length of a range,
   because processors cannot predict it. */
WIDE SB_INLINE void divide(const sb_candidate_range *range, size_t ranges, batches *b)
{
    const __m256i starts =
        _mm256_setr_epi32(0, LANES, 2 * LANES, 3 * LANES, 4 * LANES, 5 * LANES, 6 * LANES, 7 * LANES);
    size_t count = 0;
    for (size_t s = 0; s < ranges; s++) {
        const uint32_t end = range[s].end;
        for (uint32_t k = range[s].begin; k < end; k += BATCH * LANES) {
            const uint32_t left = (end - k + LANES - 1) / LANES;
            const __m256i begin = _mm256_add_epi32(_mm256_set1_epi32((int)k), starts);
            _mm256_storeu_si256((__m256i_u *)(b->begin + count), begin);
            _mm256_storeu_si256((__m256i_u *)(b->end + count), _mm256_set1_epi32((int)end));
            count += left < BATCH ? left : BATCH;
        }
    }
    b->count = count;
}

/* Offsets from sixteen candidates, and their squared lengths in units of the support radius. */
typedef struct offsets {
    __m512 x, y, z, q2;
} offsets;

WIDE SB_INLINE offsets offsets_from(sb_f4 self, __m512 x, __m512 y, __m512 z, float scale2)
{
    x = _mm512_sub_ps(_mm512_set1_ps(self[0]), x);
    y = _mm512_sub_ps(_mm512_set1_ps(self[1]), y);
    z = _mm512_sub_ps(_mm512_set1_ps(self[2]), z);
    const __m512 r2 = _mm512_fmadd_ps(x, x, _mm512_fmadd_ps(y, y, _mm512_mul_ps(z, z)));
    return (offsets){x, y, z, _mm512_mul_ps(r2, _mm512_set1_ps(scale2))};
}

/* The records of hits 0, 4, 8 and 12. */
WIDE SB_INLINE __m512 every_fourth(const sb_f4 *place, const uint32_t *hit)
{
    __m512 records = _mm512_castps128_ps512((__m128)place[hit[0]]);
    records = _mm512_insertf32x4(records, (__m128)place[hit[4]], 1);
    records = _mm512_insertf32x4(records, (__m128)place[hit[8]], 2);
    return _mm512_insertf32x4(records, (__m128)place[hit[12]], 3);
}

/* Offsets from sixteen hits: their records are loaded again and transposed into lanes. */
WIDE SB_INLINE offsets offsets_of(sb_f4 self, const sb_f4 *place, const uint32_t *hit, float scale2)
{
    const __m512 a = every_fourth(place, hit), b = every_fourth(place, hit + 1);
    const __m512 c = every_fourth(place, hit + 2), d = every_fourth(place, hit + 3);
    const __m512d ab = _mm512_castps_pd(_mm512_unpacklo_ps(a, b)), cd = _mm512_castps_pd(_mm512_unpacklo_ps(c, d));
    const __m512d z =
        _mm512_unpacklo_pd(_mm512_castps_pd(_mm512_unpackhi_ps(a, b)), _mm512_castps_pd(_mm512_unpackhi_ps(c, d)));
    return offsets_from(self, _mm512_castpd_ps(_mm512_unpacklo_pd(ab, cd)),
                        _mm512_castpd_ps(_mm512_unpackhi_pd(ab, cd)), _mm512_castpd_ps(z), scale2);
}

/* Compresses only the indices of the hits, and computes the offsets again from them. Compressing costs most, and one
   candidate in seven is a hit. */
WIDE static size_t find_avx512(const sb_candidates *of, const sb_candidate_range *range, size_t ranges, sb_hits *h,
                               sb_f4 self, float scale2, uint32_t skip)
{
    const __m512i own = _mm512_set1_epi32((int)skip);
    const __m512i lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    const float *x = of->x, *y = of->y, *z = of->z;
    uint32_t *hit = h->candidate;
    batches b;
    size_t n = 0;
    divide(range, ranges, &b);
    for (size_t m = 0; m < b.count && n < SB_HITS_MAX; m++) {
        const uint32_t k = b.begin[m];
        const __m512i candidate = _mm512_add_epi32(lanes, _mm512_set1_epi32((int)k));
        const offsets at =
            offsets_from(self, _mm512_loadu_ps(x + k), _mm512_loadu_ps(y + k), _mm512_loadu_ps(z + k), scale2);
        __mmask16 near = _mm512_cmplt_epi32_mask(candidate, _mm512_set1_epi32((int)b.end[m]));
        near = _mm512_mask_cmpneq_epi32_mask(near, candidate, own);
        near = _mm512_mask_cmp_ps_mask(near, at.q2, _mm512_set1_ps(1.0f), _CMP_LT_OQ);
        _mm512_storeu_si512(hit + n, _mm512_maskz_compress_epi32(near, candidate));
        n += (size_t)__builtin_popcount(near);
    }
    _mm512_storeu_si512(hit + n, _mm512_setzero_si512()); /* loads beyond the last hit must read a candidate */
    for (size_t k = 0; k < n; k += LANES) {
        const offsets at = offsets_of(self, of->place, hit + k, scale2);
        _mm512_storeu_ps(h->x + k, at.x);
        _mm512_storeu_ps(h->y + k, at.y);
        _mm512_storeu_ps(h->z + k, at.z);
        _mm512_storeu_ps(h->q2 + k, at.q2);
    }
    return n;
}
#endif

sb_find_hits *sb_find_hits_choose(void)
{
#ifdef SB_AVX512
    if (__builtin_cpu_supports("avx512f")) return find_avx512;
#endif
    return sb_find_hits_portable;
}
