#include "sim/hits.h"

#include <math.h>

#if defined(__x86_64__)
#include <immintrin.h>
#define SB_AVX512
#endif

SB_MULTIVERSION
static size_t find_portable(const sb_candidates *of, const sb_stretch *stretch, size_t stretches, sb_hits *h,
                            sb_f4 self, float scale2, uint32_t skip)
{
    size_t n = 0;
    for (size_t s = 0; s < stretches; s++)
        for (uint32_t k = stretch[s].begin; k < stretch[s].end && n < SB_LIST_MAX; k++) {
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
__attribute__((target("avx512f"))) static size_t find_avx512(const sb_candidates *of, const sb_stretch *stretch,
                                                             size_t stretches, sb_hits *h, sb_f4 self, float scale2,
                                                             uint32_t skip)
{
    const __m512 sx = _mm512_set1_ps(self[0]), sy = _mm512_set1_ps(self[1]), sz = _mm512_set1_ps(self[2]);
    const __m512 factor = _mm512_set1_ps(scale2), one = _mm512_set1_ps(1.0f);
    const __m512i own = _mm512_set1_epi32((int)skip);
    const __m512i lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    size_t n = 0;
    for (size_t s = 0; s < stretches; s++)
        for (uint32_t k = stretch[s].begin; k < stretch[s].end && n < SB_LIST_MAX; k += 16) {
            const uint32_t left = stretch[s].end - k;
            const __mmask16 valid = (__mmask16)(left < 16 ? (1u << left) - 1 : 0xffffu);
            __m512 x = _mm512_sub_ps(sx, _mm512_loadu_ps(of->x + k));
            __m512 y = _mm512_sub_ps(sy, _mm512_loadu_ps(of->y + k));
            __m512 z = _mm512_sub_ps(sz, _mm512_loadu_ps(of->z + k));
            __m512 q2 = _mm512_mul_ps(_mm512_fmadd_ps(x, x, _mm512_fmadd_ps(y, y, _mm512_mul_ps(z, z))), factor);
            __m512i candidate = _mm512_add_epi32(lanes, _mm512_set1_epi32((int)k));
            __mmask16 near = _mm512_mask_cmp_ps_mask(valid, q2, one, _CMP_LT_OQ);
            near = _mm512_mask_cmpneq_epi32_mask(near, candidate, own);
            _mm512_storeu_ps(h->x + n, _mm512_maskz_compress_ps(near, x));
            _mm512_storeu_ps(h->y + n, _mm512_maskz_compress_ps(near, y));
            _mm512_storeu_ps(h->z + n, _mm512_maskz_compress_ps(near, z));
            _mm512_storeu_si512(h->candidate + n, _mm512_maskz_compress_epi32(near, candidate));
            n += (size_t)__builtin_popcount(near);
        }
    for (size_t k = 0; k < n; k += 16) {
        const __m512 x = _mm512_loadu_ps(h->x + k), y = _mm512_loadu_ps(h->y + k), z = _mm512_loadu_ps(h->z + k);
        const __m512 r2 = _mm512_fmadd_ps(x, x, _mm512_fmadd_ps(y, y, _mm512_mul_ps(z, z)));
        _mm512_storeu_ps(h->q2 + k, _mm512_mul_ps(r2, factor));
    }
    return n;
}
#endif

sb_find_hits *sb_find_hits_choose(void)
{
#ifdef SB_AVX512
    if (__builtin_cpu_supports("avx512f")) return find_avx512;
#endif
    return find_portable;
}
